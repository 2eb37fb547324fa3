"""Many runs of one scene with parameters that vary, side by side on the cores of this machine or on a cluster of dask.

    python examples/sweep.py turbo.toml --vary 'bearing[1].kyy' 1e7 5e7 --runs 10000 --outputs 'probe[1].r.y' --out FOLDER
    python examples/sweep.py turbo.toml --table parameters.csv --outputs 'probe[1].r.y' --out FOLDER

FOLDER/runs/ gets a Parquet file for each chunk of runs, with a row a run; FOLDER/sweep.json holds the settings, FOLDER/parameters.parquet the
parameters of all runs. The same command goes on where an earlier one ended. Quantities are in SI units and radians. docs/sweeps.md has more.
"""

import argparse
import json
import math
import os
import sys
import warnings
from contextlib import nullcontext, suppress
from difflib import unified_diff
from functools import lru_cache
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from threading import Lock
from time import perf_counter, thread_time
from uuid import uuid4
from zipfile import BadZipFile

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

import split_rotor as sr

KEPT = {"last": lambda values: values[-1], "least": np.min, "largest": np.max}
"""What is kept of each output, by the end of its column's name."""
KILLS = 10
"""A chunk whose worker died so often is taken to kill it, and ends the sweep."""
LOOKED_AT = 100
"""So many rows of a table are looked at before anything runs, if need be."""
ONE_AT_A_TIME = Lock()
"""Of the threads of a worker: they share the instance of an FMU, and what Python does with warnings."""


# The parameters of all runs: a table with a row a run, a column a parameter by its name in the scene.


def parameters(options, scene):
    """The table that the command line asks for; a ValueError where no run could have what it asks for."""
    table = from_csv(options.table) if options.table else hypercube(options.vary, options.runs, options.seed)
    if len(set(table.column_names)) < table.num_columns or not table.num_rows:
        raise ValueError("the table of parameters has a name twice, or no rows")
    if options.fmu:
        from fmu_runs import check

        check(options.fmu, scene, table.column_names)
    causality = {name: variable["causality"] for name, variable in scene.variables.items()}
    for name in table.column_names:
        if causality.get(name) == "input":
            raise ValueError(f"{name} is an input, not a parameter: give it in the scene")
        # A column of a table, `unbalance[1].moment`, `solver.order`, or an error.
        if causality.get(name) != "parameter" and table[name].null_count == table.num_rows:
            raise ValueError(f"the column `{name}` is empty, and no parameter")
    for name in options.outputs:
        if causality.get(name) != "output":
            raise ValueError(f"{scene.name} has no output `{name}`")
    check_rows(scene, table)
    return table


def check_rows(scene, table):
    """Refuses a table of which no row that is looked at gives a scene; the others fail by themselves."""
    failures = []
    for row in table.take(np.unique(np.linspace(0, table.num_rows - 1, LOOKED_AT).astype(int))).to_pylist():
        try:
            scene.with_values(values_of(row))
            return
        except sr.SceneError as failure:
            failures.append(failure)
    raise failures[0]


def from_csv(path):
    """The table in a CSV file; a cell is a number, a text as in a scene ("15 N/um"), or empty for the scene's own value."""
    return pa.csv.read_csv(path, convert_options=pa.csv.ConvertOptions(null_values=[""], strings_can_be_null=True))


def hypercube(bounds, runs, seed):
    """A Latin hypercube: `bounds` are the two of each parameter by its name; each of as many equal parts as there are runs is met once."""
    from scipy.stats import qmc

    least, largest = np.transpose(list(bounds.values()))
    if not (np.isfinite(largest - least) & (least < largest)).all():
        raise ValueError("--vary: FROM must be below TO, both finite")
    points = qmc.scale(qmc.LatinHypercube(len(bounds), rng=seed).random(runs), least, largest)
    return pa.table(dict(zip(bounds, points.T, strict=True)))


# What a worker does.


def value_of(cell):
    """What a cell of a table says: in a column with a text, numbers and truths are texts, too."""
    if isinstance(cell, int | float):
        return cell
    text = str(cell)  # a date, too, which the scene then refuses
    for kind in (int, float, {"true": True, "false": False}.__getitem__):
        with suppress(ValueError, KeyError):
            return kind(text)
    return text


