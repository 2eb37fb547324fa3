"""What an FMU logs of a motion that grows: once for each onset along a run; and once where it diverges, or contacts are chaotic."""

import re

import numpy as np
from host import Host

# Friction inside as large as the damping outside: whirl of 20 rad/s grows above 40 rad/s.
ROTOR = {
    "support.c1": 2000.0,
    "support.d1": 40.0,
    "support.c2": 500.0,
    "support.d2": 1.0,
    "rotor.l": 0.0,
    "rotating_damping.d": 40.0,
    "start.r_c.x": 0.0,
    "start.omega.x": 0.0,
}
SWITCHES = {"effects.gravity": False, "effects.support": True, "effects.rotating_damping": True, "effects.imposed_speed": True}
SAID = re.compile(r"t = ([\d.]+) s, at ([\d.]+) rad/s, grow by a factor of e every ([\d.e+-]+) s")


def test_exact_growth_is_logged_at_each_onset_with_time_speed_and_time_constant(fmus):
    with Host(fmus["rotor"]) as host:
        host.slave.setBoolean([host.reference(name) for name in SWITCHES], list(SWITCHES.values()))
        host.start(ROTOR)
        speeds = [*range(0, 61), *range(60, 0, -1)] * 2
        for i, speed in enumerate(speeds):
            host.set({"imposed_speed.w": float(speed)})
            assert host.step(0.1 * i, 0.1) == 0
        warnings = [line for line in host.log if "unstable" in line]
        assert len(warnings) == 2, host.log
        for line, turn in zip(warnings, (0, 1), strict=True):
            t, speed, e = map(float, SAID.search(line).groups())
            assert 40.0 < speed < 50.0 and 4.0 < t - 12.2 * turn < 5.2
            exact = np.roots([5.0, 80.0, 2000.0 - 40.0j * speed]).real.max()  # m z̈ + (c + d) ż + (k − i d ω) z = 0
            assert abs(e * exact - 1.0) < 1e-3  # as it is printed


def test_regress_that_the_motion_diverges_is_logged_once(fmus):
    switches = {"effects.gravity": False, "effects.support": False, "effects.bearing[1]": True}
    start = {"rotor.m": 5.0, "rotor.l": 0.0, "bearing[1].kyy": -2e5, "bearing[1].kzz": -2e5, "start.omega.x": 0.0, "start.r_c.x": 0.0, "start.r_c.y": 1e-5}
    with Host(fmus["rotor"]) as host:
        host.slave.setBoolean([host.reference(name) for name in switches], list(switches.values()))
        host.start(start)
        for i in range(150):
            assert host.step(1e-3 * i, 1e-3) == 0
        (warning,) = (line for line in host.log if "the motion diverges" in line)
        t, deflection = map(float, re.search(r"at t = ([\d.e+-]+) s the rotor is ([\d.e+-]+) m off", warning).groups())
        # A million sizes of 0.125 m are reached at 0.12 s; it is seen where the solver's step ends.
        assert 0.119 < t < 0.14 and deflection > 0.125e6
        assert abs(deflection / (1e-5 * np.cosh(200.0 * t)) - 1.0) < 0.06, "as it is printed"
        assert host.read("r_c.y") > 1e6  # the run goes on


def test_that_contacts_are_chaotic_is_logged_once(fmus):
    """A rotor that falls in its ring off the middle bounces chaotically; one that falls straight down, far from the next bounce, does not."""
    switches = {"effects.gravity": True, "effects.support": False, "effects.rub[1]": True}
    start = {"rotor.m": 5.0, "rotor.l": 0.0, "start.omega.x": 100.0, "start.r_c.x": 0.0, "rub[1].gap": 1e-3, "rub[1].stiffness": 1e7, "rub[1].radius": 0.05, "rub[1].v0": 0.1}
    for y, stop, said in ((4e-4, 0.5, 1), (0.0, 0.05, 0)):
        with Host(fmus["rotor"]) as host:
            host.slave.setBoolean([host.reference(name) for name in switches], list(switches.values()))
            host.start(start | {"start.r_c.y": y})
            for i in range(round(stop / 1e-3)):
                assert host.step(1e-3 * i, 1e-3) == 0
            warnings = [line for line in host.log if "the contacts with the ring are chaotic" in line]
            assert len(warnings) == said, host.log
            for line in warnings:
                begins, ends = map(float, re.search(r"from t = ([\d.e-]+) s to t = ([\d.e-]+) s", line).groups())
                assert 0.012 < begins < 0.0143 and 0.1 < ends < 0.5, "it falls by a gap in 14.3 ms"


def test_regress_a_rotor_that_nothing_holds_in_a_direction_is_warned_of_once(fmus):
    """Coefficients by the names of a program whose lateral directions are x and y: it fell along z without a word."""
    bearings = {"bearing[1].position": -0.12, "bearing[2].position": 0.12}

    def said(gravity, **coefficients):
        with Host(fmus["rotor"]) as host:
            switches = {"effects.gravity": gravity, "effects.support": False, "effects.bearing[1]": True, "effects.bearing[2]": True}
            host.slave.setBoolean([host.reference(name) for name in switches], list(switches.values()))
            values = {f"bearing[{i}].{name}": value for i in (1, 2) for name, value in coefficients.items()}
            host.start(bearings | values)
            for i in range(3):
                assert host.step(1e-3 * i, 1e-3) == 0
            return [line for line in host.log if "nothing holds" in line]

    (line,) = said(True, kxx=1e6, kyy=0.8e6)
    assert "along z (a load of 49.050 N acts there) and against tilt about y (any push there" in line  # 5 kg
    (line,) = said(False, kxx=1e6, kyy=0.8e6)
    assert "along z (any push there moves it away" in line
    # Free along its axis alone is no warning.
    assert not said(True, kyy=1e6, kzz=1e6)
    assert not said(True, kxx=1e6, kyy=1e6, kzz=1e6)
