"""fmpy runs an FMU and reads all its outputs at each step: settings.py tells with which arguments."""

from fmpy import simulate_fmu
from settings import settings

fmu, stop, step, values = settings()
simulate_fmu(fmu, stop_time=stop, output_interval=step, start_values=values)
