"""The whole report on one HTML page that needs nothing beside it."""

import platform
from itertools import groupby
from pathlib import Path

import fmpy
import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from . import figures, measure, paper
from .notation import count, number


def render(scene, run):
    """The report of a `simulate.Run` of `scene`, as HTML text."""
    templates = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return templates.get_template("report.html.j2").render(
        scene=scene,
        step=run.step,
        blocks=[(name, list(rows)) for name, rows in groupby(scene.parameters.values(), lambda p: p.block)],
        figures={draw.__name__: Markup(draw(result, scene)) for draw, result in _drawn(scene, run)},
        energy=measure.energy_balance(run.result, scene.relative_tolerance),
        largest_tilt=measure.tilt(run.result).max(),
        comparisons=list(paper.comparisons(run.result)) if scene.identifier == paper.IDENTIFIER else [],
        costs=_costs(scene, run),
        versions=_versions(scene),
        log=run.log,
        number=number,
    )


LEANING = 0.2
"""A top that leans by more than this [rad] shows its nutation."""


def _drawn(scene, run):
    """The figures that suit the run, each with what it shows."""
    drawn = [figures.trajectory, figures.spin, figures.energy, figures.attitude]
    if measure.probes(run.result):
        drawn.append(figures.orbits)
    if "rotating_damping.d" in scene.parameters:
        drawn.append(figures.growth)
    if measure.tilt(run.result).max() > LEANING:
        drawn.append(figures.portrait)
    if measure.tilt(run.result).max() > np.pi / 2.0:
        drawn.append(figures.passage)
    shown = [(draw, run.result) for draw in drawn]
    return shown if run.response is None else [*shown, (figures.response, run.response)]


def _costs(scene, run):
    """What the solver spent: (what, value, unit)."""
    last = run.result[-1]
    return [
        ("method", scene.method, ""),
        ("relative tolerance", number(scene.relative_tolerance), ""),
        ("steps", count(last["solver.steps"]), ""),
        ("rejected steps", count(last["solver.rejected"]), ""),
        ("evaluations of the right-hand side, those for sampling included", count(last["solver.evaluations"]), ""),
        ("sum of the local error estimates", number(last["solver.error_estimate"], 2), ""),
        ("wall time, fmpy’s own work included", number(run.wall_time, 2), "s"),
        ("simulated time over wall time", number((scene.stop - scene.start) / run.wall_time, 3), ""),
    ]


def _versions(scene):
    return [
        ("FMU", f"{scene.identifier} {scene.version}, FMI {scene.fmi_version}"),
        ("GUID", scene.guid),
        ("fmpy", fmpy.__version__),
        ("Python", f"{platform.python_version()} on {platform.system()} {platform.machine()}"),
    ]
