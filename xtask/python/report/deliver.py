"""Everything after a result: the report, a summary, and whether the energy adds up. All that make a report end here."""

import sys
from pathlib import Path

import numpy as np

from . import linear
from .findings import findings
from .measure import energy_balance, spin_deviation
from .page import render


def add_options(parser):
    """The options of the linear view."""
    view = parser.add_mutually_exclusive_group()
    view.add_argument("--linear", type=Path, metavar="FILE", help="the scene's campbell.json")
    view.add_argument("--no-linear", metavar="WHY", default="nobody asked for the linear view.", help="why there is none")
    parser.add_argument("--unheld", default="", metavar="WORDS", help="in which directions nothing holds the rotor")


def deliver(result, arguments, folder, brief=False):
    """Writes `folder`/report.html of a `Result`; returns the exit code, 1 where the energy does not add up.

    Prints what the results warn of, and a summary, or where the report is if `brief`.
    """
    view = linear.read(arguments.linear) if arguments.linear else arguments.no_linear
    report = folder / "report.html"
    found = findings(result, view if isinstance(view, linear.Linear) else None, arguments.unheld)
    report.write_text(render(result, view, found), encoding="utf-8")
    balance = energy_balance(result.columns, result.scene.relative_tolerance)
    for finding in found:
        if finding.judged == "bad":
            print(f"  warning    {finding.value}: {finding.what}")
    print(f"  report     {report}" if brief else _summary(result, balance, report))
    if balance.holds:
        return 0
    print(
        f"error: the energy of {result.scene.identifier} does not add up: the largest residual, "
        f"{balance.residual:.3g} J, exceeds its bound, {balance.bound:.3g} J",
        file=sys.stderr,
    )
    return 1


def _summary(result, balance, report):
    """The run in a few plain lines."""
    scene, columns = result.scene, result.columns
    spin, last = columns["omega_phi"], columns[-1]
    deviation = spin_deviation(columns)
    strays = f"{np.abs(deviation.values).max():.3g} {deviation.unit}"
    steps, rejected, evaluations = (f"{last[f'solver.{n}']:.0f} {n}" for n in ("steps", "rejected", "evaluations"))
    lines = [
        scene.title,
        f"  energy     residual at most {balance.residual:.2e} J, bound {balance.bound:.2e} J",
        f"  omega_phi  {spin.min():.6g} to {spin.max():.6g} rad/s, off its start value by at most {strays}",
        f"  solver     {scene.method}: {steps}, {rejected}, {evaluations}",
    ]
    if spent := result.timings:
        duration = scene.stop - scene.start
        lines.append(
            f"  time       {duration:g} s in {spent.wall:.3g} s with fmpy, {duration / spent.wall:.3g} x real time; "
            f"{spent.solver:.2g} s of it within the FMU's steps"
        )
    return "\n".join([*lines, f"  report     {report}"])
