"""What ModelStructure says that a variable depends on, tested by perturbing everything that it might.

In initialization mode every parameter and input; in model exchange, in both charts, every state and input. A change
within rounding is none: phi passes through the chart from -e and back.

All that changes is listed. States and parameters may be listed that cancel (a force along e has no moment about e); of
inputs none may, or a partner's solver would see an algebraic loop where there is none.
"""

import re

import numpy as np
import project
import pytest
from host import MODEL_EXCHANGE

SETUPS = 48
STEPS = (1e-3, 0.3)
"""Perturbations, relative to the value."""
TURN = 7.0
"""[rad]: more than a whole turn, for phi."""
ROUNDING = 1e-12  # relative to the larger of the value and 1
POSITIVE = re.compile(
    r"rotor\.m|rotor\.Jt|support\..*|drag\..*|rotating_damping\.d|.*partner_J|unbalance.*\.(mass|radius)|bearing.*\.(cyy|czz|cxx|ct)(\[\d+\])?"
    r"|motor\.(stall_torque|synchronous_speed|time_constant)|rub.*\.(gap|stiffness|damping|friction|radius|v0)"
)
SMALL = re.compile(r"bearing.*\.(cyz|czy)(\[\d+\])?")
"""|cyz + czy|/2 <= sqrt(cyy czz)."""
SPEED = re.compile(r"bearing.*\.speed\[(\d+)\]")
"""Those of a table ascend, however they are perturbed."""
SOLVER = {"solver.relative_tolerance": 1e-9, "solver.absolute_tolerance": 1e-3, "solver.max_evaluations": 1e6}


def random_setup(names, random):
    """A rotor that can exist, in a motion without symmetry."""
    ranges = {True: (0.5, 2.0), False: (-2.0, 2.0)}
    setup = {name: random.uniform(*ranges[bool(POSITIVE.fullmatch(name))]) for name in names}
    setup |= {name: 0.1 * value for name, value in setup.items() if SMALL.fullmatch(name)}
    setup |= {name: 0.25 * 2.0 ** int(node[1]) for name in setup if (node := SPEED.fullmatch(name))}
    setup["rotor.Ja"] = setup["rotor.Jt"] * random.uniform(0.6, 1.2)  # Ja <= 2 Jt
    if "asymmetry.Jt2" in setup:
        setup["asymmetry.Jt2"] = setup["rotor.Jt"] * random.uniform(0.9, 1.1)
    setup["start.phi"] = random.uniform(-40.0, 40.0)
    for name in ("start.gamma.y", "start.gamma.z"):
        setup[name] = random.choice([-1.0, 1.0]) * random.uniform(0.1, 1.5)
    return setup


def perturbed(name, value):
    """Values nearby that are possible too."""
    if name.endswith(".phi"):
        yield value + TURN
    # Ja grows no further than 2 Jt; the others stay possible however they grow
    yield from (value * (1.0 - step if name == "rotor.Ja" else 1.0 + step) for step in STEPS)


def changed(before, after):
    """Where two lists of values differ by more than rounding."""
    before, after = np.array(before), np.array(after)
    return np.abs(after - before) > ROUNDING * np.maximum(1.0, np.abs(before))


def names_of(fmu, *causalities):
    """The Real variables of these causalities."""
    return [v.name for v in fmu.description.modelVariables if v.causality in causalities and v.type == "Real"]


@pytest.fixture
def calculated(fmu):
    """The outputs, the states and their derivatives."""
    if fmu.scene in project.GENERAL:
        pytest.skip("its switches are tried in model/tests/all/dependencies.rs")
    return names_of(fmu, "output", "local")


