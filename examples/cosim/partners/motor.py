"""A motor with a speed controller on a torsion spring, as an FMU of PythonFMU. Its states are angle and speed of the motor; over a step it holds
what it was shown."""

from described import answer, complete, parameter, shown, state
from pythonfmu import Fmi2Slave


class Motor(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.description = "a controlled motor and a torsion spring to the rotor"
        parameter(self, "J", "kg.m2", 0.05, "moment of inertia of the motor")
        parameter(self, "k", "N.m/rad", 2e4, "stiffness of the spring")
        parameter(self, "d", "N.m.s/rad", 2.0, "damping of the spring")
        parameter(self, "kp", "N.m.s/rad", 5.0, "gain of the controller")
        parameter(self, "tau_max", "N.m", 200.0, "largest torque of the motor")
        parameter(self, "w_ref", "rad/s", 300.0, "speed that the controller wants")
        parameter(self, "inner", "s", 5e-6, "step of the integration within")
        shown(self, "phi", "rad", "angle of the rotor")
        shown(self, "w", "rad/s", "speed of the rotor")
        state(self, "phi_m", "rad", "angle of the motor")
        state(self, "w_m", "rad/s", "speed of the motor")
        answer(self, "tau", "N.m", "torque on the rotor", self._torque, ["phi", "w"])

    def _torque(self):
        return self._spring(self.phi_m, self.w_m)

    def _spring(self, phi_m, w_m):
        return self.k * (phi_m - self.phi) + self.d * (w_m - self.w)

    def _acceleration(self, phi_m, w_m):
        drive = max(-self.tau_max, min(self.tau_max, self.kp * (self.w_ref - w_m)))
        return (drive - self._spring(phi_m, w_m)) / self.J

    def to_xml(self, *options):
        return complete(super().to_xml(*options), self)

    def do_step(self, current_time, step_size):
        steps = max(1, round(step_size / self.inner))
        h = step_size / steps
        for _ in range(steps):
            # The midpoint rule: Euler's would pull back by k w h/2, 6 N.m at steps of 2 µs.
            half = self.w_m + 0.5 * h * self._acceleration(self.phi_m, self.w_m)
            self.w_m += h * self._acceleration(self.phi_m + 0.5 * h * self.w_m, half)
            self.phi_m += h * half
        return True
