"""The package as a type checker, a reader of `help` and a slip of the hand see it."""

import doctest
import subprocess
import sys
from importlib.metadata import version

import pytest

import split_rotor as sr

USER = """
import split_rotor as sr

scene = sr.Scene.named("turbo").with_values({"rotor.m": 11.0, "bearing[1].kyy": "15 N/um"})
result = sr.run(scene, inputs={"drive.tau": ([0.0, 1.0], [1, 2])}, outputs=["omega_phi"], stop="0.1 s", method="taylor")
top: float = result.deflections["r_c"].largest
fastest: float = result["omega_phi"].max()
speeds = sr.campbell(scene, speeds=(0.0, 1.0)).critical_speeds["speed_rad_s"]
path = sr.package(scene, "turbo.fmu").name
"""
SLIPS = [
    "sr.run(scene, stop=1j)",
    'sr.run(scene, outputs="omega_phi")',
    'sr.run("turbo")',
    'sr.run(scene, method="euler")',
    'sr.run(scene, tolerance="tight")',
    'sr.campbell(scene, steps="3")',
    'sr.response(scene, linear="yes")',
]


def checked(text, folder):
    """What mypy says of a program."""
    file = folder / "user.py"
    file.write_text(text, encoding="utf-8")
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", folder / "cache", file]
    return subprocess.run(command, capture_output=True, encoding="utf-8", cwd=folder, check=False)


def test_regress_mypy_takes_what_is_right_and_refuses_each_slip(tmp_path):
    right = checked(USER, tmp_path)
    assert right.returncode == 0, right.stdout
    wrong = checked(USER + "\n".join(SLIPS), tmp_path)
    lines = {int(line.split(":")[1]) for line in wrong.stdout.splitlines() if ": error:" in line}
    first = USER.count("\n") + 1
    assert lines == set(range(first, first + len(SLIPS))), wrong.stdout


def test_regress_the_first_example_of_help_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    failed, tried = doctest.testmod(sr)
    assert tried >= 5 and failed == 0


def test_the_version_is_that_of_the_installed_package():
    assert sr.__version__ == version("split-rotor")


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"outputs": "omega_phi"}, 'outputs must be a list of names: write outputs=["omega_phi"]'),
        ({"outputs": 3}, 'outputs must be a list of names, such as ["omega_phi"]; 3 is no text'),
        ({"inputs": ["drive.tau"]}, "inputs must be a dictionary"),
        ({"inputs": {"drive.tau": "3"}}, "inputs['drive.tau'] must be a number, or a pair of times"),
        ({"stop": 1j}, "experiment.stop: a value must be a number, a text, True or False, or a list of these, not complex"),
    ],
)
def test_regress_arguments_of_another_kind_are_told(turbo, options, told):
    with pytest.raises(TypeError) as error:
        sr.run(turbo, **options)
    assert told in str(error.value)


def test_regress_unknown_names_are_told_as_in_scenes(turbo):
    result = sr.run(turbo, outputs=["omega_phi"], stop=0.01)
    with pytest.raises(KeyError, match="turbo has no output `omega_pi`: did you mean `omega_phi`?"):
        result["omega_pi"]
    with pytest.raises(KeyError, match="this run of turbo did not read `phi`: it read the outputs omega_phi"):
        result["phi"]
    assert result.get("phi") is None and "phi" not in result
    modes = sr.campbell(turbo, speeds=(0.0, 100.0), steps=3).modes
    with pytest.raises(KeyError, match="there is no column `speed_rads`: did you mean `speed_rad_s`?"):
        modes["speed_rads"]
