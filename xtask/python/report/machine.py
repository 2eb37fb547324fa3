"""What the drawing of a rotor needs: its body, where it is held and looked at, and its motion."""

import numpy as np

from . import measure, stations
from .pack import packed

FRAMES = 12_000
"""Moments that the drawing can show, at most."""
SIDES = 48
"""Of the polygon that stands for a circle."""
SHOWN = 0.2
"""Of the drawing's length the largest motion shall be so much."""
RINGS = ("gap", "clearance")
"""What an effect calls how far the rotor can go in it."""


def machine(result):
    """The rotor of a `Result` to scale, as JSON: lengths in m, positions along the axis from c."""
    scene, columns = result.scene, result.columns
    body = _body(scene)
    held = [_holder(scene, station) for station in stations.held(scene)]
    probes = [vars(station) for station in stations.all_of(scene, "probe", "port")]
    supported = bool(scene.blocks("support"))
    reach = [body["length"] / 2.0, *(one["position"] for one in held + probes)]
    reach += [-body["length"] / 2.0, -scene.value("rotor.l") if supported else 0.0]
    span = [min(reach), max(reach)]
    size = max(span[1] - span[0], 2.0 * body["radius"])
    return {
        "body": body,
        "held": held,
        "probes": probes,
        "support": -scene.value("rotor.l") if supported else None,
        "unbalances": [_unbalance(scene, name) for name in scene.blocks("unbalance")],
        "span": span,
        # c, where nothing is displaced: the support holds its point at the origin.
        "rest": scene.value("rotor.l") if supported else float(columns["r_c.x"][0]),
        "exaggeration": _exaggeration(columns, stations.largest_offset(scene, columns), size),
        "motion": _motion(columns),
    }


def _body(scene):
    """The prism of even density with the rotor's mass and inertia: round, or a box where the body is not symmetric."""
    m, axial, across = (scene.value(f"rotor.{name}") for name in ("m", "Ja", "Jt"))
    other = scene.value("asymmetry.Jt2") if scene.blocks("asymmetry") else across
    # (width along an axis)² of a box is 6 (sum of the inertias about the two others − its own)/m.
    sums = (across + other - axial, axial + other - across, axial + across - other)
    along, y, z = (np.sqrt(max(0.0, 6.0 * s / m)) for s in sums)
    if other == across:
        radius = np.sqrt(2.0 * axial / m)
        angles = 2.0 * np.pi * np.arange(SIDES) / SIDES
        outline = radius * np.column_stack([np.cos(angles), np.sin(angles)])
        length = np.sqrt(max(0.0, 12.0 * across / m - 3.0 * radius**2))
    else:
        outline, length = np.array([[y, z], [-y, z], [-y, -z], [y, -z]]) / 2.0, along
    return {"outline": outline.round(6).tolist(), "length": float(length), "radius": float(np.hypot(*outline[0]))}


def _holder(scene, station):
    ring = sum(scene.value(f"{station.name}.{ring}") for ring in RINGS)
    return vars(station) | {"ring": ring or None}


def _unbalance(scene, name):
    return {key: scene.value(f"{name}.{key}") for key in ("position", "radius", "angle")}


def _exaggeration(columns, largest, size):
    """1, 2, 5, 10, … times the motion, so that it is seen; 1 where the axis leans by itself so far that it is."""
    if measure.tilt(columns).max() > measure.SMALL_TILT or largest == 0.0:
        return 1.0
    wanted = max(1.0, SHOWN * size / largest)
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(power * max(step for step in (1, 2, 5) if step * power <= wanted * (1.0 + 1e-9)))


def _motion(columns):
    rows = columns[:: -(-len(columns) // FRAMES)]
    # Between two frames more digits are needed than a curve has.
    motion = {"time": packed(rows["time"], step=1e-3 * np.median(np.diff(rows["time"]))), "phi": packed(rows["phi"], step=1e-3)}
    motion |= {"omega_phi": packed(rows["omega_phi"])}
    return motion | {f"{block}.{c}": packed(rows[f"{block}.{c}"]) for block in ("r_c", "axis") for c in "xyz"}
