"""A scene simulated in this process."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _core

if TYPE_CHECKING:
    import pandas as pd  # type: ignore[import-untyped, import-not-found, unused-ignore]
    import xarray as xr  # type: ignore[import-untyped, import-not-found, unused-ignore]

Array: TypeAlias = npt.NDArray[np.float64]
"""An array of numbers."""
Numbers: TypeAlias = Sequence[float] | npt.NDArray[np.floating[Any]] | npt.NDArray[np.integer[Any]]
"""What becomes an array of numbers."""
Input: TypeAlias = float | tuple[Numbers, Numbers]
"""An input over time: a number, or times [s] and values of equal length."""
Method: TypeAlias = Literal["auto", "dopri5", "dop853", "symplectic", "stiff", "taylor"]
"""The solver's methods."""


@dataclass(frozen=True)
class Deflection:
    """The largest deflection of a station from the x axis, static deflection included."""

    largest: float
    """[m]; between the communication points too, since the solver's dense output is searched."""
    at: float
    """When that was [s]."""

    def __str__(self) -> str:
        return f"{1e6 * self.largest:.6g} µm at {self.at:.6g} s"


class Result(Mapping[str, Array]):
    """What a run showed: `result["r_c.y"]` is an array of as many values as `result.time`."""

    def __init__(self, scene: _core.Scene, seen: dict[str, Any]) -> None:
        time, count = np.frombuffer(seen["time"]), seen["count"]
        values = np.frombuffer(seen["values"]).reshape(-1, len(time))[:, :count]
        self.scene: _core.Scene = scene
        """The scene that ran, with the run's own options."""
        self.time: Array = time[:count]
        """Communication points [s], shape (points,)."""
        self.units: dict[str, str] = dict(zip(seen["names"], seen["units"], strict=True))
        """The unit of each output by its name, "" where it has none."""
        self.solver: dict[str, Any] = seen["solver"]
        """`method`, and what it spent: `steps`, `rejected`, `evaluations`."""
        self.deflections: dict[str, Deflection] = {name: Deflection(*of) for name, of in seen["largest"].items()}
        """The largest deflections of c ("r_c") and of the probes ("probe[1]"), as `cargo xtask run` prints them."""
        self.log: list[str] = seen["log"] + seen["warnings"]
        """What the solver and the rotor had to say."""
        self._values: dict[str, Array] = dict(zip(seen["names"], values, strict=True))

    def __getitem__(self, name: str) -> Array:
        """The values of this output, shape (points,)."""
        try:
            return self._values[name]
        except KeyError:
            raise KeyError(_no_output(name, self)) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return f"<Result of {self.scene.name}: {len(self)} outputs at {len(self.time)} points>"

    def to_pandas(self) -> pd.DataFrame:
        """A pandas.DataFrame: a column for each output, indexed by time [s]; units in `attrs["units"]`."""
        import pandas as pd

        frame = pd.DataFrame(self._values, index=pd.Index(self.time, name="time"))
        frame.attrs["units"] = self.units
        return frame

    def to_xarray(self) -> xr.Dataset:
        """An xarray.Dataset over `time`, the unit of each output in its `attrs["units"]`."""
        import xarray as xr

        outputs = {name: ("time", values, {"units": self.units[name]}) for name, values in self.items()}
        time = ("time", self.time, {"units": "s"})
        return xr.Dataset(outputs, coords={"time": time}, attrs={"title": self.scene.title})


def _no_output(name: object, result: Result) -> str:
    """What to say of an output that a result does not have."""
    scene = result.scene
    known = [one for one, variable in scene.variables.items() if variable["causality"] == "output"]
    if name in known:
        return f"this run of {scene.name} did not read `{name}`: it read the outputs {', '.join(result)}"
    meant = _core.did_you_mean(str(name), known)
    return f"{scene.name} has no output `{name}`" + (f": {meant}" if meant else "; list(result) has those that there are")


def run(
    scene: _core.Scene,
    *,
    inputs: Mapping[str, Input] | None = None,
    outputs: list[str] | tuple[str, ...] | None = None,
    stop: float | str | None = None,
    step: float | str | None = None,
    method: Method | None = None,
    tolerance: float | None = None,
) -> Result:
    """Simulates a scene; its values have the bits of the scene's FMU.

    inputs: inputs over time by name, in place of those of the scene: a number, or times [s] and values of equal length, linear between
        them, held before and after; equal times are a jump.
    outputs: a list of the names of those that are wanted, else all: fewer take less time.
    stop, step: end and communication step, in s or as a text with a unit ("200 ms").
    method, tolerance: as `solver.method` and `experiment.tolerance` in a scene.

    Raises SceneError where any of these is not possible, and RunError where the motion cannot be followed to the end or diverges; its
    `result` holds what was reached. Other threads run meanwhile, and Ctrl-C ends it.
    """
    options: dict[str, float | str | None] = {
        "experiment.stop": stop,
        "experiment.step": step,
        "experiment.tolerance": tolerance,
        "solver.method": method,
    }
    given = {name: value for name, value in options.items() if value is not None}
    if given:
        scene = scene.with_values(given)
    if inputs is not None:
        if not isinstance(inputs, Mapping):
            raise TypeError(f'inputs must be a dictionary, such as {{"drive.tau": 1.0}}, not {type(inputs).__name__}')
        scene = scene.with_inputs([(name, *_course(name, value)) for name, value in inputs.items()])
    seen = _core.run(scene, None if outputs is None else _names(outputs))
    result = Result(scene, seen)
    for words in seen["warnings"]:
        warnings.warn(words, stacklevel=2)
    if seen["error"] is not None:
        error = _core.RunError(seen["error"])
        error.result = result
        raise error
    return result


def _names(outputs: object) -> list[str]:
    """The names of the outputs that are wanted; a text would be taken letter by letter."""
    if isinstance(outputs, str):
        raise TypeError(f'outputs must be a list of names: write outputs=["{outputs}"]')
    names: list[Any] = list(outputs) if isinstance(outputs, Iterable) else [outputs]
    for name in names:
        if not isinstance(name, str):
            raise TypeError(f'outputs must be a list of names, such as ["omega_phi"]; {name!r} is no text')
    return names


def _course(name: str, value: Input) -> tuple[list[float], list[float]]:
    """Times [s] and values of an input that is given as a number or as both."""
    if isinstance(value, (int, float, Real)):
        return [0.0], [float(value)]
    try:
        times, values = (np.asarray(part, dtype=float) for part in value)
    except (TypeError, ValueError):
        raise TypeError(
            f"inputs[{name!r}] must be a number, or a pair of times [s] and values, such as ([0.0, 1.0], [0.0, 20.0])"
        ) from None
    return np.atleast_1d(times).tolist(), np.atleast_1d(values).tolist()
