"""fmpy runs an FMU and reads all its outputs at each step: run_fmpy.py FMU STOP STEP, in seconds."""

import sys

from fmpy import simulate_fmu

fmu, stop, step = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
simulate_fmu(fmu, stop_time=stop, output_interval=step)
