"""modelDescription.xml of every scene: what validators find, and what they miss."""

import math
import re

import project
import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu

STRUCTURED = re.compile(r"[A-Za-z]\w*(\[[1-4]\])?(\.\w+)*(\[\d+\])?|effects\.\w+\[[1-4]\]|der\(.*\)", re.ASCII)

def scalars(fmu):
    """Pairs of each ScalarVariable and the element of its type."""
    return [(variable, variable[0]) for variable in fmu.xml.find("ModelVariables")]


def declared_units(fmu):
    """The elements of UnitDefinitions."""
    return fmu.xml.find("UnitDefinitions")


def unknowns(fmu, kind):
    """Pairs of index and dependencies of an element of ModelStructure. A start at rest is found from all that is set before."""
    found = fmu.xml.findall(f"ModelStructure/{kind}/Unknown")
    if kind == "InitialUnknowns" and fmu.variables["start.at_rest"].start == "true":
        assert {u.get("dependencies") for u in found} == {None}
        known = indices(fmu, lambda v, _: v.get("causality") in {"parameter", "input"})
        return [(int(u.get("index")), known) for u in found]
    return [(int(u.get("index")), [int(word) for word in u.get("dependencies").split()]) for u in found]


def indices(fmu, wanted):
    """The indices from 1 of the variables that are wanted."""
    return [i for i, (v, kind) in enumerate(scalars(fmu), 1) if wanted(v, kind)]


def is_output(variable, _kind):
    return variable.get("causality") == "output"


def is_derivative(_variable, kind):
    return kind.get("derivative") is not None


def states(fmu):
    """The indices of the continuous states, in the order of their derivatives."""
    return [int(kind.get("derivative")) for _, kind in scalars(fmu) if kind.get("derivative")]


def test_exact_fmpy_finds_no_problem(fmu):
    assert validate_fmu(str(fmu.path)) == []
    read_model_description(str(fmu.path), validate=True)


def test_exact_package_is_what_describe_prints(fmu, xtask):
    described = xtask("describe", "--xml", fmu.scene)
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


KINDS = {
    ("parameter", "fixed", "exact"),
    ("input", "continuous", None),
    ("output", "continuous", "calculated"),
    ("local", "continuous", "calculated"),
    ("local", "discrete", "calculated"),
}
"""Causality, variability and initial, as they may go together here."""


def test_exact_kinds_of_variables(fmu):
    for variable, kind in scalars(fmu):
        of = tuple(variable.get(key) for key in ("causality", "variability", "initial"))
        assert of in KINDS, variable.get("name")
        # What is local is a state, its derivative, or the chart of the states.
        is_local = re.match(r"(der\()?([a-z_]+(\[\d\])?\.)?state\.", variable.get("name"))
        assert (of[0] == "local") == bool(is_local), variable.get("name")
        assert (of[1] == "discrete") == (variable.get("name") == "state.chart")


def test_exact_what_is_set_starts_within_its_bounds(fmu):
    for variable, kind in scalars(fmu):
        if variable.get("causality") not in ("parameter", "input"):
            continue
        name = variable.get("name")
        if kind.tag == "Boolean":
            assert kind.get("start") in ("true", "false"), name
            continue
        start = float(kind.get("start"))
        assert float(kind.get("min", "-inf")) <= start <= float(kind.get("max", "inf")), name
        if variable.get("description").endswith("> 0"):
            # In the general FMU an effect that is off may start with what would be refused.
            assert (start > 0.0 or fmu.scene in project.GENERAL) and "min" not in kind.attrib, name
        if kind.tag == "Enumeration":
            items = fmu.xml.findall(f"TypeDefinitions/SimpleType[@name='{kind.get('declaredType')}']/Enumeration/Item")
            assert kind.get("start") in [item.get("value") for item in items], name


def test_exact_calculated_variables_have_no_start(fmu):
    calculated = [(v, kind) for v, kind in scalars(fmu) if v.get("initial") == "calculated"]
    assert len(calculated) > 0
    assert [v.get("name") for v, kind in calculated if kind.get("start") is not None] == []


