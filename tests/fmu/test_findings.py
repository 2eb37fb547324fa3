"""What the report's results warn of, from runs and linear views that are known."""

import warnings
from types import SimpleNamespace

import numpy as np
import project
import pytest


@pytest.fixture
def findings(monkeypatch):
    """The module, and the linear view's."""
    monkeypatch.syspath_prepend(str(project.ROOT / "xtask" / "python"))
    from report import findings

    return findings


def run(speeds, **columns):
    """A run of 1 s through these speeds [rad/s], evenly."""
    columns = {"time": np.linspace(0.0, 1.0, 101), "omega_phi": np.interp(np.linspace(0, 1, 101), [0, 1], speeds), **columns}
    table = np.zeros(101, dtype=[(name, float) for name in columns])
    for name, values in columns.items():
        table[name] = values
    scene = SimpleNamespace(blocks=lambda *kinds: [] if "port" in kinds else ["rub[1]"], value=lambda name: 0.01)
    return SimpleNamespace(columns=table, scene=scene)


def mode(**numbers):
    """A row of a mode that swings at 100 rad/s and decays."""
    row = {"mode": 1, "direction": "forward", "frequency_rad_s": 100.0, "damping_ratio": 0.1, "growth_rate_1_s": -10.0}
    return row | numbers


def view(findings, **crossing):
    """A linear view with one critical speed, at 200 rad/s."""
    crossing = {"speed_rad_s": 200.0, "damping_ratio": 0.05, "direction": "forward", "sense": 1.0} | crossing
    return findings.linear.Linear(modes=[], critical=[crossing], thresholds=[], floquet=False)


def passed(findings, speeds, **crossing):
    return [found.what for found in findings._passed(run(speeds), view(findings, **crossing))]


def test_exact_a_critical_speed_among_those_of_the_run_is_told_with_its_amplification_factor(findings):
    (what,) = passed(findings, [0.0, 600.0])
    assert what.startswith("critical speed that an unbalance drives, within the speeds of this run, 0\u00a0rpm to 5\u202f730\u00a0rpm; amplification factor 10 (")
    assert "API 617" in what
    (what,) = passed(findings, [0.0, -600.0])  # either sense
    assert "amplification factor 10" in what
    (what,) = passed(findings, [300.0, 100.0], damping_ratio=0.0)
    assert what.endswith("; without damping")
    (what,) = passed(findings, [300.0, 100.0], damping_ratio=-0.1)
    assert what.endswith("; its mode grows by itself")


def test_exact_those_that_are_alike_are_told_as_one(findings):
    lines = [(200.0, 0.05), (210.0, 0.1), (300.0, 0.0), (630.0, 0.1)]
    crossings = [{"speed_rad_s": speed, "damping_ratio": ratio, "direction": "forward", "sense": 1.0} for speed, ratio in lines]
    linear = findings.linear.Linear(modes=[], critical=crossings, thresholds=[], floquet=False)
    found = [(found.value, found.what.split("; ")[1]) for found in findings._passed(run([0.0, 600.0]), linear)]
    assert found == [
        ("1\u202f910 · 2\u202f005\u00a0rpm", "amplification factors 10, 5 (from 2.5 on it counts as critical, API 617)"),
        ("2\u202f865\u00a0rpm", "without damping"),
        ("6\u202f016\u00a0rpm", "amplification factor 5 (from 2.5 on it counts as critical, API 617)"),
    ]


def test_exact_it_is_nearer_to_the_run_than_its_amplification_factor_allows(findings):
    # 200 rad/s and ζ = 0.05: an amplification factor of 10 asks for 17 (1 − 1/8.5) = 15 % below the lowest speed and 25 % above the highest.
    (what,) = passed(findings, [0.0, 160.1])  # 200/1.25 = 160
    assert what.startswith("critical speed that an unbalance drives, nearer than API 617 allows to the speeds of this run")
    assert len(passed(findings, [235.2, 400.0])) == 1  # 200/0.85 = 235.3
    assert passed(findings, [0.0, 159.9]) == [] == passed(findings, [235.4, 400.0])
    # Of one that is sharper no more than 16 % and 26 %; of one that is just a critical speed 0 and 10 %.
    assert len(passed(findings, [0.0, 158.8], damping_ratio=0.0)) == 1 and passed(findings, [0.0, 158.7], damping_ratio=0.0) == []
    assert passed(findings, [200.1, 400.0], damping_ratio=0.2) == [] and len(passed(findings, [0.0, 181.9], damping_ratio=0.2)) == 1


