"""The README's rotor: what it shows does what it says."""

import re

import numpy as np
import project
import pytest

README = (project.ROOT / "README.md").read_text(encoding="utf-8")


def block(language):
    """The first block of this language."""
    return re.search(rf"```{language}\n(.*?)```", README, re.DOTALL).group(1)


@pytest.fixture(scope="module")
def turbo(package):
    return package("turbo", block("toml"))


def test_its_scene_is_that_of_the_project():
    assert block("toml") in (project.ROOT / "scenes" / "turbo.toml").read_text(encoding="utf-8")


@pytest.mark.filterwarnings("ignore:FigureCanvasAgg is non-interactive")
def test_its_python_lines_run_the_turbo_rotor_through_its_critical_speed(turbo, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "Agg")
    lines = block("python").replace("target/fmu/turbo.fmu", str(turbo.path))
    assert str(turbo.path) in lines
    names = {}
    exec(lines, names)  # as a reader would, without a window
    result = names["result"]
    # 30 N.m over 0.04 kg.m2 and the unbalance's 4e-5 kg.m times the radius of gyration, for 3 s
    spin = 30.0 * 3.0 / (0.04 + 4e-5 * np.sqrt(0.04 / 12.0))
    assert abs(result["omega_phi"][-1] / spin - 1.0) < 1e-4
    whirl = np.abs(result["probe[1].r.y"])
    assert whirl.max() > 3.0 * whirl[result["time"] < 1.0].max(), "it comes to its critical speeds"


def test_run_reports_on_it(turbo, xtask):
    done = xtask("run", turbo.path.with_suffix(".toml"))
    assert done.returncode == 0, done.stderr
    folder = project.ROOT / "target" / "run" / "turbo"
    with (folder / "result.csv").open(encoding="utf-8") as table:
        names = next(table).rstrip("\n").split(",")
        columns = dict(zip(names, np.loadtxt(table, delimiter=",").T, strict=True))
    time, spin = columns["time"], columns["omega_phi"]
    assert time[-1] == 4.0
    assert abs(spin[-1] / spin[time == 2.0] - 1.5) < 1e-3, "the torque ends at 3 s"
    sag = -12.0 * 9.81 / 3e7
    assert abs(columns["r_c.z"][0] / sag - 1.0) < 1e-3, "it starts where the bearings carry it"
    assert (folder / "report.html").stat().st_size > 100_000
