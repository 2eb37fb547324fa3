"""An active magnetic bearing with a controller that samples the position, as an FMU of PythonFMU. It holds the current between samples."""

from described import answer, complete, parameter, shown, state
from pythonfmu import Fmi2Slave


class Magnetic(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.description = "F = ki i + ks r, the current i by a sampled PD controller"
        parameter(self, "ki", "N/A", 200.0, "force by current")
        parameter(self, "ks", "N/m", 1e6, "force by displacement")
        parameter(self, "kp", "A/m", 15000.0, "gain of the controller by displacement")
        parameter(self, "kd", "A.s/m", 15.0, "gain of the controller by velocity")
        parameter(self, "imax", "A", 10.0, "largest current")
        parameter(self, "sample", "s", 1e-4, "time between samples")
        for axis in "yz":
            shown(self, f"r{axis}", "m", "position of the station")
            state(self, f"i{axis}", "A", "current")
            state(self, f"last{axis}", "m", "position at the last sample")
        state(self, "taken", "1", "number of samples so far")
        for axis in "yz":
            answer(self, f"f{axis}", "N", "force on the rotor", lambda axis=axis: self._force(axis), [f"r{axis}"])

    def _force(self, axis):
        return self.ki * getattr(self, f"i{axis}") + self.ks * getattr(self, f"r{axis}")

    def to_xml(self, *options):
        return complete(super().to_xml(*options), self)

    def do_step(self, current_time, step_size):
        if current_time >= self.taken * self.sample - 1e-9:
            for axis in "yz":
                place, last = getattr(self, f"r{axis}"), getattr(self, f"last{axis}")
                velocity = (place - last) / self.sample if self.taken > 0 else 0.0
                current = -self.kp * place - self.kd * velocity
                setattr(self, f"i{axis}", max(-self.imax, min(self.imax, current)))
                setattr(self, f"last{axis}", place)
            self.taken += 1.0
        return True
