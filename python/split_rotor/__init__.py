"""A rigid rotor with six degrees of freedom: scenes, runs, linear views and FMUs, without a compiler.

>>> import split_rotor as sr
>>> scene = sr.Scene.named("turbo")
>>> result = sr.run(scene, stop=0.1)
>>> len(result["probe[1].r.y"]) == len(result.time)  # m, at times in s
True
>>> sr.campbell(scene).critical_speeds["speed_rad_s"].size > 0
True
>>> path = sr.package(scene, "turbo.fmu")

Quantities are in SI units and radians. Names of variables are those of the FMU: `list(result)`, `scene.variables`.
"""

from ._core import RunError, Scene, SceneError, __version__
from .run import Deflection, Result, run
from .studies import Accuracy, Campbell, Columns, Response, Study, accuracy, campbell, package, response

__all__ = [
    "Accuracy",
    "Campbell",
    "Columns",
    "Deflection",
    "Response",
    "Result",
    "RunError",
    "Scene",
    "SceneError",
    "Study",
    "__version__",
    "accuracy",
    "campbell",
    "package",
    "response",
    "run",
]