def values_of(row):
    """What is told of the scene by a row, which leaves the scene's own value where a cell is empty."""
    return {name: value_of(cell) for name, cell in row.items() if cell is not None}


class InProcess:
    """A way to run: by `split_rotor.run`.

    It is called with a run's parameters by their names, and returns the outputs, shape (outputs, points), and how many steps the solver took. A
    run that fails is a SceneError or a RuntimeError. Of the last run, `cpu` is the CPU time in the library [s], `log` what it had to say.
    """

    def __init__(self, scene, outputs):
        self.scene, self.outputs = scene, outputs

    def __call__(self, values):
        self.cpu, self.log = 0.0, []
        scene = self.scene.with_values(values)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            began = thread_time()
            try:
                result = sr.run(scene, outputs=self.outputs)
            finally:
                self.cpu = thread_time() - began
                self.log = [str(warning.message) for warning in told]
        return [result[name] for name in self.outputs], int(result.solver["steps"])


class Sweep:
    """A sweep as its folder tells it; `fmu` is the path of its FMU, or None."""

    def __init__(self, folder, fmu):
        text = (folder / "sweep.json").read_text(encoding="utf-8")
        self.settings = json.loads(text)
        self.parameters = pa.parquet.read_table(folder / "parameters.parquet")
        scene, outputs = sr.Scene.from_toml(self.settings["scene"]), self.settings["outputs"]
        if fmu is None:
            self.way = InProcess(scene, outputs)
        else:
            from fmu_runs import OfFmu

            self.way = OfFmu(fmu, scene, outputs)
        units = {name: {"unit": variable["unit"]} for name, variable in scene.variables.items()}
        kept = [pa.field(f"{name}.{kept}", pa.float64(), metadata=units[name]) for name in outputs for kept in KEPT]
        parameters = [field.with_metadata(units.get(field.name)) for field in self.parameters.schema]
        about = [("status", pa.string()), ("log", pa.string()), ("steps", pa.int64()), ("cpu_s", pa.float64())]
        fields = [("run", pa.int64()), *parameters, *kept, *about]
        self.schema = pa.schema(fields, metadata={"sweep": text})

    def row(self, number, values):
        """What is told of a run."""
        row = {"run": number, **values, "status": "ok"}
        try:
            outputs, row["steps"] = self.way(values_of(values))
            for name, output in zip(self.settings["outputs"], outputs, strict=True):
                row |= {f"{name}.{end}": float(keep(output)) for end, keep in KEPT.items()}
        except (sr.SceneError, RuntimeError) as failure:
            row["status"] = str(failure)
        return row | {"log": "\n".join(self.way.log), "cpu_s": self.way.cpu}


@lru_cache(maxsize=1)
def load(folder, fmu, _stamp):
    """The sweep in a folder, once a process and content of its sweep.json."""
    return Sweep(folder, fmu)


def file_of(folder, number):
    """Where the rows of a chunk are."""
    return folder / "runs" / f"chunk-{number:06}.parquet"


def run_chunk(number, folder, fmu, stamp):
    """Runs a chunk and writes its rows; how many they are, how many of them failed, and CPU time in the library [s]."""
    with ONE_AT_A_TIME:
        sweep = load(folder, fmu, stamp)
        size = sweep.settings["chunk"]
        values = sweep.parameters.slice(number * size, size).to_pylist()
        rows = [sweep.row(n, one) for n, one in enumerate(values, start=number * size)]
    write(file_of(folder, number), lambda path: pa.parquet.write_table(pa.Table.from_pylist(rows, sweep.schema), path))
    return len(rows), sum(row["status"] != "ok" for row in rows), sum(row["cpu_s"] for row in rows)


