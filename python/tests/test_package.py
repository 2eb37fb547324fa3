"""FMUs made by the package, without a compiler."""

from importlib.metadata import files

import fmpy
import numpy as np
import pytest
from conftest import ROOT
from fmpy.validation import validate_fmu

import split_rotor as sr


def names(path, of=None):
    """The names of an FMU's variables, of this causality."""
    variables = fmpy.read_model_description(path, validate=False).modelVariables
    return {variable.name for variable in variables if of is None or variable.causality == of}


@pytest.mark.parametrize("name", ["paper", "rubbing", "run_up"])
def test_it_shows_what_the_scene_calls_for(name, built, tmp_path):
    path = sr.package(sr.Scene.named(name), tmp_path / f"{name}.fmu")
    assert validate_fmu(str(path)) == []
    for causality in ["parameter", "input", "output"]:
        assert names(path, causality) == names(built(name), causality)
    besides = names(path) - names(built(name))
    assert names(built(name)) <= names(path) and all("state." in other for other in besides), besides


@pytest.mark.parametrize("name", ["rubbing", "run_up"])
def test_a_host_may_integrate(name, built, tmp_path):
    path = sr.package(sr.Scene.named(name), tmp_path / f"{name}.fmu")
    options = {"fmi_type": "ModelExchange", "stop_time": 0.2, "output_interval": 0.01, "output": ["r_c.y", "omega_phi"]}
    ours, theirs = (fmpy.simulate_fmu(one, **options) for one in [path, built(name)])
    for output in options["output"]:
        size = np.abs(theirs[output]).max()
        # CVODE counts states that stay as they are in its error.
        assert np.abs(ours[output] - theirs[output]).max() < 1e-3 * size, output


def test_every_value_is_the_scenes_and_the_guid_follows(turbo, tmp_path):
    of = []
    for mass in [12.0, 11.0]:
        path = sr.package(turbo.with_values({"rotor.m": mass}), tmp_path / f"turbo{mass:.0f}.fmu")
        description = fmpy.read_model_description(path)
        starts = {variable.name: variable.start for variable in description.modelVariables}
        # A scene's mass is that of the whole; the FMU counts the mass of the unbalance, 40 g·mm at the radius of gyration, apart.
        assert float(starts["rotor.m"]) == pytest.approx(mass - 4e-5 / np.sqrt(0.04 / mass), rel=1e-12)
        assert float(starts["bearing[2].kyy"]) == 2e7
        of.append(description.guid)
    assert of[0] != of[1]


def test_a_parameter_can_be_set(turbo, tmp_path):
    path = sr.package(turbo, tmp_path / "turbo.fmu")
    options = {"start_values": {"bearing[1].kyy": 1.5e7, "drive.tau": 30.0}, "stop_time": 0.1, "output_interval": 0.01}
    of_fmu = fmpy.simulate_fmu(path, output=["probe[1].r.y"], **options)
    changed = turbo.with_values({"bearing[1].kyy": 1.5e7})
    result = sr.run(changed, inputs={"drive.tau": 30.0}, outputs=["probe[1].r.y"], stop=0.1, step=0.01)
    assert np.array_equal(of_fmu["probe[1].r.y"], result["probe[1].r.y"])


def test_what_the_library_has_no_room_for_is_told(tmp_path):
    with pytest.raises(RuntimeError, match=r"the general FMU has no bearing\[1\].speed\[1\] \(two of a kind at most, and no tables or housings\)"):
        sr.package(sr.Scene.named("film_bearings"), tmp_path / "film.fmu")
    assert not list(tmp_path.iterdir())
    with pytest.raises(RuntimeError, match="cannot write"):
        sr.package(sr.Scene.named("paper"), tmp_path / "nosuch" / "paper.fmu")


def test_no_file_of_the_wheel_names_the_folder_where_it_was_built():
    # pip writes down from where it installed, and where it compiled to.
    travels = [file for file in files("split-rotor") if file.name != "direct_url.json" and file.suffix != ".pyc"]
    assert len(travels) > 20
    for file in travels:
        assert str(ROOT).encode() not in file.locate().read_bytes(), file
