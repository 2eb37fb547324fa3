"""One run of an FMU with fmpy: co-simulation from the start to the stop of its default experiment."""

import math
from tempfile import TemporaryDirectory
from time import perf_counter, thread_time

import fmpy
import numpy as np
from fmpy import extract, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.simulation import instantiate_fmu

from .result import Result, Timings
from .steering import Steering

LEAST_POINTS = 10_000
"""A run is looked at this often or more: a maximum between samples is then missed by little."""

STATUS = ("ok", "warning", "discard", "error", "fatal", "pending")  # fmi2Status, by number


class SimulationFailed(Exception):
    """The FMU refused a call or stopped before its stop time; the text carries its last log lines."""


def simulate(fmu_path, description, scene, inputs=()):
    """Run the FMU at `fmu_path`; `description` is fmpy's ModelDescription of it, `inputs` as `steering.Steering` takes them.

    Returns a `Result`.
    """
    steering = Steering(description, inputs)
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
            spent = _time_steps(fmu)
            steering.stop_where_inputs_bend(fmu)
            began, cpu_began = perf_counter(), thread_time()
            columns = simulate_fmu(
                directory,
                validate=True,
                fmu_instance=fmu,
                model_description=description,
                start_time=scene.start,
                stop_time=scene.stop,
                output_interval=step,
                start_values=steering.at(scene.start),
            )
            timings = Timings(sum(spent), thread_time() - cpu_began, perf_counter() - began)
        except FMICallException as failure:
            raise _failed(str(failure), log) from failure
        finally:
            fmu.freeInstance()

    reached = columns["time"][-1]
    if not np.isclose(reached, scene.stop):
        raise _failed(f"the FMU stopped at {reached:g} s of {scene.stop:g} s", log)
    return Result(scene, np.asarray(columns), f"as a co-simulation by fmpy {fmpy.__version__}", timings, tuple(log))


def _time_steps(fmu):
    """The list to which each call of fmi2DoStep adds the CPU time that it takes [s]."""
    spent, step = [], fmu.doStep

    def timed(*words, **named):
        began = thread_time()
        try:
            return step(*words, **named)
        finally:
            spent.append(thread_time() - began)

    fmu.doStep = timed
    return spent


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
