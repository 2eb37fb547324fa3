"""examples/sweep.py: every run is there once, with the values of `split_rotor.run`, whatever dies on the way."""

import json
import os
import shlex
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import psutil
import pyarrow.parquet as pq
import pytest
from conftest import ROOT, block

import split_rotor as sr

sys.path.insert(0, str(ROOT / "examples"))
import sweep  # noqa: E402

OUTPUTS = ["probe[1].r.y", "omega_phi"]
HYPERCUBE = ["--vary", "bearing[1].kyy", "1e7", "5e7", "--vary", "rotor.m", "10", "14", "--runs", "400", "--chunk", "10"]
PATIENCE = 60.0  # s, before a test gives up


@pytest.fixture(scope="session")
def scene(tmp_path_factory):
    """The path of the README's scene."""
    path = tmp_path_factory.mktemp("scene") / "turbo.toml"
    path.write_text(block("README.md", "toml"), encoding="utf-8")
    return path


def words(scene, out, of_runs, *more):
    """The words of a command."""
    return [str(scene), "--outputs", *OUTPUTS, "--out", str(out), "--stop", "0.5", "--step", "1e-3", *of_runs, *more]


def start(scene, out, *more, processes=2):
    """The command with HYPERCUBE, begun in a process group of its own."""
    command = [sys.executable, str(ROOT / "examples" / "sweep.py"), *words(scene, out, HYPERCUBE, "--processes", str(processes), *more)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)


def rows(out):
    """What the files of a sweep hold, but for the time that it took."""
    rows = pq.read_table(out / "runs").to_pylist()
    assert all(row.pop("cpu_s") >= 0.0 for row in rows)
    return rows


