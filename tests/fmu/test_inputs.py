"""The input drive.tau from fmpy: steps, ramps, derivatives; an upright rotor, which has a closed form.

Nothing but the torque acts on it: K_x = K_0 + the integral of the torque, and what the drive supplies is the change of
the kinetic energy.
"""

import numpy as np
import pytest
from host import OK

UPRIGHT = {"gravity.g.z": 0.0, "support.c1": 0.0, "support.c2": 0.0, "support.d1": 0.0, "support.d2": 0.0}
SPIN, JA = 50.0, 0.15625
SHOWN = ["drive.w", "drive.phi", "drive.a", "energy.supplied", "energy.kinetic", "energy.residual"]
ROUNDING = 1e-14  # relative, measured 2.4e-15
BY_CVODE = 1e-11  # relative, measured 3.7e-12
WORK = 4e-12  # [J], measured 1.2e-12


@pytest.fixture
def driven(fmus):
    return fmus["driven"]


def signal(*rows):
    """What fmpy takes as input."""
    return np.array(list(rows), dtype=[("time", np.float64), ("drive.tau", np.float64)])


def simulate(driven, rows, **options):
    return driven.simulate(start_values=UPRIGHT, input=signal(*rows), stop_time=1.0, output=SHOWN, **options)


def speed(impulse):
    """The speed after an impulse of the torque [N·m·s]."""
    return SPIN + impulse / JA


def assert_supplied(result):
    kinetic = result["energy.kinetic"]
    np.testing.assert_allclose(result["energy.supplied"], kinetic - kinetic[0], rtol=0.0, atol=WORK)
    assert np.abs(result["energy.residual"]).max() <= WORK


@pytest.mark.parametrize("interval", [0.01, 0.1, 0.5])
def test_exact_step(driven, interval):
    """At 0.5 s from 0 to 2 N·m."""
    result = simulate(driven, [(0.0, 0.0), (0.5, 0.0), (0.5, 2.0), (1.0, 2.0)], output_interval=interval)
    after = np.maximum(result["time"] - 0.5, 0.0)
    np.testing.assert_allclose(result["drive.w"], speed(2.0 * after), rtol=ROUNDING)
    np.testing.assert_allclose(result["drive.phi"], SPIN * result["time"] + after**2 / JA, rtol=ROUNDING)
    assert_supplied(result)


def test_exact_step_in_model_exchange(driven):
    """A time event to fmpy, at which CVode starts anew."""
    rows = [(0.0, 0.0), (0.5, 0.0), (0.5, 2.0), (1.0, 2.0)]
    result = simulate(driven, rows, output_interval=0.1, fmi_type="ModelExchange", relative_tolerance=1e-10)
    after = np.maximum(result["time"] - 0.5, 0.0)
    np.testing.assert_allclose(result["drive.w"], speed(2.0 * after), rtol=BY_CVODE)
    np.testing.assert_allclose(result["drive.phi"], SPIN * result["time"] + after**2 / JA, rtol=BY_CVODE, atol=BY_CVODE)
    assert result["drive.a"][-1] == pytest.approx(2.0 / JA, rel=BY_CVODE)


def test_exact_ramp_that_is_held(driven):
    """Without derivatives, each value of 6t N·m is held over its step of 0.01 s."""
    result = simulate(driven, [(0.0, 0.0), (1.0, 6.0)], output_interval=0.01)
    steps = np.round(result["time"] / 0.01)
    held = 6.0 * 0.01**2 * steps * (steps - 1.0) / 2.0
    np.testing.assert_allclose(result["drive.w"], speed(held), rtol=ROUNDING)


@pytest.mark.parametrize("interval", [0.01, 0.1, 0.5])
def test_exact_ramp_with_its_slope(driven, interval):
    """With derivatives, the ramp of 6 N·m/s is one at any communication step. (fmpy's own set_input_derivatives fails
    on any FMU of FMI 2.0 that has not nine inputs.)"""
    with started(driven) as host:
        for i in range(round(1.0 / interval)):
            time = i * interval
            send(host, 6.0 * time, 6.0)
            assert host.step(time, interval) == OK
            after = host.last_successful_time()
            expected = [speed(3.0 * after**2), 6.0 * after / JA, 6.0 * after]
            assert host.read("drive.w", "drive.a", "drive.tau") == pytest.approx(expected, rel=ROUNDING)


def started(driven):
    return driven.host().start(UPRIGHT)


def send(host, value, *derivatives):
    """The torque and its derivatives, at the communication point."""
    tau = [host.reference("drive.tau")]
    host.slave.setReal(tau, [value])
    for order, derivative in enumerate(derivatives, 1):
        host.slave.setRealInputDerivatives(tau, [order], [derivative])


def test_exact_parabola_with_its_derivatives(driven):
    """Order 2 is taken too; the highest that is claimed is 1, because some masters fetch the highest alone."""
    with started(driven) as host:
        send(host, 1.0, -4.0, 12.0)
        assert host.step(0.0, 1.0) == OK
        assert host.read("drive.tau", "drive.a") == pytest.approx([3.0, 3.0 / JA], rel=ROUNDING)
        assert host.read("drive.w") == pytest.approx(speed(1.0 - 2.0 + 2.0), rel=ROUNDING)
        (jerk,) = host.slave.getRealOutputDerivatives([host.reference("drive.a")], [1])
        assert jerk == pytest.approx((-4.0 + 12.0) / JA, rel=ROUNDING)


def test_exact_start_value_holds_until_it_is_set(driven):
    with started(driven) as host:
        assert host.read("drive.tau") == 0.5
        assert host.step(0.0, 0.5) == OK
        send(host, -1.5)
        assert host.step(0.5, 0.5) == OK
        assert host.read("drive.w") == pytest.approx(speed(0.25 - 0.75), rel=ROUNDING)


def test_exact_input_before_the_start(driven):
    """In any state before the run, with its derivatives."""
    for state in ("instantiated", "initialization"):
        with driven.host() as host:
            host.slave.setupExperiment(startTime=3.0)
            host.set(UPRIGHT)
            if state == "initialization":
                host.slave.enterInitializationMode()
            send(host, 2.0, 4.0)
            if state == "instantiated":
                host.slave.enterInitializationMode()
            host.slave.exitInitializationMode()
            assert host.step(3.0, 1.0) == OK
            assert host.read("drive.w") == pytest.approx(speed(4.0), rel=ROUNDING)


@pytest.mark.parametrize("value, shown", [(np.nan, "NaN"), (np.inf, "inf"), (-np.inf, "-inf")])
def test_exact_an_infinite_input_is_refused(driven, value, shown):
    """The old value stays."""
    name = "drive.tau (value reference 6144)"
    with started(driven) as host:
        tau = [host.reference("drive.tau")]
        assert host.refused("setReal", tau, [value]) == f"fmi2SetReal: {name} = {shown} must be a finite number"
        assert host.refused("setRealInputDerivatives", tau, [1], [value]) == (
            f"fmi2SetRealInputDerivatives: derivative {shown} of {name} must be a finite number"
        )
        for order in (0, 3, -1):
            assert host.refused("setRealInputDerivatives", tau, [order], [1.0]) == (
                f"fmi2SetRealInputDerivatives: order = {order} of {name} must be 1 or 2"
            )
        assert host.read("drive.tau") == 0.5
        assert host.step(0.0, 0.5) == OK
        assert host.read("drive.w") == pytest.approx(speed(0.25), rel=ROUNDING)
