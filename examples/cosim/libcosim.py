"""The turbo rotor of the README on two bearings that are FMUs of PythonFMU, with libcosim as the master.

    pip install libcosimpy==0.0.6 pythonfmu==0.7.0 fmpy numpy
    python examples/cosim/libcosim.py target/fmu/rotor.fmu

libcosim reads all outputs, sets all inputs, and steps all FMUs, so each force is the answer to what was shown a step before. Printed: the
largest distance at the probe over the last tenth of 50 ms from the same rotor with bearings of its own, relative to the motion, where the
ports hold the forces, where they go by what they learn, and where the bearings' coefficients are given. docs/cosimulation.md says what
happens; examples/coupled.py does the same without a master.
"""

import subprocess
import sys
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from coupled import AXES, DAMPING, PLACES, PROBE, ROTOR, SPAN, STIFFNESS, coefficients, compare  # noqa: E402

STEPS = (2e-4, 1e-4)  # [s]
NANOSECONDS = 1e9  # [1/s], the unit of libcosim's clock
MOTION = {f"{of}{axis}": f"{of}.{axis}" for of in "rv" for axis in AXES}
FORCE = {f"f{axis}": f"f.{axis}" for axis in AXES}


class Execution:
    """FMUs that libcosim steps together."""

    def __init__(self, step):
        self.execution = CosimExecution.from_step_size(round(step * NANOSECONDS))
        self.observer = CosimObserver.create_last_value()
        self.execution.add_observer(self.observer)
        self.references = {}

    def add(self, path, name, values):
        """An FMU with these start values."""
        index = self.execution.add_local_slave(CosimLocalSlave(str(path), name))
        variables = self.execution.slave_variables(index)
        self.references[index] = {variable.name.decode(): variable.reference for variable in variables}
        for variable, value in values.items():
            give = self.execution.boolean_initial_value if isinstance(value, bool) else self.execution.real_initial_value
            if not give(index, self.references[index][variable], value):
                sys.exit(f"libcosim does not set {variable} of {name}")
        return index

    def connect(self, source, output, target, given):
        self.execution.connect_real_variables(
            source, self.references[source][output], target, self.references[target][given]
        )

    def way(self, rotor, steps):
        """The probe [m] after each step."""
        probe = [self.references[rotor][name] for name in PROBE]
        way = []
        for _ in range(steps):
            if not self.execution.step():
                sys.exit("libcosim did not step")
            way.append(self.observer.last_real_values(rotor, probe))
        return np.array(way)


def switched_on(*effects):
    return {"effects.support": False} | {f"effects.{effect}": True for effect in ("unbalance[1]", "probe[1]", *effects)}


def whole(fmu, step):
    """The same rotor with bearings of its own."""
    execution = Execution(step)
    positions = {f"bearing[{n}].position": place for n, place in enumerate(PLACES, 1)}
    values = switched_on("bearing[1]", "bearing[2]") | ROTOR | positions | coefficients("bearing")
    return execution.way(execution.add(fmu, "rotor", values), round(SPAN / step))


def coupled(fmu, bearing, step, values):
    """The rotor, its bearings as partners at its ports."""
    execution = Execution(step)
    positions = {f"port[{n}].position": place for n, place in enumerate(PLACES, 1)}
    rotor = execution.add(fmu, "rotor", switched_on("port[1]", "port[2]") | ROTOR | positions | values)
    for n, (place, stiffness, damping) in enumerate(zip(PLACES, STIFFNESS, DAMPING), 1):
        given = {f"k{axis}": k for axis, k in zip(AXES, stiffness)} | {f"c{axis}": c for axis, c in zip(AXES, damping)}
        partner = execution.add(bearing, f"bearing_{n}", given | {"r0x": place})
        for name, shown in MOTION.items():
            execution.connect(rotor, f"port[{n}].{shown}", partner, name)
        for name, answer in FORCE.items():
            execution.connect(partner, name, rotor, f"port[{n}].{answer}")
    return execution.way(rotor, round(SPAN / step))


def main(fmu):
    log_output_level(CosimLogLevel.WARNING)
    with TemporaryDirectory() as folder:
        subprocess.run(
            [sys.executable, "-m", "pythonfmu", "build", "-f", HERE / "bearing.py", "-d", folder],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        bearing = Path(folder) / "Bearing.fmu"
        compare(STEPS, partial(whole, fmu), partial(coupled, fmu, bearing))


if __name__ == "__main__":
    main(*sys.argv[1:])
