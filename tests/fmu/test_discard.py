"""A rotor that tumbles about a transverse axis, held by next to no spring: at 3.1 rad the spring's law ends."""

import math

import motion
import numpy as np
import pytest
from fmpy.simulation import instantiate_fmu
from host import DISCARD, OK, WARNING

TUMBLE = 5.0  # [rad/s], about y
LIMIT = 3.1  # [rad]
START = {
    "start.omega.x": 0.0,
    "start.omega.y": TUMBLE,
    "gravity.g.z": 0.0,
    "support.c1": 0.0,
    "support.c2": 1e-300,
}
END = LIMIT / TUMBLE  # [s]
STEP = 0.01  # [s]
STOP = 1.0  # [s]
REASON = "the tilt |gamma| reaches 3.1 rad, and a spring or torque that follows gamma (c2, tau) has no limit at pi"

REACHED = 1e-12  # [rad], measured 4e-16
MOTION = 1e-13  # [1] or [rad], measured 1.8e-15
ENERGY = 1e-14  # [1], measured 0


@pytest.fixture
def host(paper):
    """An instance that steps until it is refused."""
    with paper.host() as host:
        host.start(START, stopTime=STOP)
        host.time = 0.0
        while (answer := host.step(host.time, STEP)) == OK:
            host.time += STEP
        host.answer = answer
        yield host


def test_exact_the_step_is_discarded_with_its_reason(host):
    assert host.answer == DISCARD
    last = host.log[-1]
    time = host.last_successful_time()
    assert (last.status, last.category) == (DISCARD, "logStatusDiscard")
    assert last.text == f"fmi2DoStep: no step is possible beyond t = {time!r} s: {REASON}"


def test_exact_the_last_successful_time_is_where_the_law_ends(host):
    assert host.time <= host.last_successful_time() <= host.time + STEP
    assert abs(TUMBLE * host.last_successful_time() - LIMIT) <= REACHED
    assert host.terminated()
    assert host.slave.getStatus(0) == DISCARD


def test_exact_outputs_are_those_of_the_last_successful_time(host):
    """The axis turns about y at a constant rate; nothing spins."""
    assert np.all(np.isfinite(host.outputs()))
    angle = TUMBLE * host.last_successful_time()
    read = lambda name, components: np.array([host.read(f"{name}.{c}") for c in components])
    np.testing.assert_allclose(read("axis", "xyz"), [math.cos(angle), 0.0, -math.sin(angle)], rtol=0.0, atol=MOTION)
    np.testing.assert_allclose(read("gamma", "yz"), [angle, 0.0], rtol=0.0, atol=MOTION)
    np.testing.assert_allclose(read("omega", "xyz"), [0.0, TUMBLE, 0.0], rtol=0.0, atol=MOTION)
    attitude = motion.attitude(np.array([0.0, *read("gamma", "yz")]))
    np.testing.assert_allclose(attitude[:, 0], read("axis", "xyz"), rtol=0.0, atol=MOTION)
    assert host.read("phi") == 2.0 * math.pi * host.read("turns") + host.read("angle")
    assert abs(host.read("phi")) <= MOTION
    energy = 0.5 * 0.078125 * TUMBLE**2
    assert abs(host.read("energy.total") - energy) <= ENERGY * energy


def test_exact_the_instance_stays_usable(host):
    """Another try is discarded too, and moves nothing; after a reset the instance is as new."""
    motion = [name for name, v in host.variables.items() if v.causality == "output" and "solver" not in name]
    time, outputs = host.last_successful_time(), host.read(*motion)
    assert host.step(time, STEP) == DISCARD
    assert (host.last_successful_time(), host.read(*motion)) == (time, outputs)
    host.slave.terminate()
    host.slave.reset()
    host.start()
    assert host.step(0.0, STOP) == OK
    assert not host.terminated()


def test_exact_fmpy_ends_instead_of_looping(paper):
    """A step that is discarded without fmi2Terminated fmpy repeats for ever; here its timeout would end it."""
    log = []
    logger = lambda _environment, _instance, status, _category, message: log.append((status, message.decode()))
    fmu = instantiate_fmu(str(paper.directory), paper.description, "CoSimulation", logger=logger)
    result = paper.simulate(fmu_instance=fmu, start_values=START, stop_time=STOP, output_interval=STEP, timeout=20.0)
    fmu.freeInstance()
    assert abs(result["time"][-1] - END) <= REACHED / TUMBLE
    assert [status for status, _ in log] == [WARNING, DISCARD]
    assert "exceeds pi/2" in log[0][1]
    assert log[1][1].endswith(REASON)


def test_exact_a_shorter_step_would_still_do(paper):
    """Up to the end of the law all is well: the step is refused, not the motion."""
    with paper.host() as host:
        host.start(START)
        assert host.step(0.0, END - 1e-3) == OK
        assert not host.terminated()
        assert host.step(END - 1e-3, 0.5e-3) == OK
        assert host.step(END - 0.5e-3, 1e-3) == DISCARD
