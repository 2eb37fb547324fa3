"""CoFMPy runs an FMU and reads all its outputs at each step: settings.py tells with which arguments.

It sends 0 to every input that is neither connected nor given a value. Its clock adds up steps, and it may take one more than
fits; it neither terminates nor frees the instance.
"""

from cofmpy import Coordinator
from settings import settings

fmu, stop, step, values = settings()
rotor = {"id": "rotor", "name": "rotor", "path": fmu, "initialization": values}
coordinator = Coordinator()
coordinator.start({"fmus": [rotor], "connections": []})
coordinator.run_simulation(step, stop)
