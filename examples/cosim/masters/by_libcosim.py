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
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    slaves, references = {}, {}
    for name, (path, values) in models.items():
        slaves[name] = execution.add_local_slave(CosimLocalSlave(str(path), name))
        variables = execution.slave_variables(slaves[name])
        references[name] = {variable.name.decode(): variable.reference for variable in variables}
        for variable, value in values.items():
            give = {bool: execution.boolean_initial_value, int: execution.integer_initial_value}
            if not give.get(type(value), execution.real_initial_value)(slaves[name], references[name][variable], value):
                sys.exit(f"libcosim does not set {variable} of {name}")

    def of(end):
        name, variable = end.split(".", 1)
        return slaves[name], references[name][variable]

    for source, sink in links:
        execution.connect_real_variables(*of(source), *of(sink))
    seen = []
    for _ in range(count):
        if not execution.step():
            raise StepFailed("libcosim did not step")
        seen.append([observer.last_real_values(slave, [reference])[0] for slave, reference in map(of, watched)])
    return np.array(seen)
