"""A linear bearing as an FMU of PythonFMU (0.6.3 and 0.7.0): `pythonfmu build -f bearing.py`.

It is shown place and velocity of a station and answers with the force on the rotor, at once: it has no states.
"""

from pythonfmu import Fmi2Causality, Fmi2Initial, Fmi2Slave, Fmi2Variability, Real

AXES = "xyz"


class Bearing(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.author, self.description = "split-rotor", "F = -k (r - r0) - c v, each axis on its own"
        for axis in AXES:
            self._variable(f"k{axis}", "stiffness [N/m]", Fmi2Causality.parameter, Fmi2Variability.tunable)
            self._variable(f"c{axis}", "damping [N.s/m]", Fmi2Causality.parameter, Fmi2Variability.tunable)
            self._variable(f"r0{axis}", "place at rest [m]", Fmi2Causality.parameter, Fmi2Variability.tunable)
            self._variable(f"r{axis}", "place of the station [m]", Fmi2Causality.input, Fmi2Variability.continuous)
            self._variable(f"v{axis}", "its velocity [m/s]", Fmi2Causality.input, Fmi2Variability.continuous)
            force = Real(
                f"f{axis}",
                description="force on the rotor [N]",
                causality=Fmi2Causality.output,
                variability=Fmi2Variability.continuous,
                initial=Fmi2Initial.calculated,
                getter=lambda axis=axis: self._force(axis),
            )
            self.register_variable(force)

    def _variable(self, name, description, causality, variability):
        setattr(self, name, 0.0)
        self.register_variable(Real(name, description=description, causality=causality, variability=variability))

    def _force(self, axis):
        k, c, rest, place, velocity = (getattr(self, name + axis) for name in ("k", "c", "r0", "r", "v"))
        return -k * (place - rest) - c * velocity

    def do_step(self, current_time, step_size):
        return True
