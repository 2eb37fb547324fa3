"""Pictures of where the rotor is and how it leans: its centre, its axis, γ and φ, the axial rate."""

import numpy as np
from markupsafe import Markup

from . import measure, paper, stations
from .notation import RPM, multiple, number
from .plots import COLOURS, curve, lines, paths

FLAT = 1e-9
"""Tilts of less [rad] and paths of less than this part of the distance are rounding."""
LONGEST_PATH = 5000
"""Points of a path."""


def spin(result, view):
    """The speed where it changes, else how far it strays from its start (the paper's Figure 6)."""
    columns, scene = result.columns, result.scene
    spin, deviation = columns["omega_phi"], measure.spin_deviation(columns)
    time = ("time [s]", columns["time"])
    if np.ptp(spin) > 0.01 * np.abs(spin).max():
        drawn = curve("speed", spin * RPM, "blue")
        return lines("Speed", Markup("The axial rate ω<sub>φ</sub> = dφ/dt."), time, ("speed [rpm]", [drawn], {}))
    largest = deviation.values[deviation.extremum]
    if np.ptp(spin) <= 1e-11 * np.abs(spin).max():
        return None
    curves = [curve("this run", deviation.values, "blue")]
    if scene.identifier == paper.IDENTIFIER:
        bound = np.full(len(spin), paper.SPIN_BOUND)
        sides = (("+", bound), ("−", -bound))
        curves += [curve(f"the paper: {sign}{paper.SPIN_BOUND:g} %", side, "orange", dash=1) for sign, side in sides]
    quantity_ = "ω<sub>φ</sub>/ω<sub>φ</sub>(0) − 1" if deviation.unit == "%" else "ω<sub>φ</sub> − ω<sub>φ</sub>(0)"
    caption = Markup(
        f"The axial rate ω<sub>φ</sub> = dφ/dt beside its start value, {quantity_}; at its largest "
        f"{number(largest, 3)} {deviation.unit} at {number(columns['time'][deviation.extremum])} s{paper.figure(result, 6)}."
    )
    return lines("Speed beside its start", caption, time, (f"deviation [{deviation.unit}]", curves, {}))


def sphere(result, view):
    """The axis in space, where it leans far."""
    tilt = measure.tilt(result.columns).max()
    if tilt <= measure.SMALL_TILT:
        return None
    caption = f"The tip of the axis t on its sphere, e to the right and z up; it leans by {number(np.degrees(tilt), 3)}° at most."
    return {"kind": "sphere", "title": "The axis", "caption": caption}


def tilt(result, view):
    """γ and its length, of a rotor that leans by itself."""
    columns = result.columns
    tilt = measure.tilt(columns)
    if (stations.is_machine(result.scene) and tilt.max() <= measure.SMALL_TILT) or tilt.max() <= FLAT:
        return None
    curves = [curve(f"γ{c}", columns[f"gamma.{c}"], colour) for c, colour in zip("yz", COLOURS)]
    caption = Markup("The transverse Euler vector γ, and its length θ, the angle by which the axis leans.")
    time = ("time [s]", columns["time"])
    return lines("Tilt", caption, time, ("γ [rad]", curves, {}), ("θ [rad]", [curve("θ", tilt, "purple")], {}))


def passage(result, view):
    """φ, t and γ while the axis leans by more than a right angle."""
    if measure.tilt(result.columns).max() <= np.pi / 2.0:
        return None
    shown = result.columns[measure.around_largest_tilt(result.columns)]
    axis = [curve(f"t{c}", shown[f"axis.{c}"], colour) for c, colour in zip("xyz", COLOURS)]
    gamma = [curve(f"γ{c}", shown[f"gamma.{c}"], colour) for c, colour in zip("yz", COLOURS[1:])]
    caption = (
        "φ, the axis t and γ around the largest tilt. At t = −e, where θ = π, the direction of γ has no limit; near it φ and γ turn "
        "about quickly together, while the axis and the attitude go straight on."
    )
    phi = [curve("φ", shown["phi"], "blue")]
    plots = (("φ [rad]", phi, {}), ("t", axis, {}), ("γ [rad]", gamma, {}))
    return lines("Passage of the largest tilt", caption, ("time [s]", shown["time"]), *plots)


def path(result, view):
    """The way of c across the x axis (the paper's Figure 5)."""
    if stations.is_machine(result.scene) or not stations.is_followed(result.columns):
        return None
    rows = result.columns[:: -(-len(result.columns) // LONGEST_PATH)]
    y, z = rows["r_c.y"], rows["r_c.z"]
    largest = max(np.ptp(y), np.ptp(z))
    if largest <= FLAT * abs(result.columns["r_c.x"]).max():
        return None
    unit, size = multiple(largest, "m")
    marks = [{"x": y[i] / size, "y": z[i] / size, "label": label} for i, label in ((0, "start"), (-1, "end"))]
    caption = f"Across the reference axis, seen along it, z up{paper.figure(result, 5)}."
    ways = [("c", y / size, z / size, marks)]
    return paths("Path of the mass centre", caption, f"y [{unit}]", (f"z [{unit}]", ways), equal=True)


def coordinates(result, view):
    """The same against the time."""
    columns = result.columns
    if stations.is_machine(result.scene) or all(np.ptp(columns[f"r_c.{c}"]) <= FLAT for c in "xyz"):
        return None
    unit, size = multiple(max(np.ptp(columns[f"r_c.{c}"]) for c in "xyz"), "m")
    plots = [(f"{c} [{unit}]", [curve(c, columns[f"r_c.{c}"] / size, "blue")], {}) for c in "xyz"]
    caption = f"Along the reference axis, across it, and upwards{paper.figure(result, 5)}."
    return lines("Coordinates of the mass centre", caption, ("time [s]", columns["time"]), *plots)
