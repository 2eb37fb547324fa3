"""A bearing on a pedestal that has a mass, as an FMU of PythonFMU. Its states are position and velocity of the pedestal; over a step it holds
what it was shown."""

from described import answer, complete, parameter, shown, state
from pythonfmu import Fmi2Slave


class Pedestal(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.description = "a mass on a spring to the ground, and a bearing on that"
        parameter(self, "m", "kg", 40.0, "mass of the pedestal")
        parameter(self, "kb", "N/m", 1e7, "stiffness of the bearing")
        parameter(self, "cb", "N.s/m", 1000.0, "damping of the bearing")
        parameter(self, "kf", "N/m", 5e7, "stiffness of the foundation")
        parameter(self, "cf", "N.s/m", 2000.0, "damping of the foundation")
        parameter(self, "inner", "s", 5e-6, "step of the integration within")
        for axis in "yz":
            shown(self, f"r{axis}", "m", "position of the station")
            shown(self, f"v{axis}", "m/s", "velocity of the station")
            state(self, f"y{axis}", "m", "position of the pedestal")
            state(self, f"u{axis}", "m/s", "velocity of the pedestal")
        for axis in "yz":
            answer(self, f"f{axis}", "N", "force on the rotor", lambda axis=axis: self._force(axis), [f"r{axis}", f"v{axis}"])

    def _of(self, axis):
        return [getattr(self, name + axis) for name in ("r", "v", "y", "u")]

    def _force(self, axis):
        r, v, y, u = self._of(axis)
        return -self.kb * (r - y) - self.cb * (v - u)

    def _acceleration(self, r, v, y, u):
        return (self.kb * (r - y) + self.cb * (v - u) - self.kf * y - self.cf * u) / self.m

    def to_xml(self, *options):
        return complete(super().to_xml(*options), self)

    def do_step(self, current_time, step_size):
        steps = max(1, round(step_size / self.inner))
        h = step_size / steps
        for axis in "yz":
            r, v, y, u = self._of(axis)
            for _ in range(steps):
                half = u + 0.5 * h * self._acceleration(r, v, y, u)
                u += h * self._acceleration(r, v, y + 0.5 * h * u, half)
                y += h * half
            setattr(self, f"y{axis}", y)
            setattr(self, f"u{axis}", u)
        return True
