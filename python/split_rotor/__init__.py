"""A rigid rotor with six degrees of freedom: scenes, runs, linear views and FMUs, without a compiler.

    import split_rotor as sr

    scene = sr.Scene.named("jeffcott")
    result = sr.run(scene, stop=2.0)
    result["probe[1].r.y"]                # m, one value for each of result.time
    sr.campbell(scene).critical_speeds    # rad/s
    sr.package(scene, "jeffcott.fmu")

Quantities are in SI units and radians. Names of variables are those of the FMU.
"""

from ._core import RunError, Scene, SceneError
from .run import Result, run
from .studies import Accuracy, Campbell, Columns, Response, Study, accuracy, campbell, package, response

__all__ = [
    "Accuracy",
    "Campbell",
    "Columns",
    "Response",
    "Result",
    "RunError",
    "Scene",
    "SceneError",
    "Study",
    "accuracy",
    "campbell",
    "package",
    "response",
    "run",
]
