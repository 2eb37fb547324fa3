"""The input drive.tau from fmpy: steps and ramps as fmpy gives them; an upright rotor, which has a closed form.

Nothing but the torque acts on it: K_x = K_0 + the integral of the torque, and what the drive supplies is the change of
the kinetic energy. What a polynomial of the input does, call by call: tests/interface/inputs.rs.
"""

import numpy as np
import pytest
from fmpy.simulation import Input
from host import Host

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


def test_regress_exact_a_constant_that_fmpy_rounds_leaves_the_ramp_alone(fmus):
    """Of a constant 100 fmpy makes 100.00000000000001 now and then, which threw the speed back from 77.6 to 99.6 rad/s."""
    rows = np.array([(0.0, 100.0), (1.1, 100.0)], dtype=[("time", np.float64), ("imposed_speed.w", np.float64)])
    start = {"imposed_speed.w": 100.0, "imposed_speed.a": -22.4, "start.omega.x": 100.0, "unbalance[1].mass": 0.0}
    shown = ["omega_phi"]
    result = fmus["jeffcott"].simulate(start_values=start, input=rows, stop_time=1.0, output_interval=0.01, output=shown)
    table = rows["imposed_speed.w"][np.newaxis]
    sent = np.array([Input.interpolate(time=t, t=rows["time"], table=table)[0].item() for t in result["time"]])
    assert np.any(sent != 100.0) and np.all(np.abs(sent - 100.0) < 2e-14)
    np.testing.assert_allclose(result["omega_phi"], 100.0 - 22.4 * result["time"], rtol=1e-13)


def test_regress_what_is_set_of_an_effect_that_is_off_is_said_once(fmus):
    """The input did nothing, as fmi2OK."""

    def said(before, during, on=(), off=()):
        with Host(fmus["rotor"]) as host:
            for names, value in [(on, True), (off, False)]:
                host.slave.setBoolean([host.reference(f"effects.{name}") for name in names], [value] * len(names))
            host.start(before)
            for i in range(3):
                host.set(during)
                assert host.step(0.01 * i, 0.01) == 0
            return [line for line in host.log if " is off" in line]

    (line,) = said({"drive.tau": 5.0}, {"drive.tau": 6.0})
    assert "drive.tau is set, but effects.drive is off: " in line and "before fmi2ExitInitializationMode" in line
    (line,) = said({}, {"drive.tau": 5.0, "port[1].f.z": 1.0})
    assert "drive.tau is set, but effects.drive is off, port[1].f.z is set, but effects.port[1] is off: " in line
    (line,) = said({"bearing[2].kyy": 1e6}, {})
    assert "bearing[2].kyy is set, but effects.bearing[2] is off: " in line
    # What is 0, what is as it was, and what is on.
    assert not said({"drive.tau": 0.0, "motor.command": 1.0}, {"drive.tau": 0.0})
    assert not said({"drive.tau": 5.0}, {"drive.tau": 6.0}, on=["drive"])
    # A switch is no variable of what is off, and does not use up the warning.
    assert not said({}, {}, off=["gravity"])
    (line,) = said({}, {"drive.tau": 5.0}, off=["gravity"])
    assert "effects.gravity" not in line and "drive.tau is set, but effects.drive is off: " in line
