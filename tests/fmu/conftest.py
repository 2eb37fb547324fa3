"""Fixtures of the tests of the packaged FMUs. Make these with `cargo xtask package <scene> ...`."""

import subprocess
from pathlib import Path

import numpy as np
import project
import pytest
from packaged import unpack


@pytest.fixture(scope="session")
def fmus(tmp_path_factory):
    """Every scene's FMU, by the scene's name."""
    folder = tmp_path_factory.mktemp("fmus")

    class Fmus(dict):
        def __missing__(self, scene):
            return self.setdefault(scene, unpack(project.packaged(scene), folder / scene))

    return Fmus()


@pytest.fixture(params=project.PACKAGED)
def fmu(request, fmus):
    """Each scene's FMU."""
    return fmus[request.param]


@pytest.fixture(scope="session")
def paper(fmus):
    """The rotor of Sorokin and Zhang."""
    return fmus["paper"]


@pytest.fixture(scope="session")
def xtask():
    """Runs xtask with these words; a finished process with its text."""
    program = project.build_xtask()
    return lambda *words: subprocess.run(
        [program, *map(str, words)], cwd=project.ROOT, capture_output=True, encoding="utf-8", check=False
    )


@pytest.fixture(scope="session")
def package(xtask, tmp_path_factory):
    """Packages the scene in this TOML text under this name."""

    def make(name, text):
        folder = tmp_path_factory.mktemp(name)
        scene = folder / f"{name}.toml"
        scene.write_text(text, encoding="utf-8")
        done = xtask("package", scene, "--platforms", "here", "--out", folder)
        assert done.returncode == 0, done.stderr
        return unpack(folder / f"{name}.fmu", folder / "unpacked")

    return make


@pytest.fixture(scope="session")
def reference():
    """The paper's rotor from two formulations in quadruple precision: data/README.md."""
    return np.genfromtxt(Path(__file__).parent / "data" / "paper_reference.csv", delimiter=",", names=True)
