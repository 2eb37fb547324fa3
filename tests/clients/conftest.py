"""Fixtures of the tests with recorded FMUs."""

import functools
from dataclasses import dataclass
from pathlib import Path

import pytest
from fmpy import read_model_description
from fmpy.model_description import ModelDescription

import project
import recorded


@dataclass(frozen=True)
class Packaged:
    """A packaged FMU, the one that records beside it, and its library."""

    description: ModelDescription
    recorded: Path
    library: Path


@pytest.fixture(scope="session")
def recorder():
    """recorder.c, compiled."""
    return recorded.build_recorder()


@pytest.fixture(scope="session")
def packaged(recorder, tmp_path_factory):
    """A scene's FMU by the scene's name."""

    @functools.cache
    def find(scene):
        fmu = project.PACKAGES / f"{scene}.fmu"
        if not fmu.is_file():
            pytest.fail(f"not packaged: run `cargo xtask package {scene}`", pytrace=False)
        folder = tmp_path_factory.mktemp(scene)
        copy = folder / fmu.name
        recorded.record_fmu(fmu, recorder, copy)
        return Packaged(read_model_description(fmu), copy, recorded.unpack_library(fmu, folder))

    return find
