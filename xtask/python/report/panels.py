"""The pictures of a report: what each shows, as JSON that the page draws.

Each function of PANELS takes a `Result` and a `linear.Linear`, or None, and returns a panel, or None where the run has nothing
to show there. A panel is a dictionary of `kind` (how the page draws it: web/<kind>.js), `title`, `caption` and its curves.
"""

import math

import numpy as np
from markupsafe import Markup

from . import linear, measure, paper, spectrum, stations
from .machine import machine
from .notation import RPM, multiple, number, quantity, rpm
from .pack import extremes, packed
from .turns import turns

LAST = 3
"""Turns of an orbit."""
SWEPT = 0.2
"""A run whose speed changes by this part of its highest is a run-up, or a run-down."""
LONGEST_PATH = 5000
"""Points of a path."""
FLAT = 1e-9
"""Motions of less than this part of the machine, and tilts of less [rad], are rounding."""
MOST_DAMPED = 3.0
"""Modes of a larger logarithmic decrement are not seen."""
COLOURS = ("blue", "orange", "green", "purple")


def panels(result, view):
    """All that this run has something to show for."""
    return [panel for panel in (draw(result, view) for draw in PANELS) if panel]


def is_machine(scene):
    """Whether the rotor is out of balance or held at stations: its vibration is what one looks at."""
    return bool(scene.blocks("unbalance", *stations.HOLDING))


def _curve(label, values, colour, **style):
    return {"label": label, "values": values, "colour": colour, **style}


def _lines(title, caption, x, *plots):
    """Curves against a common ascending `x`, (label, values); each plot (label, curves, options)."""
    label, along = x
    rows = extremes(*(curve["values"] for _, curves, _ in plots for curve in curves))
    keep = lambda curve: curve | {"values": packed(np.asarray(curve["values"], dtype=float)[rows])}  # noqa: E731
    return {
        "kind": "lines",
        "title": title,
        "caption": caption,
        "x": {"label": label, "values": packed(along[rows])},
        "plots": [{"label": label, "curves": [keep(c) for c in curves], **more} for label, curves, more in plots],
    }


def _xy(title, caption, x_label, *plots, equal=False):
    """Paths in planes over a common x axis; each plot (label, paths), a path (label, x, y, marks)."""

    def path(colour, label, x, y, marks=()):
        return {"label": label, "x": packed(x), "y": packed(y), "colour": colour, "marks": list(marks)}

    drawn = [{"label": label, "paths": [path(c, *p) for c, p in zip(COLOURS, paths)]} for label, paths in plots]
    return {"kind": "paths", "title": title, "caption": caption, "x": x_label, "plots": drawn, "equal": equal}


def _rotor(result, view):
    drawn = machine(result)
    what = "box" if len(drawn["body"]["outline"]) == 4 else "cylinder"
    caption = f"To scale along and across the axis. The body is the {what} of even density with the rotor’s mass and inertia."
    return {"kind": "rotor", "title": "The rotor", "caption": caption, "machine": drawn}


def _seen(result):
    """(station, turns) of the stations that can be looked at turn by turn."""
    places = ((station, turns(station, result.columns)) for station in stations.looked_at(result.scene))
    return [(station, seen) for station, seen in places if seen]


def _sweeps(seen):
    speed = seen[0][1].speed if seen else np.zeros(1)
    return np.ptp(speed) > SWEPT * speed.max() and len(speed) >= 20


