"""A host of one instance: like fmpy's FMU2Slave or FMU2Model, but every call returns its status, and every message is kept."""

from ctypes import byref, c_double
from typing import NamedTuple

from fmpy import calloc, free
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Model,
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2LastSuccessfulTime,
    fmi2Terminated,
)

OK, WARNING, DISCARD, ERROR, FATAL = range(5)
MODEL_EXCHANGE, CO_SIMULATION = range(2)


class Message(NamedTuple):
    """What the FMU logged, byte for byte."""

    status: int
    category: str
    text: str
    instance: str


class Host:
    """An instance of a packaged FMU. Used as a context, it frees the instance."""

    def __init__(self, fmu, logging=True, guid=None, name="instance", kind=CO_SIMULATION, memory_functions=True):
        self.log = []
        self.fmu, self.kind = fmu, kind
        self.variables = fmu.variables
        self.number_of_states = fmu.description.numberOfContinuousStates
        self.slave = (FMU2Slave if kind == CO_SIMULATION else FMU2Model)(
            instanceName=name,
            guid=guid or fmu.description.guid,
            modelIdentifier=fmu.description.coSimulation.modelIdentifier,
            unzipDirectory=str(fmu.directory),
        )
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(self._logger)
        if memory_functions:
            callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
            callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self._callbacks = callbacks
        self.slave.component = self.slave.fmi2Instantiate(
            name.encode(),
            kind,
            self.slave.guid.encode(),
            fmu.directory.as_uri().encode(),
            byref(callbacks),
            False,
            logging,
        )

    def __enter__(self):
        return self

    def __exit__(self, *_exception):
        self.slave.freeInstance()

    def _logger(self, _environment, instance, status, category, message):
        self.log.append(Message(status, category.decode(), message.decode(), instance.decode()))

    def status(self, method, *arguments, **named):
        """The status of a method of fmpy's, by its name."""
        try:
            getattr(self.slave, method)(*arguments, **named)
        except FMICallException as refused:
            return refused.status
        return OK

    def refused(self, method, *arguments, **named):
        """The one line that the call logs; it must return fmi2Error."""
        before = len(self.log)
        assert self.status(method, *arguments, **named) == ERROR
        (message,) = self.log[before:]
        assert (message.status, message.category) == (ERROR, "logStatusError")
        return message.text

    def reference(self, name):
        """The value reference of a variable."""
        return self.variables[name].valueReference

    def set(self, values):
        """Sets Real parameters by name."""
        self.slave.setReal([self.reference(name) for name in values], list(values.values()))

    def set_method(self, number):
        """Sets solver.method."""
        self.slave.setInteger([self.reference("solver.method")], [number])

    def set_states(self, states):
        """fmi2SetContinuousStates"""
        states = list(states)
        self.slave.setContinuousStates((c_double * len(states))(*states), len(states))

    def states(self):
        """fmi2GetContinuousStates"""
        return self._filled("getContinuousStates")

    def rates(self):
        """fmi2GetDerivatives"""
        return self._filled("getDerivatives")

    def nominals(self):
        """fmi2GetNominalsOfContinuousStates"""
        return self._filled("getNominalsOfContinuousStates")

    def _filled(self, method):
        numbers = (c_double * self.number_of_states)()
        getattr(self.slave, method)(numbers, len(numbers))
        return list(numbers)

    def start(self, values=(), **experiment):
        """From the instantiated state to the first communication point, or to the first event mode."""
        self.slave.setupExperiment(**experiment)
        self.set(dict(values))
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        return self

    def read(self, *names):
        """Values of Real variables by name; of one variable, the value itself."""
        values = self.slave.getReal([self.reference(name) for name in names])
        return values if len(names) > 1 else values[0]

    def outputs(self):
        """All outputs."""
        return self.slave.getReal([v.valueReference for v in self.variables.values() if v.causality == "output"])

    def motion(self):
        """All outputs that are not of the solver."""
        return self.read(*(name for name, v in self.variables.items() if v.causality == "output" and "solver" not in name))

    def step(self, time, size):
        """The status of fmi2DoStep."""
        return self.status("doStep", time, size)

    def run(self, times):
        """Steps from each of the times to the next; all outputs at the last."""
        for time, following in zip(times, times[1:]):
            assert self.step(time, following - time) == OK
        return self.outputs()

    def last_successful_time(self):
        """What fmi2GetRealStatus says of it [s]."""
        return self.slave.getRealStatus(fmi2LastSuccessfulTime)

    def terminated(self):
        """What fmi2GetBooleanStatus says of fmi2Terminated."""
        return bool(self.slave.getBooleanStatus(fmi2Terminated))