def run_here(scene, out, of_runs, *more):
    """The rows of a sweep without dask."""
    options = sweep.arguments(words(scene, out, of_runs, *more))
    stamp = sweep.prepare(options)
    runs = pq.read_metadata(out / "parameters.parquet").num_rows
    for number in range(-(-runs // options.chunk)):
        sweep.run_chunk(number, options.out, options.fmu, stamp)
    return rows(out)


def wait_for(what):
    """What this gives as soon as it is true."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if found := what():
            return found
        time.sleep(0.01)
    pytest.fail("nothing happened")


def chunks(out):
    """The files of chunks that are there."""
    return {path.name: path.stat().st_mtime_ns for path in (out / "runs").glob("chunk-*.parquet")}


@pytest.fixture(scope="session")
def undisturbed(scene, tmp_path_factory):
    """The folder of a sweep that nobody disturbed."""
    out = tmp_path_factory.mktemp("undisturbed")
    process = start(scene, out)
    told, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0, errors
    assert told.splitlines()[-1].startswith("400 runs, 0 failed, ") and "200 of 400 runs, " in told
    return out


def test_each_row_is_a_run(scene, undisturbed):
    found = rows(undisturbed)
    assert [row["run"] for row in found] == list(range(400)) and {row["status"] for row in found} == {"ok"}
    for row in found[::100]:
        changed = sr.Scene.load(scene).with_values({name: row[name] for name in ["bearing[1].kyy", "rotor.m"]})
        result = sr.run(changed, outputs=OUTPUTS, stop=0.5, step=1e-3)
        assert row["steps"] == result.solver["steps"]
        for name in OUTPUTS:
            kept = [row[f"{name}.{kept}"] for kept in ("last", "least", "largest")]
            assert kept == [result[name][-1], result[name].min(), result[name].max()]
    schema = pq.read_schema(next((undisturbed / "runs").iterdir()))
    assert schema.field("probe[1].r.y.last").metadata == {b"unit": b"m"} and schema.field("rotor.m").metadata == {b"unit": b"kg"}
    settings = json.loads(schema.metadata[b"sweep"])
    assert settings == json.loads((undisturbed / "sweep.json").read_text(encoding="utf-8")) and settings["seed"] == 0


def test_exact_a_hypercube_meets_each_part_of_each_range_once():
    bounds = {"rotor.m": (10.0, 14.0), "bearing[1].kyy": (1e7, 5e7)}
    table = sweep.hypercube(bounds, 100, 3)
    for name, (least, largest) in bounds.items():
        parts = np.floor((table[name].to_numpy() - least) / (largest - least) * 100.0)
        assert sorted(parts) == list(range(100))
    assert table.equals(sweep.hypercube(bounds, 100, 3)) and not table.equals(sweep.hypercube(bounds, 100, 4))


def test_a_worker_killed_twice_loses_nothing(scene, undisturbed, tmp_path):
    process = start(scene, tmp_path)
    killed = set()
    for count in [1, 6]:
        wait_for(lambda count=count: len(chunks(tmp_path)) >= count)
        workers = [child for child in psutil.Process(process.pid).children(recursive=True) if "spawn_main" in " ".join(child.cmdline())]
        worker = max(workers, key=lambda child: child.cpu_times().user)
        worker.kill()
        killed.add(worker.pid)
    assert len(killed) == 2 and len(chunks(tmp_path)) < 40
    told, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0 and told.splitlines()[-1].startswith("400 runs, 0 failed, "), errors
    assert rows(tmp_path) == rows(undisturbed)
    assert len(list((tmp_path / "runs").iterdir())) == 40, "no file is left of a worker that was killed"


def test_a_sweep_that_was_killed_goes_on(scene, undisturbed, tmp_path):
    process = start(scene, tmp_path)
    wait_for(lambda: len(chunks(tmp_path)) >= 3)
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    before = chunks(tmp_path)
    assert 3 <= len(before) < 40
    # As where the machine lost its power, too: one is empty, and one has the end of a file only.
    for lost, keeps in zip(sorted(before)[:2], [0, 1000], strict=True):
        path = tmp_path / "runs" / lost
        whole = path.read_bytes()
        path.write_bytes(bytes(len(whole) - keeps if keeps else 0) + whole[len(whole) - keeps :])
        del before[lost]
    process = start(scene, tmp_path, processes=1)
    told, errors = process.communicate(timeout=PATIENCE)
    assert told.splitlines()[-1].endswith(" of 1 cores"), told
    done = 10 * len(before)
    assert process.returncode == 0 and told.splitlines()[-1].startswith(f"{400 - done} runs ({done} were there), 0 failed, "), errors
    assert before.items() <= chunks(tmp_path).items(), "what was there is not run again"
    assert rows(tmp_path) == rows(undisturbed)


def test_a_finished_sweep_tells_so_at_once_and_one_without_parameters_is_refused(scene, undisturbed, tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "tqdm", None)  # nothing is begun
    assert sweep.main(words(scene, undisturbed, HYPERCUBE)) == 0
    assert capsys.readouterr().out == "all 400 runs were there, 0 failed\n"
    shutil.copy(undisturbed / "sweep.json", tmp_path)
    assert sweep.main(words(scene, tmp_path, HYPERCUBE)) == 1
    assert "sweep.json or parameters.parquet is lost or damaged; take another --out" in capsys.readouterr().err
    (tmp_path / "sweep.json").unlink()
    shutil.copytree(undisturbed / "runs", tmp_path / "runs")
    assert sweep.main(words(scene, tmp_path, HYPERCUBE)) == 1
    assert "has runs, and no sweep.json that says of what" in capsys.readouterr().err


def test_other_settings_are_refused_and_told(scene, undisturbed, tmp_path, capsys):
    other = tmp_path / "turbo.toml"
    other.write_text(scene.read_text(encoding="utf-8").replace("Ja = 0.04", "Ja = 0.05"), encoding="utf-8")
    before = chunks(undisturbed)
    assert sweep.main(words(other, undisturbed, HYPERCUBE, "--seed", "1")) == 1
    told = capsys.readouterr().err
    assert "sweep.json has other settings (-) than these (+)" in told
    assert "  scene\n    -Ja = 0.04\n    +Ja = 0.05\n  seed\n    -0\n    +1\n" in told and "outputs" not in told
    assert chunks(undisturbed) == before


def test_a_table_and_a_run_that_fails(scene, tmp_path):
    table = tmp_path / "parameters.csv"
    table.write_text("rotor.m,bearing[1].kyy,unbalance[1].moment\n11,15 N/um,1e-5\n-1,1.5e7,1e-5\n11,1.5e7,1e-5\n12,,2e-5\n", encoding="utf-8")
    good, bad, same, last = run_here(scene, tmp_path / "out", ["--table", str(table)])
    assert (good["status"], last["status"], last["bearing[1].kyy"]) == ("ok", "ok", None)
    assert good["probe[1].r.y.largest"] == same["probe[1].r.y.largest"], "numbers may stand among texts"
    assert "it must be a finite number > 0" in bad["status"] and bad["probe[1].r.y.last"] is bad["steps"] is None
    changed = sr.Scene.load(scene).with_values({"unbalance[1].moment": 2e-5})
    assert last["probe[1].r.y.largest"] == sr.run(changed, outputs=OUTPUTS, stop=0.5, step=1e-3)["probe[1].r.y"].max()


def test_truths_whole_numbers_and_names_are_cells_too(scene, tmp_path):
    table = tmp_path / "parameters.csv"
    table.write_text("solver.order,start.at_rest,solver.method\n4,true,dop853\n8,flase,stiff\n8,false,stiff\n", encoding="utf-8")
    first, slip, last = run_here(scene, tmp_path / "out", ["--table", str(table)])
    assert (first["status"], last["status"]) == ("ok", "ok") and 'start.at_rest = "flase"' in slip["status"]


def test_parameters_may_be_possible_only_together(scene, tmp_path):
    table = tmp_path / "parameters.csv"
    table.write_text("rotor.Ja,rotor.Jt\n0.5,0.1\n0.5,0.5\n0.5,0.1\n", encoding="utf-8")
    first, together, last = run_here(scene, tmp_path / "out", ["--table", str(table)])
    assert together["status"] == "ok" and first["status"] == last["status"] and "rotor.Ja" in first["status"]


@pytest.mark.parametrize("by_fmu", [False, True])
def test_what_the_rotor_warns_of_and_why_a_run_ended_early_are_in_its_row(by_fmu, tmp_path):
    # It tumbles, held by next to no spring, whose law ends at 3.1 rad; at the slower speed it does not come so far.
    values = {"start.omega.x": 0.0, "gravity.g.z": 0.0, "support.c1": 0.0, "support.c2": 1e-300}
    scene, path, table = sr.Scene.named("paper").with_values(values), tmp_path / "tumbles.toml", tmp_path / "parameters.csv"
    path.write_text(scene.toml, encoding="utf-8")
    table.write_text("start.omega.y\n4.9\n1.0\n", encoding="utf-8")
    fmu = ["--fmu", str(sr.package(scene, tmp_path / "tumbles.fmu"))] if by_fmu else []
    words = [str(path), "--table", str(table), "--outputs", "r_c.x", "--out", str(tmp_path / "out"), "--stop", "1", *fmu]
    options = sweep.arguments(words)
    sweep.run_chunk(0, options.out, options.fmu, sweep.prepare(options))
    early, whole = rows(options.out)
    assert "the tilt |gamma| reaches 3.1 rad" in early["status"] and "pi/2" in early["log"] and early["r_c.x.last"] is None
    assert (whole["status"], whole["log"]) == ("ok", "") and whole["r_c.x.last"] is not None


def test_exact_an_fmu_gives_the_rows_of_the_package(scene, tmp_path):
    fmu = sr.package(sr.Scene.load(scene), tmp_path / "turbo.fmu")
    table = tmp_path / "parameters.csv"
    table.write_text("rotor.m,bearing[1].kyy,unbalance[1].moment\n11,15 N/um,1e-5\n-1,,1e-5\n13,,\n11,15 N/um,1e-5\n", encoding="utf-8")
    of_fmu = run_here(scene, tmp_path / "fmu", ["--table", str(table)], "--fmu", str(fmu))
    assert of_fmu == run_here(scene, tmp_path / "package", ["--table", str(table)])
    first, failed, other, again = ({name: value for name, value in row.items() if name != "run"} for row in of_fmu)
    assert first == again != other and (other["status"], failed["steps"]) == ("ok", None), "nothing is left of the run before"


def test_inputs_over_time_are_the_scenes_under_an_fmu_too(scene, tmp_path):
    # It bends between two communication points, at one, and jumps.
    text = scene.read_text(encoding="utf-8").replace("time = [0.0, 3.0, 3.0]", "time = [0.0, 0.0333, 0.1, 0.25005, 0.25005]")
    bent = tmp_path / "turbo.toml"
    bent.write_text(text.replace("value = [30.0, 30.0, 0.0]", "value = [10.0, 30.0, 20.0, 35.0, -5.0]"), encoding="utf-8")
    fmu = sr.package(sr.Scene.load(bent), tmp_path / "turbo.fmu")
    of_runs = ["--vary", "rotor.m", "10", "14", "--runs", "3"]
    of_fmu = run_here(bent, tmp_path / "fmu", of_runs, "--fmu", str(fmu))
    ours = run_here(bent, tmp_path / "package", of_runs)
    assert of_fmu == ours


@pytest.mark.parametrize(
    ("more", "told"),
    [
        (["--vary", "rotor.q", "1", "2"], "unknown key `rotor.q`"),
        (["--vary", "solver.method_number", "0.2", "0.4"], "solver.method"),
        (["--vary", "rotor.m", "-2", "-1"], "it must be a finite number > 0"),
        (["--vary", "rotor.m", "2", "1"], "FROM must be below TO"),
        (["--vary", "rotor.m", "2", "inf"], "both finite"),
        (["--vary", "drive.tau", "2", "3"], "drive.tau is an input, not a parameter"),
        (["--vary", "rotor.m", "2", "3", "--fmu", "nosuch.fmu"], "nosuch.fmu"),
        (["--vary", "rotor.m", "1", "2", "--outputs", "rotor.m"], "turbo has no output `rotor.m`"),
        (["--table", "nosuch.csv"], "nosuch.csv"),
        (["--table", "empty.csv"], "the column `rotor.q` is empty, and no parameter"),
        (["--table", "dates.csv"], 'm = "2026-01-01"'),
        (["--vary", "rotor.Ja", "0.04", "0.05", "--fmu", "paper.fmu"], "paper.fmu is of another scene: rotor.m = 5.0, not 11.999"),
        (["--vary", "experiment.stop", "1", "2", "--fmu", "turbo.fmu"], "experiment.stop cannot vary under an FMU"),
        (["--vary", "solver.method_number", "2", "3", "--fmu", "turbo.fmu"], "solver.method_number cannot vary under an FMU"),
        (["--vary", "rotor.m", "2", "3", "--fmu", "other.fmu"], "other.fmu is of another scene: probe[1].angle is in one of them only"),
    ],
)
def test_what_cannot_be_swept_is_told_at_the_start(scene, tmp_path, monkeypatch, capsys, more, told):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty.csv").write_text("rotor.m,rotor.q\n11,\n12,\n", encoding="utf-8")
    (tmp_path / "dates.csv").write_text("rotor.m\n2026-01-01\n", encoding="utf-8")
    for name in {"paper.fmu", "turbo.fmu"}.intersection(more):
        sr.package(sr.Scene.named(name.removesuffix(".fmu")), tmp_path / name)
    if "other.fmu" in more:
        text = scene.read_text(encoding="utf-8")
        sr.package(sr.Scene.from_toml(text[: text.index("[[effects.probe")] + text[text.index("[effects.drive]") :]), tmp_path / "other.fmu")
    assert sweep.main([str(scene), "--outputs", "phi", "--out", "out", *more]) == 1
    error = capsys.readouterr().err
    assert error.startswith("error: ") and told in error
    assert not (tmp_path / "out").exists()


def test_lines_of_the_document(scene, undisturbed, tmp_path, monkeypatch):
    text = (ROOT / "docs" / "sweeps.md").read_text(encoding="utf-8")
    lines = [line for part in text.split("```sh\n")[1:] for line in part.split("```")[0].splitlines()]
    commands = [shlex.split(line, comments=True) for line in lines if "examples/sweep.py" in line]
    assert len(commands) > 3
    for _python, _file, *of_command in commands:
        sweep.arguments(of_command)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sweep").symlink_to(undisturbed)
    names = {}
    exec(text.split("```python\n")[1].split("```")[0], names)  # as a reader would
    assert len(names["runs"]) == 400
