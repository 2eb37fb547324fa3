"""The turbo rotor of the README on two bearings that are another model, beside the same rotor with bearings of its own.

    python examples/coupled.py target/fmu/rotor.fmu

fmpy is the master. As libcosim and ecos do, it reads all outputs, sets all inputs, and steps, so each force is the answer to what was
shown a step before. Printed: the largest distance at the probe over the last tenth of 50 ms, relative to the motion, where the ports hold
the forces, where they go by what they learn, and where the bearings' coefficients are given. docs/cosimulation.md says what happens.
"""

import sys
from functools import partial
from tempfile import TemporaryDirectory

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

SPAN = 0.05  # [s]
STEPS = (1e-3, 2e-4, 1e-4, 1e-5)  # [s]
PLACES = (-0.12, 0.12)  # [m]
# Stiffness [N/m] and damping [N·s/m] of the bearings along x, y and z.
STIFFNESS = np.array([[1e6, 2e7, 1.5e7], [0.0, 2e7, 1.5e7]])
DAMPING = np.array([[500.0, 2000.0, 2000.0], [0.0, 2000.0, 2000.0]])
ROTOR = {
    "rotor.m": 12.0,
    "rotor.Ja": 0.04,
    "rotor.Jt": 0.12,
    "rotor.l": 0.0,
    "start.r_c.x": 0.0,
    "start.omega.x": 1500.0,
    "unbalance[1].mass": 1e-3,
    "unbalance[1].radius": 0.04,
    "unbalance[1].position": 0.03,
    "probe[1].position": 0.12,
    "solver.relative_tolerance": 1e-9,
}
PROBE = ("probe[1].r.y", "probe[1].r.z")
AXES = "xyz"


def coefficients(of):
    """The bearings' coefficients, as values of a bearing or a port."""
    names = [f"{kind}{axis}{axis}" for kind in "kc" for axis in AXES]
    values = np.hstack([STIFFNESS, DAMPING])
    return {f"{of}[{n}].{name}": value for n in (1, 2) for name, value in zip(names, values[n - 1])}


class Rotor:
    """The general FMU with these effects and values, started."""

    def __init__(self, path, effects, values):
        description = read_model_description(path)
        with TemporaryDirectory() as folder:  # what is loaded needs its file no more
            identifier = description.coSimulation.modelIdentifier
            self.fmu = FMU2Slave(
                guid=description.guid, unzipDirectory=extract(path, folder), modelIdentifier=identifier, instanceName="turbo"
            )
            self.fmu.instantiate()
        self.variables = {variable.name: variable for variable in description.modelVariables}
        self.fmu.setupExperiment(startTime=0.0)
        self.set({"effects.support": False} | {f"effects.{effect}": True for effect in effects} | values)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def set(self, values):
        for name, value in values.items():
            variable = self.variables[name]
            (self.fmu.setBoolean if variable.type == "Boolean" else self.fmu.setReal)([variable.valueReference], [value])

    def get(self, names):
        return np.array(self.fmu.getReal([self.variables[name].valueReference for name in names]))

    def end(self):
        self.fmu.terminate()
        self.fmu.freeInstance()


def whole(path, step):
    """The way of the probe [m], where the bearings are the FMU's own."""
    bearings = {f"bearing[{n}].position": place for n, place in enumerate(PLACES, 1)} | coefficients("bearing")
    rotor = Rotor(path, ["unbalance[1]", "probe[1]", "bearing[1]", "bearing[2]"], ROTOR | bearings)
    way = []
    for n in range(round(SPAN / step)):
        rotor.fmu.doStep(n * step, step)
        way.append(rotor.get(PROBE))
    rotor.end()
    return np.array(way)


def coupled(path, step, values):
    """The same, where the bearings are another model: a function here, an FMU of another tool elsewhere."""
    ports = {f"port[{n}].position": place for n, place in enumerate(PLACES, 1)} | values
    rotor = Rotor(path, ["unbalance[1]", "probe[1]", "port[1]", "port[2]"], ROTOR | ports)
    shows = [[f"port[{n}].{of}.{axis}" for of in "rv" for axis in AXES] for n in (1, 2)]
    rest = np.array([[place, 0.0, 0.0] for place in PLACES])
    motion = [rotor.get(names) for names in shows]
    way = []
    for n in range(round(SPAN / step)):
        answers = [-k * (x[:3] - at) - c * x[3:] for k, c, x, at in zip(STIFFNESS, DAMPING, motion, rest)]
        motion = [rotor.get(names) for names in shows]
        for port, force in enumerate(answers, 1):
            rotor.set({f"port[{port}].f.{axis}": part for axis, part in zip(AXES, force)})
        rotor.fmu.doStep(n * step, step)
        way.append(rotor.get(PROBE))
    rotor.end()
    return np.array(way)


def compare(steps, whole, coupled):
    """Prints the errors at these steps [s] of `coupled`, called with a step and values of the ports, beside `whole`, called with a step."""
    held = {f"port[{n}].learn": False for n in (1, 2)}
    print(f"{'step [s]':>9} {'held':>8} {'learnt':>8} {'given':>8}")
    for step in steps:
        exact = whole(step)
        tenth = -max(1, len(exact) // 10)
        ways = [coupled(step, values) for values in (held, {}, coefficients("port"))]
        errors = [np.abs(way - exact)[tenth:].max() / np.abs(exact).max() for way in ways]
        print(f"{step:9.0e} " + " ".join(f"{error:8.1e}" for error in errors))


if __name__ == "__main__":
    (fmu,) = sys.argv[1:]
    compare(STEPS, partial(whole, fmu), partial(coupled, fmu))
