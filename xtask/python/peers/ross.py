"""ROSS: a rotor on a shaft of beam elements, made stiffer until it is as rigid as ours; `cargo xtask test ROSS --long` runs it.

It reads what `campbell` and `response` found of ross.toml, and fails where ROSS differs by more than its beam explains. Into target/ross
go ross.csv, the differences against the stiffness, and ross.json, which `against_ross.py` draws.
"""

import csv
import json
import sys
import tomllib
from pathlib import Path

# First, for it keeps what ROSS's libraries print apart from the answers.
from . import task
from .ross_model import Rotor

import numpy as np

STIFFER = 10.0 ** np.arange(0.0, 6.5, 0.5)
"""Young's modulus over that of steel."""
SHOWN = (1.0, 1000.0)
LINEAR = 7
"""The first so many differences are well above ROSS's rounding, which grows with the stiffness."""
EXTRAPOLATED = 5
"""Through so many the rigid shaft is found: more would have more rounding, fewer less of the curve."""
AGREED = 1e-8
"""So much may be left there [1]: measured 3e-9, 2e-9 and 7e-10 at most with five kernels of OpenBLAS, which is ROSS's rounding."""
QUANTITIES = ("modes", "critical_speeds", "response")


def eigenvalues(frequency, damping_ratio):
    return np.abs(frequency) * (1j - damping_ratio / np.sqrt(1.0 - damping_ratio**2))


def nearest(values, to):
    """Which of these is nearest to each of those."""
    return [int(np.argmin(np.abs(values - value))) for value in to]


class Ours:
    """What `campbell` and `response` found."""

    def __init__(self, target):
        campbell, response = (json.loads((target / name / f"ross/{name}.json").read_text()) for name in ("campbell", "response"))
        modes = campbell["modes"]
        self.speeds = np.unique([mode["speed_rad_s"] for mode in modes])

        def at_speeds(key):
            return np.array([[mode[key] for mode in modes if mode["speed_rad_s"] == speed] for speed in self.speeds])

        self.directions, damping_ratios = at_speeds("direction"), at_speeds("damping_ratio")
        self.least_damping = np.min(damping_ratios[self.directions != "axial"])
        rows = [row for row in response["responses"] if row["station"] != "c"]
        self.stations = np.unique([row["position_m"] for row in rows]).tolist()

        def phasors(station, axis):
            at_station = [row for row in rows if row["position_m"] == station]
            return [row[f"amplitude_{axis}_m"] * np.exp(1j * row[f"phase_{axis}_rad"]) for row in at_station]

        self.found = (
            eigenvalues(at_speeds("frequency_rad_s"), damping_ratios),
            np.array([crossing["speed_rad_s"] for crossing in campbell["critical_speeds"][0]["speeds"]]),
            np.array([[phasors(station, axis) for axis in "yz"] for station in self.stations]),
        )

    def differences(self, theirs):
        """The largest of each of QUANTITIES, over its own size or the largest orbit of the station."""
        modes, critical, response = self.found
        sizes = modes, critical, np.max(np.abs(response), axis=(1, 2), keepdims=True)
        return [np.max(np.abs((one - other) / size)) for one, other, size in zip(theirs, self.found, sizes)]


def found(rotor, stiffer, ours):
    """QUANTITIES of ROSS, and how many of its modes whirl otherwise than ours."""
    model = rotor.model(stiffer)
    campbell = model.run_campbell(ours.speeds, frequencies=6)
    modes = eigenvalues(campbell.wd, campbell.damping_ratio)
    which = np.array([nearest(*pair) for pair in zip(modes, ours.found[0])])
    # 0 and 1 where all nodes whirl forward or backward.
    whirls = np.take_along_axis(campbell.whirl_values, which, axis=1)
    otherwise = (whirls == 0.0) & (ours.directions != "forward") | (whirls == 1.0) & (ours.directions != "backward")
    # No root is found closer than its rounding.
    critical = model.run_critical_speed(num_modes=10, rtol=1e-9 * stiffer).wd()
    place, size = rotor.node(rotor.unbalance), rotor.unbalance["mass"] * rotor.unbalance["radius"]
    forced = model.run_unbalance_response(place, size, rotor.unbalance["angle"], ours.speeds).forced_resp
    response = [forced[6 * node : 6 * node + 2] for node in map(rotor.nodes.index, ours.stations)]
    quantities = np.take_along_axis(modes, which, axis=1), critical[nearest(critical, ours.found[1])], np.array(response)
    return quantities, np.count_nonzero(otherwise)


