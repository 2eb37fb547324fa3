"""What can be told of a scene without a run, or with many, and its FMU."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core

if TYPE_CHECKING:
    import pandas as pd  # type: ignore[import-untyped, import-not-found, unused-ignore]


class Columns(Mapping[str, "npt.NDArray[Any]"]):
    """A table: an array for each column by its name, whose end tells the unit; NaN where there is no value, names with commas between."""

    def __init__(self, rows: Sequence[Mapping[str, Any]]) -> None:
        names = list(rows[0]) if rows else []
        self._columns = {name: np.array([self._cell(row[name]) for row in rows]) for name in names}

    @staticmethod
    def _cell(value: Any) -> Any:
        if isinstance(value, list):
            return ", ".join(value)
        return np.nan if value is None else value

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        try:
            return self._columns[name]
        except KeyError:
            meant = _core.did_you_mean(str(name), list(self))
            raise KeyError(f"there is no column `{name}`: {meant or 'there are ' + ', '.join(self)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        rows = len(next(iter(self.values()), ()))
        return f"<{rows} rows of {', '.join(self)}>"

    def to_pandas(self) -> pd.DataFrame:
        """The same as a pandas.DataFrame."""
        import pandas as pd

        return pd.DataFrame(self._columns)


class Study:
    """What a command shows of a scene: `str(study)` is its table in Markdown."""

    def __init__(self, table: str, text: str) -> None:
        self.table: str = table
        """The table that the command prints."""
        self.data: dict[str, Any] = json.loads(text)
        """All of it, as in the JSON file that the command writes."""

    def __str__(self) -> str:
        return self.table

    def _repr_markdown_(self) -> str:
        return self.table


class Campbell(Study):
    """Modes against the spin, about the steady state at each speed."""

    @property
    def modes(self) -> Columns:
        """A row for each mode at each speed: speed, number, frequency, damping ratio, direction, growth."""
        return Columns(self.data["modes"])

    @property
    def critical_speeds(self) -> Columns:
        """Where modes cross multiples (`order`) of the speed; empty of a body that is not symmetric."""
        of = self.data.get("critical_speeds", [])
        return Columns([{"order": line["order"], **crossing} for line in of for crossing in line["speeds"]])

    @property
    def thresholds(self) -> Columns | npt.NDArray[np.float64]:
        """Where modes begin or cease to grow: rows as `critical_speeds`, or of a body that is not symmetric an array of speeds [rad/s]."""
        of = self.data["thresholds"]
        return np.array(of) if self.data.get("floquet") else Columns(of)


class Response(Study):
    """Orbits that an unbalance causes, against the spin, at probes or bearings and at c."""

    @property
    def linear(self) -> Columns:
        """A row for each station at each speed, by the linear equations."""
        return Columns(self.data["responses"])

    @property
    def peaks(self) -> Columns:
        """A row for each linear resonance peak of a station, 0-to-peak: as a fixed probe along y or z sees it, and of the larger semi-axis."""
        return Columns(self.data["peaks"])

    @property
    def nonlinear(self) -> Columns:
        """A row for each station in each motion that repeats with the revolution, by the laws as they stand."""
        return Columns(self.data["nonlinear"])


class Accuracy(Study):
    """What accuracy costs in time with each method."""

    @property
    def rows(self) -> Columns:
        """A row for each method and setting: its error over the motion's own size, CPU time, steps, evaluations."""
        return Columns(self.data["rows"])

    @property
    def sentences(self) -> list[str]:
        """Which setting to take."""
        return list(self.data["sentences"])


def accuracy(scene: _core.Scene) -> Accuracy:
    """Error against time for every method, of the scene's FMU with the package's own library; it takes about a minute."""
    with TemporaryDirectory() as folder:
        return Accuracy(*_core.accuracy(scene, folder))


def campbell(
    scene: _core.Scene,
    *,
    speeds: Sequence[float] | None = None,
    steps: int = 201,
    orders: Sequence[float] = (1.0, 2.0),
) -> Campbell:
    """Whirl frequencies and damping, critical speeds and thresholds of stability of a scene.

    speeds: the first and the last [rad/s], else from 0 to half as much again as the scene reaches; or as its fastest mode, where the scene
        reaches no speed or only one that is small beside its lowest mode. The table begins with the range.
    steps: at how many speeds.
    orders: multiples of the speed whose crossings are critical speeds.
    """
    return Campbell(*_core.campbell(scene, speeds, steps, list(orders)))


def response(
    scene: _core.Scene, *, speeds: Sequence[float] | None = None, steps: int = 401, linear: bool = False
) -> Response:
    """Half axes and phases of the orbits that the unbalance of a scene causes.

    speeds, steps: as of `campbell`.
    linear: only by the linear equations, which takes no time; else up to a minute.
    """
    return Response(*_core.response(scene, speeds, steps, linear))


def package(scene: _core.Scene, path: str | PathLike[str]) -> Path:
    """Writes the FMU of a scene (FMI 2.0, co-simulation and model exchange, Linux on x86-64); its path.

    Its library holds every effect, and switches on those that the scene calls for; its outputs have the bits of the FMU that
    `cargo xtask package` builds for the scene alone. A scene may call for two of a kind at most, and for no tables or housings.
    """
    _core.package(scene, path)
    return Path(path)
