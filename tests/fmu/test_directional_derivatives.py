"""Directional and output derivatives through fmpy, against extrapolated differences of what the FMU shows."""

import numpy as np
import pytest
from host import MODEL_EXCHANGE, OK

STEP = 0.02
"""The longest of the differences, of a state or an input whose size is about 1."""
LEVELS = 6
DIRECTION = 1e-11  # relative to the largest derivative of the variable and 1, measured 2.5e-12
ALONG_MOTION = 3e-8  # relative to the derivative and 1, of energies to the kinetic one, measured 7.6e-9 (support.M)
TIME_STEP = 0.004  # [s]
NOW = 0.25  # [s]


def extrapolated(f, step):
    """The derivative of f at 0 by central differences of step, step/2, …, extrapolated to none (Richardson 1911)."""
    table = []
    for level in range(LEVELS):
        h = step / 2.0**level
        value = (np.array(f(h)) - np.array(f(-h))) / (2.0 * h)
        for i, previous in enumerate(table):
            table[i], value = value, value + (value - previous) / (4.0 ** (i + 1) - 1.0)
        table.append(value)
    return table[-1]


def smooth(variables):
    """The Real outputs, states and rates but for whole turns and what is left of them, which jump."""
    return [v.name for v in variables.values() if v.causality in ("output", "local") and v.type == "Real"
            and v.name not in ("turns", "angle") and not v.name.startswith("solver.")]


@pytest.fixture(params=[0.6, 2.5], ids=["from e", "from -e"])
def host(request, gentle):
    """An instance in model exchange, in either chart, at a state without symmetry."""
    random = np.random.default_rng(20183)
    with gentle.host(kind=MODEL_EXCHANGE) as host:
        host.start({"start.gamma.y": request.param}).slave.enterContinuousTimeMode()
        states = random.uniform(-1.0, 1.0, host.number_of_states)
        states[9:11] = [0.5, -0.4]
        host.set_states(states)
        yield host


def test_exact_directional_derivatives(host):
    names = smooth(host.variables)
    unknown = [host.reference(name) for name in names]
    states = np.array(host.states())
    known = [d.variable.derivative.valueReference for d in host.fmu.description.derivatives]

    def along(seeds):
        def moved(x):
            host.set_states(states + x * seeds)
            return host.read(*names)
        return extrapolated(moved, STEP)

    columns = np.transpose([host.slave.getDirectionalDerivative(unknown, [one], [1.0]) for one in known])
    size = np.maximum(1.0, np.abs(columns).max(axis=1))
    worst = 0.0
    for i in range(len(known)):
        expected = along(np.eye(len(known))[i])
        worst = max(worst, (np.abs(columns[:, i] - expected) / size).max())
    assert worst <= DIRECTION
    # A direction is the sum of its parts.
    host.set_states(states)
    seeds = np.linspace(-1.0, 2.0, len(known))
    together = host.slave.getDirectionalDerivative(unknown, known, list(seeds))
    np.testing.assert_allclose(together, columns @ seeds, rtol=0.0, atol=1e-12 * np.max(np.abs(columns) @ np.abs(seeds)))
    assert host.slave.getDirectionalDerivative([host.reference("turns")], known, list(seeds)) == [0.0]


def test_exact_derivatives_by_an_input(fmus):
    """Everything is linear in the torque: the derivative is the difference."""
    driven = fmus["driven"]
    with driven.host(kind=MODEL_EXCHANGE) as host:
        host.start({"start.gamma.y": 0.6, "drive.tau": 0.0}).slave.enterContinuousTimeMode()
        names = smooth(host.variables)
        before = np.array(host.read(*names))
        tau = host.reference("drive.tau")
        sensitivity = host.slave.getDirectionalDerivative([host.reference(name) for name in names], [tau], [2.0])
        host.set({"drive.tau": 2.0})
        np.testing.assert_allclose(sensitivity, np.array(host.read(*names)) - before, rtol=1e-9, atol=1e-9)
        moved = {name for name, value in zip(names, sensitivity) if value != 0.0}
        # n lies in the plane of e and t, that of x and z
        assert moved == {"der(state.K.x)", "der(state.K.z)", "der(state.supplied)", "drive.a"}


def test_exact_derivatives_in_initialization_mode(fmu):
    with fmu.host() as host:
        host.slave.setupExperiment()
        host.slave.enterInitializationMode()
        rate, speed = host.reference("der(state.r.y)"), host.reference("state.v.y")
        assert host.slave.getDirectionalDerivative([rate], [speed], [1.0]) == [1.0]


def test_exact_output_derivatives_along_the_motion(gentle):
    """In co-simulation, where an input has a slope."""
    outputs = [name for name in smooth(gentle.variables) if gentle.variables[name].causality == "output"]
    start = {"solver.relative_tolerance": 1e-13}
    times = sorted({NOW + sign * TIME_STEP / 2.0**level for level in range(LEVELS) for sign in (-1, 1)} | {NOW})
    with gentle.host() as host:
        host.start(start)
        if "drive.tau" in gentle.variables:
            tau = [host.reference("drive.tau")]
            host.slave.setReal(tau, [1.0])
            host.slave.setRealInputDerivatives(tau * 2, [1, 2], [-3.0, 8.0])
        shown, time = {}, 0.0
        for following in times:
            assert host.step(time, following - time) == OK
            time = host.last_successful_time()
            shown[following] = host.read(*outputs)
            if following == NOW:
                rates = host.slave.getRealOutputDerivatives([host.reference(name) for name in outputs], [1] * len(outputs))
    expected = extrapolated(lambda h: shown[NOW + h], TIME_STEP)
    kinetic = shown[NOW][outputs.index("energy.kinetic")]
    size = np.maximum(np.abs(expected), [kinetic if name.startswith("energy.") else 1.0 for name in outputs])
    error = np.abs(rates - expected) / size
    assert error.max() <= ALONG_MOTION, outputs[error.argmax()]
