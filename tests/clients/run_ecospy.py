"""ecos runs an FMU and reads all its variables at each step: run_ecospy.py FMU STOP STEP, in seconds.

It reads them for a table, values.csv in the current folder, which nobody needs.
"""

import sys

from ecospy import EcosSimulation, EcosSimulationStructure

fmu, stop, step = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
with EcosSimulationStructure() as structure:
    structure.add_model("rotor", fmu)
    with EcosSimulation(step_size=step, structure=structure) as simulation:
        simulation.add_csv_writer("values.csv")
        if not simulation.init():
            sys.exit("ecos did not start")
        simulation.step(round(stop / step))
        simulation.terminate()
