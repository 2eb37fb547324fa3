"""A pedestal that carries a bearing of the rotor, as an FMU of PythonFMU. It has states only, position and velocity of the housing; over a step
it holds the load that it was shown."""

from described import complete, parameter, shown, state
from pythonfmu import Fmi2Slave


class Housing(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.description = "a mass on a spring to the ground"
        parameter(self, "m", "kg", 40.0, "mass of the pedestal")
        parameter(self, "kf", "N/m", 5e7, "stiffness of the foundation")
        parameter(self, "cf", "N.s/m", 2000.0, "damping of the foundation")
        parameter(self, "inner", "s", 5e-6, "step of the integration within")
        for axis in "yz":
            shown(self, f"F{axis}", "N", "force on the housing")
            state(self, f"r{axis}", "m", "position of the housing")
            state(self, f"v{axis}", "m/s", "velocity of the housing")

    def to_xml(self, *options):
        return complete(super().to_xml(*options), self)

    def do_step(self, current_time, step_size):
        steps = max(1, round(step_size / self.inner))
        h = step_size / steps
        for axis in "yz":
            f, r, v = (getattr(self, name + axis) for name in "Frv")
            for _ in range(steps):
                half = v + 0.5 * h * (f - self.kf * r - self.cf * v) / self.m
                v += h * (f - self.kf * (r + 0.5 * h * v) - self.cf * half) / self.m
                r += h * half
            setattr(self, f"r{axis}", r)
            setattr(self, f"v{axis}", v)
        return True
