"""terminalsAndIcons.xml: by the schema, and about variables that there are."""

import re
from pathlib import Path

import fmpy
import pytest
from lxml import etree

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"

FLANGE = {"tau": "inflow", "phi": "signal", "w": "signal", "a": "signal", "energy_error": "signal"}
"""The members of `drive`, with the names of Modelica's adaptors between flanges and signals, and one beside them."""


@pytest.fixture
def root(fmu):
    """The file's root element."""
    return etree.parse(fmu.directory / "terminalsAndIcons" / "terminalsAndIcons.xml").getroot()


def test_exact_schema_holds(root):
    etree.XMLSchema(etree.parse(SCHEMA)).assertValid(root.getroottree())
    assert root.get("fmiVersion") == "3.0"


def test_exact_schema_sees_a_slip(root):
    """The schema is one that can fail."""
    root.find("GraphicalRepresentation/Icon").attrib.pop("x1")
    assert not etree.XMLSchema(etree.parse(SCHEMA)).validate(root.getroottree())


def test_exact_members_are_inputs_and_outputs(fmu, root):
    for terminal in root.findall("Terminals/Terminal"):
        members = terminal.findall("TerminalMemberVariable")
        for member in members:
            name = member.get("variableName")
            assert fmu.variables[name].causality in ("input", "output"), name
            assert name == f"{terminal.get('name')}.{member.get('memberName')}"
        assert len({member.get("memberName") for member in members}) == len(members) > 0


def test_exact_a_drive_is_a_terminal(fmu, root):
    named = {terminal.get("name"): terminal for terminal in root.findall("Terminals/Terminal")}
    ports = [name for name in named if re.fullmatch(r"port\[\d\]", name)]
    assert set(ports) == {name.partition(".")[0] for name in fmu.variables if name.startswith("port[")}
    housings = [name for name in named if name.endswith(".housing")]
    assert set(housings) == {name.partition(".moves")[0] for name in fmu.variables if name.endswith(".housing.moves")}
    assert set(named) - set(ports) - set(housings) == {"drive", "imposed_speed"} & {name.partition(".")[0] for name in fmu.variables}
    terminals = [terminal for name, terminal in named.items() if name == "drive"]
    for terminal in terminals:
        members = {m.get("memberName"): m.get("variableKind") for m in terminal.findall("TerminalMemberVariable")}
        assert members == FLANGE
        # A partner with angle and torque only can be connected.
        assert terminal.get("matchingRule") == "bus"
        assert terminal.get("terminalKind") == "Modelica.Mechanics.Rotational.Interfaces.Flange_a"
