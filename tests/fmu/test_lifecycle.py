"""From instantiation to termination, driven call by call."""

import numpy as np
import pytest
from host import ERROR, OK

SHIFT = 4e-9  # [N, s and smaller], measured 1.2e-9 in solver.next_step: a step spans whole digits of the time, 1.4e-14 s
TIMES = np.arange(0, 129) / 64.0  # [s], without rounding


@pytest.fixture
def host(paper):
    with paper.host() as host:
        yield host


def test_exact_reset_gives_the_same_bits(host):
    first = host.start().run(TIMES)
    host.slave.terminate()
    assert host.outputs() == first
    host.slave.reset()
    assert host.start().run(TIMES) == first


def test_exact_reset_forgets_what_the_host_set(host):
    first = host.start().run(TIMES)
    host.slave.reset()
    other = host.start({"rotor.m": 6.0, "solver.relative_tolerance": 1e-7}, startTime=3.0, stopTime=4.0, tolerance=1e-5)
    assert other.run(3.0 + TIMES[:65]) != first
    host.slave.reset()
    assert host.read("rotor.m", "solver.relative_tolerance") == [5.0, 1e-10]
    assert host.start().run(TIMES) == first


def test_exact_reset_forgets_the_experiment(host):
    """And that the host had set a tolerance of its own, which would win over the next experiment's."""
    host.start(tolerance=1e-4).run(TIMES)
    evaluations = host.read("solver.evaluations")
    host.slave.reset()
    host.start({"solver.relative_tolerance": 1e-9}, startTime=3.0, stopTime=4.0)
    host.slave.reset()
    host.slave.enterInitializationMode()
    host.slave.exitInitializationMode()
    host.run(TIMES * 4.0)
    assert host.last_successful_time() == 8.0
    host.slave.reset()
    host.start(tolerance=1e-4).run(TIMES)
    assert host.read("solver.evaluations") == evaluations


def test_exact_two_instances_do_not_disturb_each_other(paper, host):
    alone = host.start().run(TIMES)
    host.slave.reset()
    host.start()
    with paper.host(name="heavier") as other:
        other.start({"rotor.m": 7.0})
        for now, following in zip(TIMES, TIMES[1:]):
            assert host.step(now, following - now) == other.step(now, following - now) == OK
        assert other.outputs() != alone
        other.slave.reset()
    assert host.outputs() == alone


def test_exact_start_time_only_shifts_the_motion(host):
    """At 1e-6 with all that the solver does; at 1e-10 rounding has a say in its first steps, and so in those that follow."""
    for tolerance, shown in [(1e-6, host.outputs), (1e-10, host.motion)]:
        host.start(tolerance=tolerance).run(TIMES)
        from_zero = shown()
        host.slave.reset()
        host.start(startTime=100.0, tolerance=tolerance).run(100.0 + TIMES)
        assert host.last_successful_time() == 102.0
        np.testing.assert_allclose(shown(), from_zero, rtol=0.0, atol=SHIFT)
        host.slave.reset()


def test_exact_communication_steps_do_not_change_the_motion(host):
    """The solver steps ahead on its own: only what is read, and the evaluations that reading takes, may differ."""
    host.start().run(TIMES)
    regular = [*host.motion(), *host.read("solver.steps", "solver.rejected")]
    host.slave.reset()
    random = np.random.default_rng(64)
    some = np.unique(np.append(random.choice(TIMES, 20), [0.0, TIMES[-1]]))
    assert np.ptp(np.diff(some)) > 0.0
    host.start().run(some)
    assert [*host.motion(), *host.read("solver.steps", "solver.rejected")] == regular


def test_exact_values_before_the_start_are_those_at_the_start(host):
    host.slave.setupExperiment()
    host.set({"start.omega.x": 40.0})
    instantiated = host.read("omega.x", "K_c.x", "energy.kinetic")
    host.slave.enterInitializationMode()
    initializing = host.read("omega.x", "K_c.x", "energy.kinetic")
    host.slave.exitInitializationMode()
    assert instantiated == initializing == host.read("omega.x", "K_c.x", "energy.kinetic")
    assert instantiated == [40.0, 0.15625 * 40.0, 0.5 * 0.15625 * 40.0**2]


@pytest.mark.parametrize(
    "calls, reason",
    [
        ([("exitInitializationMode",)], 'fmi2ExitInitializationMode: not legal in the state "instantiated": '
                                        "call fmi2EnterInitializationMode first"),
        ([("doStep", 0.0, 0.1)], 'fmi2DoStep: not legal in the state "instantiated": '
                                 "call it between fmi2ExitInitializationMode and fmi2Terminate"),
        ([("enterInitializationMode",), ("setupExperiment",)],
         'fmi2SetupExperiment: not legal in the state "initialization mode": '
         "call it before fmi2EnterInitializationMode, or fmi2Reset first"),
        ([("enterInitializationMode",), ("terminate",)],
         'fmi2Terminate: not legal in the state "initialization mode": '
         "call it between fmi2ExitInitializationMode and fmi2Terminate"),
        ([("enterInitializationMode",), ("exitInitializationMode",), ("terminate",), ("doStep", 0.0, 0.1)],
         'fmi2DoStep: not legal in the state "terminated": '
         "call it between fmi2ExitInitializationMode and fmi2Terminate"),
        ([("enterInitializationMode",), ("exitInitializationMode",), ("enterInitializationMode",)],
         'fmi2EnterInitializationMode: not legal in the state "step complete": call fmi2Reset first'),
    ],
)
def test_exact_a_wrong_sequence_is_refused(host, calls, reason):
    for call in calls[:-1]:
        assert host.status(*call) == OK
    assert host.refused(*calls[-1]) == reason


def test_exact_a_wrong_guid_is_refused(paper):
    with paper.host(guid="{00000000-0000-0000-0000-000000000000}", logging=False) as host:
        assert host.slave.component is None
        reason = (
            'fmi2Instantiate: fmuGUID = "{00000000-0000-0000-0000-000000000000}" must be '
            f'"{paper.description.guid}": the binary and the modelDescription.xml differ'
        )
        assert host.log == [(ERROR, "logStatusError", reason, "instance")]