def _orbits(result, view):
    seen = _seen(result) if is_machine(result.scene) else []
    last = [(station, np.append(t.offset[-LAST:].ravel(), t.offset[-1, -1:])[:-1]) for station, t in seen]
    largest = max((np.abs(q - q.mean()).max() for _, q in last), default=0.0)
    if largest <= FLAT * stations.largest_offset(result.scene, result.columns):
        return None
    unit, size = multiple(largest, "m")
    paths = []
    for station, q in last:
        q = (q - q.mean()) / size
        paths.append((station.name, q.real, q.imag, [{"x": z.real, "y": z.imag} for z in q[:: len(q) // LAST]]))
    caption = f"The last {LAST} turns about their middle, at {rpm(seen[0][1].speed[-1])}. A dot marks where φ passes a whole turn."
    return _xy("Orbits", caption, f"y [{unit}]", (f"z [{unit}]", paths), equal=True)


def _path(result, view):
    if is_machine(result.scene):
        return None
    rows = result.columns[:: -(-len(result.columns) // LONGEST_PATH)]
    y, z = rows["r_c.y"], rows["r_c.z"]
    largest = max(np.ptp(y), np.ptp(z))
    if largest <= FLAT * abs(result.columns["r_c.x"]).max():
        return None
    unit, size = multiple(largest, "m")
    marks = [{"x": y[i] / size, "y": z[i] / size, "label": label} for i, label in ((0, "start"), (-1, "end"))]
    caption = f"Across the reference axis, seen along it, z up{_as_in(result, 5)}."
    paths = [("c", y / size, z / size, marks)]
    return _xy("Path of the mass centre", caption, f"y [{unit}]", (f"z [{unit}]", paths), equal=True)


def _run_up(result, view):
    seen = _seen(result) if result.scene.blocks("unbalance") else []
    if not _sweeps(seen):
        return None
    amplitudes, phases = [], []
    unit, size = multiple(max(_amplitude(t).max() for _, t in seen), "m")
    for station, t in seen:
        speed, amplitude = t.speed[1:] * RPM, _amplitude(t)[1:] / size
        top = amplitude.argmax()
        mark = {"x": speed[top], "y": amplitude[top], "label": f"{number(amplitude[top], 3)} {unit} at {rpm(t.speed[1 + top])}"}
        amplitudes.append((station.name, speed, amplitude, [mark]))
        phase = np.degrees(np.unwrap(np.angle(t.order(1)[1:])))
        phase -= 360.0 * round(phase[top] / 360.0)
        phases.append((station.name, speed, np.where(amplitude > 0.02 * amplitude.max(), phase, np.nan)))
    caption = (
        "The part of the motion that goes round once in a turn, turn by turn: the longer half axis of its orbit, and by how much "
        "its forward part is ahead of the rotor’s mark, φ = 0. The first turn is left out."
    )
    return _xy("Run-up", caption, "speed [rpm]", (f"amplitude 1× [{unit}]", amplitudes), ("phase [°]", phases))


def _amplitude(seen):
    """The longer half axis of the synchronous orbit in each turn [m]."""
    return np.abs(seen.order(1)) + np.abs(seen.order(-1))


def _waterfall(result, view):
    seen = _seen(result)
    if not _sweeps(seen):
        return None
    station, t = seen[0]
    time, offset = result.columns["time"], station.offset(result.columns)
    fastest = np.abs(result.columns["omega_phi"]).max() / math.tau
    highest = min(2.5 * fastest, 0.5 / (time[1] - time[0]))
    # The window at which the line of a run-up is as wide as it is steep.
    width = 2.0 * math.sqrt((time[-1] - time[0]) / fastest)
    times, frequencies, amplitude = spectrum.waterfall(time, offset, highest, width)
    unit, size = multiple(amplitude.max(), "m")
    decibels = 20.0 * np.log10(np.maximum(amplitude / amplitude.max(), 1e-3))
    return {
        "kind": "waterfall",
        "title": f"Waterfall, {station.name}",
        "caption": f"Amplitudes of whirls, forward above and backward below 0 Hz; the brightest is {number(amplitude.max() / size, 3)} "
        f"{unit}, black 60 dB below. Dashed: once and twice a turn.",
        "x": [float(times[0]), float(times[-1])],
        "y": float(frequencies[-1]),
        "levels": np.round(decibels + 60.0).astype(int).tolist(),
        "time": packed(t.time),
        "turning": packed(t.speed / math.tau),
    }


def _spectrum(result, view):
    station = stations.looked_at(result.scene)[0]
    time, offset = result.columns["time"], station.offset(result.columns)
    if _sweeps(_seen(result)) or np.abs(offset - offset.mean()).max() <= FLAT * stations.largest_offset(result.scene, result.columns):
        return None
    frequency, amplitude = spectrum.full(time, offset)
    turning = np.abs(result.columns["omega_phi"][-1]) / math.tau
    loud = np.abs(frequency[amplitude > 1e-3 * amplitude.max()]).max()
    highest = 1.2 * turning if loud < turning < min(4.0 * loud, frequency[-1]) else 1.2 * loud
    inside = np.abs(frequency) <= highest
    unit, size = multiple(amplitude.max(), "m")
    shown = np.maximum(amplitude[inside], 1e-4 * amplitude.max()) / size
    caption = f"Whirls in the second half of the run, forward at positive and backward at negative frequencies; {station.name}."
    if turning < frequency[-1]:
        caption += f" One turn: {number(turning)} Hz."
    curve = _curve("amplitude", shown, "blue")
    marks = [{"x": turning, "label": "1×"}] if turning < highest else []
    return _lines(f"Spectrum, {station.name}", caption, ("frequency [Hz]", frequency[inside]), (f"amplitude [{unit}]", [curve], {"log": True, "lines": marks}))


def _campbell(result, view):
    if view is None or view.floquet:
        return None
    speeds = np.unique([row["speed_rad_s"] for row in view.modes])
    frequencies, decrements = [], []
    colours = {"forward": "blue", "backward": "orange"}
    for number_, rows in view.branches():
        names = [row["direction"] for row in rows]
        name = max(set(names), key=names.count)
        colour = colours.get(name, "green")
        label = f"{number_} {name}"
        at = np.searchsorted(speeds, [row["speed_rad_s"] for row in rows])
        frequency, decrement = np.full(len(speeds), np.nan), np.full(len(speeds), np.nan)
        frequency[at] = [abs(row["frequency_rad_s"]) / math.tau for row in rows]
        decrement[at] = [linear.decrement(row["damping_ratio"]) for row in rows]
        frequencies.append(_curve(label, frequency, colour))
        decrements.append(_curve(label, np.where(np.abs(decrement) <= MOST_DAMPED, decrement, np.nan), colour))
    frequencies.append(_curve("1×", speeds / math.tau, "muted", dash=True))
    marks = [{"x": c["speed_rad_s"] * RPM, "y": c["speed_rad_s"] / math.tau} for c in view.critical if c["speed_rad_s"] <= speeds[-1]]
    plots = [("frequency [Hz]", frequencies, {"marks": marks})]
    if any(np.nanmax(np.abs(curve["values"]), initial=0.0) > linear.NEITHER for curve in decrements):
        plots.append(("log. decrement", decrements, {"lines": [{"y": 0.0}]}))
    caption = "Modes about the steady state against the speed; dots are critical speeds."
    if len(plots) == 2:
        caption += " Below zero, a mode grows by itself."
    else:
        caption += " No mode is damped and none grows."
    return _lines("Campbell diagram", caption, ("speed [rpm]", speeds * RPM), *plots)


def _growth_in_a_turn(result, view):
    if view is None or not view.floquet:
        return None
    speeds, rates = view.growth()
    caption = "Of small motions beside the one that repeats with each revolution, against the speed (Floquet); above zero they grow."
    return _lines("Fastest growth", caption, ("speed [rpm]", speeds * RPM), ("growth [1/s]", [_curve("growth", rates, "blue")], {}))


def loads(result):
    """Of everything that holds the rotor its force on it [N], by name; a force of always nothing left out."""
    columns, found = result.columns, {}
    for block in result.scene.blocks("support", *stations.HOLDING):
        parts = [columns[f"{block}.F.{c}"] for c in "xyz" if f"{block}.F.{c}" in columns.dtype.names]
        if np.any(parts):
            found[block] = np.sqrt(sum(part**2 for part in parts))
    return found


def _loads(result, view):
    found = loads(result)
    if not any(np.ptp(load) > FLAT * load.max() for load in found.values()):
        return None
    unit, size = multiple(max(load.max() for load in found.values()), "N")
    curves = [_curve(name, load / size, COLOURS[i % 4]) for i, (name, load) in enumerate(found.items())]
    return _lines("Loads", "Size of the force on the rotor.", ("time [s]", result.columns["time"]), (f"force [{unit}]", curves, {}))


def _spin(result, view):
    columns, scene = result.columns, result.scene
    spin, deviation = columns["omega_phi"], measure.spin_deviation(columns)
    time = ("time [s]", columns["time"])
    if np.ptp(spin) > 0.01 * np.abs(spin).max():
        curve = _curve("speed", spin * RPM, "blue")
        return _lines("Speed", Markup("The axial rate ω<sub>φ</sub> = dφ/dt."), time, ("speed [rpm]", [curve], {}))
    largest = deviation.values[deviation.extremum]
    if np.ptp(spin) <= 1e-11 * np.abs(spin).max():
        return None
    curves = [_curve("this run", deviation.values, "blue")]
    if scene.identifier == paper.IDENTIFIER:
        bound = np.full(len(spin), paper.SPIN_BOUND)
        curves += [_curve(f"the paper: {sign}{paper.SPIN_BOUND:g}", float(f"{sign}1") * bound, "orange", dash=True) for sign in "+-"]
    quantity_ = "ω<sub>φ</sub>/ω<sub>φ</sub>(0) − 1" if deviation.unit == "%" else "ω<sub>φ</sub> − ω<sub>φ</sub>(0)"
    caption = Markup(
        f"The axial rate ω<sub>φ</sub> = dφ/dt beside its start value, {quantity_}; at its largest "
        f"{number(largest, 3)} {deviation.unit} at {number(columns['time'][deviation.extremum])} s{_as_in(result, 6)}."
    )
    return _lines("Speed beside its start", caption, time, (f"deviation [{deviation.unit}]", curves, {}))


def _sphere(result, view):
    tilt = measure.tilt(result.columns).max()
    if tilt <= measure.SMALL_TILT:
        return None
    caption = f"The tip of the axis t on its sphere, e to the right and z up; it leans by {number(np.degrees(tilt), 3)}° at most."
    return {"kind": "sphere", "title": "The axis", "caption": caption}


def _tilt(result, view):
    columns = result.columns
    tilt = measure.tilt(columns)
    if (is_machine(result.scene) and tilt.max() <= measure.SMALL_TILT) or tilt.max() <= FLAT:
        return None
    curves = [_curve(f"γ{c}", columns[f"gamma.{c}"], colour) for c, colour in zip("yz", COLOURS)]
    caption = Markup("The transverse Euler vector γ, and its length θ, the angle by which the axis leans.")
    time = ("time [s]", columns["time"])
    return _lines("Tilt", caption, time, ("γ [rad]", curves, {}), ("θ [rad]", [_curve("θ", tilt, "purple")], {}))


def _passage(result, view):
    if measure.tilt(result.columns).max() <= np.pi / 2.0:
        return None
    shown = result.columns[measure.around_largest_tilt(result.columns)]
    axis = [_curve(f"t{c}", shown[f"axis.{c}"], colour) for c, colour in zip("xyz", COLOURS)]
    gamma = [_curve(f"γ{c}", shown[f"gamma.{c}"], colour) for c, colour in zip("yz", COLOURS[1:])]
    caption = (
        "φ, the axis t and γ around the largest tilt. At t = −e, where θ = π, the direction of γ has no limit; near it φ and γ turn "
        "about quickly together, while the axis and the attitude go straight on."
    )
    phi = [_curve("φ", shown["phi"], "blue")]
    plots = (("φ [rad]", phi, {}), ("t", axis, {}), ("γ [rad]", gamma, {}))
    return _lines("Passage of the largest tilt", caption, ("time [s]", shown["time"]), *plots)


def _coordinates(result, view):
    columns = result.columns
    if is_machine(result.scene) or all(np.ptp(columns[f"r_c.{c}"]) <= FLAT for c in "xyz"):
        return None
    unit, size = multiple(max(np.ptp(columns[f"r_c.{c}"]) for c in "xyz"), "m")
    plots = [(f"{c} [{unit}]", [_curve(c, columns[f"r_c.{c}"] / size, "blue")], {}) for c in "xyz"]
    return _lines("Coordinates of the mass centre", f"The same against the time{_as_in(result, 5)}.", ("time [s]", columns["time"]), *plots)


def _growth(result, view):
    if not result.scene.blocks("rotating_damping"):
        return None
    station = stations.looked_at(result.scene)[0]
    distance = np.abs(station.offset(result.columns))
    unit, size = multiple(distance.max(), "m")
    caption = f"Distance of {station.name} from the x axis. A whirl that grows or dies by itself is a straight line here."
    distance = np.maximum(distance, 1e-9 * distance.max()) / size
    return _lines("Growth", caption, ("time [s]", result.columns["time"]), (f"distance [{unit}]", [_curve("distance", distance, "blue")], {"log": True}))


def _response(result, view):
    if result.response is None:
        return None
    speed, radius = result.response["speed"] * RPM, result.response["radius"]
    unit, size = multiple(radius.max(), "m")
    caption = "The radius of the whirl that lasts, one run at each imposed speed."
    curve = _curve("radius", radius / size, "blue", points=True)
    return _lines("Response to unbalance", caption, ("speed [rpm]", speed), (f"radius [{unit}]", [curve], {}))


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
        styles = {"work supplied − lost": ("purple", {"width": 5}), "kinetic": ("blue", {}), "potential": ("orange", {}), "total": ("text", {"dash": True})}
        curves = [_curve(n, c / size, styles[n][0], **styles[n][1]) for n, c in changes.items()]
        plots.append((f"change [{unit}]", curves, {}))
    residual = columns["energy.residual"]
    if np.any(residual):
        unit, size = multiple(np.abs(residual).max(), "J")
        plots.append((f"residual [{unit}]", [_curve("residual", residual / size, "green")], {}))
    caption = (
        f"What went to and fro since the start{_as_in(result, 7)}, and the residual total − total(start) − supplied + dissipated, zero for "
        f"an exact solution; at its largest {quantity(np.abs(residual).max(), 'J')}."
    )
    return _lines("Energy", caption, ("time [s]", columns["time"]), *plots) if plots else None


def _as_in(result, figure):
    return f" (the paper’s Figure {figure})" if result.scene.identifier == paper.IDENTIFIER else ""


PANELS = (
    _rotor,
    _orbits,
    _path,
    _run_up,
    _waterfall,
    _spectrum,
    _response,
    _campbell,
    _growth_in_a_turn,
    _loads,
    _spin,
    _sphere,
    _tilt,
    _passage,
    _coordinates,
    _growth,
    _energy,
)
