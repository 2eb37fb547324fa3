"""ecos runs an FMU and reads all its variables at each step: settings.py tells with which arguments.

It reads them for a table, values.csv in the current folder, which nobody needs.
"""

import sys

from ecospy import EcosSimulation, EcosSimulationStructure
from settings import settings

fmu, stop, step, values = settings()
with EcosSimulationStructure() as structure:
    structure.add_model("rotor", fmu)
    structure.add_parameter_set("values", {f"rotor::{name}": value for name, value in values.items()})
    with EcosSimulation(step_size=step, structure=structure) as simulation:
        simulation.add_csv_writer("values.csv")
        if not simulation.init(parameter_set="values"):
            sys.exit("ecos did not start")
        simulation.step(round(stop / step))
        simulation.terminate()
