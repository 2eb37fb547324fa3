"""CoFMPy runs an FMU and reads all its outputs at each step: run_cofmpy.py FMU STOP STEP, in seconds.

Its clock adds up steps, and it may take one more than fits; it neither terminates nor frees the instance.
"""

import sys

from cofmpy import Coordinator

fmu, stop, step = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
coordinator = Coordinator()
coordinator.start({"fmus": [{"id": "rotor", "name": "rotor", "path": fmu}], "connections": []})
coordinator.run_simulation(step, stop)
