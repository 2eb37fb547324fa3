"""A linear bearing as an FMU of PythonFMU: stiffness and damping along each axis, and across y and z.

It has no states: it answers with the force on the rotor to what it is shown.
"""

from described import answer, complete, parameter, shown
from pythonfmu import Fmi2Slave

PAIRS = ("xx", "yy", "yz", "zy", "zz")


class Bearing(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.description = "F = -K r - C v"
        for pair in PAIRS:
            parameter(self, f"k{pair}", "N/m", 0.0, f"stiffness, force along {pair[0]} by displacement along {pair[1]}")
            parameter(self, f"c{pair}", "N.s/m", 0.0, f"damping, force along {pair[0]} by velocity along {pair[1]}")
        for axis in "xyz":
            shown(self, f"r{axis}", "m", "position of the station")
            shown(self, f"v{axis}", "m/s", "velocity of the station")
        for axis in "xyz":
            depends = [f"{of}{other}" for of in "rv" for other in "xyz" if axis + other in PAIRS]
            answer(self, f"f{axis}", "N", "force on the rotor", lambda axis=axis: self._force(axis), depends)

    def _force(self, axis):
        def by(coefficient, motion):
            return sum(
                getattr(self, coefficient + axis + other) * getattr(self, motion + other)
                for other in "xyz"
                if axis + other in PAIRS
            )

        return -by("k", "r") - by("c", "v")

    def to_xml(self, *options):
        return complete(super().to_xml(*options), self)

    def do_step(self, current_time, step_size):
        return True
