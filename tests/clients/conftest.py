"""Fixtures of the tests with third-party clients: recorded runs of the packaged FMUs."""

import functools
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest
from fmpy import read_model_description
from fmpy.model_description import ModelDescription

import project
import recorded
import recording

PATIENCE = 600.0  # [s]: the slowest client takes 4 s


@dataclass(frozen=True)
class Packaged:
    """A packaged FMU, the one that records beside it, and its library."""

    description: ModelDescription
    recorded: Path
    library: Path

    @property
    def stop(self):
        """[s]"""
        return float(self.description.defaultExperiment.stopTime)

    @property
    def step(self):
        """[s]"""
        return float(self.description.defaultExperiment.stepSize)

    @property
    def inputs(self):
        """Pairs of name and start value, for clients that would send 0 to what nobody connects."""
        inputs = (variable for variable in self.description.modelVariables if variable.causality == "input")
        return tuple((variable.name, float(variable.start)) for variable in inputs)

    @property
    def outputs(self):
        """fmpy's variables."""
        return [variable for variable in self.description.modelVariables if variable.causality == "output"]


@pytest.fixture(scope="session")
def recorder():
    """recorder.c, compiled."""
    return recorded.build_recorder()


@pytest.fixture(scope="session")
def packaged(recorder, tmp_path_factory):
    """A scene's FMU by the scene's name."""

    @functools.cache
    def find(scene):
        fmu = project.packaged(scene)
        folder = tmp_path_factory.mktemp(scene)
        copy = folder / fmu.name
        recorded.record_fmu(fmu, recorder, copy)
        return Packaged(read_model_description(fmu), copy, recorded.unpack_library(fmu, folder))

    return find


def interpreter(client):
    """The Python that has this client."""
    if client == "fmpy":
        return sys.executable
    python = project.ROOT / "target" / "venv-clients" / "bin" / "python"
    if not python.is_file():
        pytest.fail(f"{client} is not installed: `cargo xtask test --long` installs it", pytrace=False)
    return python


@pytest.fixture(scope="session")
def python_of():
    """The Python that has a client, by the client's name."""
    return interpreter


@pytest.fixture(scope="session")
def record(packaged, tmp_path_factory):
    """All calls of a whole run of this client with this scene and these start values, pairs of name and value; each run is
    made once."""

    @functools.cache
    def run(client, scene, values=()):
        fmu = packaged(scene)
        folder = tmp_path_factory.mktemp(client)
        file = folder / "recording.txt"
        program = Path(__file__).with_name(f"run_{client}.py")
        done = subprocess.run(
            [interpreter(client), program, fmu.recorded, str(fmu.stop), str(fmu.step), *[f"{n}={v!r}" for n, v in values]],
            # What a client unpacks and leaves behind goes with the rest of the folder.
            env=os.environ | {recorded.VARIABLE: str(file), "TMPDIR": str(folder)},
            cwd=folder,
            capture_output=True,
            encoding="utf-8",
            timeout=PATIENCE,
        )
        if done.returncode != 0:
            pytest.fail(f"{client} fails with {done.returncode}:\n{done.stdout}{done.stderr}", pytrace=False)
        return recording.calls(file.read_text(encoding="ascii"))

    return run
