"""A torsion spring without mass between two rotors, as an FMU of PythonFMU. It has no states."""

from described import answer, complete, parameter, shown
from pythonfmu import Fmi2Slave


class Torsion(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.description = "a torsion spring and damper between two rotors"
        parameter(self, "k", "N.m/rad", 2e4, "stiffness")
        parameter(self, "d", "N.m.s/rad", 1.0, "damping")
        for end in (1, 2):
            shown(self, f"phi{end}", "rad", f"angle of rotor {end}")
            shown(self, f"w{end}", "rad/s", f"speed of rotor {end}")
        motion = ["phi1", "w1", "phi2", "w2"]
        answer(self, "tau1", "N.m", "torque on rotor 1", lambda: -self._torque(), motion)
        answer(self, "tau2", "N.m", "torque on rotor 2", self._torque, motion)

    def _torque(self):
        return self.k * (self.phi1 - self.phi2) + self.d * (self.w1 - self.w2)

    def to_xml(self, *options):
        return complete(super().to_xml(*options), self)

    def do_step(self, current_time, step_size):
        return True
