"""A host of one instance: like fmpy's FMU2Slave or FMU2Model, but fmi2DoStep returns its status."""

from ctypes import byref, c_double

from fmpy import calloc, free
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Model,
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)

OK, WARNING, DISCARD = range(3)
MODEL_EXCHANGE, CO_SIMULATION = range(2)


class Host:
    """An instance of a packaged FMU. Used as a context, it frees the instance. Its messages are appended to `log`."""

    def __init__(self, fmu, kind=CO_SIMULATION, memory_functions=True, guid=None, log=None):
        self.fmu, self.kind = fmu, kind
        self.variables = fmu.variables
        self.slave = (FMU2Slave if kind == CO_SIMULATION else FMU2Model)(
            instanceName="instance",
            guid=fmu.description.guid,
            modelIdentifier=fmu.description.coSimulation.modelIdentifier,
            unzipDirectory=str(fmu.directory),
        )
        # Callbacks of its own: fmpy's default ones log through what an earlier simulate_fmu left behind.
        callbacks = fmi2CallbackFunctions()
        self.log = [] if log is None else log
        callbacks.logger = fmi2CallbackLoggerTYPE(lambda *message: self.log.append(message[-1].decode("utf-8")))
        if memory_functions:
            callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
            callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self._callbacks = callbacks
        self.slave.component = self.slave.fmi2Instantiate(
            b"instance",
            kind,
            (guid or fmu.description.guid).encode(),
            fmu.directory.as_uri().encode(),
            byref(callbacks),
            False,
            False,
        )

    def __enter__(self):
        return self

    def __exit__(self, *_exception):
        self.slave.freeInstance()

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
        numbers = (c_double * self.fmu.description.numberOfContinuousStates)()
        self.slave.getContinuousStates(numbers, len(numbers))
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

    def step(self, time, size):
        """The status of fmi2DoStep."""
        try:
            self.slave.doStep(time, size)
        except FMICallException as refused:
            return refused.status
        return OK
