"""A scene simulated in this process."""

import warnings
from collections.abc import Iterator, Mapping
from numbers import Real

import numpy as np

from . import _core


class Result(Mapping):
    """What a run showed: `result["r_c.y"]` is an array of as many values as `result.time`."""

    def __init__(self, scene, seen):
        time, count = np.frombuffer(seen["time"]), seen["count"]
        values = np.frombuffer(seen["values"]).reshape(-1, len(time))[:, :count]
        self.scene = scene
        """The scene that ran, with the run's own options."""
        self.time = time[:count]
        """Communication points [s], shape (points,)."""
        self.units = dict(zip(seen["names"], seen["units"], strict=True))
        """The unit of each output by its name, "" where it has none."""
        self.solver = seen["solver"]
        """`method`, and what it spent: `steps`, `rejected`, `evaluations`."""
        self.log = seen["log"] + seen["warnings"]
        """What the solver and the rotor had to say."""
        self._values = dict(zip(seen["names"], values, strict=True))

    def __getitem__(self, name) -> np.ndarray:
        """The values of this output, shape (points,)."""
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self):
        return len(self._values)

    def __repr__(self):
        return f"<Result of {self.scene.name}: {len(self)} outputs at {len(self.time)} points>"

    def to_pandas(self):
        """A pandas.DataFrame: a column for each output, indexed by time [s]; units in `attrs["units"]`."""
        import pandas as pd

        frame = pd.DataFrame(self._values, index=pd.Index(self.time, name="time"))
        frame.attrs["units"] = self.units
        return frame

    def to_xarray(self):
        """An xarray.Dataset over `time`, the unit of each output in its `attrs["units"]`."""
        import xarray as xr

        outputs = {name: ("time", values, {"units": self.units[name]}) for name, values in self.items()}
        time = ("time", self.time, {"units": "s"})
        return xr.Dataset(outputs, coords={"time": time}, attrs={"title": self.scene.title})


def run(scene, *, inputs=None, outputs=None, stop=None, step=None, method=None, tolerance=None) -> Result:
    """Simulates a scene; its values have the bits of the scene's FMU.

    inputs: inputs over time by name, in place of those of the scene: a number, or times [s] and values of equal length, linear between
        them, held before and after; equal times are a jump.
    outputs: names of those that are wanted, else all: fewer take less time.
    stop, step: end and communication step [s].
    method, tolerance: as `solver.method` and `experiment.tolerance` in a scene.

    Raises SceneError where any of these is not possible, and RunError where the motion cannot be followed to the end; its `result` holds what
    was reached. Other threads run meanwhile, and Ctrl-C ends it.
    """
    options = {
        "experiment.stop": stop,
        "experiment.step": step,
        "experiment.tolerance": tolerance,
        "solver.method": method,
    }
    options = {name: value for name, value in options.items() if value is not None}
    if options:
        scene = scene.with_values(options)
    if inputs:
        scene = scene.with_inputs([(name, *_course(value)) for name, value in inputs.items()])
    seen = _core.run(scene, None if outputs is None else list(outputs))
    result = Result(scene, seen)
    for words in seen["warnings"]:
        warnings.warn(words, stacklevel=2)
    if seen["error"] is not None:
        error = _core.RunError(seen["error"])
        error.result = result
        raise error
    return result


def _course(value):
    """Times [s] and values of an input that is given as a number or as both."""
    if isinstance(value, Real):
        return [0.0], [float(value)]
    times, values = value
    return np.asarray(times, dtype=float).tolist(), np.asarray(values, dtype=float).tolist()
