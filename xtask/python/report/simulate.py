"""One run of an FMU with fmpy: co-simulation from the start to the stop of its default experiment."""

import math
from dataclasses import dataclass
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np
from fmpy import extract, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.simulation import instantiate_fmu

LEAST_POINTS = 10_000
"""A run is looked at this often or more: a maximum between samples is then missed by little."""

STATUS = ("ok", "warning", "discard", "error", "fatal", "pending")  # fmi2Status, by number


class SimulationFailed(Exception):
    """The FMU refused a call or stopped before its stop time; the text carries its last log lines."""


@dataclass(frozen=True)
class Run:
    """What a run left behind."""

    result: np.ndarray
    """Structured: `time` [s] and every output, a row a communication point."""
    step: float
    """Between two communication points [s]."""
    stride: int
    """How many of them make a step of the scene's experiment."""
    wall_time: float
    """From the set-up of the experiment to its end, fmpy's own work included [s]."""
    log: list[str]
    """What the FMU logged, `status category: message`."""
    response: np.ndarray | None = None
    """Of a scene that answers to an imposed speed, columns `speed` [rad/s] and `radius` [m] of the whirl that lasts."""

    @property
    def experiment(self):
        """The result at the steps of the scene's experiment, and at its end."""
        rows = np.arange(0, len(self.result), self.stride)
        return self.result[np.union1d(rows, len(self.result) - 1)]


def simulate(fmu_path, description, scene):
    """Run the FMU at `fmu_path`; `description` is fmpy's ModelDescription of it."""
    log = []
    stride = max(1, math.ceil(LEAST_POINTS * scene.step / (scene.stop - scene.start) * (1.0 - 1e-9)))
    step = scene.step / stride

    def logger(_environment, _instance, status, category, message):
        log.append(" ".join((STATUS[status], f"{_text(category)}:", _text(message))))

    with TemporaryDirectory() as directory:
        extract(fmu_path, directory)
        try:
            fmu = instantiate_fmu(directory, description, "CoSimulation", logger=logger, debug_logging=True)
        except Exception as failure:  # fmpy raises nothing narrower here
            raise _failed(str(failure), log) from failure
        try:
            began = perf_counter()
            result = simulate_fmu(
                directory,
                validate=True,
                fmu_instance=fmu,
                model_description=description,
                start_time=scene.start,
                stop_time=scene.stop,
                output_interval=step,
            )
            wall_time = perf_counter() - began
        except FMICallException as failure:
            raise _failed(str(failure), log) from failure
        finally:
            fmu.freeInstance()

    reached = result["time"][-1]
    if not np.isclose(reached, scene.stop):
        raise _failed(f"the FMU stopped at {reached:g} s of {scene.stop:g} s", log)
    return Run(result, step, stride, wall_time, log)


SPEED = "imposed_speed.w"
SPEEDS = np.linspace(0.4, 2.0, 49)
"""Of the scene's own speed."""
LASTING = 0.9
"""After this part of a run, what lasts is left."""


def responds(description):
    """Whether a mass out of balance turns at a given speed."""
    names = {variable.name for variable in description.modelVariables}
    return SPEED in names and "unbalance[1].mass" in names and not any(name.startswith("effects.") for name in names)


def respond(fmu_path, description, scene):
    """The whirl that lasts at each speed, by a run of the whole experiment."""
    own = next(float(variable.start) for variable in description.modelVariables if variable.name == SPEED)
    radii = [_whirl(fmu_path, description, scene, own * speed) for speed in SPEEDS]
    return np.rec.fromarrays([own * SPEEDS, radii], names="speed,radius")


def _whirl(fmu_path, description, scene, speed):
    try:
        result = simulate_fmu(
            fmu_path,
            model_description=description,
            start_time=scene.start,
            stop_time=scene.stop,
            output_interval=scene.step,
            start_values={SPEED: speed},
            output=["r_c.y", "r_c.z"],
        )
    except FMICallException as failure:
        raise _failed(f"at {speed:g} rad/s: {failure}", []) from failure
    last = result[result["time"] >= scene.start + LASTING * (scene.stop - scene.start)]
    y, z = (last[name] - last[name].mean() for name in ("r_c.y", "r_c.z"))
    return np.sqrt(np.mean(y**2 + z**2))


def _failed(reason, log):
    return SimulationFailed("\n  ".join([reason, *log[-5:]]))


def _text(value):
    return value.decode("utf-8", errors="replace")
