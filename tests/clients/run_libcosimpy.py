"""libcosim runs an FMU and reads all its variables at each step: settings.py tells with which arguments."""

import sys

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave
from settings import settings

NANOSECONDS = 1e9  # [1/s], the unit of libcosim's clock

fmu, stop, step, values = settings()
execution = CosimExecution.from_step_size(round(step * NANOSECONDS))
index = execution.add_local_slave(CosimLocalSlave(fmu, "rotor"))
observer = CosimObserver.create_last_value()
execution.add_observer(observer)
references = {variable.name.decode(): variable.reference for variable in execution.slave_variables(index)}
for name, value in values.items():
    give = execution.integer_initial_value if isinstance(value, int) else execution.real_initial_value
    if not give(index, references[name], value):
        sys.exit(f"libcosim does not set {name}")
if not execution.step(round(stop / step)):
    sys.exit("libcosim did not reach the end")
