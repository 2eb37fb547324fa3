"""Run an FMU of split-rotor with fmpy, check its energy, and write a report with pictures.

    python demo.py FMU --out DIR

writes DIR/report.html and, at the steps of the scene's experiment, DIR/trajectory.csv. Exit code 1 where
the run fails or its energy does not add up, with the reason on stderr.
"""

import argparse
import csv
import sys
from dataclasses import replace
from pathlib import Path
from zipfile import BadZipFile

import numpy as np
from fmpy import read_model_description
from fmpy.model_description import ValidationError

from report.measure import energy_balance, spin_deviation
from report.page import render
from report.scene import Scene
from report.simulate import SimulationFailed, respond, responds, simulate


def main():
    """The command line; returns the exit code."""
    sys.stdout.reconfigure(errors="replace")  # a title may hold what the terminal cannot show
    arguments = _arguments()
    try:
        description = read_model_description(arguments.fmu)
        scene = Scene.of(description)
        run = simulate(arguments.fmu, description, scene)
        if responds(description):
            run = replace(run, response=respond(arguments.fmu, description, scene))
    except (BadZipFile, ValidationError, SimulationFailed) as failure:
        print(f"error: {arguments.fmu}: {failure}", file=sys.stderr)
        return 1

    arguments.out.mkdir(parents=True, exist_ok=True)
    report = arguments.out / "report.html"
    report.write_text(render(scene, run), encoding="utf-8")
    _write_csv(arguments.out / "trajectory.csv", run.experiment)

    balance = energy_balance(run.result, scene.relative_tolerance)
    print(summary(scene, run, balance, report))
    if not balance.holds:
        print(
            f"error: the energy of {scene.identifier} does not add up: the largest residual, "
            f"{balance.residual:.3g} J, exceeds its bound, {balance.bound:.3g} J",
            file=sys.stderr,
        )
        return 1
    return 0


def summary(scene, run, balance, report):
    """The run in a few plain lines."""
    spin, last = run.result["omega_phi"], run.result[-1]
    deviation = spin_deviation(run.result)
    strays = f"{np.abs(deviation.values).max():.3g} {deviation.unit}"
    steps, rejected, evaluations = (f"{last[f'solver.{n}']:.0f} {n}" for n in ("steps", "rejected", "evaluations"))
    duration = scene.stop - scene.start
    return f"""{scene.title}
  energy     residual at most {balance.residual:.2e} J, bound {balance.bound:.2e} J
  omega_phi  {spin.min():.6g} to {spin.max():.6g} rad/s, off its start value by at most {strays}
  solver     {scene.method}: {steps}, {rejected}, {evaluations}
  time       {duration:g} s in {run.wall_time:.3g} s with fmpy, {duration / run.wall_time:.3g} x real time
  report     {report}"""


def _write_csv(path, result):
    """Every column of fmpy's structured array, each number in the shortest form that reads back the same."""
    with path.open("w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(result.dtype.names)
        rows.writerows(result.tolist())


def _arguments():
    parser = argparse.ArgumentParser(description="Run an FMU of split-rotor and report on it.")
    parser.add_argument("fmu", type=Path, metavar="FMU", help="the packaged FMU")
    parser.add_argument("--out", type=Path, metavar="DIR", required=True, help="where the report goes")
    arguments = parser.parse_args()
    if not arguments.fmu.is_file():
        parser.error(f"{arguments.fmu}: no such file; `cargo xtask package` makes it")
    return arguments


if __name__ == "__main__":
    sys.exit(main())
