"""A step that cannot be done is given up, wherever on the time axis it is: near t = 0 the time has far finer digits
than the state, so "the time still advances" is no reason to go on."""

import json
import subprocess
import sys

import pytest

# [s]: a run takes less than 0.01 s, and Python some seconds to begin; one that goes on by 1e-17 s a step ends never.
PATIENCE = 60.0
REACHED = 1e-9  # [s], of the end of the law, measured 2e-16, but 2e-10 at 1e6 s, where time is rounded to 1e-10 s
LAW_ENDS = 0.62  # [s] after the start, at 3.1 rad

RUN = "import fmpy, json, sys; print(float(fmpy.simulate_fmu(sys.argv[1], **json.loads(sys.argv[2]))['time'][-1]))"


def last_time(fmu, **options):
    """Where a run of fmpy's ends [s]; in a process of its own, which can be stopped."""
    command = [sys.executable, "-c", RUN, str(fmu.path), json.dumps(options)]
    try:
        done = subprocess.run(command, capture_output=True, encoding="utf-8", timeout=PATIENCE, check=True)
    except subprocess.TimeoutExpired:
        pytest.fail(f"fmi2DoStep does not return: {options}")
    return float(done.stdout.splitlines()[-1])


@pytest.mark.parametrize("start", [0.0, -0.62, -0.61, -0.5, 1e6])
def test_exact_a_tumbling_rotor_ends_at_any_time(paper, start):
    """Turning about y at 5 rad/s; from -0.62 s the law of the spring ends at t = 0."""
    tumble = {"start.omega.x": 0.0, "start.omega.y": 5.0, "support.c1": 0.0, "support.c2": 1e-300}
    end = last_time(paper, start_values=tumble, start_time=start, stop_time=start + 1.0, output_interval=0.01)
    assert abs(end - start - LAW_ENDS) <= REACHED


def test_exact_a_start_at_the_end_of_the_law_ends(paper):
    tumble = {"start.gamma.y": 3.0999999, "start.omega.x": 0.0, "start.omega.y": 5.0}
    assert 0.0 <= last_time(paper, start_values=tumble, stop_time=0.05, output_interval=0.0025) <= 1e-6


def test_exact_an_overflowing_force_ends(paper):
    assert last_time(paper, start_values={"support.c1": 1e300}, stop_time=0.1, output_interval=0.01) <= 1e-6
