from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

from .run import Result

__version__: str
"""The version of the package."""

class SceneError(ValueError):
    """A scene that cannot be simulated: what is wrong, where, and what would be right."""

class RunError(RuntimeError):
    """A run that ended early."""

    result: Result
    """What was reached."""

class Scene:
    """The rotor, what acts on it, how it starts and how long it is looked at; it does not change, and can be pickled."""

    @staticmethod
    def from_toml(text: str, path: str | PathLike[str] = "scene.toml") -> Scene:
        """The scene in this text; `path` names it, and is where the files of its inputs are looked for."""

    @staticmethod
    def load(path: str | PathLike[str]) -> Scene:
        """The scene in this TOML file."""

    @staticmethod
    def named(name: str) -> Scene:
        """One of the scenes that come with the package: `Scene.names()`."""

    @staticmethod
    def names() -> list[str]: ...
    def with_values(self, values: Mapping[str, float | str | bool | Sequence[float]]) -> Scene:
        """This scene with other parameters, by the names of variables ("rotor.m", "bearing[1].kyy", "unbalance[1].moment", "experiment.stop");
        values as in a scene: numbers in SI units, or texts with a unit ("3000 rpm")."""

    def with_inputs(self, inputs: Sequence[tuple[str, Sequence[float], Sequence[float]]]) -> Scene:
        """This scene with these inputs over time, in place of its own of the same names: name, times in s, values."""

    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def toml(self) -> str:
        """Its text."""

    @property
    def effects(self) -> list[str]: ...
    @property
    def variables(self) -> dict[str, dict[str, Any]]:
        """Parameters, inputs and outputs by name: causality, unit, description, start."""

    @property
    def inputs(self) -> dict[str, tuple[list[float], list[float]]]:
        """Its inputs over time by name: times in s and values."""

    @property
    def experiment(self) -> dict[str, float]:
        """When and how finely it is looked at: `start`, `stop` and `step` in s, `tolerance`."""

def did_you_mean(name: str, known: Sequence[str]) -> str | None:
    """Which of the known names was probably meant, in words; None where none is like it."""

def run(scene: Scene, names: Sequence[str] | None) -> dict[str, Any]: ...
def campbell(
    scene: Scene, speeds: Sequence[float] | None, steps: int, orders: Sequence[float]
) -> tuple[str, str]: ...
def response(scene: Scene, speeds: Sequence[float] | None, steps: int, linear: bool) -> tuple[str, str]: ...
def accuracy(scene: Scene, folder: str | PathLike[str]) -> tuple[str, str]: ...
def package(scene: Scene, path: str | PathLike[str]) -> None: ...
