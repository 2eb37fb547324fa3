"""Scenes: the project's own travel along, values are changed by name, errors are those of the commands."""

import pickle

import pytest
from conftest import ROOT

import split_rotor as sr


def test_the_scenes_of_the_project_are_in_the_package():
    assert sr.Scene.names() == sorted(path.stem for path in (ROOT / "scenes").glob("*.toml"))
    for name in sr.Scene.names():
        scene = sr.Scene.named(name)
        assert scene.toml == (ROOT / "scenes" / f"{name}.toml").read_text(encoding="utf-8")
        assert sr.Scene.load(ROOT / "scenes" / f"{name}.toml").variables == scene.variables


def test_a_name_that_is_none_is_told_as_the_commands_tell_it():
    with pytest.raises(sr.SceneError, match="there is no scene `papr`") as told:
        sr.Scene.named("papr")
    assert "did you mean `paper`?" in str(told.value)
    with pytest.raises(sr.SceneError, match="it cannot be read"):
        sr.Scene.load("nosuch.toml")


def test_all_that_is_wrong_is_told_with_line_and_mark():
    with pytest.raises(sr.SceneError) as told:
        sr.Scene.from_toml("[rotor]\nm = -1.0\nJa = 0.1\nJt = 0.2\n[effects.drg]\n", "mine.toml")
    assert "mine.toml:2:5\n" in str(told.value) and "m = -1.0\n  |     ^^^^ it must be a finite number > 0" in str(told.value)
    assert "did you mean `drag`?" in str(told.value)


def test_values_are_those_of_a_scene(turbo):
    values = {
        "rotor.m": 11,
        "start.omega.x": "3000 rpm",
        "bearing[2].kyy": 1e7,
        "unbalance[1].moment": "20 g mm",
        "start.at_rest": False,
        "experiment.stop": 0.5,
    }
    changed = turbo.with_values(values).variables
    starts = {name: variable["start"] for name, variable in changed.items()}
    assert (starts["bearing[1].kyy"], starts["bearing[2].kyy"]) == (2e7, 1e7)
    # A scene's mass is that of the whole.
    assert starts["rotor.m"] + starts["unbalance[1].mass"] == pytest.approx(11.0, rel=1e-15)
    assert starts["start.omega.x"] == pytest.approx(100.0 * 3.141592653589793, rel=1e-15)
    assert starts["unbalance[1].mass"] * starts["unbalance[1].radius"] == pytest.approx(2e-5, rel=1e-15)
    assert starts["start.at_rest"] == 0.0
    whole = turbo.variables["rotor.m"]["start"] + turbo.variables["unbalance[1].mass"]["start"]
    assert whole == pytest.approx(12.0, rel=1e-15), "a scene does not change"


def test_inputs_and_experiment_are_those_of_the_file(turbo, tmp_path):
    assert turbo.inputs == {"drive.tau": ([0.0, 3.0, 3.0], [30.0, 30.0, 0.0])} and sr.Scene.named("paper").inputs == {}
    assert turbo.experiment == {"start": 0.0, "stop": 4.0, "step": 2e-4, "tolerance": 1e-8}
    (tmp_path / "tau.csv").write_text("time,drive.tau\n0,1\n2,3\n", encoding="utf-8")
    text = turbo.toml.split("[[input]]")[0] + '[[input]]\nname = "drive.tau"\nfile = "tau.csv"\n'
    assert sr.Scene.from_toml(text, tmp_path / "turbo.toml").inputs == {"drive.tau": ([0.0, 2.0], [1.0, 3.0])}


def test_columns_of_tables_are_lists():
    scene = sr.Scene.named("film_bearings")
    speeds = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]
    count = sum(name.startswith("bearing[1].speed[") for name in scene.variables)
    changed = scene.with_values({"bearing[1].speed": speeds[:count]}).variables
    assert [changed[f"bearing[1].speed[{n + 1}]"]["start"] for n in range(count)] == speeds[:count]
    assert scene.with_values({"bearing[1].speed[1]": 0.5}).variables["bearing[1].speed[1]"]["start"] == 0.5


@pytest.mark.parametrize(
    ("value", "told"),
    [
        ({"rotor.m": -1}, "it must be a finite number > 0"),
        ({"rotor.q": 1}, "[rotor] knows m, Ja, Jt, l"),
        ({"bearing[3].kyy": 1}, "the scene has no parameter `bearing[3].kyy`"),
        ({"drag.linear": 1}, "the scene has no parameter `drag.linear`"),
        ({"bearing[1].kyy.z": 1}, "the scene has no parameter `bearing[1].kyy.z`"),
        ({"start.omega.x": "3000 rpx"}, "did you mean `rpm`?"),
        ({"rotor.m": float("nan")}, "rotor.m = nan is not possible"),
    ],
)
def test_what_cannot_be_is_told(turbo, value, told):
    with pytest.raises(sr.SceneError) as error:
        turbo.with_values(value)
    assert told in str(error.value)


def test_a_scene_is_pickled(turbo):
    again = pickle.loads(pickle.dumps(turbo.with_values({"rotor.m": 11.0})))
    assert again.name == "turbo"
    assert again.variables == turbo.with_values({"rotor.m": 11.0}).variables != turbo.variables
