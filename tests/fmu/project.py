"""Where the project's files are, and its command line."""

import json
import os
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCENES = sorted(path.stem for path in (ROOT / "scenes").glob("*.toml"))
# Those whose FMUs are tested: all, or what the environment names.
PACKAGED = os.environ.get("SPLIT_ROTOR_PACKAGED", " ".join(SCENES)).split()
# And those whose FMUs were made over the library of every effect, whose states they show too: they run, and their bits are tested.
OVER_GENERAL = os.environ.get("SPLIT_ROTOR_OVER_GENERAL", "").split()
# Those that name no adaptive method are too stiff, too fast or too long for most methods and for differences; so are the machines that
# inputs over time drive.
UNLIKE = ('method = "auto"', 'method = "symplectic"', "[[input]]")
GENTLE = [
    scene for scene in SCENES if not any(word in (ROOT / "scenes" / f"{scene}.toml").read_text("utf-8") for word in UNLIKE)
]
GENERAL = [scene for scene in SCENES if "\ngeneral = true" in "\n" + (ROOT / "scenes" / f"{scene}.toml").read_text("utf-8")]
# The jobs of `cargo xtask test` have a folder of their own.
OF_TESTS = os.environ.get("SPLIT_ROTOR_FMUS")
PACKAGES = Path(OF_TESTS or ROOT / "target" / "fmu")
BUILDERS = ROOT / "target" / "package"
KEPT = BUILDERS / "lists"


def packaged(scene):
    """A scene's FMU as it was packaged last. The test is skipped where other scenes are tested, and fails where it is not there."""
    if scene not in PACKAGED + OVER_GENERAL:
        pytest.skip(f"{scene}.fmu: `cargo xtask test packaged --long` tests it")
    path = PACKAGES / f"{scene}.fmu"
    if not path.is_file():
        remedy = "test packaged --long" if OF_TESTS else f"package {scene}"
        pytest.fail(f"{path} is not there: run `cargo xtask {remedy}`", pytrace=False)
    return path


def effects(scene):
    """The effects of which the scene's FMU has variables: those that it calls for, and all of them in a general one."""
    if scene in GENERAL:
        return {text.stem for text in (ROOT / "modelDescription/documentation/effects").glob("*.html")}
    text = (ROOT / "scenes" / f"{scene}.toml").read_text(encoding="utf-8")
    return set(re.findall(r"^\[+effects\.(\w+)", text, re.MULTILINE))


def build_xtask():
    """Builds xtask once, if it is not up to date; the path of its program."""
    cargo = os.environ.get("CARGO", "cargo")
    command = [cargo, "build", "--quiet", "--bin", "xtask", "--message-format=json"]
    built = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    messages = map(json.loads, built.stdout.splitlines())
    return next(message["executable"] for message in messages if message.get("executable"))
