"""A rotor and models of another tool, coupled by a master.

    pip install pythonfmu==0.7.0 fmpy numpy     # and for their masters: libcosimpy==0.0.6 ecospy==0.7.2; matplotlib for pictures
    cargo xtask package rotor
    python examples/cosim/cosim.py target/fmu/rotor.fmu linear libcosim 1e-3 2e-4 1e-4

For the pair housing package examples/cosim/housed.toml, and give its FMU.

The pair is one of linear, journal, pedestal, housing, magnetic, motor, two_rotors (pairs.py); the master plain, fresh, gauss_seidel, iterated, ssp,
libcosim, osp, ecos, cofmupy, or cofmupy_seidel (masters/; by_cofmupy.py says how to install those two); then come communication steps [s].
Printed for each: the largest error of what is watched over the last tenth of the run, relative to the largest motion, where the rotor holds its
inputs, where nothing is set, and with what docs/cosimulation.md advises for the pair. Values of your own are one more column:

    python examples/cosim/cosim.py target/fmu/rotor.fmu linear libcosim 1e-4 --set effects.extrapolation=true \\
        --set extrapolation.order=2 --set extrapolation.lag=1.0 --set extrapolation.redo=true
"""

import argparse
import json
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from masters import StepFailed
from pairs import LATE, PAIRS, with_paths

PARTNERS = Path(__file__).resolve().parent / "partners"
MASTERS = {
    "plain": "by_fmpy",
    "fresh": "by_fmpy",
    "gauss_seidel": "by_fmpy",
    "iterated": "by_fmpy",
    "ssp": "by_ssp",
    "libcosim": "by_libcosim",
    "osp": "by_osp",
    "ecos": "by_ecos",
    "cofmupy": "by_cofmupy",
    "cofmupy_seidel": "by_cofmupy",
}
ARE_SEIDEL = {"gauss_seidel", "cofmupy_seidel"}
ARE_FRESH = {"fresh", "iterated"} | ARE_SEIDEL


def built(kind, folder):
    """The FMU of a partner, made by PythonFMU."""
    command = [sys.executable, "-m", "pythonfmu", "build", "--handle-state", "-d", folder]
    command += ["-f", PARTNERS / f"{kind}.py", PARTNERS / "described.py"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return Path(folder) / f"{kind.capitalize()}.fmu"


def error(found, exact):
    """The largest over the last tenth, relative to the largest motion, in words."""
    if found is None:
        return "fails"
    tenth = -max(1, len(exact) // 10)
    return f"{np.abs(found - exact)[tenth:].max() / np.abs(exact).max():.1e}"


def ways(pair, master):
    """Values of the rotor, by the heads of the columns."""
    advised = pair.advised | (LATE if pair.advised and master not in ARE_FRESH else {})
    if master in ARE_SEIDEL:
        # The partner has the step still before it at whose end the angle is shown.
        advised = {name: -value if name.endswith(".ahead") else value for name, value in advised.items()}
    return {"held": pair.held, "nothing set": {}} | ({"advised": advised} if advised else {})


def own(text):
    """Name and value of NAME=VALUE: true, false, a whole number, or one with a point."""
    name, value = text.split("=")
    return name, json.loads(value)


def write(path, times, watched, found):
    """Writes the ways that did not fail as a CSV."""
    ways = {head: way for head, way in found.items() if way is not None}
    heads = ["time"] + [f"{name}, {head}" for head in ways for name in watched]
    names = ",".join(f'"{head}"' for head in heads)
    np.savetxt(path, np.hstack([times[:, None], *ways.values()]), "%.17g", ",", header=names, comments="")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("fmu", help="a general rotor, target/fmu/rotor.fmu")
    parser.add_argument("pair", choices=PAIRS)
    parser.add_argument("master", choices=MASTERS)
    parser.add_argument("steps", nargs="+", type=float, help="communication steps [s]")
    parser.add_argument("--fine", type=float, default=1e-6, help="step of the reference [s] where none is exact (%(default)s)")
    parser.add_argument("--out", help="a CSV of all that is watched, at the last of the steps")
    parser.add_argument("--picture", help="an SVG, PNG or PDF of the same (needs matplotlib)")
    parser.add_argument("--set", type=own, action="append", default=[], metavar="NAME=VALUE", help="a value of the rotor")
    asked = parser.parse_args()
    pair = PAIRS[asked.pair]
    run = getattr(import_module(f"masters.{MASTERS[asked.master]}"), asked.master)
    more = {"means": pair.means} if asked.master == "iterated" else {}
    with TemporaryDirectory() as folder:
        kinds = {kind for kind, _ in pair.models.values()} - {"rotor"}
        paths = {"rotor": asked.fmu} | {kind: built(kind, folder) for kind in kinds}
        columns = ways(pair, asked.master) | ({"as set": dict(asked.set)} if asked.set else {})
        print(f"{'step [s]':>9}" + "".join(f"{head:>13}" for head in columns))
        for step in asked.steps:
            exact, count = np.array(pair.exact(paths, step, asked.fine)), round(pair.span / step)
            found = {"exact": exact}
            for head, values in columns.items():
                try:
                    found[head] = run(with_paths(pair, paths, values), pair.links, pair.watched, step, count, **more)
                except StepFailed as failed:
                    print(f"{head}: {failed}", file=sys.stderr)
                    found[head] = None
            print(f"{step:9.0e}" + "".join(f"{error(found[head], exact):>13}" for head in columns), flush=True)
        times = step * np.arange(1, count + 1)
        if asked.out:
            write(asked.out, times, pair.watched, found)
        if asked.picture:
            # Imported here, since nothing else needs matplotlib.
            title = f"{asked.pair} in {asked.master}, steps of {step:g} s"
            import_module("picture").draw(asked.picture, title, times, pair.watched[0], found)


if __name__ == "__main__":
    main()
