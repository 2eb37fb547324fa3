"""One run, wherever it comes from: all that the report knows of it."""

import csv
import json
from dataclasses import dataclass

import numpy as np
from fmpy import read_model_description

from .scene import Scene


DEFLECTIONS = "deflections.json"
"""The largest deflections of a run, beside its table."""


class NotAResult(Exception):
    """A folder does not hold a run; the text names the file and what is wrong with it."""


@dataclass(frozen=True)
class Timings:
    """What a run took [s]."""

    solver: float
    """CPU time of the solver: in fmpy, that within fmi2DoStep; in `run`, with the search for the largest deflections."""
    total: float | None = None
    """CPU time from the set-up of the experiment to its end, the host's own work included; None without a host."""
    wall: float | None = None
    """Wall time of the same."""


@dataclass(frozen=True)
class Deflection:
    """The largest deflection of a station from the x axis, static deflection included."""

    station: str
    """Its name: `r_c`, `probe[1]` …"""
    largest: float
    """[m]"""
    at: float
    """When that was [s]."""
    is_sample: bool = False
    """Whether it is the largest of the samples, between which it may have been larger."""


@dataclass(frozen=True)
class Result:
    """What a run left behind."""

    scene: Scene
    columns: np.ndarray
    """Structured: `time` [s] and every output in its SI unit, a row a sample."""
    by: str
    """What ran it, as the page shall say."""
    timings: Timings | None = None
    """None where nobody measured."""
    log: tuple[str, ...] = ()
    """What the FMU logged, `status category: message`."""
    response: np.ndarray | None = None
    """Of a scene that answers to an imposed speed, columns `speed` [rad/s] and `radius` [m] of the whirl that lasts."""
    deflections: tuple[Deflection, ...] = ()
    """The largest deflections that the solver's dense output tells; empty where only samples are known."""

    @property
    def at_steps(self):
        """The columns at the steps of the scene's experiment, and at its end."""
        time = self.columns["time"]
        stride = max(1, round(self.scene.step / (time[1] - time[0])))
        return self.columns[np.union1d(np.arange(0, len(time), stride), len(time) - 1)]


def read(folder, table="result.csv", solver=None):
    """The run in `folder`: its modelDescription.xml and its `table`, `time` and a column an output; `solver` is the CPU time it took [s]."""
    try:
        scene = Scene.of(read_model_description(str(folder / "modelDescription.xml")))
        with (folder / table).open(encoding="utf-8", newline="") as file:
            rows = csv.reader(file)
            names = next(rows, [])
            values = [tuple(map(float, row)) for row in rows]
    except (OSError, ValueError) as failure:
        raise NotAResult(f"{folder}: {failure}") from failure
    if missing := {"time", *scene.outputs} - set(names):
        raise NotAResult(f"{folder / table}: no column {', '.join(sorted(missing))}")
    if len(values) < 2 or any(len(row) != len(names) for row in values):
        raise NotAResult(f"{folder / table}: at least two rows are needed, all as long as the header")
    columns = np.array(values, dtype=[(name, float) for name in names])
    timings = None if solver is None else Timings(solver)
    return Result(scene, columns, "without an FMU, by cargo xtask run", timings, deflections=_deflections(folder / DEFLECTIONS))


def _deflections(file):
    """The largest deflections in `file`; none where it is not there."""
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
        return tuple(Deflection(one["station"], one["largest_m"], one["at_s"]) for one in found)
    except FileNotFoundError:
        return ()
    except (OSError, ValueError, KeyError, TypeError) as failure:
        raise NotAResult(f"{file}: {failure}") from failure
