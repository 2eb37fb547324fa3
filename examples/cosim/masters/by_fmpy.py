"""Masters of our own, over fmpy: four orders in which values are passed on."""

from tempfile import TemporaryDirectory

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave

from masters import StepFailed

CONVERGED = 1e-8  # of the largest answer so far
PATIENCE = 60  # iterations


class Model:
    """An FMU that has been started."""

    def __init__(self, name, path, values):
        description = read_model_description(path)
        self.folder = TemporaryDirectory()
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=extract(path, self.folder.name),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.variables = {variable.name: variable for variable in description.modelVariables}
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        for variable, value in values.items():
            known = self.variables[variable]
            give = {"Boolean": self.fmu.setBoolean, "Integer": self.fmu.setInteger}.get(known.type, self.fmu.setReal)
            give([known.valueReference], [value])
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def references(self, names):
        return [self.variables[name].valueReference for name in names]

    def end(self):
        self.fmu.terminate()
        self.fmu.freeInstance()
        self.folder.cleanup()


class Link:
    """All links from one model to another."""

    def __init__(self, source, outputs, sink, inputs):
        self.source, self.sink = source, sink
        self.outputs, self.inputs = source.references(outputs), sink.references(inputs)

    def read(self):
        return self.source.fmu.getReal(self.outputs)

    def give(self, values):
        self.sink.fmu.setReal(self.inputs, list(values))

    def pass_on(self):
        self.give(self.read())


class System:
    """Models that are started, and their links: those that leave a rotor apart from those that leave a partner."""

    def __init__(self, models, links, watched):
        self.models = {name: Model(name, *of) for name, of in models.items()}
        self.rotors = [model for model in self.models.values() if "drive.phi" in model.variables]
        self.partners = [model for model in self.models.values() if model not in self.rotors]
        among = {}
        for source, sink in links:
            (from_model, output), (to_model, given) = (end.split(".", 1) for end in (source, sink))
            of = among.setdefault((from_model, to_model), ([], []))
            of[0].append(output)
            of[1].append(given)
        all_links = [Link(self.models[a], outputs, self.models[b], inputs) for (a, b), (outputs, inputs) in among.items()]
        self.shows = [link for link in all_links if link.source in self.rotors]
        self.answers = [link for link in all_links if link.source in self.partners]
        self.watched = [name.split(".", 1) for name in watched]

    def run(self, step, count, one_step):
        """Calls `one_step` `count` times; returns the watched values after each."""
        seen = []
        try:
            for n in range(count):
                one_step(n * step, step)
                seen.append(
                    [self.models[name].fmu.getReal(self.models[name].references([of]))[0] for name, of in self.watched]
                )
        except FMICallException as failed:
            raise StepFailed(f"at t = {n * step:g} s: {failed}") from failed
        finally:
            for model in self.models.values():
                model.end()
        return np.array(seen)


def step_all(models, time, step):
    for model in models:
        model.fmu.doStep(time, step)


def plain(models, links, watched, step, count):
    """All outputs are read, all inputs are set, all models step: partners answer a step late."""
    system = System(models, links, watched)
    for link in system.shows + system.answers:
        link.pass_on()

    def one(time, step):
        read = [(link, link.read()) for link in system.shows + system.answers]
        for link, values in read:
            link.give(values)
        step_all(system.models.values(), time, step)

    return system.run(step, count, one)


def fresh(models, links, watched, step, count):
    """Partners are shown the motion and answer to it before all models step."""
    system = System(models, links, watched)

    def one(time, step):
        for link in system.shows + system.answers:
            link.pass_on()
        step_all(system.models.values(), time, step)

    return system.run(step, count, one)


def gauss_seidel(models, links, watched, step, count):
    """The rotors step first, and partners are shown where they arrived before they step in turn."""
    system = System(models, links, watched)
    for link in system.shows + system.answers:
        link.pass_on()

    def one(time, step):
        step_all(system.rotors, time, step)
        for link in system.shows:
            link.pass_on()
        step_all(system.partners, time, step)
        for link in system.answers:
            link.pass_on()

    return system.run(step, count, one)


def iterated(models, links, watched, step, count, means=True):
    """Rolls each step back and repeats it until the answers at its end fit the motion: loads go on by a line to them. Partners that hold
    their inputs over a step get the mean of its ends, or with `means` false what they have at its start."""
    system = System(models, links, watched)
    for link in system.shows + system.answers:
        link.pass_on()
    ends = [np.array(link.read()) for link in system.answers]
    largest = [np.zeros_like(end) for end in ends]

    def one(time, step):
        nonlocal ends
        states = [(model, model.fmu.getFMUState()) for model in system.models.values()]
        begins = [np.array(link.read()) for link in system.answers]
        shown = [np.array(link.read()) for link in system.shows]
        for tried in range(PATIENCE):
            for model, state in states if tried else ():
                model.fmu.setFMUState(state)
            for link, begin, end in zip(system.answers, begins, ends):
                link.give(begin)
                link.sink.fmu.setRealInputDerivatives(link.inputs, [1] * len(begin), list((end - begin) / step))
            step_all(system.rotors, time, step)
            now = [np.array(link.read()) for link in system.shows]
            for link, before, after in zip(system.shows, shown, now):
                link.give(0.5 * (before + after) if means else before)
            step_all(system.partners, time, step)
            for link, after in zip(system.shows, now):
                link.give(after)
            found = [np.array(link.read()) for link in system.answers]
            largest[:] = [np.maximum(one, np.abs(other)) for one, other in zip(largest, found)]
            fits = all(
                np.all(np.abs(new - old) <= CONVERGED * np.max(most)) for new, old, most in zip(found, ends, largest)
            )
            ends = found
            if fits:
                break
        else:
            raise StepFailed(f"the iteration does not converge at t = {time:g} s: take shorter steps")
        for model, state in states:
            model.fmu.freeFMUState(state)

    return system.run(step, count, one)
