"""What InitialUnknowns says an output depends on, tested by perturbing every parameter in initialization mode."""

import struct

import numpy as np
import pytest

SETUPS = 24
STEPS = (1e-3, 0.3)
"""Perturbations, relative to the value."""
TURN = 7.0
"""[rad]: more than a whole turn, for start.phi."""
POSITIVE = {"rotor.m", "rotor.Jt", "support.c1", "support.c2", "support.d1", "support.d2"}


def random_setup(names, random):
    """A rotor that can exist, in a motion without symmetry."""
    setup = {name: random.uniform(0.5, 2.0) if name in POSITIVE else random.uniform(-2.0, 2.0) for name in names}
    setup["rotor.Ja"] = setup["rotor.Jt"] * random.uniform(0.5, 1.5)  # Ja <= 2 Jt
    setup["start.phi"] = random.uniform(-40.0, 40.0)
    for name in ("start.gamma.y", "start.gamma.z"):
        setup[name] = random.choice([-1.0, 1.0]) * random.uniform(0.1, 1.5)
    return setup


def perturbed(name, value):
    """Values nearby that are possible too."""
    if name == "start.phi":
        yield value + TURN
    # Ja grows no further than 2 Jt; the others stay possible however they grow
    yield from (value * (1.0 - step if name == "rotor.Ja" else 1.0 + step) for step in STEPS)


def bits(values):
    return [struct.pack("<d", value) for value in values]


@pytest.fixture
def observed(fmu):
    """The pairs (output, parameter) in which a change of the parameter was seen to change the output."""
    outputs = [v.name for v in fmu.description.modelVariables if v.causality == "output"]
    names = [v.name for v in fmu.description.modelVariables if v.causality == "parameter" and v.type == "Real"]
    physical = [name for name in names if not name.startswith("solver.")]
    tolerances = {"solver.relative_tolerance": 1e-9, "solver.absolute_tolerance": 1e-3}
    random = np.random.default_rng(20181)
    pairs = set()
    with fmu.host() as host:
        host.slave.setupExperiment()
        host.slave.enterInitializationMode()
        for _ in range(SETUPS):
            setup = random_setup(physical, random) | tolerances
            host.set(setup)
            before = bits(host.read(*outputs))
            changes = [(name, value) for name in setup for value in perturbed(name, setup[name])]
            for name, value in changes:
                host.set({name: value})
                after = bits(host.read(*outputs))
                pairs |= {(o, name) for o, old, new in zip(outputs, before, after) if old != new}
                host.set({name: setup[name]})
            for method in (2, 3):
                host.set_method(method)
                after = bits(host.read(*outputs))
                pairs |= {(o, "solver.method") for o, old, new in zip(outputs, before, after) if old != new}
        assert bits(host.read(*outputs)) == before
    return pairs


@pytest.fixture
def listed(fmu):
    """The pairs that modelDescription.xml lists."""
    return {(u.variable.name, v.name) for u in fmu.description.initialUnknowns for v in u.dependencies}


def test_exact_no_unlisted_parameter_changes_an_output(observed, listed):
    assert sorted(observed - listed) == []


def test_exact_every_listed_parameter_changes_its_output(observed, listed):
    assert listed
    assert sorted(listed - observed) == []
