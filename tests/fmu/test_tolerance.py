"""Which tolerance and which method are in force, and that the log says so."""

import numpy as np
import pytest

TIMES = np.arange(0, 101) / 100.0  # [s]
SCENE, EXPERIMENT, OWN = 1e-10, 1e-4, 1e-7
SAME_MOTION = 1e-8  # [rad], dopri5 against dop853 at 1e-10, axis after 1 s, measured 7e-10
AUTO, DOPRI5, DOP853, SYMPLECTIC, STIFF = 1, 2, 3, 4, 5


@pytest.fixture
def run(paper):
    """Runs with these start values and this experiment: evaluations, what the log says of the tolerance."""

    def evaluations(values=(), **experiment):
        with paper.host() as host:
            host.start(values, **experiment).run(TIMES)
            said = [message.text for message in host.log if message.category == "logSolver"]
            # Beside it the log says from which sizes on a motion counts.
            return host.read("solver.evaluations"), [text.partition("; it is relative to")[0] for text in said]

    return evaluations


def test_exact_the_scene_rules_when_nobody_else_says(run):
    _, said = run()
    assert said == ["the relative tolerance in force is 1e-10, the one of the scene"]


def test_exact_auto_says_what_it_takes_and_why(paper):
    with paper.host() as host:
        host.set_method(AUTO)
        host.start()
        said = [message.text for message in host.log if message.category == "logSolver"]
        assert len(said) == 2 and said[1].startswith("auto takes dop853, and stiff as long as"), said


def test_exact_the_experiment_rules_over_the_scene(run):
    evaluations, said = run(tolerance=EXPERIMENT)
    assert said == ["the relative tolerance in force is 0.0001, the one of fmi2SetupExperiment"]
    assert evaluations < 0.5 * run()[0]


@pytest.mark.parametrize("own", [SCENE, OWN])
def test_exact_the_host_rules_over_the_experiment(run, own):
    """Even where the host sets what the scene has already."""
    evaluations, said = run({"solver.relative_tolerance": own}, tolerance=EXPERIMENT)
    assert said == [f"the relative tolerance in force is {own!r}, ".replace("1e-07", "1e-7") +
                    "the one that the host set as solver.relative_tolerance"]
    assert evaluations == run({"solver.relative_tolerance": own})[0]
    assert evaluations > run(tolerance=EXPERIMENT)[0]


def test_exact_the_parameter_stays_what_was_set(paper):
    with paper.host() as host:
        host.start(tolerance=EXPERIMENT)
        assert host.read("solver.relative_tolerance") == SCENE


@pytest.mark.parametrize("tolerance", [0.0, -1e-6, 1e-15, 0.2, np.nan])
def test_exact_an_impossible_tolerance_is_refused(paper, tolerance):
    shown = "NaN" if np.isnan(tolerance) else repr(tolerance).replace("e-0", "e-")
    with paper.host() as host:
        assert host.refused("setupExperiment", tolerance=tolerance) == (
            f"fmi2SetupExperiment: tolerance = {shown} is not possible: it must be a number from 1e-14 to 0.1"
        )


def test_exact_the_absolute_tolerance_is_in_force(run):
    loose = {"solver.relative_tolerance": 1e-10, "solver.absolute_tolerance": 1e-5}
    assert run(loose)[0] < run()[0]


@pytest.mark.parametrize("method, stages, dense", [(DOPRI5, 6, 0), (DOP853, 12, 3)], ids=["dopri5", "dop853"])
def test_exact_the_method_is_chosen_by_number(paper, method, stages, dense):
    """Two evaluations find the first step; a step's last stage is the first of the next; one look between steps."""
    with paper.host() as host:
        host.set_method(method)
        host.start()
        host.step(0.0, 1.0)
        steps, rejected, evaluations = host.read("solver.steps", "solver.rejected", "solver.evaluations")
        assert host.slave.getInteger([host.reference("solver.method")]) == [method]
    assert evaluations == 2 + stages * (steps + rejected) + dense


@pytest.mark.parametrize("number", [AUTO, DOPRI5, DOP853, SYMPLECTIC, STIFF])
def test_exact_the_number_stands_for_the_method(paper, number):
    """A host that cannot set an Enumeration sets an Integer: the same bits come of it, whatever solver.method says."""
    outputs = []
    for method, method_number in [(number, 0), (number % STIFF + 1, number)]:
        with paper.host() as host:
            host.set_method(method)
            host.slave.setInteger([host.reference("solver.method_number")], [method_number])
            outputs.append(host.start().run(TIMES[:11]))
    assert outputs[0] == outputs[1]


def test_exact_both_methods_find_the_same_motion(paper):
    axes = []
    for method in (DOPRI5, DOP853):
        with paper.host() as host:
            host.set_method(method)
            host.start().run(TIMES)
            axes.append(host.read("axis.x", "axis.y", "axis.z"))
    assert np.linalg.norm(np.subtract(*axes)) <= SAME_MOTION


def test_exact_a_method_that_is_not_listed_is_refused(paper):
    with paper.host() as host:
        host.set_method(7)
        host.slave.enterInitializationMode()
        assert host.refused("exitInitializationMode") == (
            "fmi2ExitInitializationMode: solver.method = 7 is not possible: it must be 1 (auto) or 2 (dopri5) or "
            "3 (dop853) or 4 (symplectic) or 5 (stiff)"
        )


def test_exact_a_number_that_is_no_method_is_refused(paper):
    with paper.host() as host:
        host.slave.setInteger([host.reference("solver.method_number")], [7])
        host.slave.enterInitializationMode()
        assert host.refused("exitInitializationMode") == (
            "fmi2ExitInitializationMode: solver.method_number = 7 is not possible: it must be 0 or 1 or 2 or 3 or 4 or 5"
        )
