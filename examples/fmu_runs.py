"""Runs of a packaged FMU under fmpy, one after another on one instance."""

import math
from bisect import bisect_left, bisect_right
from itertools import pairwise
from tempfile import TemporaryDirectory
from time import thread_time

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Real, fmi2ValueReference
from fmpy.simulation import instantiate_fmu


def check(path, scene, names):
    """Refuses an FMU of another scene, and names of what cannot be set as a real number."""
    kinds, starts = {}, {}
    for variable in read_model_description(path).modelVariables:
        if variable.causality in ("parameter", "input"):
            kinds[variable.name] = variable.type
            starts[variable.name] = float({"false": 0, "true": 1}.get(variable.start, variable.start))
    ours = {name: variable["start"] for name, variable in scene.variables.items() if variable["causality"] in ("parameter", "input")}
    for name, start in ours.items():
        if starts.get(name, start) != start and name not in scene.inputs:
            raise ValueError(f"{path} is of another scene: {name} = {starts[name]}, not {start}")
    if other := sorted(ours.keys() ^ starts.keys()):
        raise ValueError(f"{path} is of another scene: {other[0]} is in one of them only")
    for name in names:
        if name.startswith("experiment.") or kinds.get(name, "Real") != "Real":
            raise ValueError(f"{name} cannot vary under an FMU")


class OfFmu:
    """Runs of the FMU of a scene, with the scene's experiment and inputs; a way to run as `sweep.InProcess` is.

    The instance is reset before each run. `cpu` [s] includes fmpy's own part of the calls.
    """

    def __init__(self, path, scene, outputs):
        description = read_model_description(path)
        self.log = []
        with TemporaryDirectory() as folder:  # what is loaded needs its file no more
            extract(path, folder)
            self.fmu = instantiate_fmu(folder, description, "CoSimulation", logger=self._hear)
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}
        real = [variable for variable in description.modelVariables if variable.causality == "parameter" and variable.type == "Real"]
        self.starts = {variable.name: float(variable.start) for variable in real}
        self.scene, self.experiment, self.inputs = scene, scene.experiment, scene.inputs
        self.steps = list(self._steps())
        count, points = len(outputs), 1 + sum(at_point for *_, at_point in self.steps)
        self.read = (fmi2ValueReference * count)(*(self.references[name] for name in outputs))
        self.seen = (fmi2Real * count * points)()

    def __call__(self, values):
        self.cpu, self.log = 0.0, []
        # What follows from a value in a scene, such as the radius of an unbalance that is given by its moment, follows here too.
        variables = self.scene.with_values(values).variables
        starts = {name: variables[name]["start"] for name in self.starts.keys() & variables.keys()}
        changed = {name: start for name, start in starts.items() if start != self.starts[name]}
        began = thread_time()
        try:
            self._run(changed)
            return np.array(self.seen).T, int(self.fmu.getReal([self.references["solver.steps"]])[0])
        except FMICallException as failure:
            raise RuntimeError(" ".join([str(failure), *self.log[-1:]])) from failure
        finally:
            self.cpu = thread_time() - began

    def _run(self, values):
        fmu, experiment, read, seen = self.fmu, self.experiment, self.read, self.seen
        start = experiment["start"]
        fmu.reset()
        fmu.setReal([self.references[name] for name in values], list(values.values()))
        self._steer(self._courses(start, self.inputs))
        fmu.setupExperiment(experiment["tolerance"], start, experiment["stop"])
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        fmu.fmi2GetReal(fmu.component, read, len(read), seen[0])
        point = 0
        for t, size, courses, at_point in self.steps:
            if courses:
                self._steer(courses)
            fmu.doStep(t, size)
            if at_point:
                point += 1
                fmu.fmi2GetReal(fmu.component, read, len(read), seen[point])

    def _steps(self):
        """The steps of a run, as `split_rotor.run` makes them: time and size [s], the inputs that bend or jump there, whether it ends at a
        communication point."""
        start, stop, step = (self.experiment[name] for name in ("start", "stop", "step"))
        points = [min(start + n * step, stop) for n in range(math.ceil((stop - start) / step - 1e-9) + 1)]
        bending = {name: set(times) for name, (times, _) in self.inputs.items()}
        bends = sorted(set().union(*bending.values()))
        for t, end in pairwise(points):
            stops = [t, *bends[bisect_right(bends, t) : bisect_left(bends, end)], end]
            for a, b in pairwise(stops):
                yield a, b - a, self._courses(a, [name for name, times in bending.items() if a in times]), b == end

    def _courses(self, t, names):
        """Value reference, value and rate [1/s] of these inputs from time `t` [s] on."""
        return [(self.references[name], *_course(*self.inputs[name], t)) for name in names]

    def _steer(self, courses):
        if courses:
            references, values, rates = zip(*courses, strict=True)
            self.fmu.setReal(references, values)
            self.fmu.setRealInputDerivatives(references, [1] * len(references), rates)

    def _hear(self, _environment, _instance, _status, _category, message):
        self.log.append(message.decode("utf-8", errors="replace"))


def _course(times, values, t):
    """The value of an input at time `t` [s] and its rate from there on: linear between its points, held before and after."""
    after = bisect_right(times, t)
    if after in (0, len(times)):
        return values[max(after - 1, 0)], 0.0
    span, change = times[after] - times[after - 1], values[after] - values[after - 1]
    part = (t - times[after - 1]) / span
    return values[after - 1] * (1.0 - part) + values[after] * part, change / span
