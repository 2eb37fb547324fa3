"""Values that cannot be, and calls that set or read what they must not."""

import math

import pytest
from host import OK


@pytest.fixture
def host(paper):
    with paper.host() as host:
        yield host


@pytest.mark.parametrize(
    "values, reason",
    [
        ({"rotor.m": 0.0}, "rotor.m = 0.0 is not possible: it must be a finite number > 0"),
        ({"rotor.m": -5.0}, "rotor.m = -5.0 is not possible: it must be a finite number > 0"),
        ({"rotor.m": math.inf}, "rotor.m = inf is not possible: it must be a finite number > 0"),
        ({"rotor.Jt": -0.1}, "rotor.Jt = -0.1 is not possible: it must be a finite number > 0"),
        ({"rotor.Ja": 0.2}, "rotor.Ja = 0.2 is not possible: it must be at most 2 rotor.Jt = 0.15625 "
                            "(a thin disk has Ja = 2 Jt)"),
        ({"rotor.l": math.nan}, "rotor.l = NaN is not possible: it must be a finite number"),
        ({"start.gamma.y": -3.2}, "|start.gamma| = 3.2 is not possible: it must be at most pi = 3.141592653589793"),
        ({"start.gamma.y": 3.0, "start.gamma.z": 4.0},
         "|start.gamma| = 5.0 is not possible: it must be at most pi = 3.141592653589793"),
        ({"start.gamma.z": math.nan}, "start.gamma.z = NaN is not possible: it must be a finite number"),
        ({"start.omega.x": -math.inf}, "start.omega.x = -inf is not possible: it must be a finite number"),
        ({"support.c1": -1.0}, "support.c1 = -1.0 is not possible: it must be a finite number >= 0"),
        ({"support.d2": -1.0}, "support.d2 = -1.0 is not possible: it must be a finite number >= 0"),
        ({"gravity.g.z": math.nan}, "gravity.g.z = NaN is not possible: it must be a finite number"),
        ({"solver.relative_tolerance": 0.0},
         "solver.relative_tolerance = 0.0 is not possible: it must be a number from 1e-14 to 0.1"),
        ({"solver.absolute_tolerance": -1.0},
         "solver.absolute_tolerance = -1.0 is not possible: it must be 0 or a number from 1e-20 to 0.01"),
        ({"solver.absolute_tolerance": 100.0},
         "solver.absolute_tolerance = 100.0 is not possible: it must be 0 or a number from 1e-20 to 0.01"),
        ({"solver.max_evaluations": 10.0},
         "solver.max_evaluations = 10.0 is not possible: it must be a number from 1000.0 to 1000000000000.0"),
    ],
    ids=lambda given: next(iter(given)) if isinstance(given, dict) else "",
)
def test_exact_an_impossible_parameter_is_named(host, values, reason):
    right = dict(zip(values, [host.read(name) for name in values]))
    host.set(values)
    host.slave.enterInitializationMode()
    assert host.refused("exitInitializationMode") == f"fmi2ExitInitializationMode: {reason}"
    # The instance is as it was: with the value corrected it goes on.
    host.set(right)
    assert host.status("exitInitializationMode") == OK
    host.run([0.0, 0.1])


def test_exact_the_limits_themselves_are_possible(host):
    host.set({"rotor.Ja": 2.0 * 0.078125, "start.gamma.y": 3.0, "support.c1": 0.0, "support.c2": 0.0})
    host.slave.enterInitializationMode()
    assert host.status("exitInitializationMode") == OK


@pytest.mark.parametrize(
    "call, arguments, reason",
    [
        ("getReal", ([99999],), "fmi2GetReal: there is no variable with value reference 99999: "
                                "modelDescription.xml lists them"),
        ("getReal", ([255],), "fmi2GetReal: there is no variable with value reference 255: "
                              "modelDescription.xml lists them"),
        ("setReal", ([2**32 - 1], [1.0]), "fmi2SetReal: there is no variable with value reference 4294967295: "
                                          "modelDescription.xml lists them"),
        ("getInteger", (["r_c.x"],), "fmi2GetInteger: r_c.x (value reference 768) is of type Real, not Integer"),
        ("getReal", (["solver.method"],),
         "fmi2GetReal: solver.method (value reference 512) is of type Integer, not Real"),
        ("setReal", (["solver.method"], [3.0]),
         "fmi2SetReal: solver.method (value reference 512) is of type Integer, not Real"),
        ("setInteger", (["rotor.m"], [5]), "fmi2SetInteger: rotor.m (value reference 0) is of type Real, not Integer"),
        ("getBoolean", (["rotor.m"],), "fmi2GetBoolean: rotor.m (value reference 0) is of type Real, not Boolean"),
        ("setBoolean", (["rotor.m"], [True]),
         "fmi2SetBoolean: rotor.m (value reference 0) is of type Real, not Boolean"),
        ("getString", (["rotor.m"],), "fmi2GetString: rotor.m (value reference 0) is of type Real, not String"),
        ("setReal", (["r_c.x"], [0.0]), "fmi2SetReal: r_c.x (value reference 768) is an output: only parameters and inputs can be set"),
        ("setReal", (["support.F.x"], [0.0]), "fmi2SetReal: support.F.x (value reference 5124) is an output: only parameters and inputs can be set"),
        ("getInteger", (["support.c1"],),
         "fmi2GetInteger: support.c1 (value reference 5120) is of type Real, not Integer"),
    ],
)
def test_exact_a_wrong_reference_is_refused(host, call, arguments, reason):
    numbers = [host.reference(r) if isinstance(r, str) else r for r in arguments[0]]
    before = host.outputs()
    assert host.refused(call, numbers, *arguments[1:]) == reason
    assert host.outputs() == before


def test_exact_one_wrong_reference_leaves_all_values(host):
    references = [host.reference("rotor.m"), host.reference("r_c.x")]
    host.refused("setReal", references, [6.0, 1.0])
    assert host.read("rotor.m") == 5.0


@pytest.mark.parametrize(
    "call, name, value, reason",
    [
        ("setReal", "rotor.m", 6.0,
         'fmi2SetReal: rotor.m (value reference 0) is a fixed parameter, not to be set in the state "step complete": set '
         "it before fmi2ExitInitializationMode, or call fmi2Reset first"),
        ("setInteger", "solver.method", 2,
         'fmi2SetInteger: not legal in the state "step complete": no input is of this type, and parameters are set before '
         "fmi2ExitInitializationMode: call fmi2Reset first"),
    ],
)
def test_exact_parameters_are_fixed_after_initialization(host, call, name, value, reason):
    host.start()
    assert host.refused(call, [host.reference(name)], [value]) == reason
    assert host.slave.getInteger([host.reference("solver.method")]) == [3]
    assert host.read("rotor.m") == 5.0
