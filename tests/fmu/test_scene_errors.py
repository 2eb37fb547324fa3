"""Scenes that cannot be, at the command line. What is said of each: model/tests/golden/scene_errors."""

import project
import pytest

BAD = "[rotor]\nm = -1\nJa = 0.15625\nJt = 0.078125\n"
SAID = """\
error: rotor.m = -1 is not possible
 --> {scene}:2:5
  |
2 | m = -1
  |     ^^ it must be a finite number > 0
"""


@pytest.mark.parametrize("command", ["describe", "package", "demo", "accuracy"])
def test_exact_every_command_refuses_a_bad_scene(xtask, tmp_path, command):
    """Before anything is built."""
    scene = tmp_path / "bad.toml"
    scene.write_text(BAD, encoding="utf-8")
    refused = xtask(command, scene)
    assert (refused.returncode, refused.stdout) == (1, "")
    assert refused.stderr == SAID.format(scene=scene)


def test_exact_message_where_there_is_no_scene(xtask):
    refused = xtask("describe", "papr")
    assert (refused.returncode, refused.stdout) == (1, "")
    said = ["error: there is no scene `papr`", f"--> {project.ROOT / 'scenes' / 'papr.toml'}"]
    said += [" = help: did you mean `paper`?", f" = help: the scenes are {', '.join(project.SCENES)}"]
    assert [line.rstrip() for line in refused.stderr.splitlines() if line.strip() != "|"] == said


def test_exact_message_where_there_is_no_file(xtask):
    refused = xtask("describe", "nosuch.toml")
    assert (refused.returncode, refused.stdout) == (1, "")
    assert refused.stderr == "error: there is no such file\n--> nosuch.toml\n"


def test_exact_message_of_a_file_that_is_not_text(xtask, tmp_path):
    scene = tmp_path / "bad.toml"
    scene.write_bytes(b"title = '\xff'")
    refused = xtask("describe", scene)
    assert (refused.returncode, refused.stdout) == (1, "")
    said = ["error: this letter is not written in UTF-8", f" --> {scene}:1:10"]
    said += ["  |", "1 | title = '\ufffd'", "  |          ^ save the file as UTF-8\n"]
    assert refused.stderr == "\n".join(said)


@pytest.mark.parametrize("command", ["hard-cases", "bench", "test"])
def test_exact_a_part_that_is_not_there_is_refused_at_once(xtask, command):
    refused = xtask(command, "nosuch")
    assert (refused.returncode, refused.stdout) == (1, "")
    assert 'name holds "nosuch": there are' in refused.stderr
