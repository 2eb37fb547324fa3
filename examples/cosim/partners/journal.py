"""A short journal bearing (Ocvirk) with half a film (Gümbel), as an FMU of PythonFMU. It has no states."""

from math import hypot, pi

from described import answer, complete, parameter, shown
from pythonfmu import Fmi2Slave

LARGEST = 0.98  # eccentricity; the film has no limit at 1


class Journal(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.description = "a short journal bearing, cavitated over half of its circumference"
        parameter(self, "mu", "Pa.s", 0.02, "viscosity")
        parameter(self, "R", "m", 0.025, "radius")
        parameter(self, "L", "m", 0.02, "length")
        parameter(self, "c", "m", 50e-6, "radial clearance")
        for axis in "yz":
            shown(self, f"r{axis}", "m", "position of the station")
            shown(self, f"v{axis}", "m/s", "velocity of the station")
        shown(self, "w", "rad/s", "speed of the rotor")
        for n, axis in enumerate("yz"):
            value = lambda n=n: self._force()[n]  # noqa: E731
            answer(self, f"f{axis}", "N", "force on the rotor", value, ["ry", "rz", "vy", "vz", "w"])

    def _force(self):
        distance = hypot(self.ry, self.rz)
        if distance > 1e-12 * self.c:
            y, z = self.ry / distance, self.rz / distance
            turning = (self.vz * y - self.vy * z) / distance
        else:
            y, z, turning = 1.0, 0.0, 0.0
        e = min(distance / self.c, LARGEST)
        approach = (self.vy * y + self.vz * z) / self.c
        entrained = self.w - 2.0 * turning
        q = 1.0 - e * e
        scale = self.mu * self.R * self.L**3 / (2.0 * self.c**2)
        radial = -scale * (abs(entrained) * 2.0 * e**2 / q**2 + pi * (1.0 + 2.0 * e**2) / q**2.5 * approach)
        squeezed = 4.0 * e / q**2 * approach
        across = scale * (pi * e / (2.0 * q**1.5) * entrained + (squeezed if entrained >= 0.0 else -squeezed))
        return radial * y - across * z, radial * z + across * y

    def to_xml(self, *options):
        return complete(super().to_xml(*options), self)

    def do_step(self, current_time, step_size):
        return True
