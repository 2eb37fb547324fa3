"""cofmupy 1.0.0: its method `jacobi` passes values on after all models have stepped, so partners answer a step late; with `gauss_seidel` the
rotors step first. In the first step all inputs are 0.

It needs an environment of its own, with older versions than the other masters. pip found no versions that fit all it names:

    pip install fmpy==0.3.20 pythonfmu==0.6.3 networkx==3.2.1 numpy pandas scipy plotly matplotlib rich confluent-kafka
    pip install --no-deps cofmupy==1.0.0

It can set Real variables only, so a scene is written and packaged for each rotor. A scene with `general = true` needs no compiler: it shares
the library of rotor.fmu. The FMU warns of motor.command, since cofmupy sets every input.
"""

import json
import subprocess
import sys
import tempfile
from collections import defaultdict
from contextlib import redirect_stdout
from pathlib import Path

import numpy as np
from cofmupy import Coordinator
from fmpy.fmi1 import FMICallException

from masters import StepFailed

ROOT = Path(__file__).resolve().parents[3]


def cofmupy(models, links, watched, step, count):
    return stepped("jacobi", models, links, watched, step, count)


def cofmupy_seidel(models, links, watched, step, count):
    return stepped("gauss_seidel", models, links, watched, step, count)


def stepped(method, models, links, watched, step, count):
    """What is watched after each step by one of cofmupy's methods."""
    with tempfile.TemporaryDirectory() as folder:
        # cofmupy unpacks FMUs there, and leaves them behind.
        tempfile.tempdir = folder
        try:
            fmus = []
            for name, (path, values) in models.items():
                if "rotor.m" in values:
                    path, values = packaged(name, values, Path(folder)), {}
                fmus.append({"id": name, "name": name, "path": str(path), "initialization": values})
            connections = [{"source": end(source), "target": [end(sink)]} for source, sink in links]
            coordinator = Coordinator()
            with redirect_stdout(sys.stderr):
                coordinator.start({"cosim_method": method, "fmus": fmus, "connections": connections})
            # Else the order is that of a Python set: another one in each process, unless PYTHONHASHSEED is set.
            coordinator.master.sequence_order = [list(models)]
            for n in range(count):
                try:
                    coordinator.do_step(step)
                except FMICallException as failed:
                    raise StepFailed(f"at t = {n * step:g} s: {failed}") from failed
            found = coordinator.get_results()
        finally:
            tempfile.tempdir = None
    return np.array([found[tuple(name.split(".", 1))] for name in watched]).T


def end(text):
    name, variable = text.split(".", 1)
    return {"type": "fmu", "id": name, "variable": variable, "unit": ""}


def packaged(name, values, folder):
    """The FMU of a rotor that begins with these values."""
    file = folder / f"{name}.toml"
    file.write_text(scene(values), encoding="utf-8")
    command = ["cargo", "xtask", "package", file, "--platforms", "here", "--out", folder]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, encoding="utf-8")
    if done.returncode != 0:
        sys.exit(done.stderr)
    return file.with_suffix(".fmu")


def scene(values):
    """The scene of rotor.fmu with these values, as a text."""
    on, keys = {"gravity": True}, defaultdict(list)
    for name, value in values.items():
        table, key = name.split(".", 1)
        if table == "effects":
            on[key] = value
        else:
            keys[table].append(f"{key} = {json.dumps(value)}")
    lines = ["general = true"]
    for table in ("rotor", "start", "solver"):
        lines += [f"[{table}]", *keys[table]]
    for effect in sorted(effect for effect, is_on in on.items() if is_on):
        head, _, number = effect.partition("[")
        lines += [f"[[effects.{head}]]" if number else f"[effects.{head}]", *keys[effect]]
    return "\n".join(lines) + "\n"