def test_exact_each_state_has_its_derivative(fmu):
    """der(state.x) is the derivative of state.x; units and order go with it."""
    variables = scalars(fmu)
    found = {variables[i - 1][0].get("name"): variables[i - 1] for i in states(fmu)}
    continuous = [v for v, _ in variables if (v.get("causality"), v.get("variability")) == ("local", "continuous")]
    local = [v.get("name") for v in continuous]
    assert sorted([f"der({name})" for name in found] + list(found)) == sorted(local)
    units = {"m": "m/s", "m/s": "m/s2", "kg.m2/s": "N.m", "rad": "rad/s", "J": "W", "N.m": "N.m/s"}
    rates = {v.get("name"): kind.get("unit") for v, kind in variables if is_derivative(v, kind)}
    assert rates == {f"der({name})": units[kind.get("unit")] for name, (_, kind) in found.items()}
    own = sum(not name.startswith("state.") for name in found)
    rigid = 12 if fmu.scene in ("free_top", "tumbling", "dzhanibekov") else 14
    assert len(found) == rigid + own, "with work integrals where work could be done"


def test_exact_states_that_a_change_of_chart_sets_anew_say_so(fmu):
    """FMI 2.0.4, 2.2.7: reinit, where the FMU changes a state at an event."""
    reinit = [v.get("name") for v, kind in scalars(fmu) if kind.get("reinit") is not None]
    # A jump of the imposed speed supplies energy at an event.
    imposed = any(v.get("name") == "imposed_speed.w" for v, _ in scalars(fmu))
    assert reinit == ["state.gamma.y", "state.gamma.z", "state.phi", *(["state.supplied"] if imposed else [])]
    assert {kind.get("reinit") for _, kind in scalars(fmu)} == {None, "true"}


def test_exact_structure_is_complete_and_ascending(fmu):
    outputs, derivatives = indices(fmu, is_output), indices(fmu, is_derivative)
    assert [index for index, _ in unknowns(fmu, "Outputs")] == outputs
    assert [index for index, _ in unknowns(fmu, "Derivatives")] == derivatives
    initial = [index for index, _ in unknowns(fmu, "InitialUnknowns")]
    assert initial == sorted(outputs + states(fmu) + derivatives)


@pytest.mark.parametrize("kind", ["Outputs", "Derivatives", "InitialUnknowns"])
def test_exact_dependencies_are_known_and_ascending(fmu, kind):
    """On states and inputs; in initialization mode on parameters and inputs."""
    set_before = {"parameter", "input"} if kind == "InitialUnknowns" else {"input"}
    known = set(indices(fmu, lambda v, _: v.get("causality") in set_before))
    known |= set() if kind == "InitialUnknowns" else set(states(fmu))
    found = unknowns(fmu, kind)
    for index, dependencies in found:
        assert dependencies == sorted(set(dependencies)), f"of {scalars(fmu)[index - 1][0].get('name')}"
        assert set(dependencies) <= known, f"of {scalars(fmu)[index - 1][0].get('name')}"
    assert any(dependencies for _, dependencies in found)


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
    expected |= {"state.r.x": 1280, "der(state.r.x)": 1294, "gravity.g.x": 16 << 8, "support.c1": 20 << 8, "support.F.x": (20 << 8) + 4}
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
    settings = {"solver.method", "solver.relative_tolerance", "solver.absolute_tolerance", "solver.order",
                "solver.max_evaluations", "solver.method_number", "start.at_rest"}
    spent = {"solver.steps", "solver.rejected", "solver.evaluations", "solver.error_estimate"}
    pure = {name for name in pure if not name.startswith(("effects.", "extrapolation."))}
    pure = {name for name in pure if not name.endswith((".command", ".contact", ".friction", ".learn", ".ahead", ".lag"))}
    assert pure == settings | spent | {"turns", "axis.x", "axis.y", "axis.z", "state.chart"}


def test_exact_exponents_of_units(fmus):
    units = [unit for fmu in fmus.values() for unit in declared_units(fmu)]
    table = {unit.get("name"): {b: int(p) for b, p in unit.find("BaseUnit").items()} for unit in units}
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
        "rad/s2": {"rad": 1, "s": -2},
        "J": newton | {"m": 2},
        "W": {"kg": 1, "m": 2, "s": -3},
        "N": newton,
        "N.m": newton | {"m": 2},
        "N.m/s": {"kg": 1, "m": 2, "s": -3},
        "N/m": {"kg": 1, "s": -2},
        "N.m/rad": newton | {"m": 2, "rad": -1},
        "N.s/m": {"kg": 1, "s": -1},
        "N.m.s2/rad2": {"kg": 1, "m": 2, "rad": -2},
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
    always = {"rotor", "start", "solver", "energy", "r_c", "v_c", "gamma", "omega", "K_c", "axis", "state", "der(state"}
    found = {re.sub(r"^der\(|\[\d\]$", "", block) for block in blocks - always}
    assert found == project.effects(fmu.scene) | ({"effects"} if fmu.scene in project.GENERAL else set())
