"""What the tests of the package share. `cargo xtask wheel` runs them on the wheel that it built, in an environment without Rust."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def block(document, language):
    """The first block of this language in a document of the project."""
    text = (ROOT / document).read_text(encoding="utf-8")
    return text.split(f"```{language}\n")[1].split("```")[0]


@pytest.fixture(scope="session")
def built():
    """The path of the FMU that xtask made of a scene."""
    folder = Path(os.environ.get("SPLIT_ROTOR_FMUS", ROOT / "target" / "fmu"))

    def find(name):
        path = folder / f"{name}.fmu"
        if not path.is_file():
            pytest.fail(f"{path} is not there: run `cargo xtask package {name}`", pytrace=False)
        return path

    return find


@pytest.fixture
def turbo():
    """The README's rotor."""
    import split_rotor as sr

    return sr.Scene.from_toml(block("README.md", "toml"), "turbo.toml")
