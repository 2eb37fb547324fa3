"""The pictures of a report: what each shows, as JSON that the page draws.

Each function of PANELS takes a `Result` and a `linear.Linear`, or None, and returns a panel, or None where the run has nothing
to show there. A panel is a dictionary of `kind` (how the page draws it: web/<kind>.js), `title`, `caption` and what is drawn.
"""

import math
from collections import Counter

import numpy as np

from . import attitude, linear, measure, paper, stations, vibration
from .machine import machine
from .notation import RPM, multiple, quantity
from .plots import COLOURS, curve, lines

FLAT = 1e-9
"""Loads and energies that change by less than this part of themselves are constant."""
MOST_DAMPED = 3.0
"""Modes of a larger logarithmic decrement are not seen."""


def panels(result, view):
    """All that this run has something to show for."""
    return [panel for panel in (draw(result, view) for draw in PANELS) if panel]


def _rotor(result, view):
    drawn = machine(result)
    what = "box" if len(drawn["body"]["outline"]) == 4 else "cylinder"
    caption = f"To scale along and across the axis. The body is the {what} of even density with the rotor’s mass and inertia."
    if not stations.is_followed(result.columns):
        caption += " The samples are too far apart to follow it: only at them it stands as drawn."
    return {"kind": "rotor", "title": "The rotor", "caption": caption, "machine": drawn}


def _campbell(result, view):
    if view is None or view.floquet:
        return None
    speeds = np.unique([row["speed_rad_s"] for row in view.modes])
    frequencies, decrements = [], []
    colours, of_colour = {"forward": "blue", "backward": "orange"}, Counter()
    for number_, rows in view.branches():
        names = [row["direction"] for row in rows]
        name = max(set(names), key=names.count)
        colour, label = colours.get(name, "green"), f"{number_} {name}"
        dash = of_colour[colour]
        of_colour[colour] += 1
        at = np.searchsorted(speeds, [row["speed_rad_s"] for row in rows])
        frequency, decrement = np.full(len(speeds), np.nan), np.full(len(speeds), np.nan)
        frequency[at] = [abs(row["frequency_rad_s"]) / math.tau for row in rows]
        decrement[at] = [linear.decrement(row["damping_ratio"]) for row in rows]
        frequencies.append(curve(label, frequency, colour, dash=dash))
        decrements.append(curve(label, np.where(np.abs(decrement) <= MOST_DAMPED, decrement, np.nan), colour, dash=dash))
    frequencies.append(curve("1×", speeds / math.tau, "muted", dash=1))
    critical = [crossing["speed_rad_s"] for crossing in view.critical]
    marks = [{"x": speed * RPM, "y": speed / math.tau} for speed in critical]
    plots = [("frequency [Hz]", frequencies, {"marks": marks})]
    if any(np.nanmax(np.abs(one["values"]), initial=0.0) > linear.NEITHER for one in decrements):
        plots.append(("log. decrement", decrements, {"lines": [{"y": 0.0}]}))
    caption = "Modes about the steady state against the speed; dots are critical speeds."
    if len(plots) == 2:
        caption += " Below zero, a mode grows by itself."
    elif all(abs(row["damping_ratio"]) <= linear.NEITHER for row in view.modes):
        caption += " None of them is damped and none grows."
    else:
        caption += " What creeps or grows without swinging has no decrement."
    return lines("Campbell diagram", caption, ("speed [rpm]", speeds * RPM), *plots)


def _growth_in_a_turn(result, view):
    if view is None or not view.floquet:
        return None
    speeds, rates = view.growth()
    caption = "Of small motions beside the one that repeats with each revolution, against the speed (Floquet); above zero they grow."
    return lines("Fastest growth", caption, ("speed [rpm]", speeds * RPM), ("growth [1/s]", [curve("growth", rates, "blue")], {}))


def loads(result):
    """Of everything that holds the rotor its force on it [N], by name; a force of always nothing left out."""
    columns, found = result.columns, {}
    for block in result.scene.blocks():
        parts = [columns[f"{block}.F.{c}"] for c in "xyz" if f"{block}.F.{c}" in columns.dtype.names]
        if np.any(parts):
            found[block] = np.sqrt(sum(part**2 for part in parts))
    return found


def _loads(result, view):
    found = loads(result)
    if not any(np.ptp(load) > FLAT * load.max() for load in found.values()):
        return None
    unit, size = multiple(max(load.max() for load in found.values()), "N")
    curves = [curve(name, load / size, COLOURS[i % 4]) for i, (name, load) in enumerate(found.items())]
    return lines("Loads", "Size of the force on the rotor.", ("time [s]", result.columns["time"]), (f"force [{unit}]", curves, {}))


def _energy(result, view):
    columns = result.columns
    work = columns["energy.supplied"] - columns["energy.dissipated"]
    parts = {"work supplied − lost": work} if np.any(work) else {}
    parts |= {name: columns[f"energy.{name}"] for name in ("kinetic", "potential", "total")}
    changes = {name: values - values[0] for name, values in parts.items()}
    plots = []
    turnover = measure.energy_balance(columns, result.scene.relative_tolerance).turnover
    largest = max(np.abs(change).max() for change in changes.values())
    if largest > FLAT * turnover:
        unit, size = multiple(largest, "J")
        # One may hide another: what lies below is wide, what lies above is dashed.
        colours = {"kinetic": "blue", "potential": "orange", "total": "text"}
        styles = {"total": {"dash": 1}, "work supplied − lost": {"width": 5}}
        curves = [curve(n, c / size, colours.get(n, "purple"), **styles.get(n, {})) for n, c in changes.items()]
        plots.append((f"change [{unit}]", curves, {}))
    residual = columns["energy.residual"]
    if np.any(residual):
        unit, size = multiple(np.abs(residual).max(), "J")
        plots.append((f"residual [{unit}]", [curve("residual", residual / size, "green")], {}))
    caption = (
        f"What went to and fro since the start{paper.figure(result, 7)}, and the residual total − total(start) − supplied + "
        f"dissipated, zero for an exact solution; at its largest {quantity(np.abs(residual).max(), 'J')}."
    )
    return lines("Energy", caption, ("time [s]", columns["time"]), *plots) if plots else None


PANELS = (
    _rotor,
    vibration.orbits,
    attitude.path,
    vibration.run_up,
    vibration.waterfall,
    vibration.whirls,
    vibration.response,
    _campbell,
    _growth_in_a_turn,
    _loads,
    attitude.spin,
    attitude.sphere,
    attitude.tilt,
    attitude.passage,
    attitude.coordinates,
    vibration.growth,
    _energy,
)
