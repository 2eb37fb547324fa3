"""`cargo xtask package --ssp`: a system by the schemas of SSP 1.0, with the right connections and boundary. tests/clients/test_ssp_masters.py runs it."""

import zipfile

import project
import pytest
from fmpy.ssp.ssd import Component, read_ssd, read_ssv
from lxml import etree

UNITS = {"N": 'kg="1" m="1" s="-2"', "kN": 'kg="1" m="1" s="-2" factor="1000"', "m": 'm="1"', "rad/s": 's="-1" rad="1"', "K": 'K="1"'}
VARIABLES = [
    ("r.y", "input", "m"),
    ("w", "input", "rad/s"),
    ("T", "input", "K"),
    ("f_y", "output", "N"),
    ("lift", "output", "m"),
    ("k", "parameter", None),
]


@pytest.fixture
def partner(tmp_path):
    """Makes an FMU with these variables, that nothing can run, in this file."""

    def make(name="film.fmu", variables=VARIABLES):
        units = "".join(f'<Unit name="{unit}"><BaseUnit {base}/></Unit>' for unit, base in UNITS.items())
        of = "".join(
            f'<ScalarVariable name="{name}" causality="{causality}"><Real start="0"{f" unit={chr(34)}{unit}{chr(34)}" if unit else ""}/></ScalarVariable>'
            for name, causality, unit in variables
        )
        xml = f"""<fmiModelDescription fmiVersion="2.0"><CoSimulation modelIdentifier="film"/>
            <UnitDefinitions>{units}</UnitDefinitions><ModelVariables>{of}</ModelVariables></fmiModelDescription>"""
        with zipfile.ZipFile(tmp_path / name, "w") as archive:
            archive.writestr("modelDescription.xml", xml)
        return tmp_path / name

    return make


@pytest.fixture
def system(xtask, tmp_path):
    """Packages `rotor` with these options: the path of the package and fmpy's view of it, checked against the schemas."""

    def make(*options):
        project.packaged("rotor")
        done = xtask("package", "rotor", "--platforms", "here", "--ssp", "--out", tmp_path, *options)
        assert done.returncode == 0, done.stderr
        return tmp_path / "rotor.ssp", read_ssd(tmp_path / "rotor.ssp").system

    return make


def connectors(element, kind):
    return {connector.name for connector in element.connectors if connector.kind == kind}


def test_exact_the_rotor_alone_has_all_inputs_and_outputs_at_the_boundary(system, fmus):
    path, system = system("--boundary")
    [rotor] = system.elements
    for kind in ("input", "output"):
        own = {name for name, variable in fmus["rotor"].variables.items() if variable.causality == kind}
        assert connectors(rotor, kind) == own
        assert connectors(system, kind) == {f"rotor_{name}" for name in own}
    assert len(system.connections) == len(rotor.connectors)
    with zipfile.ZipFile(path) as package, zipfile.ZipFile(package.open("resources/rotor.fmu")) as fmu:
        assert "modelDescription.xml" in fmu.namelist()


def test_exact_a_partner_is_connected_by_names_and_the_rest_is_at_the_boundary(system, partner):
    path, system = system("--boundary", "--partner", f"port[2]={partner()}")
    rotor, film = system.elements
    assert isinstance(film, Component) and film.source == "resources/film.fmu"
    inside = {
        f"{of.startElement}.{of.startConnector} {of.endElement}.{of.endConnector}"
        for of in system.connections
        if of.startElement and of.endElement
    }
    assert inside == {"rotor.port[2].r.y film.r.y", "rotor.omega_phi film.w", "film.f_y rotor.port[2].f.y"}
    assert "film_T" in connectors(system, "input") and "film_lift" in connectors(system, "output")
    assert "rotor_port[2].f.y" not in connectors(system, "input") and "rotor_port[2].r.y" not in connectors(system, "output")
    assert "rotor_port[2].f.z" in connectors(system, "input")
    # What is connected acts.
    values = {parameter.name: parameter.value for parameter in read_ssv(path, "resources/rotor.ssv").parameters}
    assert values["effects.port[2]"] == "true" and values["effects.port[1]"] == "false"
    assert [parameter.name for parameter in read_ssv(path, "resources/film.ssv").parameters] == ["k"]


def test_exact_a_system_has_no_boundary_and_no_inputs_that_nothing_feeds(system, partner):
    _, system = system("--partner", f"port[2]={partner()}")
    rotor, film = system.elements
    assert not system.connectors and len(system.connections) == 3
    assert connectors(rotor, "input") == {"port[2].f.y"} and connectors(film, "input") == {"r.y", "w"}


def test_exact_schema_sees_a_slip(system):
    """The schema is one that can fail."""
    path, _ = system()
    with zipfile.ZipFile(path) as package:
        root = etree.fromstring(package.read("SystemStructure.ssd"))
    root.attrib.pop("version")
    with zipfile.ZipFile(path, "w") as package:
        package.writestr("SystemStructure.ssd", etree.tostring(root))
    with pytest.raises(Exception, match="version"):
        read_ssd(path)


def test_regress_wrong_partners_are_refused_before_anything_is_built(xtask, partner, tmp_path):
    def refused(scene, *partners):
        given = [word for of in partners for word in ("--partner", of)]
        done = xtask("package", scene, "--ssp", "--out", tmp_path / "none", *given)
        assert done.returncode != 0 and not (tmp_path / "none").exists()
        return done.stderr

    film = partner()
    assert "coupled has no terminal port[3], only port[1], port[2]" in refused("coupled", f"port[3]={film}")
    assert "paper has no terminal: add [[effects.port]] or [effects.drive]" in refused("paper", f"drive={film}")
    assert "port[1] already has a partner" in refused("coupled", f"port[1]={film}", f"port[1]={film}")
    assert "none of its outputs has the name of an input of drive. Found: f_y, lift. Right: one or more of tau" in refused(
        "driven", f"drive={film}"
    )
    assert "its f.y is in kN, and port[1].f.y in N" in refused("coupled", f"port[1]={partner('kilo.fmu', [('f.y', 'output', 'kN')])}")
    assert "nosuch.fmu" in refused("coupled", "port[1]=nosuch.fmu")
    assert "port[1]=bearing.fmu" in refused("coupled", "port[1]")