def test_exact_no_alarm_where_it_is_damped_or_goes_backward(findings):
    assert len(passed(findings, [0.0, 600.0], damping_ratio=0.199)) == 1  # 1/(2 · 2.5) = 0.2
    assert passed(findings, [0.0, 600.0], damping_ratio=0.201) == []
    assert passed(findings, [0.0, 600.0], direction="backward", sense=-1.0) == []
    assert len(passed(findings, [0.0, 600.0], direction="backward", sense=-0.999)) == 1, "an ellipse holds a circle forward"


def test_regress_no_unbalance_is_said_to_drive_a_critical_speed_where_there_is_none(findings):
    result = run([0.0, 600.0])
    result.scene.blocks = lambda *kinds: []
    (found,) = findings._passed(result, view(findings))
    assert found.what.startswith("critical speed that an unbalance would drive (this scene has none), within") and found.judged == ""


def test_exact_growth_is_told_with_its_time_and_when_the_threshold_was_passed(findings):
    """A mode that swings at 20 rad/s and grows by 0.4 1/s, above 40 rad/s."""
    rate, swing = 0.4, 20.0
    ratio = -rate / np.hypot(rate, swing)
    row = {"mode": 1, "direction": "forward", "frequency_rad_s": swing}
    quiet, grown = ({"damping_ratio": 0.1, "growth_rate_1_s": -2.0}, {"damping_ratio": ratio, "growth_rate_1_s": rate})
    modes = [row | {"speed_rad_s": speed} | (grown if speed > 40.0 else quiet) for speed in (0.0, 30.0, 60.0)]
    linear = findings.linear.Linear(modes=modes, critical=[], thresholds=[(40.0, "above", 1)], floquet=False)
    found = findings._stability(run([0.0, 60.0]), linear)
    assert found.judged == "bad" and "forward mode grows by e in 2.5\u00a0s at 573\u00a0rpm" in found.what
    assert found.what.endswith("it grows above 382\u00a0rpm, passed at 0.67\u00a0s")  # the first sample after 2/3 s
    assert findings._stability(run([60.0, 60.0]), linear).what.endswith("it grows above 382\u00a0rpm")
    linear.thresholds.append((50.0, "above", 2))
    assert findings._stability(run([60.0, 60.0]), linear).what.endswith("it grows above 382\u00a0rpm; another grows above 477\u00a0rpm")
    assert findings._stability(run([0.0, 30.0]), linear).judged == "good"


def test_regress_the_growth_that_is_told_is_the_fastest_of_all_modes(findings):
    """Every mode that creeps has a damping ratio of -1: the report gave the first one, of 27.5 ms, where another grows by e in 3.04 ms."""
    rates = {1: [36.4, 10.0], 2: [20.0, 329.0], 3: [-5.0, 100.0]}
    rows = [(number, speed, rate) for number, both in rates.items() for speed, rate in zip((0.0, 100.0), both, strict=True)]
    creep = {"direction": "creep", "frequency_rad_s": 0.0}
    modes = [creep | {"mode": n, "speed_rad_s": at, "growth_rate_1_s": r, "damping_ratio": -np.sign(r)} for n, at, r in rows]
    modes += [mode(mode=4, direction="axial", speed_rad_s=speed, damping_ratio=-0.5, growth_rate_1_s=50.0) for speed in (0.0, 100.0)]
    linear = findings.linear.Linear(modes=modes, critical=[], thresholds=[], floquet=False)
    found = findings._stability(run([0.0, 100.0]), linear)
    assert (found.value, found.what) == ("unstable", "creep mode grows by e in 3.04\u00a0ms at 955\u00a0rpm, without swinging")
    # Between two speeds that were looked at, and where a mode along the axis is the fastest.
    assert "grows by e in 5.73\u00a0ms at 477\u00a0rpm" in findings._stability(run([50.0, 50.0]), linear).what
    assert findings._stability(run([0.0, 0.0]), linear).what.startswith("axial mode grows by e in 20\u00a0ms at 0\u00a0rpm")


def test_regress_a_rotor_that_turns_backwards_is_told(findings):
    assert findings._backwards(run([0.0, 90.0])) is None
    assert findings._backwards(run([-90.0, -80.0])).what.endswith("(ω_φ < 0) in this run; speeds are shown by their size")
    assert "in part of this run" in findings._backwards(run([-10.0, 80.0])).what


