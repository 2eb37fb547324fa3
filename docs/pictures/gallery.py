"""Draws scenes/SCENE.svg: of each packaged scene the picture that shows best what it teaches.

Needs what the demo needs:  cargo xtask package SCENE ... && python gallery.py [SCENE ...]
"""

import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "xtask" / "python"))

import figures  # noqa: E402
from fmpy import read_model_description  # noqa: E402
from report.scene import Scene  # noqa: E402
from report.simulate import respond, simulate  # noqa: E402

PICTURES = {
    "centrifuge": figures.whirl,
    "coupled": figures.trajectory,
    "driven": figures.spin,
    "dzhanibekov": figures.portrait,
    "film_bearings": figures.spin,
    "flywheel": figures.orbits,
    "free_top": figures.attitude,
    "heavy_top": figures.portrait,
    "high_spin": figures.attitude,
    "jeffcott": figures.response,
    "long_run": figures.energy,
    "overhung": figures.spin,
    "paper": figures.trajectory,
    "reaction_wheel": figures.whirl,
    "rotor": figures.energy,
    "rubbing": figures.orbits,
    "run_up": figures.spin,
    "spindle": figures.whirl,
    "stiff_support": figures.attitude,
    "tumbling": figures.passage,
    "turbo": figures.whirl,
    "unstable_whirl": figures.growth,
    "washing_machine": figures.whirl,
}
MOST = 1000
"""Points of a slow curve; more make the file larger and look the same."""


def picture(name):
    """The SVG of a scene, as text."""
    fmu = ROOT / "target" / "fmu" / f"{name}.fmu"
    description = read_model_description(fmu)
    scene = Scene.of(description)
    draw = PICTURES[name]
    if draw is figures.response:
        result = respond(fmu, description, scene)
    else:
        inputs = tomllib.loads((ROOT / "scenes" / f"{name}.toml").read_text(encoding="utf-8")).get("input", ())
        run = simulate(fmu, description, scene, inputs)
        # What is quick in these would be lost between the steps of the experiment.
        is_quick = draw in (figures.portrait, figures.passage, figures.whirl)
        result = run.columns if is_quick else run.at_steps[:: max(1, len(run.at_steps) // MOST)]
    return draw(result, scene)


if __name__ == "__main__":
    for name in sys.argv[1:] or PICTURES:
        (HERE / "scenes" / f"{name}.svg").write_text(picture(name), encoding="utf-8")
