"""`cargo xtask run`: without a package the bits of the packaged FMU, under the names of its outputs."""

import numpy as np
import project
import pytest

SCENES = [
    scene
    for scene in project.PACKAGED
    if scene != "long_run" and "[[input]]" not in (project.ROOT / "scenes" / f"{scene}.toml").read_text(encoding="utf-8")
]
"""The first takes as long as all others; the second are told their inputs by `run`, and fmpy is not."""


@pytest.mark.parametrize("scene", SCENES)
def test_exact_bits_of_the_packaged_fmu(scene, fmus, xtask):
    done = xtask("run", scene, "--no-report")
    assert done.returncode == 0, done.stderr
    folder = project.ROOT / "target" / "run" / scene
    fmu = fmus[scene]
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
