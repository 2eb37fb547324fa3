"""libcosim runs an FMU and reads all its variables at each step: run_libcosimpy.py FMU STOP STEP, in seconds."""

import sys

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

NANOSECONDS = 1e9  # [1/s], the unit of libcosim's clock

fmu, stop, step = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
execution = CosimExecution.from_step_size(round(step * NANOSECONDS))
slave = CosimLocalSlave(fmu, "rotor")
execution.add_local_slave(slave)
observer = CosimObserver.create_last_value()
execution.add_observer(observer)
if not execution.step(round(stop / step)):
    sys.exit("libcosim did not reach the end")
