"""`cargo xtask accuracy` on a scene of the user's own: what it leaves behind, and that its errors are the true ones."""

import csv
import json
import re
from xml.etree import ElementTree

import numpy as np
import project
import pytest

NAME = "accuracy_of_a_second"
STOP = 1.0  # [s]; the reference of the tests has a row there
STEP = STOP / 100.0  # [s]; the command reads the motion at irregular times, and at the end
SWEPT = 31  # tolerances
STEPS = 13  # of symplectic, for each order
SAME = 1e-4  # relative, measured 3.2e-5: the reference is right to 2e-13 rad in phi
TIGHT = 1e-5  # where `auto` need not try stiff
FLOOR = 1e-11  # of what can be told
FILES = {"accuracy.csv", "accuracy.json", "accuracy.md", "accuracy.svg"}


@pytest.fixture(scope="module")
def measured(xtask, tmp_path_factory):
    """The folder with the result, and what was printed."""
    paper = (project.ROOT / "scenes" / "paper.toml").read_text(encoding="utf-8")
    scene = tmp_path_factory.mktemp("scene") / f"{NAME}.toml"
    scene.write_text(paper.replace("stop = 10.0", f"stop = {STOP}"), encoding="utf-8")
    done = xtask("accuracy", scene)
    assert (done.returncode, done.stderr) == (0, "")
    return project.ROOT / "target" / "accuracy" / NAME, done.stdout


@pytest.fixture(scope="module")
def found(measured):
    return json.loads((measured[0] / "accuracy.json").read_text(encoding="utf-8"))


