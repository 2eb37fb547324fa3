"""The demo on the packaged paper's rotor: a report that needs nothing beside it, an exit code that means something."""

import csv
import json
import os
import re
import subprocess
import sys

import project
import pytest

DEMO = project.ROOT / "xtask" / "python"
LIBRARY = {"https://github.com/leeoniya/uPlot"}  # in the head of its file
LARGEST = 1_500_000  # [bytes], measured 828 000


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
    assert set(re.findall(r'https?://[^\s"\'<>)]+', report)) <= LIBRARY
    # what a browser would fetch
    assert re.findall(r"<(?:link|img|iframe|object|embed)\b|@import|url\(", report) == []
    assert re.findall(r'\b(?:src|href)="', report) == []
    assert "Permission is hereby granted" in report and "<td>uPlot</td><td>1.6.32</td>" in report, "the licence goes with it"
    assert len(report.encode()) <= LARGEST


def test_exact_report_holds_its_pictures(report):
    """Each with its title, its caption and what is to be drawn; a browser draws them in test_report.py."""
    panels = json.loads(re.search(r'<script type="application/json" id="panels">(.*?)</script>', report, re.DOTALL)[1])
    titles = re.findall(r"<figure class=\"\w+\">\s*<h2>(.*?)</h2>", report)
    assert titles == [panel["title"] for panel in panels]
    assert {"The rotor", "Path of the mass centre", "Speed beside its start", "Energy"} <= set(titles)
    assert "The axis" not in titles, "it leans too little for a picture of its own"
    assert all(panel["caption"] for panel in panels)
    motion = panels[0]["machine"]["motion"]
    assert len(motion["time"]["whole"]) == len(motion["r_c.z"]["whole"]) == 10_001
    assert "NaN" not in report.split('id="panels"')[1].split("</script>")[0]


def test_literature_report_finds_the_maximum_of_the_paper(demo, report):
    assert "off its start value by at most 0.0702 %" in demo[1]
    assert "0.0702 % at 2.704 s" in report
    assert "at most: less than the" in report and "not less than the" not in report


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


def test_exact_energy_that_does_not_add_up_is_an_error(paper, run, monkeypatch, capsys, tmp_path):
    from report import measure

    monkeypatch.setattr(measure, "BOUND_FACTOR", 0.0)
    monkeypatch.setattr(measure, "ROUNDING", 0.0)
    assert run(paper.path) == 1
    error = capsys.readouterr().err
    assert re.fullmatch(
        r"error: the energy of paper does not add up: the largest residual, \S+ J, exceeds its bound, 0 J\n", error
    )
    page = (tmp_path / "demo" / "report.html").read_text(encoding="utf-8")
    what = "at most: not less than the 0\u00a0J that tolerance and rounding allow"
    assert re.search(f'{what} where [^<]* moves</dt><dd class="bad">', page)


def test_exact_a_run_that_ends_early_is_an_error(paper, run, monkeypatch, capsys):
    """A rotor that tumbles to where the law of its spring ends."""
    from report import simulate

    own = simulate.simulate_fmu
    start = {"start.omega.x": 0.0, "start.omega.y": 5.0, "support.c1": 0.0, "support.c2": 1e-300}
    monkeypatch.setattr(simulate, "simulate_fmu", lambda *words, **named: own(*words, **{**named, "start_values": start}))
    assert run(paper.path) == 1
    error = capsys.readouterr().err
    assert f"error: {paper.path}: the FMU stopped at 0.62 s of 10 s" in error
    assert "the tilt |gamma| reaches 3.1 rad" in error


def test_exact_a_file_that_is_no_fmu_is_an_error(run, tmp_path, capsys):
    file = tmp_path / "no.fmu"
    file.write_text("no zip", encoding="utf-8")
    assert run(file) == 1
    assert capsys.readouterr().err == f"error: {file}: File is not a zip file\n"
