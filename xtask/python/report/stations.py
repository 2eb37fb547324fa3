"""Places along the axis, and how they move across it."""

from dataclasses import dataclass

import numpy as np

MOST = 4
"""Stations that one picture shows."""


@dataclass(frozen=True)
class Station:
    """A place on the axis."""

    name: str
    position: float
    """From the mass centre c along the axis [m]."""

    def offset(self, result):
        """y + i z, across the x axis [m]."""
        axis = result["axis.y"] + 1j * result["axis.z"]
        return result["r_c.y"] + 1j * result["r_c.z"] + self.position * axis

    def velocity(self, result):
        """The rate of the offset [m/s]."""
        ω, t = ([result[f"{name}.{c}"] for c in "xyz"] for name in ("omega", "axis"))
        turning = (ω[2] * t[0] - ω[0] * t[2]) + 1j * (ω[0] * t[1] - ω[1] * t[0])
        return result["v_c.y"] + 1j * result["v_c.z"] + self.position * turning


ROUNDING = 1e-9
"""Motions of less than this part of the largest distance are rounding."""
FOLLOWED = 0.1
"""Samples follow a motion where the mean of the rates at two of them tells the way between to this part of the whole."""


def is_followed(result):
    """Whether the samples are close enough to tell how c moves, across the x axis."""
    c = Station("c", 0.0)
    offset, rate = c.offset(result), c.velocity(result)
    told = np.diff(result["time"]) * (rate[1:] + rate[:-1]) / 2.0
    swing, size = np.abs(offset - offset.mean()).max(), np.abs(offset).max()
    return np.abs(np.diff(offset) - told).max() <= max(FOLLOWED * swing, ROUNDING * size)


def all_of(scene, *kinds):
    """The stations of these kinds of blocks, in the scene's order."""
    return [Station(name, scene.value(f"{name}.position")) for name in scene.blocks(*kinds)]


def held(scene):
    """Where the rotor is held: all that has a place and a force, such as a bearing."""
    return [s for s in all_of(scene) if f"{s.name}.position" in scene.parameters and f"{s.name}.F.y" in scene.outputs]


def is_machine(scene):
    """Whether the rotor is out of balance or held at stations: its vibration is what one looks at."""
    return bool(scene.blocks("unbalance") or held(scene))


def looked_at(scene):
    """Where vibration is looked at: at the probes and where the rotor is held, a place once, else at c."""
    places = {}
    for station in all_of(scene, "probe") + held(scene):
        places.setdefault(station.position, station)
    return list(places.values())[:MOST] or [Station("c", 0.0)]


def largest_offset(scene, result):
    """How far any station goes from the x axis [m]."""
    places = [Station("c", 0.0), *all_of(scene, "probe"), *held(scene)]
    return max(np.abs(place.offset(result)).max() for place in places)
