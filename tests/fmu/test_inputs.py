"""The input drive.tau from fmpy: steps and ramps as fmpy gives them; an upright rotor, which has a closed form.

Nothing but the torque acts on it: K_x = K_0 + the integral of the torque, and what the drive supplies is the change of
the kinetic energy. What a polynomial of the input does, call by call: tests/interface/inputs.rs.
"""

import numpy as np
import pytest

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