def write(path, write_to):
    """Writes a file as a whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(f".{path.name}.{uuid4().hex}")  # such names are passed over by who reads the folder
    write_to(unfinished)
    os.replace(unfinished, path)


# What the command does.


def prepare(options):
    """Writes down what will be run, or makes sure that it is what stands there; a stamp of it."""
    load_scene = sr.Scene.load if options.scene.endswith(".toml") else sr.Scene.named
    experiment = {"experiment.stop": options.stop, "experiment.step": options.step}
    scene = load_scene(options.scene).with_values({name: value for name, value in experiment.items() if value is not None})
    if scene.inputs:  # those from files too: a worker has none
        scene = scene.with_inputs([(name, *course) for name, course in scene.inputs.items()])
    settings = settings_of(options, scene)
    text = json.dumps(settings, indent=1, ensure_ascii=False)
    file = options.out / "sweep.json"
    if not file.exists():
        if any(options.out.glob("runs/chunk-*")):
            raise ValueError(f"{options.out} has runs, and no sweep.json that says of what; take another --out")
        table = parameters(options, scene)
        write(file.with_name("parameters.parquet"), lambda path: pa.parquet.write_table(table, path))
        write(file, lambda path: path.write_text(text, encoding="utf-8"))
    elif (there := settings_in(file)) is None or whole_table(file.with_name("parameters.parquet")) is None:
        raise ValueError(f"{options.out}: sweep.json or parameters.parquet is lost or damaged; take another --out")
    elif there != settings:
        lines = [line for name in there | settings for line in difference(name, there.get(name), settings.get(name))]
        raise ValueError("\n".join([f"{file} has other settings (-) than these (+); take another --out", *lines]))
    return sha256(text.encode()).hexdigest()


def settings_of(options, scene):
    """What the results depend on."""
    if options.table:
        of_runs = {"table": digest(options.table)}
    else:
        of_runs = {"vary": {name: list(ends) for name, ends in options.vary.items()}, "runs": options.runs, "seed": options.seed}
    by = f"FMU {digest(options.fmu)}" if options.fmu else "split_rotor.run"
    return {"version": version("split-rotor"), "scene": scene.toml, "by": by, **of_runs, "outputs": options.outputs, "chunk": options.chunk}


def settings_in(file):
    """Those that were written down; None where the file is damaged."""
    with suppress(ValueError):
        return json.loads(file.read_text(encoding="utf-8"))


def digest(path):
    """The SHA-256 of a file."""
    return sha256(path.read_bytes()).hexdigest()


def difference(name, there, here):
    """Lines that say how a setting differs, if it does."""
    texts = [(value if isinstance(value, str) else json.dumps(value)).splitlines() for value in (there, here)]
    lines = list(unified_diff(*texts, n=0, lineterm=""))[2:]
    return [f"  {name}", *(f"    {line}" for line in lines if not line.startswith("@@"))] if lines else []


def whole_table(file):
    """The table in a file; None where it is not there or damaged, as by a loss of power."""
    with suppress(OSError, pa.ArrowException):
        return pa.parquet.read_table(file)


def statuses(file, count):
    """Those of the runs of a chunk; none where so many are not there."""
    table = whole_table(file)
    return [] if table is None or table.num_rows != count else table["status"].to_pylist()


def run_all(options, stamp):
    """Runs the chunks that are not there, and tells how it goes; returns the exit code, 1 where every run of the sweep failed."""
    began = perf_counter()
    folder, size = options.out, options.chunk
    runs = pa.parquet.read_metadata(folder / "parameters.parquet").num_rows
    before = {n: statuses(file_of(folder, n), min(size, runs - n * size)) for n in range(math.ceil(runs / size))}
    missing, there = [n for n, told in before.items() if not told], sum(map(len, before.values()))
    done, failed, cpu, cores = 0, sum(status != "ok" for told in before.values() for status in told), 0.0, 1
    if not missing:
        print(f"all {runs} runs were there, {failed} failed")
        return 1 if failed == runs else 0
    import dask
    from distributed import Client, LocalCluster, as_completed
    from tqdm import tqdm

    if options.scheduler:
        print(f"waiting for {options.scheduler} and its workers", flush=True)
    # Dask's profiler would take a fiftieth of the time, and nobody looks at it.
    dask.config.set({"distributed.scheduler.allowed-failures": KILLS, "distributed.worker.profile.enabled": False})
    here = nullcontext(options.scheduler) if options.scheduler else LocalCluster(
        n_workers=options.processes, threads_per_worker=1, dashboard_address=None
    )
    with here as cluster, Client(cluster) as client, tqdm(total=runs, initial=there, unit=" runs", disable=None) as bar:
        for module in ["fmu_runs.py", "sweep.py"] if options.fmu else ["sweep.py"]:
            client.upload_file(str(Path(__file__).with_name(module)))
        client.wait_for_workers(1)
        tasks = client.map(run_chunk, missing, folder=folder, fmu=options.fmu, stamp=stamp, pure=False)
        for task, result in as_completed(tasks, with_results=True):
            if isinstance(result, BaseException):
                raise result
            task.release()  # or dask would run it again where its worker dies
            count, failures, seconds = result
            cores = max(cores, len(client.nthreads()))  # a worker runs one chunk at a time
            tenths = 10 * (there + done) // runs
            done, failed, cpu = done + count, failed + failures, cpu + seconds
            bar.update(count)
            if bar.disable and 10 * (there + done) // runs > tenths:
                print(f"{there + done} of {runs} runs, {perf_counter() - began:.0f} s", flush=True)
    for unfinished in folder.glob("runs/.*"):  # of workers that were killed
        unfinished.unlink()
    wall = perf_counter() - began
    earlier = f" ({there} were there)" if there else ""
    share = cpu / (wall * cores)
    print(f"{done} runs{earlier}, {failed} failed, {wall:.1f} s; CPU in the library {cpu:.1f} s, {share:.0%} of {cores} cores")
    return 1 if failed == runs else 0


def arguments(words=None):
    """The command line."""

    def a_path(word):
        return Path(word).resolve()  # a worker may run elsewhere

    parser = argparse.ArgumentParser(description="Many runs of one scene with parameters that vary.")
    parser.add_argument("scene", metavar="SCENE", help="a scene's file, or the name of one that comes with the package")
    of_runs = parser.add_mutually_exclusive_group(required=True)
    of_runs.add_argument("--table", type=Path, metavar="CSV", help="a row a run, a column a parameter by its name in the scene")
    of_runs.add_argument(
        "--vary", action="append", nargs=3, metavar=("NAME", "FROM", "TO"), help="a parameter between bounds, by a Latin hypercube; repeat it"
    )
    parser.add_argument("--runs", type=int, default=1000, metavar="N", help="with --vary: how many (1000)")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="with --vary: of the hypercube (0)")
    parser.add_argument("--outputs", nargs="+", required=True, metavar="NAME", help="of each, its last, least and largest value is kept")
    parser.add_argument("--out", type=a_path, required=True, metavar="FOLDER", help="where the results go")
    parser.add_argument("--stop", type=float, metavar="S", help="the end of each run, in place of the scene's")
    parser.add_argument("--step", type=float, metavar="S", help="between the points that are looked at, in place of the scene's")
    parser.add_argument("--fmu", type=a_path, metavar="FILE", help="run this packaged FMU of the scene under fmpy, in place of split_rotor.run")
    parser.add_argument("--chunk", type=int, default=100, metavar="N", help="runs a task and a file (100)")
    parser.add_argument("--processes", type=int, metavar="N", help="of the cluster on this machine (one a core)")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="of a cluster of dask; its workers see the same folders")
    options = parser.parse_args(words)
    if min(options.runs, options.chunk, 1 if options.processes is None else options.processes) < 1:
        parser.error("--runs, --chunk and --processes must be at least 1")
    options.outputs = list(dict.fromkeys(options.outputs))
    names = [name for name, *_ in options.vary or ()]
    if len(set(names)) < len(names):
        parser.error("--vary: a parameter is named twice")
    try:
        options.vary = {name: (float(least), float(largest)) for name, least, largest in options.vary or ()}
    except ValueError as error:
        parser.error(f"--vary: {error}")
    return options


def main(words=None):
    """The command; returns the exit code."""
    options = arguments(words)
    try:
        stamp = prepare(options)
    except (ValueError, OSError, BadZipFile) as error:  # a SceneError, too
        print(f"error: {str(error).removeprefix('error: ')}", file=sys.stderr)
        return 1
    try:
        return run_all(options, stamp)
    except KeyboardInterrupt:
        print("interrupted: the same command goes on with it", file=sys.stderr)
        return 130
    except Exception as error:  # whatever happens to a cluster and its workers
        print(f"error: {type(error).__name__}: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    import sweep  # by its name, under which workers find it

    sys.exit(sweep.main())