def test_exact_a_rotor_at_rest_that_leans_far_is_told(findings):
    """On one bearing it hangs."""

    def found(at_rest, tilt):
        result = run([0.0, 60.0], **{"axis.x": np.full(101, np.cos(np.radians(tilt)))})
        result.scene.parameters = {"start.at_rest": SimpleNamespace(value=at_rest)}
        return findings._rest(result)

    assert (found("true", 90.0).value, found("true", 90.0).judged) == ("90°", "bad")
    assert found("true", 5.0) is None is found("false", 90.0)


def test_exact_contact_is_told_with_its_first_time_and_gap(findings):
    touches = np.where(np.linspace(0.0, 1.0, 101) > 0.305, 1.0, 0.0)
    found = findings._contact(run([0.0, 60.0], **{"rub[1].contact": touches}))
    assert found.what == "the shaft touches rub[1], whose gap is 10\u00a0mm, first at 0.31\u00a0s"
    assert findings._contact(run([0.0, 60.0], **{"rub[1].contact": 0.0 * touches})) is None


def test_a_verdict_of_small_motions_says_what_it_leaves_out(findings):
    modes = [mode(speed_rad_s=speed) for speed in (0.0, 90.0)]
    linear = findings.linear.Linear(modes=modes, critical=[], thresholds=[], floquet=False)
    free, touching = (findings._stability(run([0.0, 80.0]), linear, touches) for touches in (False, True))
    assert (free.judged, touching.judged) == ("good", "") and touching.what.startswith("while nothing touches, ")


def test_regress_a_verdict_of_a_rotor_with_ports_says_that_their_loads_are_held(findings):
    for ratio in (-0.1, 0.0, 0.1):
        row = mode(damping_ratio=ratio, growth_rate_1_s=-100.0 * ratio)
        linear = findings.linear.Linear(modes=[row | {"speed_rad_s": 90.0}], critical=[], thresholds=[], floquet=False)
        seen = run([80.0, 80.0])
        assert "ports" not in findings._stability(seen, linear).what
        seen.scene.blocks = lambda *kinds: ["rotor", "port[2]"]
        assert "with the loads at its ports held" in findings._stability(seen, linear).what


def test_regress_a_picture_of_modes_that_creep_denies_no_growth(findings):
    """"None of them is damped and none grows" stood below an unstable rotor."""
    from report import panels

    def caption(ratio):
        row = {"mode": 1, "direction": "creep", "frequency_rad_s": 0.0, "damping_ratio": ratio}
        modes = [row | {"speed_rad_s": speed} for speed in (0.0, 90.0)]
        linear = findings.linear.Linear(modes=modes, critical=[], thresholds=[], floquet=False)
        return panels._campbell(run([80.0, 80.0]), linear)["caption"]

    assert caption(0.0).endswith("None of them is damped and none grows.")
    assert "none grows" not in caption(-1.0) and caption(-1.0).endswith("What creeps or grows without swinging has no decrement.")


def test_exact_a_body_that_is_not_symmetric_is_unstable_where_its_revolutions_say_so(findings):
    # Growth of this size is rounding or is not: the linear view knows.
    modes = [{"speed_rad_s": speed, "growth_rate_1_s": 2e-6} for speed in (50.0, 90.0)]
    linear = findings.linear.Linear(modes=modes, critical=[], thresholds=[], floquet=True, growing=(90.0,))
    assert [findings._stability(run([speed, speed]), linear).judged for speed in (50.0, 90.0)] == ["", "bad"]


def test_exact_the_largest_deflection_is_that_of_the_run_or_else_said_to_be_a_sample(findings):
    lines = {name: np.zeros(101) for name in ("r_c.z", "axis.y", "axis.z", "gamma.y", "gamma.z")} | {"axis.x": np.ones(101)}
    seen = run([100.0, 100.0], **{"r_c.y": np.linspace(0.0, -2e-5, 101)}, **lines)
    seen.scene.blocks = lambda *kinds: []
    seen.scene.outputs, seen.scene.parameters, seen.deflections = {}, {}, ()
    (found,) = findings._motion(seen)
    assert found.value == "20\u00a0µm"
    assert found.what == "largest sample of the deflection off the x axis, static deflection included: r_c, at 1\u00a0s"
    of_run = [findings.Deflection("r_c", 20.5e-6, 0.3), findings.Deflection("probe[1]", 31.25e-6, 0.625)]
    seen.deflections = of_run
    (found,) = findings._motion(seen)
    assert found.value == "31.25\u00a0µm"
    assert found.what == "largest deflection off the x axis, static deflection included: probe[1], at 0.625\u00a0s"