@pytest.fixture
def observed_at_start(fmu, calculated):
    """The pairs (variable, parameter or input) in which a change of the second was seen to change the first."""
    physical = [name for name in names_of(fmu, "parameter", "input") if not name.startswith("solver.")]
    random = np.random.default_rng(20181)
    pairs = set()
    with fmu.host() as host:
        host.slave.setupExperiment()
        host.slave.enterInitializationMode()

        def note(name, before):
            after = host.read(*calculated)
            pairs.update((of, name) for of, is_new in zip(calculated, changed(before, after)) if is_new)

        for _ in range(SETUPS):
            setup = random_setup(physical, random) | SOLVER
            host.set(setup)
            before = host.read(*calculated)
            for name, value in [(name, value) for name in setup for value in perturbed(name, setup[name])]:
                host.set({name: value})
                note(name, before)
                host.set({name: setup[name]})
            for method in (2, 3):
                host.set_method(method)
                note("solver.method", before)
        assert host.read(*calculated) == before
    return pairs


@pytest.fixture
def observed_later(fmu, calculated):
    """The pairs (output or derivative, state or input) in which a change of the second was seen to change the first."""
    physical = [name for name in names_of(fmu, "parameter", "input") if not name.startswith("solver.")]
    states = [d.variable.derivative.name for d in fmu.description.derivatives]
    inputs = names_of(fmu, "input")
    random = np.random.default_rng(20182)
    pairs, charts = set(), set()
    for _ in range(SETUPS):
        with fmu.host(kind=MODEL_EXCHANGE) as host:
            host.start(random_setup(physical, random)).slave.enterContinuousTimeMode()
            charts |= set(host.slave.getInteger([host.reference("state.chart")]))
            state = dict(zip(states, random.uniform(-2.0, 2.0, len(states))))
            # |gamma| stays below 3.1 rad when it is perturbed
            state |= {name: 0.8 * value for name, value in state.items() if ".gamma." in name}

            def note(name, before):
                after = host.read(*calculated)
                pairs.update((of, name) for of, is_new in zip(calculated, changed(before, after)) if is_new)

            host.set_states(state.values())
            before = host.read(*calculated)
            for name in states:
                for value in (*perturbed(name, state[name]), -state[name]):
                    host.set_states((state | {name: value}).values())
                    note(name, before)
            host.set_states(state.values())
            for name in inputs:
                old = host.read(name)
                for value in perturbed(name, old):
                    host.set({name: value})
                    note(name, before)
                host.set({name: old})
            assert host.read(*calculated) == before
    assert charts == {1, 2}
    return {(of, name) for of, name in pairs if of not in states}


def listed(unknowns):
    """The pairs that modelDescription.xml lists."""
    return {(u.variable.name, v.name) for u in unknowns for v in u.dependencies}


def inputs_among(fmu, pairs):
    """The pairs whose second is an input; but a motor's command acts at once only where it has no time constant."""
    inputs = set(names_of(fmu, "input")) - {"motor.command"}
    return sorted((of, on) for of, on in pairs if on in inputs)


def test_exact_dependencies_at_the_start(fmu, observed_at_start):
    # the residual is a total less the same total
    in_xml = {(of, on) for of, on in listed(fmu.description.initialUnknowns) if of != "energy.residual"}
    assert sorted(observed_at_start - in_xml) == [], "not listed"
    assert inputs_among(fmu, in_xml - observed_at_start) == [], "listed, but nothing changes"
    assert in_xml


def test_exact_dependencies_later(fmu, observed_later):
    in_xml = listed(fmu.description.outputs) | listed(fmu.description.derivatives)
    assert sorted(observed_later - in_xml) == [], "not listed"
    assert inputs_among(fmu, in_xml - observed_later) == [], "listed, but nothing changes"
    assert in_xml


def test_exact_positions_and_angles_depend_on_no_input(fmus):
    """Or a partner's solver would see an algebraic loop where there is none."""
    driven = fmus["driven"].description
    on_input = {u.variable.name for u in driven.outputs if "drive.tau" in [v.name for v in u.dependencies]}
    assert on_input == {"drive.a"}
    on_input = {u.variable.name for u in driven.derivatives if "drive.tau" in [v.name for v in u.dependencies]}
    assert on_input == {"der(state.K.x)", "der(state.K.y)", "der(state.K.z)", "der(state.supplied)"}