def extrapolated(values):
    """The polynomial in 1/E through the first of these, at 0."""
    x = 1.0 / STIFFER[:EXTRAPOLATED]
    weights = [np.prod([other / (other - one) for other in x if other != one]) for one in x]
    return sum(weight * value for weight, value in zip(weights, values))


def judged(differences, explained, limit, otherwise):
    """What is wrong, if anything."""
    wrong = [f"{otherwise} modes whirl the other way"] if otherwise else []
    for name, theirs, bound, left in zip(QUANTITIES, differences[:LINEAR].T, explained[:LINEAR].T, limit):
        if not np.all(theirs <= bound):
            wrong.append(f"{name}: they differ by more than the shaft yields")
        # What bends the line of 1/E is smaller than that by the same part.
        falls = (theirs[1:] * STIFFER[1:LINEAR]) / (theirs[:-1] * STIFFER[: LINEAR - 1])
        if not np.all(np.abs(falls - 1.0) <= bound[:-1]):
            wrong.append(f"{name}: the difference does not fall as 1/E")
        if not left <= AGREED:
            wrong.append(f"{name}: {left:.1e} is left where the shaft is rigid, allowed {AGREED:g}")
    return "; ".join(wrong)


def curves(quantities):
    """What is drawn: frequencies by mode, critical speeds, larger half axes by station."""
    modes, critical, response = quantities
    y, z = response[:, 0], response[:, 1]
    major = 0.5 * (np.abs(y + 1j * z) + np.abs(y - 1j * z))
    return [modes.imag.T.tolist(), critical.tolist(), major.tolist()]


def write(folder, ours, theirs, judged_by):
    """The files, and the table."""
    differences, explained, limit = judged_by
    header = ["stiffer", *QUANTITIES, *(f"{name}_explained" for name in QUANTITIES)]
    rows = np.vstack([np.column_stack([STIFFER, differences, explained]), [np.inf, *limit, 0.0, 0.0, 0.0]])
    shown = {f"{stiffer:g}": curves(theirs[STIFFER.tolist().index(stiffer)]) for stiffer in SHOWN}
    drawn = {"speeds": ours.speeds.tolist(), "stations": ours.stations, "ours": curves(ours.found), "theirs": shown}
    drawn |= {"rows": rows[:-1].tolist(), "limit": limit, "agreed": AGREED}
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "ross.json").write_text(json.dumps(drawn), encoding="utf-8")
    with open(folder / "ross.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows.tolist()])
    for row in [header[:4], *([f"{value:.2e}" for value in row[:4]] for row in rows)]:
        print("".join(f"{cell:>16}" for cell in row), file=task.ANSWERS, flush=True)


def main():
    target = Path(sys.argv[1])
    ours, rotor = Ours(target), Rotor(tomllib.loads((Path(__file__).parent / "ross.toml").read_text(encoding="utf-8")))
    explained = rotor.explained(ours.speeds, np.max(np.abs(ours.found[0]))) / STIFFER
    # At a peak a response changes by that over twice the damping ratio.
    explained = np.stack([explained, explained, explained / (2.0 * ours.least_damping)], axis=1)
    theirs, otherwise = zip(*(found(rotor, stiffer, ours) for stiffer in STIFFER))
    differences = np.array([ours.differences(quantities) for quantities in theirs])
    limit = ours.differences([extrapolated(values) for values in zip(*theirs)])
    write(target / "ross", ours, theirs, (differences, explained, limit))
    sys.exit(judged(differences, explained, limit, sum(otherwise[:LINEAR])) or None)


if __name__ == "__main__":
    main()
