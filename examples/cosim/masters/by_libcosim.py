"""libcosim (libcosimpy 0.0.6): it reads all outputs, sets all inputs, and steps all FMUs, so partners answer a step late."""

import sys

import numpy as np
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

from masters import StepFailed

NANOSECONDS = 1e9  # [1/s], the unit of libcosim's clock


def libcosim(models, links, watched, step, count):
    log_output_level(CosimLogLevel.WARNING)
    execution = CosimExecution.from_step_size(round(step * NANOSECONDS))
    slaves = {name: execution.add_local_slave(CosimLocalSlave(str(path), name)) for name, (path, _) in models.items()}
    of = references(execution, slaves)
    for name, (_, values) in models.items():
        for variable, value in values.items():
            give = {bool: execution.boolean_initial_value, int: execution.integer_initial_value}
            if not give.get(type(value), execution.real_initial_value)(*of(f"{name}.{variable}"), value):
                sys.exit(f"libcosim does not set {variable} of {name}")
    for source, sink in links:
        execution.connect_real_variables(*of(source), *of(sink))
    return stepped(execution, slaves, watched, count)


def references(execution, slaves):
    """What libcosim calls a "model.variable"."""
    known = {
        f"{name}.{variable.name.decode()}": (slave, variable.reference)
        for name, slave in slaves.items()
        for variable in execution.slave_variables(slave)
    }
    return known.__getitem__


def stepped(execution, slaves, watched, count):
    """What is watched after each step."""
    observer, of = CosimObserver.create_last_value(), references(execution, slaves)
    execution.add_observer(observer)
    seen = []
    for _ in range(count):
        if not execution.step():
            raise StepFailed("libcosim did not step")
        seen.append([observer.last_real_values(slave, [reference])[0] for slave, reference in map(of, watched)])
    return np.array(seen)
