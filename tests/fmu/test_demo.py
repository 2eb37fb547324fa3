"""The demo on the packaged paper's rotor: a report that needs nothing beside it, an exit code that means something."""

import csv
import os
import re
import subprocess
import sys
from xml.etree import ElementTree

import project
import pytest

DEMO = project.ROOT / "xtask" / "python"
NAMESPACES = {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"}
LARGEST = 1_500_000  # [bytes], measured 516 000
FIGURES = 4


@pytest.fixture(scope="module")
def demo(paper, tmp_path_factory):
    """The folder that the demo wrote, and what it printed."""
    out = tmp_path_factory.mktemp("demo") / "paper"
    environment = os.environ | {"PYTHONIOENCODING": "utf-8"}
    command = [sys.executable, DEMO / "demo.py", paper.path, "--out", out]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", env=environment)
    assert (done.returncode, done.stderr) == (0, "")
    return out, done.stdout


@pytest.fixture(scope="module")
def report(demo):
    return (demo[0] / "report.html").read_text(encoding="utf-8")


def test_exact_report_needs_nothing_beside_it(report):
    assert set(re.findall(r'https?://[^\s"\'<>)]+', report)) <= NAMESPACES
    # what a browser would fetch; inside a figure, references to its own parts are no such thing
    assert re.findall(r'<(?:script|link|img|iframe|object|embed)\b|@import|url\((?!#)', report) == []
    assert [href for href in re.findall(r'\b(?:src|href)="([^"]*)"', report) if not href.startswith("#")] == []
    assert len(report.encode()) <= LARGEST


def test_exact_report_holds_its_figures(report):
    figures = re.findall(r"<figure>\s*(<svg.*?</svg>)\s*<figcaption>", report, re.DOTALL)
    assert len(figures) == FIGURES
    for figure in figures:
        svg = ElementTree.fromstring(figure)
        drawn = [path.get("d") for path in svg.iter("{http://www.w3.org/2000/svg}path")]
        assert max(len(path) for path in drawn) > 1000, "a curve"
        assert "nan" not in figure.lower()


def test_literature_report_finds_the_maximum_of_the_paper(demo, report):
    assert "off its start value by at most 0.0702 %" in demo[1]
    assert "0.0702 % at 2.704 s" in report
    assert "it holds" in report and "does not hold" not in report


def test_exact_trajectory_stands_at_the_steps_of_the_experiment(demo):
    with (demo[0] / "trajectory.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 1001
    assert [float(row["time"]) for row in rows] == pytest.approx([i / 100.0 for i in range(1001)], abs=1e-12)
    assert {"r_c.x", "phi", "gamma.z", "energy.residual", "support.F.z"} <= rows[0].keys()


@pytest.fixture
def run(monkeypatch, tmp_path):
    """Runs the demo in this process on an FMU; its exit code."""
    monkeypatch.syspath_prepend(str(DEMO))
    import demo

    def call(fmu):
        monkeypatch.setattr(sys, "argv", ["demo.py", str(fmu), "--out", str(tmp_path / "demo")])
        return demo.main()

    return call


def test_exact_energy_that_does_not_add_up_is_an_error(paper, run, monkeypatch, capsys):
    from report import measure

    monkeypatch.setattr(measure, "BOUND_FACTOR", 0.0)
    assert run(paper.path) == 1
    error = capsys.readouterr().err
    assert re.fullmatch(
        r"error: the energy of paper does not add up: the largest residual, \S+ J, exceeds its bound, 0 J\n", error
    )


def test_exact_a_run_that_ends_early_is_an_error(paper, run, monkeypatch, capsys):
    """A rotor that tumbles to where the law of its spring ends."""
    from report import simulate

    own = simulate.simulate_fmu
    start = {"start.omega.x": 0.0, "start.omega.y": 5.0, "support.c1": 0.0, "support.c2": 1e-300}
    monkeypatch.setattr(simulate, "simulate_fmu", lambda *words, **named: own(*words, start_values=start, **named))
    assert run(paper.path) == 1
    error = capsys.readouterr().err
    assert f"error: {paper.path}: the FMU stopped at 0.62 s of 10 s" in error
    assert "the tilt |gamma| reaches 3.1 rad" in error


def test_exact_a_file_that_is_no_fmu_is_an_error(run, tmp_path, capsys):
    file = tmp_path / "no.fmu"
    file.write_text("no zip", encoding="utf-8")
    assert run(file) == 1
    assert capsys.readouterr().err == f"error: {file}: File is not a zip file\n"
