"""fmpy where the law of a spring ends, at 3.1 rad: the paper's rotor turns end over end, held by next to no spring."""

import pytest
from fmpy.simulation import instantiate_fmu
from host import DISCARD, WARNING

START = {
    "start.omega.x": 0.0,
    "start.omega.y": 5.0,
    "gravity.g.z": 0.0,
    "support.c1": 0.0,
    "support.c2": 1e-300,
}
END = 3.1 / 5.0  # [s]
REACHED = 1e-12  # [s], measured 1e-16
REASON = "the tilt |gamma| reaches 3.1 rad, and the spring support.c2, which follows gamma, has no limit at pi"


@pytest.fixture
def simulate(paper):
    """Runs with these start values; the result, and what was logged."""

    def run(kind, log, **options):
        logger = lambda _environment, _instance, status, _category, message: log.append((status, message.decode()))
        instance = instantiate_fmu(str(paper.directory), paper.description, kind, logger=logger)
        # A step that is discarded without fmi2Terminated fmpy repeats for ever; here its timeout would end it.
        return paper.simulate(fmu_instance=instance, fmi_type=kind, timeout=20.0, **options)

    return run


def test_exact_fmpy_ends_instead_of_looping(simulate):
    log = []
    result = simulate("CoSimulation", log, start_values=START, stop_time=1.0, output_interval=0.01)
    assert abs(result["time"][-1] - END) <= REACHED
    assert [status for status, _ in log] == [WARNING, DISCARD]
    assert "exceeds pi/2" in log[0][1]
    assert log[1][1].endswith(REASON)


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_exact_cvode_ends_where_a_law_ends(simulate):
    """fmpy cannot tell CVode of fmi2Discard; CVode gives up: an error, not a wrong result."""
    log = []
    start = START | {"start.gamma.y": 3.0, "start.omega.y": 0.5}
    with pytest.raises(RuntimeError, match="the (right-hand side|rootfinding) routine failed"):
        simulate(
            "ModelExchange", log, start_values=start, stop_time=0.5, output_interval=0.25, relative_tolerance=1e-11
        )
    assert [status for status, _ in log[:2]] == [WARNING, DISCARD]
    told = {f"fmi2Get{what}: {REASON}" for what in ("Derivatives", "EventIndicators")}
    assert {message for _, message in log[1:]} <= told
