"""Scenes that cannot be: each message names the file, the line, the key, the value and what would be right.

Those of several effects of a kind: model/tests/all/scenes.rs."""

import project
import pytest

PAPER = (project.ROOT / "scenes" / "paper.toml").read_text(encoding="utf-8")

CASES = {
    "unknown section": (
        "[rotor]", "[rotr]",
        ", line 5: unknown key `rotr`: a scene knows title, general, rotor, start, effects, solver, experiment",
    ),
    "unknown key in rotor": (
        "m = 5.0", "mass = 5.0", ", line 6: unknown key `rotor.mass`: [rotor] knows m, Ja, Jt, l",
    ),
    "unknown key in start": (
        "omega = {", "Omega = {", ", line 13: unknown key `start.Omega`: [start] knows r_c, v_c, phi, gamma, omega",
    ),
    "unknown component": (
        "r_c = { x", "r_c = { w", ", line 12: unknown key `start.r_c.w`: [start.r_c] knows x, y, z",
    ),
    "unknown key in an effect": (
        "c2 =", "c3 =", ", line 20: unknown key `effects.support.c3`: [effects.support] knows c1, c2, d1, d2",
    ),
    "unknown key in solver": (
        "relative_tolerance", "rtol",
        ", line 24: unknown key `solver.rtol`: [solver] knows method, relative_tolerance, absolute_tolerance, "
        "step_size, order, max_evaluations, method_number",
    ),
    "unknown key in experiment": (
        "step =", "dt =", ", line 28: unknown key `experiment.dt`: [experiment] knows start, stop, step, tolerance",
    ),
    "output as a key": (
        "c2 =", "F = { x = 1.0 }\nc2 =",
        ", line 20: unknown key `effects.support.F`: [effects.support] knows c1, c2, d1, d2",
    ),
    "unknown effect": (
        "effects.gravity", "effects.gravty", ", line 15: unknown effect `gravty`: there are gravity, support, drive, asymmetry, "
        "unbalance, bearing, rotating_damping, drag, probe, port, imposed_speed, extrapolation, motor, rub",
    ),
    "an effect's former name": (
        "effects.support]", "effects.shaft]\n[effects.support]",
        ", line 18: effect `shaft` is now called `drive`: write [effects.drive]",
    ),
    "text for a number": (
        "m = 5.0", 'm = "5 kg"', ', line 6: rotor.m = "5 kg" is not possible: it must be a number in kg',
    ),
    "text for a time": (
        "stop = 10.0", 'stop = "ten"', ', line 27: experiment.stop = "ten" is not possible: it must be a number in s',
    ),
    "number for a table": (
        "r_c = { x = 0.75 }", "r_c = 0.75", ", line 12: start.r_c = 0.75 is not possible: it must be a table of x, y, z, such as { x = 0.1 }",
    ),
    "number for a title": (
        'title = "Rotor in a block of springs (Sorokin and Zhang 2018)"', "title = 5",
        ", line 3: title = 5 is not possible: it must be a string",
    ),
    "missing mass": ("m = 5.0\n", "", ": `rotor.m` is missing: give the mass in kg as `m = ...` under [rotor]"),
    "missing place of the support": (
        "l = 0.75\n", "",
        ": `rotor.l` is missing: give the distance from the support point a to the mass centre c in m as `l = ...` under [rotor]",
    ),
    "negative mass": (
        "m = 5.0", "m = -5.0", ", line 6: rotor.m = -5.0 is not possible: it must be a finite number > 0",
    ),
    "not a number": ("l = 0.75", "l = nan", ", line 9: rotor.l = NaN is not possible: it must be a finite number"),
    "negative stiffness": (
        "c1 = 2000.0", "c1 = -1.0",
        ", line 19: effects.support.c1 = -1.0 is not possible: it must be a finite number >= 0",
    ),
    "impossible inertia": (
        "Jt = 0.078125", "Jt = 0.05",
        ", line 7: rotor.Ja = 0.15625 is not possible: it must be at most 2 rotor.Jt = 0.1 (a thin disk has Ja = 2 Jt)",
    ),
    "too large a tilt": (
        "[start]", "[start]\ngamma = { y = 3.0, z = 4.0 }",
        ", line 12: |start.gamma| = 5.0 is not possible: it must be at most pi = 3.141592653589793",
    ),
    "unknown method": (
        '"dop853"', '"rk4"', ', line 23: solver.method = "rk4" is not possible: it must be one of "auto", "dopri5", "dop853", "symplectic", "stiff", "taylor"',
    ),
    "method by number": (
        '"dop853"', "3", ', line 23: solver.method = 3 is not possible: it must be one of "auto", "dopri5", "dop853", "symplectic", "stiff", "taylor"',
    ),
    "impossible tolerance": (
        "1e-10", "1.0",
        ", line 24: solver.relative_tolerance = 1.0 is not possible: it must be a number from 1e-14 to 0.1",
    ),
    "stop before start": (
        "stop = 10.0", "start = 20.0\nstop = 10.0",
        ", line 28: experiment.stop = 10.0 is not possible: it must be later than experiment.start = 20.0 s",
    ),
    "no step": (
        "step = 0.01", "step = 0.0",
        ", line 28: experiment.step = 0.0 is not possible: it must be a number of seconds > 0, at most stop - start = 10.0 s",
    ),
    "broken TOML": ("m = 5.0", "m = = 5.0", ", line 6: is not TOML: extra `=`, expected nothing"),
    "too many in a general scene": (
        "[rotor]", "general = true\n" + 5 * "[[effects.probe]]\n" + "[rotor]",
        ", line 6: [[effects.probe]] stands 5 times: there may be up to 4",
    ),
    "number for a truth": (
        "[rotor]", "general = 1\n[rotor]", ", line 5: general = 1 is not possible: it must be true or false",
    ),
    "unknown component of an input": (
        "[effects.gravity]", "[[effects.port]]\nposition = 0.0\nf = { a = 1.0 }\n[effects.gravity]",
        ", line 17: unknown key `effects.port[1].f.a`: [effects.port.f] knows x, y, z",
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_exact_message_of_a_scene_that_cannot_be(xtask, tmp_path, case):
    old, new, message = CASES[case]
    assert PAPER.count(old) == 1, "the scene has changed: mend the case"
    scene = tmp_path / "bad.toml"
    scene.write_text(PAPER.replace(old, new), encoding="utf-8")
    described = xtask("describe", scene)
    assert (described.returncode, described.stdout) == (1, "")
    assert described.stderr == f"error: {scene}{message}\n"


def test_exact_each_message_is_another():
    messages = [message for _, _, message in CASES.values()]
    assert len(messages) >= 20 and len(set(messages)) == len(messages)


@pytest.mark.parametrize("command", ["describe", "package", "demo", "accuracy"])
def test_exact_every_command_refuses_a_bad_scene(xtask, tmp_path, command):
    """Before anything is built."""
    scene = tmp_path / "bad.toml"
    scene.write_text("[rotor]\nm = -1\n", encoding="utf-8")
    refused = xtask(command, scene)
    assert (refused.returncode, refused.stdout) == (1, "")
    reason = "line 2: rotor.m = -1.0 is not possible: it must be a finite number > 0"
    assert refused.stderr == f"error: {scene}, {reason}\n"


@pytest.mark.parametrize("given", ["nosuch", "nosuch.toml"])
def test_exact_message_where_there_is_no_scene(xtask, given):
    described = xtask("describe", given)
    assert (described.returncode, described.stdout) == (1, "")
    file = project.ROOT / "scenes" / "nosuch.toml" if given == "nosuch" else given
    scene = f"scene: give a path to a TOML file, or one of the names {', '.join(project.SCENES)}"
    assert described.stderr == f"error: {file}: there is no such {scene if given == 'nosuch' else 'file'}\n"


def test_exact_message_of_a_file_that_is_not_text(xtask, tmp_path):
    scene = tmp_path / "bad.toml"
    scene.write_bytes(b"title = '\xff'")
    described = xtask("describe", scene)
    assert (described.returncode, described.stdout) == (1, "")
    assert described.stderr == f"error: {scene}: cannot be read: stream did not contain valid UTF-8\n"
