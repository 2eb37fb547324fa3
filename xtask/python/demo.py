"""Run an FMU of split-rotor with fmpy, check its energy, and write a report with pictures.

    python demo.py FMU --out DIR [--inputs JSON] [--linear FILE | --no-linear WHY]

writes DIR/report.html and, at the steps of the scene's experiment, DIR/trajectory.csv. Exit code 1 where
the run fails or its energy does not add up, with the reason on stderr.
"""

import argparse
import csv
import json
import sys
from dataclasses import replace
from pathlib import Path
from zipfile import BadZipFile

from fmpy import read_model_description
from fmpy.model_description import ValidationError

from report.deliver import add_options, deliver
from report.scene import Scene
from report.simulate import SimulationFailed, respond, responds, simulate


def main():
    """The command line; returns the exit code."""
    sys.stdout.reconfigure(errors="replace")  # a title may hold what the terminal cannot show
    arguments = _arguments()
    try:
        description = read_model_description(arguments.fmu)
        scene = Scene.of(description)
        result = simulate(arguments.fmu, description, scene, arguments.inputs)
        # Inputs over time are the run that is asked for, a run-up mostly.
        if responds(description) and not arguments.inputs:
            result = replace(result, response=respond(arguments.fmu, description, scene))
    except (BadZipFile, ValidationError, SimulationFailed) as failure:
        print(f"error: {arguments.fmu}: {failure}", file=sys.stderr)
        return 1

    arguments.out.mkdir(parents=True, exist_ok=True)
    _write_csv(arguments.out / "trajectory.csv", result.at_steps)
    return deliver(result, arguments, arguments.out)


def _write_csv(path, columns):
    """Every column of a structured array, each number in the shortest form that reads back the same."""
    with path.open("w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(columns.dtype.names)
        rows.writerows(columns.tolist())


def _arguments():
    parser = argparse.ArgumentParser(description="Run an FMU of split-rotor and report on it.")
    parser.add_argument("fmu", type=Path, metavar="FMU", help="the packaged FMU")
    parser.add_argument("--out", type=Path, metavar="DIR", required=True, help="where the report goes")
    parser.add_argument(
        "--inputs", type=json.loads, default=[], metavar="JSON", help="inputs over time: name, time and value of each"
    )
    add_options(parser)
    arguments = parser.parse_args()
    if not arguments.fmu.is_file():
        parser.error(f"{arguments.fmu}: no such file; `cargo xtask package` makes it")
    return arguments


if __name__ == "__main__":
    sys.exit(main())
