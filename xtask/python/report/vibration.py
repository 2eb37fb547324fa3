"""Pictures of a rotor that vibrates: orbits, the run-up, frequencies, what an unbalance does."""

import math

import numpy as np

from . import spectrum, stations
from .notation import RPM, multiple, number, rpm
from .pack import packed
from .plots import curve, lines, paths
from .turns import LEAST_SAMPLES, samples, turns

LASTING = 1e-3
"""A vibration lasts where its middle turn has this part of its largest."""
LAST = 3
"""Turns of an orbit."""
SWEPT = 0.2
"""A run whose speed changes by this part of its highest is a run-up, or a run-down."""


def _seen(result):
    """(station, turns) of the stations that can be looked at turn by turn."""
    places = ((station, turns(station, result.columns)) for station in stations.looked_at(result.scene))
    return [(station, seen) for station, seen in places if seen]


def unseen(result):
    """Why the ways and frequencies of a run would be wrong, or None."""
    if not stations.is_machine(result.scene):
        return None if stations.is_followed(result.columns) else "the samples are too far apart to follow the motion."
    if _seen(result):
        return None
    if samples(result.columns) >= LEAST_SAMPLES:
        return "they are shown of three turns in one sense or more."
    needed = f"they need {LEAST_SAMPLES:g} samples a turn, and the fastest has {number(samples(result.columns), 2)}"
    return f"{needed}: make experiment.step smaller."


def _sweeps(seen):
    speed = seen[0][1].speed if seen else np.zeros(1)
    return np.ptp(speed) > SWEPT * speed.max() and len(speed) >= 20


def orbits(result, view):
    """The last turns of each station."""
    seen = _seen(result) if stations.is_machine(result.scene) else []
    last = [(station, t.offset[-LAST:].ravel()) for station, t in seen]
    largest = max((np.abs(q - q.mean()).max() for _, q in last), default=0.0)
    if largest <= stations.ROUNDING * stations.largest_offset(result.scene, result.columns):
        return None
    unit, size = multiple(largest, "m")
    ways = []
    for station, q in last:
        q = (q - q.mean()) / size
        ways.append((station.name, q.real, q.imag, [{"x": z.real, "y": z.imag} for z in q[:: len(q) // LAST]]))
    caption = f"The last {LAST} turns about their middle, at {rpm(seen[0][1].speed[-1])}. A dot marks where φ passes a whole turn."
    return paths("Orbits", caption, f"y [{unit}]", (f"z [{unit}]", ways), equal=True)


def run_up(result, view):
    """Amplitude and phase of the part that goes round with the rotor, against the speed (Bode)."""
    seen = _seen(result) if result.scene.blocks("unbalance") else []
    if not _sweeps(seen):
        return None
    parts = [(station, t.speed[1:], *_synchronous(t)) for station, t in seen]
    parts = [part for part in parts if np.isfinite(part[2]).any()]
    if not parts:
        return None
    amplitudes, phases, largest = [], [], []
    unit, size = multiple(max(np.nanmax(amplitude) for _, _, amplitude, _ in parts), "m")
    for station, speed, amplitude, phase in parts:
        top = np.nanargmax(amplitude)
        largest.append(f"{station.name} {number(amplitude[top] / size, 3)} {unit} at {rpm(speed[top])}")
        mark = {"x": speed[top] * RPM, "y": amplitude[top] / size}
        amplitudes.append((station.name, speed * RPM, amplitude / size, [mark]))
        phase = phase - 360.0 * round(phase[top] / 360.0)
        phases.append((station.name, speed * RPM, np.where(amplitude > 0.02 * amplitude[top], phase, np.nan)))
    is_whole = all(np.isfinite(amplitude).all() for _, _, amplitude, _ in parts)
    hidden = "" if is_whole else ", and so are turns in which motions of other frequencies hide it"
    caption = (
        f"The part of the motion that goes round once in a turn: the longer half axis of its orbit (largest: "
        f"{', '.join(largest)}), and by how much its forward part is ahead of the rotor’s mark, φ = 0. The first turn is left out{hidden}."
    )
    title = "Run-up" if seen[0][1].speed[-1] >= seen[0][1].speed[0] else "Run-down"
    return paths(title, caption, "speed [rpm]", (f"amplitude 1× [{unit}]", amplitudes), ("phase [°]", phases))


def _synchronous(seen):
    """Longer half axis [m] and phase [°] of the synchronous orbit after the first turn; NaN where others hide it."""
    forward, backward, shown = (part[1:] for part in seen.synchronous())
    amplitude = np.abs(forward) + np.abs(backward)
    phase = np.full(len(amplitude), np.nan)
    phase[shown] = np.degrees(np.unwrap(np.angle(forward[shown])))
    return np.where(shown, amplitude, np.nan), phase


def waterfall(result, view):
    """Frequencies against the time, of a run whose speed changes."""
    seen = _seen(result)
    if not _sweeps(seen) or np.median(seen[0][1].whirl) < LASTING * seen[0][1].whirl.max():
        return None
    if seen[0][1].whirl.max() <= stations.ROUNDING * stations.largest_offset(result.scene, result.columns):
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
        "caption": "Amplitudes of whirls, forward above and backward below 0 Hz. Dashed: once and twice a turn.",
        "loudest": f"{number(amplitude.max() / size, 3)}\u00a0{unit}",
        "x": [float(times[0]), float(times[-1])],
        "y": float(frequencies[-1]),
        "levels": np.round(decibels + 60.0).astype(int).tolist(),
        "time": packed(t.time),
        "turning": packed(t.speed / math.tau),
    }


def whirls(result, view):
    """Frequencies of a run whose speed does not."""
    station = stations.looked_at(result.scene)[0]
    time, offset = result.columns["time"], station.offset(result.columns)
    moving = np.abs(offset - offset.mean()).max() > stations.ROUNDING * stations.largest_offset(result.scene, result.columns)
    if _sweeps(_seen(result)) or unseen(result) or not moving:
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
    drawn = curve("amplitude", shown, "blue")
    marks = [{"x": turning, "label": "1×"}] if turning < highest else []
    plot = (f"amplitude [{unit}]", [drawn], {"log": True, "lines": marks})
    return lines(f"Spectrum, {station.name}", caption, ("frequency [Hz]", frequency[inside]), plot)


def growth(result, view):
    """How a whirl that damping in the rotor may drive grows or dies."""
    if not result.scene.blocks("rotating_damping"):
        return None
    station = stations.looked_at(result.scene)[0]
    distance = np.abs(station.offset(result.columns))
    unit, size = multiple(distance.max(), "m")
    caption = f"Distance of {station.name} from the x axis. A whirl that grows or dies by itself is a straight line here."
    distance = np.maximum(distance, 1e-9 * distance.max()) / size
    plot = (f"distance [{unit}]", [curve("distance", distance, "blue")], {"log": True})
    return lines("Growth", caption, ("time [s]", result.columns["time"]), plot)


def response(result, view):
    """The whirl that lasts, against an imposed speed."""
    if result.response is None:
        return None
    speed, radius = result.response["speed"] * RPM, result.response["radius"]
    unit, size = multiple(radius.max(), "m")
    caption = "The radius of the whirl that lasts, one run at each imposed speed."
    drawn = curve("radius", radius / size, "blue", points=True)
    return lines("Response to unbalance", caption, ("speed [rpm]", speed), (f"radius [{unit}]", [drawn], {}))