def test_regress_a_rotor_that_nothing_holds_is_not_called_stable(findings):
    """It drifted by 12.6 mm under a green "stable"."""
    modes = [mode(speed_rad_s=speed) for speed in (0.0, 600.0)]
    linear = findings.linear.Linear(modes=modes, critical=[], thresholds=[], floquet=False)
    words = "nothing holds the rotor along z (any push there moves it away)"
    held = findings._stability(run([100.0, 300.0]), linear)
    assert (held.value, held.judged) == ("stable", "good")
    unheld = findings._stability(run([100.0, 300.0]), linear, unheld=words)
    assert (unheld.value, unheld.judged) == ("no mode grows", "")
    assert unheld.what.startswith("beside the directions in which nothing holds the rotor, at ")
    told = findings._unheld(words)
    assert (told.value, told.what, told.judged) == ("not held", words, "bad")
    assert findings._unheld("") is None


def tabled(findings, *crossings, tables=(("bearing[1]", 10.0, 150.0),)):
    """A linear view of a machine with a table that is known from 10 to 150 rad/s."""
    rows = [{"speed_rad_s": 200.0, "damping_ratio": 0.05, "direction": "forward", "sense": 1.0} | crossing for crossing in crossings]
    modes = [{"speed_rad_s": 600.0}]
    return findings.linear.Linear(modes=modes, critical=rows, thresholds=[], floquet=False, tables=tables)


def test_regress_a_critical_speed_beyond_a_table_is_not_judged(findings):
    view = tabled(findings, {"speed_rad_s": 100.0, "held": []}, {"held": ["bearing[1]"]})
    judged, unknown = findings._passed(run([0.0, 600.0]), view)
    assert judged.value == "955\u00a0rpm" and "API 617)" in judged.what
    assert unknown.value == "1\u202f910\u00a0rpm"
    assert unknown.what == "critical speed beyond a table: coefficients of bearing[1] are held there, so API 617 does not judge them"
    assert "where the coefficients of bearing[1] are held beyond a table" in findings._critical(view).what
    assert "held" not in findings._critical(tabled(findings, {"held": []})).what


def test_regress_a_run_that_leaves_a_table_is_told(findings):
    def told(speeds):
        return [found.what for found in findings._held(run(speeds), tabled(findings))]

    assert told([10.0, 150.0]) == told([-150.0, -20.0]) == []
    for speeds in ([0.0, 150.0], [20.0, 151.0], [-20.0, -151.0]):
        (what,) = told(speeds)
        assert what.startswith("coefficients of bearing[1], whose table is known from 95.5\u00a0rpm to 1\u202f432\u00a0rpm, are held at other speeds")


def test_regress_no_picture_is_drawn_of_a_run_up_in_which_nothing_whirls(monkeypatch):
    """0/0 stood in its decibels, of which numpy warned."""
    monkeypatch.syspath_prepend(str(project.ROOT / "xtask" / "python"))
    from report import vibration

    time = np.linspace(0.0, 1.0, 4001)
    names = [f"{name}.{c}" for name in ("r_c", "v_c", "axis", "omega") for c in "xyz"]
    table = np.zeros(len(time), dtype=[(name, float) for name in ["time", "phi", "omega_phi", *names]])
    table["time"], table["phi"], table["omega_phi"], table["axis.x"] = time, 300.0 * time**2, 600.0 * time, 1.0
    scene = SimpleNamespace(blocks=lambda *kinds: [], parameters={}, outputs={}, value=lambda name: 0.0)
    result = SimpleNamespace(columns=table, scene=scene)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert vibration.waterfall(result, None) is None
        table["r_c.y"] = 1e-5 * np.cos(table["phi"])
        table["v_c.y"] = -1e-5 * np.sin(table["phi"]) * table["omega_phi"]
        assert vibration.waterfall(result, None)["kind"] == "waterfall"


def test_exact_a_verdict_says_at_how_many_speeds_it_was_looked_at(findings):
    speeds = np.linspace(0.0, 90.0, 10)
    modes = [mode(speed_rad_s=speed) for speed in speeds]
    linear = findings.linear.Linear(modes=modes, critical=[], thresholds=[], floquet=False)
    assert findings._stability(run([0.0, 45.0]), linear).what.endswith("; looked at 5 speeds within those of the run")
    modes = [{"speed_rad_s": speed, "growth_rate_1_s": -1.0} for speed in speeds]
    linear = findings.linear.Linear(modes=modes, critical=[], thresholds=[], floquet=True)
    assert findings._stability(run([0.0, 45.0]), linear).what.endswith("; looked at 5 speeds within those of the run")
    assert findings._stability(run([45.0, 45.0]), linear).what.endswith("; looked at the speeds nearest to that of the run")
