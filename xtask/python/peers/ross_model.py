"""The rotor of ross.toml for ROSS: a steel shaft of beam elements from bearing to bearing, as many times stiffer as asked for, and a disk.

ROSS's axis is z, its x and y are our y and z; its spin and the phase of its unbalance are ours.
"""

import ross

import numpy as np
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator

STEEL = {"rho": 7810.0, "E": 2.11e11, "Poisson": 0.3}
DIAMETER = 0.04  # [m]


class Bearing(ross.BearingElement):
    """A bearing by our law. ROSS makes a spline of a table that smooths every value by 1 and more in SI units: much for a damping."""

    def __init__(self, n, block):
        super().__init__(n, kxx=0.0, cxx=0.0)
        self.axial = {letter: block.get(f"{letter}xx", 0.0) for letter in "kc"}
        speed = np.array(block["speed"], dtype=float)
        names = [letter + pair for letter in "kc" for pair in ("yy", "yz", "zy", "zz")]
        values = np.array([block[name] for name in names], dtype=float)
        # eq. 100: SciPy has the same slopes but at the ends.
        slopes = PchipInterpolator(speed, values, axis=1).derivative()(speed)
        slopes[:, [0, -1]] = 0.0
        self.law, self.highest = CubicHermiteSpline(speed, values, slopes, axis=1), speed[-1]

    def across(self, speed):
        """K and C across the axis."""
        return self.law(min(abs(speed), self.highest)).reshape(2, 2, 2)

    def K(self, frequency):
        return np.pad(self.across(frequency)[0], (0, 1)) + np.diag([0.0, 0.0, self.axial["k"]])

    def C(self, frequency):
        return np.pad(self.across(frequency)[1], (0, 1)) + np.diag([0.0, 0.0, self.axial["c"]])

    def stiffness(self, speeds, rate):
        """The most that it resists a motion of this rate [1/s] with, at these speeds [N/m]."""
        return max(np.linalg.norm(self.across(speed), 2, (1, 2)) @ (1.0, rate) for speed in speeds)


class Rotor:
    """A shaft and a disk of the mass, mass centre and inertia of the scene."""

    def __init__(self, scene):
        rotor, effects = scene["rotor"], scene["effects"]
        self.bearings, (self.unbalance,) = effects["bearing"], effects["unbalance"]
        ends = [block["position"] for block in self.bearings]
        self.length, middle = ends[1] - ends[0], 0.5 * (ends[0] + ends[1])
        shaft = 0.25 * np.pi * DIAMETER**2 * self.length * STEEL["rho"]
        self.m = rotor["m"] - shaft
        self.place = -shaft * middle / self.m
        self.Ip = rotor["Ja"] - shaft * DIAMETER**2 / 8.0
        of_shaft = shaft * (self.length**2 / 12.0 + DIAMETER**2 / 16.0 + middle**2)
        self.Id = rotor["Jt"] - of_shaft - self.m * self.place**2
        self.nodes = sorted([*ends, self.place, self.unbalance["position"]])

    def node(self, block):
        return self.nodes.index(block["position"])

    def model(self, stiffer):
        material = ross.Material("shaft", **STEEL | {"E": stiffer * STEEL["E"]})
        spans = zip(self.nodes, self.nodes[1:])
        shaft = [ross.ShaftElement(L=to - at, idl=0.0, odl=DIAMETER, material=material) for at, to in spans]
        disk = ross.DiskElement(self.nodes.index(self.place), self.m, self.Id, self.Ip, tag="disk")
        # As with us, the mass of the unbalance is put onto the axis.
        point = ross.DiskElement(self.node(self.unbalance), self.unbalance["mass"], 0.0, 0.0, tag="unbalance")
        return ross.Rotor(shaft, [disk, point], [Bearing(self.node(block), block) for block in self.bearings])

    def explained(self, speeds, rate):
        """The part of their stiffness that both bearings lose to a steel shaft in series with them, a beam on two supports \\[1]."""
        stiffness = sum(Bearing(0, block).stiffness(speeds, rate) for block in self.bearings)
        return stiffness * self.length**3 / (48.0 * STEEL["E"] * np.pi * DIAMETER**4 / 64.0)
