"""modelDescription.xml of every scene: what validators find, and what they miss."""

import math
import re

import project
import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu

STRUCTURED = re.compile(r"[A-Za-z]\w*(\[[1-4]\])?(\.\w+)*|der\(.*\)", re.ASCII)
CAPABILITIES = {
    "canGetAndSetFMUstate": "true",
    "canHandleVariableCommunicationStepSize": "true",
    "canNotUseMemoryManagementFunctions": "true",
}
"""All that works so far; INTERFACE.md says what will."""


def scalars(fmu):
    """Pairs of each ScalarVariable and the element of its type."""
    return [(variable, variable[0]) for variable in fmu.xml.find("ModelVariables")]


def declared_units(fmu):
    """The elements of UnitDefinitions."""
    return fmu.xml.find("UnitDefinitions")


def unknowns(fmu, kind):
    """Pairs of index and dependencies of an element of ModelStructure."""
    return [(int(u.get("index")), u.get("dependencies")) for u in fmu.xml.find(f"ModelStructure/{kind}")]


def test_exact_fmpy_finds_no_problem(fmu):
    assert validate_fmu(str(fmu.path)) == []
    read_model_description(str(fmu.path), validate=True)


def test_exact_package_is_what_describe_prints(fmu, xtask):
    described = xtask("describe", fmu.scene)
    assert described.returncode == 0, described.stderr
    packed = (fmu.directory / "modelDescription.xml").read_text(encoding="utf-8")
    assert packed == described.stdout, f"out of date: run `cargo xtask package {fmu.scene}`"


def test_exact_attributes_of_the_model(fmu):
    given = {key: fmu.xml.get(key) for key in ("fmiVersion", "modelName", "variableNamingConvention")}
    assert given == {"fmiVersion": "2.0", "modelName": fmu.scene, "variableNamingConvention": "structured"}
    assert re.fullmatch(r"\{[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\}", fmu.xml.get("guid"))
    experiment = {key: float(value) for key, value in fmu.xml.find("DefaultExperiment").items()}
    assert experiment.keys() == {"startTime", "stopTime", "tolerance", "stepSize"}
    assert experiment["startTime"] < experiment["stopTime"]
    assert 0.0 < experiment["stepSize"] <= experiment["stopTime"] - experiment["startTime"]


def test_exact_capabilities_claim_only_what_works(fmu):
    claimed = dict(fmu.xml.find("CoSimulation").attrib)
    assert claimed.pop("modelIdentifier") == fmu.scene
    assert claimed == CAPABILITIES
    assert fmu.xml.find("ModelExchange") is None


def test_exact_parameters_start_within_their_bounds(fmu):
    for variable, kind in scalars(fmu):
        if variable.get("causality") != "parameter":
            continue
        name, start = variable.get("name"), float(kind.get("start"))
        assert (variable.get("variability"), variable.get("initial")) == ("fixed", "exact"), name
        assert float(kind.get("min", "-inf")) <= start <= float(kind.get("max", "inf")), name
        if kind.tag == "Enumeration":
            items = fmu.xml.findall(f"TypeDefinitions/SimpleType[@name='{kind.get('declaredType')}']/Enumeration/Item")
            assert kind.get("start") in [item.get("value") for item in items], name


def test_exact_calculated_variables_have_no_start(fmu):
    calculated = [(v, kind) for v, kind in scalars(fmu) if v.get("initial") == "calculated"]
    assert len(calculated) == sum(v.get("causality") == "output" for v, _ in scalars(fmu)) > 0
    assert [v.get("name") for v, kind in calculated if kind.get("start") is not None] == []


def test_exact_structure_is_complete_and_ascending(fmu):
    outputs = [i for i, (v, _) in enumerate(scalars(fmu), 1) if v.get("causality") == "output"]
    assert [index for index, _ in unknowns(fmu, "Outputs")] == outputs
    assert [index for index, _ in unknowns(fmu, "InitialUnknowns")] == outputs
    assert fmu.xml.find("ModelStructure/Derivatives") is None


def test_exact_dependencies_are_known_and_ascending(fmu):
    variables = scalars(fmu)
    known = [i for i, (v, _) in enumerate(variables, 1) if v.get("causality") == "parameter"]
    for index, dependencies in unknowns(fmu, "InitialUnknowns"):
        listed = [int(word) for word in dependencies.split()]
        assert listed == sorted(set(listed)), f"of {variables[index - 1][0].get('name')}"
        assert set(listed) <= set(known), f"of {variables[index - 1][0].get('name')}"
    assert {dependencies for _, dependencies in unknowns(fmu, "Outputs")} == {""}, "there are no inputs yet"


