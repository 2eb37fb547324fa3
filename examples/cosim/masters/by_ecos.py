"""ecos (ecospy 0.7.2): it steps all FMUs, and then passes on all values, so partners answer a step late."""

import sys

import numpy as np
from ecospy import EcosSimulation, EcosSimulationStructure


def ecos(models, links, watched, step, count):
    def of(end):
        return end.replace(".", "::", 1)

    with EcosSimulationStructure() as structure:
        for name, (path, _) in models.items():
            structure.add_model(name, path)
        for source, sink in links:
            structure.make_real_connection(of(source), of(sink))
        values = {f"{name}::{variable}": value for name, (_, own) in models.items() for variable, value in own.items()}
        structure.add_parameter_set("values", values)
        with EcosSimulation(step_size=step, structure=structure) as simulation:
            if not simulation.init(parameter_set="values"):
                sys.exit("ecos did not start")
            seen = []
            for _ in range(count):
                simulation.step(1)
                seen.append([simulation.get_real(of(name)) for name in watched])
            simulation.terminate()
    return np.array(seen)
