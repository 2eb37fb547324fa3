"""The whole report on one HTML page that needs nothing beside it."""

import json
import platform
import re
from itertools import groupby
from pathlib import Path

import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from . import paper, vibration
from .linear import Linear
from .notation import count, number
from .panels import panels

WEB = Path(__file__).parent / "web"
SCRIPTS = ("numbers", "colours", "plot", "lines", "paths", "waterfall", "space", "moment", "rotor", "sphere", "page")
"""The page's own scripts, each after those that it uses."""


def render(result, view, findings):
    """The report of a `Result`, as HTML text; `view` is its `Linear`, or why it has none; `findings` stand first."""
    templates = Environment(
        loader=FileSystemLoader(WEB),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    scene, linear = result.scene, view if isinstance(view, Linear) else None
    shown = panels(result, linear)
    return templates.get_template("report.html.j2").render(
        scene=scene,
        by=result.by,
        step=np.median(np.diff(result.columns["time"])),
        findings=findings,
        panels=shown,
        left_out=_left_out(result, view),
        comparisons=list(paper.comparisons(result.columns)) if scene.identifier == paper.IDENTIFIER else [],
        costs=_costs(result),
        blocks=[(name, list(rows)) for name, rows in groupby(scene.parameters.values(), lambda p: p.block)],
        versions=_versions(scene),
        log=result.log,
        number=number,
        file=lambda name: Markup((WEB / name).read_text(encoding="utf-8")),
        scripts=SCRIPTS,
        # What could end the element that holds it is written as an escape.
        data=Markup(json.dumps(shown, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")),
    )


def _left_out(result, view):
    """(what, why) of pictures that one would look for."""
    why = vibration.unseen(result)
    return [
        *([] if isinstance(view, Linear) else [("critical speeds and no Campbell diagram", view)]),
        *([("orbits, paths and frequencies", why)] if why else []),
    ]


def _costs(result):
    """What the solver spent: (what, value, unit)."""
    scene, last, spent = result.scene, result.columns[-1], result.timings
    rows = [
        ("method", scene.method, ""),
        ("relative tolerance", number(scene.relative_tolerance), ""),
        ("steps", count(last["solver.steps"]), ""),
        ("rejected steps", count(last["solver.rejected"]), ""),
        ("evaluations of the right-hand side, those for sampling included", count(last["solver.evaluations"]), ""),
        ("sum of the local error estimates", number(last["solver.error_estimate"], 2), ""),
    ]
    if spent:
        searched = "" if spent.total else ", search for the largest deflections included"
        rows.append((f"CPU time of the solver{searched}", number(spent.solver, 2), "s"))
    if spent and spent.total:
        rows += [
            ("CPU time of the whole run, fmpy’s own work included", number(spent.total, 2), "s"),
            ("wall time of the whole run", number(spent.wall, 2), "s"),
            ("simulated time over wall time", number((scene.stop - scene.start) / spent.wall, 3), ""),
        ]
    return rows


def _version_of_uplot():
    """As the head of its file has it."""
    head = (WEB / "uplot" / "uPlot.iife.min.js").read_text(encoding="utf-8").partition("\n")[0]
    return re.search(r"\(v([\d.]+)\)", head)[1]


def _versions(scene):
    return [
        ("model", f"{scene.identifier} {scene.version}, FMI {scene.fmi_version}"),
        ("GUID", scene.guid),
        ("uPlot", _version_of_uplot()),
        ("Python", f"{platform.python_version()} on {platform.system()} {platform.machine()}"),
    ]