def test_exact_files_are_there_and_tell_the_same(measured, found):
    folder, printed = measured
    assert {path.name for path in folder.iterdir()} == FILES
    assert (folder / "accuracy.md").read_text(encoding="utf-8") in printed
    with (folder / "accuracy.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(found["rows"])
    for row, same in zip(rows, found["rows"]):
        assert row.keys() == same.keys()
        assert (float(row["error"]) if row["error"] else None) == same["error"]


def test_exact_errors_fall_with_the_tolerance(found):
    adaptive = [row for row in found["rows"] if row["method"] != "symplectic"]
    methods = {row["method"] for row in adaptive}
    assert methods == {"dopri5", "dop853", "stiff", "taylor", "auto"}
    for method in methods:
        rows = {row["value"]: row for row in adaptive if row["method"] == method}
        assert len(rows) == SWEPT
        for kind in ("error", "place_error", "axis_error", "worst_axis_error_rad"):
            loose, middle, tight = (rows[value][kind] for value in (1e-4, 1e-8, 1e-12))
            assert loose > 100.0 * middle > 1e4 * tight, (method, kind)
        costs = [rows[value]["evaluations"] for value in (1e-4, 1e-8, 1e-12)]
        assert costs == sorted(costs)
        for row in rows.values():
            assert row["worst_axis_error_rad"] >= row["axis_error_rad"]
            assert row["error"] == max(row[kind] for kind in ("place_error", "axis_error", "phi_error"))


@pytest.mark.parametrize("order", [2, 4, 6, 8])
def test_exact_each_order_has_its_steps(found, order):
    """That errors fall as the order has it: model/tests/all/composition.rs."""
    rows = [row for row in found["rows"] if (row["method"], row["order"]) == ("symplectic", order)]
    assert len(rows) == STEPS and {row["parameter"] for row in rows} == {"solver.step_size"}
    assert (np.diff([row["value"] for row in rows]) < 0.0).all()


def test_exact_price_of_auto_is_told(found):
    (told,) = (sentence for sentence in found["sentences"] if sentence.startswith("auto takes "))
    assert "dop853 from " in told and " to 1e-13. At most, at " in told
    taken = {row["value"]: row["taken"] for row in found["rows"] if row["method"] == "auto"}
    assert all(taken[value] == "dop853" for value in taken if value <= TIGHT), taken
    assert {row["taken"] for row in found["rows"] if row["method"] != "auto"} == {None}
    assert "as dear as the cheapest that errs no more" in told


def test_exact_relations_of_the_columns(found):
    assert found["experiment"] == {"start_s": 0.0, "stop_s": STOP, "scene_stop_s": STOP, "points": 100}
    floor = found["reference"]["agreement"]["error"]
    assert 0.0 < floor < FLOOR
    sizes = found["sizes"]
    for row in found["rows"]:
        if row["failure"] is not None:
            assert row["method"] == "symplectic" and "the energy is not kept" in row["failure"]
            continue
        assert row["real_time_factor"] == pytest.approx(STOP / row["cpu_time_s"])
        assert (row["simulated_s"], row["scene_s"], row["points_told"]) == (STOP, STOP, 100)
        assert row["error_told"] == (row["error"] > floor)
        assert row["axis_error"] == pytest.approx(row["worst_axis_error_rad"] / sizes["axis_rad"], rel=1e-12)
        assert row["place_error"] <= 1.000001 * row["worst_r_c_error_m"] / sizes["place_m"]


@pytest.mark.parametrize("method, number, tolerance", [("dopri5", 2, 1e-6), ("dop853", 3, 1e-7)])
def test_literature_error_is_the_true_one(paper, found, reference, method, number, tolerance):
    """Against quadruple precision instead of the command's own reference, with fmpy instead of the command's own calls."""
    start = {"solver.method": number, "solver.relative_tolerance": tolerance}
    result = paper.simulate(stop_time=STOP, output_interval=STEP, start_values=start)[-1]
    exact = reference[np.isclose(reference["t"], STOP)][0]
    theta = np.hypot(exact["gy"], exact["gz"])
    axis = np.array([np.cos(theta), np.sinc(theta / np.pi) * exact["gz"], -np.sinc(theta / np.pi) * exact["gy"]])
    off = np.linalg.norm(np.cross([result[f"axis.{c}"] for c in "xyz"], axis))
    row = next(row for row in found["rows"] if (row["method"], row["value"]) == (method, tolerance))
    assert row["axis_error_rad"] == pytest.approx(off, rel=SAME)
    assert row["phi_error_rad"] == pytest.approx(abs(result["phi"] - exact["phi"]), rel=SAME)


def test_exact_advice_is_the_cheapest_row_that_suffices(measured):
    printed = measured[1]
    for goal in ("1e-3", "1e-6", "1e-9"):
        assert re.search(f"For an error of at most {goal} take (dop|taylor)", printed)


def test_exact_picture_has_a_curve_a_method_and_its_words(measured):
    svg = ElementTree.parse(measured[0] / "accuracy.svg")
    words = " ".join("".join(text.itertext()) for text in svg.iter("{http://www.w3.org/2000/svg}text"))
    for wanted in ("split-rotor dopri5", "split-rotor dop853", "[ms]", "motion's own size", "CPU", "rustc"):
        assert wanted in words


def test_exact_message_where_no_method_reaches_the_end(xtask, tmp_path):
    """A rotor that tumbles to where the law of its spring ends."""
    scene = tmp_path / "accuracy_of_nothing.toml"
    scene.write_text(
        "[rotor]\nm = 1.0\nJa = 1.0\nJt = 1.0\nl = 0.5\n[start]\nomega = { y = 5.0 }\n"
        "[effects.support]\nc2 = 1e-300\n[experiment]\nstop = 1.0\n",
        encoding="utf-8",
    )
    refused = xtask("accuracy", scene)
    assert refused.returncode == 1
    # cargo may have told before that it waits for another one.
    assert "\nerror: no method can run accuracy_of_nothing to its end: fmi2DoStep: " in "\n" + refused.stderr
    assert "the tilt |gamma| reaches 3.1 rad" in refused.stderr


ORDINARY = """
title = "An ordinary rotor, run up"
[rotor]
m = 12.0
Ja = 0.04
Jt = 0.12
l = 0.0
[effects.drive]
tau = 24.0
[[effects.bearing]]
position = -0.12
kyy = 2e7
kzz = 1.5e7
cyy = 2000.0
czz = 2000.0
[[effects.bearing]]
position = 0.12
kyy = 2e7
kzz = 1.5e7
cyy = 2000.0
czz = 2000.0
[[effects.unbalance]]
mass = 0.002
radius = 0.02
position = 0.0
[experiment]
stop = 6.0
step = 0.001
"""
WHIRL = 20.492464e-6  # [m]; the largest, by an independent reference
SEEN = 0.02  # relative: among 997 points
GOALS = (1e-3, 1e-6, 1e-9)


@pytest.mark.long
def test_regress_an_ordinary_rotor_is_drawn_and_advised_by_its_whirl(xtask, tmp_path):
    """Its axis does not tilt: judged by the axis alone the picture was empty, and the advice wrong by 62 %."""
    scene = tmp_path / "accuracy_of_the_ordinary.toml"
    scene.write_text(ORDINARY, encoding="utf-8")
    done = xtask("accuracy", scene)
    assert (done.returncode, done.stderr) == (0, "")
    folder = project.ROOT / "target" / "accuracy" / scene.stem
    found = json.loads((folder / "accuracy.json").read_text(encoding="utf-8"))
    assert found["sizes"]["place_m"] == pytest.approx(WHIRL, rel=SEEN)
    assert found["reference"]["agreement"]["error"] < 1e-9
    drawn = (folder / "accuracy.svg").read_text(encoding="utf-8")
    for method in ("dopri5", "dop853", "symplectic", "stiff", "taylor", "auto"):
        assert f"split-rotor {method}<" in drawn
    assert "no method errs" not in drawn
    rows = [row for row in found["rows"] if row["failure"] is None]
    for goal, sentence in zip(GOALS, (said for said in found["sentences"] if said.startswith("For an error"))):
        method, value = re.search(r" take (\S+) with .* = (\S+):", sentence).groups()
        taken = [row for row in rows if (row["method"], row["value"]) == (method, float(value))]
        assert taken and min(row["error"] for row in taken) <= goal, sentence