def test_exact_value_references_are_unique(fmu):
    references = [v.get("valueReference") for v, _ in scalars(fmu)]
    assert len(set(references)) == len(references) > 0


def test_exact_value_references_are_the_same_in_all_scenes(fmus):
    by_name, by_reference = {}, {}
    for fmu in fmus.values():
        for variable, kind in scalars(fmu):
            name, reference = variable.get("name"), variable.get("valueReference")
            assert by_name.setdefault(name, (reference, kind.tag)) == (reference, kind.tag), fmu.scene
            assert by_reference.setdefault(reference, name) == name, fmu.scene


def test_golden_value_references(paper):
    """Scripts and other tools' models may hold these numbers: a change breaks them."""
    expected = {"rotor.m": 0, "start.r_c.x": 256, "solver.method": 512, "r_c.x": 768, "energy.kinetic": 1024}
    expected |= {"gravity.g.x": 16 << 8, "support.c1": 20 << 8, "support.F.x": (20 << 8) + 4}
    assert {name: paper.variables[name].valueReference for name in expected} == expected


def test_exact_units_are_declared_and_used(fmu):
    declared = {unit.get("name"): unit for unit in declared_units(fmu)}
    used = {kind.get("unit") for _, kind in scalars(fmu) if kind.get("unit")}
    assert used == set(declared)
    for name, unit in declared.items():
        assert unit.find("BaseUnit").attrib, f"{name} in SI base units"
    for variable, kind in scalars(fmu):
        if kind.get("displayUnit"):
            shown = [display.get("name") for display in declared[kind.get("unit")].findall("DisplayUnit")]
            assert kind.get("displayUnit") in shown, variable.get("name")


def test_exact_only_pure_numbers_have_no_unit(fmu):
    pure = {variable.get("name") for variable, kind in scalars(fmu) if not kind.get("unit")}
    settings = {"solver.method", "solver.relative_tolerance", "solver.absolute_tolerance"}
    spent = {"solver.steps", "solver.rejected", "solver.evaluations", "solver.error_estimate"}
    assert pure == settings | spent | {"turns", "axis.x", "axis.y", "axis.z"}


def test_exact_exponents_of_units(paper):
    table = {unit.get("name"): {b: int(p) for b, p in unit.find("BaseUnit").items()} for unit in declared_units(paper)}
    newton = {"kg": 1, "m": 1, "s": -2}
    assert table == {
        "kg": {"kg": 1},
        "kg.m2": {"kg": 1, "m": 2},
        "kg.m2/s": {"kg": 1, "m": 2, "s": -1},
        "m": {"m": 1},
        "m/s": {"m": 1, "s": -1},
        "m/s2": {"m": 1, "s": -2},
        "s": {"s": 1},
        "rad": {"rad": 1},
        "rad/s": {"rad": 1, "s": -1},
        "J": newton | {"m": 2},
        "N": newton,
        "N.m": newton | {"m": 2},
        "N/m": {"kg": 1, "s": -2},
        "N.m/rad": newton | {"m": 2, "rad": -1},
        "N.s/m": {"kg": 1, "s": -1},
        "N.m.s/rad": {"kg": 1, "m": 2, "s": -1, "rad": -1},
    }


def test_exact_display_units(paper):
    """FMI 2.0: shown value = factor * value + offset."""
    shown = {d.get("name"): float(d.get("factor")) for u in declared_units(paper) for d in u.findall("DisplayUnit")}
    assert shown == {"deg": pytest.approx(180.0 / math.pi, rel=1e-15), "rpm": pytest.approx(30.0 / math.pi, rel=1e-15)}


def test_exact_names_are_unique_and_structured(fmu):
    names = [v.get("name") for v, _ in scalars(fmu)]
    assert len(set(names)) == len(names)
    assert [name for name in names if not STRUCTURED.fullmatch(name)] == []
    assert [v.get("name") for v, _ in scalars(fmu) if not v.get("description")] == []


def test_exact_effects_that_a_scene_does_not_name_are_not_there(fmu):
    blocks = {v.get("name").partition(".")[0] for v, _ in scalars(fmu) if "." in v.get("name")}
    always = {"rotor", "start", "solver", "energy", "r_c", "v_c", "gamma", "omega", "K_c", "axis"}
    text = (project.ROOT / "scenes" / f"{fmu.scene}.toml").read_text(encoding="utf-8")
    assert blocks - always == set(re.findall(r"^\[+effects\.(\w+)", text, re.MULTILINE))
