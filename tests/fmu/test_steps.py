"""Steps that are refused: fmi2Error, a line in the log, nothing changed."""

import numpy as np
import pytest
from host import ERROR, OK

STEP = 0.1  # [s]


@pytest.fixture
def host(paper):
    """An instance at 1 s that stops at 2 s."""
    with paper.host() as host:
        host.start(stopTime=2.0).run(np.arange(11) / 10.0)
        yield host


@pytest.mark.parametrize(
    "time, step, reason",
    [
        (1.0, 0.0, "communicationStepSize = 0.0 must be a finite number > 0"),
        (1.0, -0.1, "communicationStepSize = -0.1 must be a finite number > 0"),
        (1.0, np.nan, "communicationStepSize = NaN must be a finite number > 0"),
        (1.0, np.inf, "communicationStepSize = inf must be a finite number > 0"),
        (1.0, 1e-17, "communicationStepSize = 1e-17 is too small to advance the time 1.0: about "
                     "4.440892098500626e-16 is needed"),
        (1.1, 0.1, "currentCommunicationPoint = 1.1 must be 1.0, where the last step ended"),
        (0.9, 0.1, "currentCommunicationPoint = 0.9 must be 1.0, where the last step ended"),
        (1.0 + 1e-9, 0.1, "currentCommunicationPoint = 1.000000001 must be 1.0, where the last step ended"),
        (np.nan, 0.1, "currentCommunicationPoint = NaN must be 1.0, where the last step ended"),
        (1.0, 1.1, "the step to 2.1 goes past the stop time 2.0"),
        (1.0, 1.0 + 1e-8, "the step to 2.00000001 goes past the stop time 2.0"),
    ],
)
def test_exact_a_refused_step_changes_nothing(paper, host, time, step, reason):
    before = host.outputs()
    assert host.refused("doStep", time, step) == f"fmi2DoStep: {reason}"
    assert host.outputs() == before
    assert host.last_successful_time() == 1.0
    assert not host.terminated()
    with paper.host() as undisturbed:
        undisturbed.start(stopTime=2.0).run(np.arange(11) / 10.0)
        undisturbed.outputs()
        assert undisturbed.step(1.0, STEP) == host.step(1.0, STEP) == OK
        assert undisturbed.outputs() == host.outputs()


def test_exact_times_within_rounding_are_equal(host):
    """INTERFACE.md: within 1e-9 h + 4 ulp(t)."""
    assert host.step(1.0 + 0.9e-9 * STEP, STEP) == OK
    now = host.last_successful_time()
    assert host.step(now - 0.9e-9 * STEP, STEP) == OK
    now = host.last_successful_time()
    rest = 2.0 - now
    assert host.step(now, rest + 0.9e-9 * rest) == OK


def test_exact_the_stop_time_is_reached_and_not_passed(host):
    assert host.step(1.0, 1.0) == OK
    assert host.step(2.0, 1e-3) == ERROR
    assert host.last_successful_time() == 2.0


def test_exact_without_a_stop_time_there_is_no_end(paper):
    with paper.host() as host:
        host.start()
        assert host.step(0.0, 12.0) == OK


@pytest.mark.parametrize(
    "experiment, reason",
    [
        ({"startTime": np.nan}, "startTime = NaN must be a finite number of seconds"),
        ({"startTime": np.inf}, "startTime = inf must be a finite number of seconds"),
        ({"startTime": 2.0, "stopTime": 1.0}, "stopTime = 1.0 must not be before startTime = 2.0"),
        ({"stopTime": np.nan}, "stopTime = NaN must not be before startTime = 0.0"),
    ],
)
def test_exact_an_impossible_experiment_is_refused(paper, experiment, reason):
    with paper.host() as host:
        assert host.refused("setupExperiment", **experiment) == f"fmi2SetupExperiment: {reason}"
        host.start().run([0.0, STEP])
