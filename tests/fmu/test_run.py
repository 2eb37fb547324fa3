"""`cargo xtask run`: without a package the bits of the packaged FMU, under the names of its outputs."""

import json
import re

import numpy as np
import project
import pytest

SCENES = [
    scene
    for scene in project.PACKAGED + project.OVER_GENERAL
    if scene != "long_run" and "[[input]]" not in (project.ROOT / "scenes" / f"{scene}.toml").read_text(encoding="utf-8")
]
"""The first takes as long as all others; the second are told their inputs by `run`, and fmpy is not."""


@pytest.mark.parametrize("scene", SCENES)
def test_exact_bits_of_the_packaged_fmu(scene, fmus, xtask):
    done = xtask("run", scene, "--no-report")
    assert done.returncode == 0, done.stderr
    folder = project.ROOT / "target" / "run" / scene
    fmu = fmus[scene]
    if scene in project.PACKAGED:
        assert (folder / "modelDescription.xml").read_bytes() == (fmu.directory / "modelDescription.xml").read_bytes()
    experiment = fmu.description.defaultExperiment
    of_fmu = fmu.simulate(start_time=float(experiment.startTime), output_interval=float(experiment.stepSize))
    with (folder / "result.csv").open(encoding="utf-8") as table:
        assert tuple(next(table).rstrip("\n").split(",")) == of_fmu.dtype.names
        of_run = np.loadtxt(table, delimiter=",")
    assert np.array_equal(of_run, np.array(of_fmu.tolist()))
    assert f"up to {float(experiment.stopTime):g} s" in done.stdout


def test_a_step_that_cannot_be_done_is_told(xtask, tmp_path):
    text = (project.ROOT / "scenes" / "tumbling.toml").read_text(encoding="utf-8")
    scene = tmp_path / "ending.toml"
    scene.write_text(text + "\n[effects.support]\nc1 = 0.0\nc2 = 1e-300\n", encoding="utf-8")
    done = xtask("run", scene, "--no-report")
    assert done.returncode == 1
    assert "ending.toml: no step is possible beyond t = " in done.stderr
    assert "the tilt |gamma| reaches 3.1 rad" in done.stderr
    assert "up to" in done.stdout


def test_the_report_holds_a_run_against_the_tolerance_of_its_experiment(xtask, tmp_path):
    text = (project.ROOT / "scenes" / "turbo.toml").read_text(encoding="utf-8")
    scene = tmp_path / "loose.toml"
    scene.write_text(text.replace("[experiment]", "[experiment]\ntolerance = 1e-4"), encoding="utf-8")
    done = xtask("run", scene)
    assert done.returncode == 0, done.stderr
    page = (project.ROOT / "target" / "run" / "loose" / "report.html").read_text(encoding="utf-8")
    assert '<td>relative tolerance</td><td class="value">0.0001</td>' in page


WHIRL = """
[rotor]
m = 2.0
Ja = 0.02
Jt = 0.03
[start]
r_c.y = 12.673757e-6
v_c.y = 3.9476339e-3
[[effects.bearing]]
position = 0.0
kyy = 8e4
kzz = 8e4
kt = 1e3
[experiment]
tolerance = 1e-9
stop = 0.07
step = 0.0142
"""
"""A whirl of 200 rad/s along y, of the amplitude A below, begun 1 rad before its largest; sampled 2.2 times in a period."""
AMPLITUDE = np.hypot(12.673757e-6, 3.9476339e-3 / 200.0)


def test_exact_terminal_and_report_show_the_largest_deflection_between_the_samples(xtask, tmp_path):
    scene = tmp_path / "coarse_whirl.toml"
    scene.write_text(WHIRL, encoding="utf-8")
    done = xtask("run", scene)
    assert done.returncode == 0, done.stderr
    folder = project.ROOT / "target" / "run" / "coarse_whirl"
    (found,) = json.loads((folder / "deflections.json").read_text(encoding="utf-8"))
    assert found["station"] == "r_c" and abs(found["largest_m"] / AMPLITUDE - 1.0) < 1e-6
    with (folder / "result.csv").open(encoding="utf-8") as table:
        column = next(table).split(",").index("r_c.y")
        samples = np.loadtxt(table, delimiter=",")[:, column]
    assert np.abs(samples).max() < 0.999 * AMPLITUDE, "the samples do not tell"
    shown = f"{1e6 * AMPLITUDE:.6g}"
    assert f"deflection r_c at most {shown} µm off the x axis, static deflection included, at " in done.stdout
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert f"{shown}\u00a0µm" in page
    assert "largest deflection off the x axis, static deflection included: r_c, at " in page and "largest sample" not in page


def test_regress_a_run_that_diverges_ends_with_the_reason(xtask, tmp_path):
    scene = tmp_path / "diverging.toml"
    scene.write_text(WHIRL.replace("8e4", "-8e4").replace("stop = 0.07", "stop = 70.0"), encoding="utf-8")
    done = xtask("run", scene, "--no-report")
    assert done.returncode == 1
    assert re.search(r"diverging.toml: the motion diverges: at t = .* s the rotor is .* m off, more than 1e6 times its size", done.stderr)
    assert "the run ends there" in done.stderr and "deflection r_c at most" in done.stdout
