"""Third-party clients run the packaged FMU for a whole run, and every call is recorded: what they were given is what
the library gives to the same calls made directly, and their motions agree with one another."""

import struct
import sys

import pytest
import recording
from recording import Place
from replay import first_difference, messages

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="recorder.c is written for POSIX")

SCENES = ["paper", "driven", "coupled"]
"""Two of them have inputs, which begin with other values than 0."""
OTHERS = [pytest.param(client, marks=pytest.mark.long) for client in ("libcosimpy", "ecospy", "cofmpy")]

CLOCKS = 1e-12  # [s], measured 1.8e-15 (libcosimpy) and 1.7e-13 (ecospy and cofmpy, which add up steps)
MOTIONS = 1e-9  # of the nominal, measured 1.0e-12 and 1.0e-10: support.F.z, whose rate is 600 N/s, at these two clocks


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("client", ["fmpy", *OTHERS])
def test_exact_the_same_calls_give_the_same_bits(record, packaged, client, scene):
    assert first_difference(record(client, scene, packaged(scene).inputs), packaged(scene).library) is None


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("client", ["fmpy", *OTHERS])
def test_fmi_the_client_reads_everything_to_the_end_and_nothing_is_refused(record, packaged, client, scene):
    fmu, calls = packaged(scene), record(client, scene, packaged(scene).inputs)
    assert [call for call in calls if not call.accepted] == []
    points = recording.trajectory(calls)
    assert len(points) >= round(fmu.stop / fmu.step)
    assert points[-1][0] >= fmu.stop - CLOCKS
    outputs = {variable.valueReference for variable in fmu.outputs}
    assert [time for time, values in points if not outputs <= set(values)] == []


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("client", OTHERS)
def test_fmi_the_motion_is_that_of_fmpy(record, packaged, client, scene):
    """What the motion cost is left out, and so are turns and angle: together they are phi, apart they jump."""
    inputs = packaged(scene).inputs
    compared = [v for v in packaged(scene).outputs if not v.name.startswith(("solver.", "turns", "angle"))]
    here, there = (recording.trajectory(record(one, scene, inputs)) for one in ("fmpy", client))
    pairs = list(zip(here, there))
    assert max(abs(time - other) for (time, _), (other, _) in pairs) <= CLOCKS
    apart = {
        v.name: max(abs(here[v.valueReference] - there[v.valueReference]) for (_, here), (_, there) in pairs)
        / float(v.nominal or 1.0)
        for v in compared
    }
    assert max(apart.values()) <= MOTIONS, apart


ZEROS = "all inputs are 0, and the scene begins with drive.tau = 0.5"


@pytest.mark.long
def test_fmi_zeros_that_a_client_sends_unasked_are_warned_of_once(record, packaged):
    """CoFMPy sends 0 to an input that nobody connected, and so simulates another problem."""
    fmu = packaged("driven")
    (tau,) = (v.valueReference for v in fmu.description.modelVariables if v.causality == "input")
    unasked = record("cofmpy", "driven")
    sent = [call.arguments[1:] for call in unasked if call.function == "fmi2SetReal"]
    assert sent and all(one == [[tau], 1, [0.0]] for one in sent)
    assert sum(ZEROS in message for message in messages(unasked, fmu.library)) == 1
    for asked in (record("cofmpy", "driven", fmu.inputs), record("fmpy", "driven")):
        assert not any(ZEROS in message for message in messages(asked, fmu.library))


@pytest.mark.long
def test_fmi_a_client_that_sets_no_enumeration_sets_the_number_of_the_method(record, packaged):
    """libcosim has no enumerations."""
    fmu, dopri5 = packaged("paper"), 2
    reference = {v.name: v.valueReference for v in fmu.description.modelVariables}
    calls = record("libcosimpy", "paper", (("solver.method_number", dopri5),))
    given = [(call.accepted, call.arguments[1:]) for call in calls if call.function == "fmi2SetInteger"]
    assert given and all(one == (True, [[reference["solver.method_number"]], 1, [dopri5]]) for one in given)
    steps = lambda calls: recording.trajectory(calls)[-1][1][reference["solver.steps"]]
    by_name = record("fmpy", "paper", (("solver.method", dopri5),))
    assert steps(calls) == steps(by_name) != steps(record("fmpy", "paper"))


def flipped(number):
    """The next number but for the sign: the lowest bit of its digits is the other one."""
    (bits,) = struct.unpack("<q", struct.pack("<d", number))
    return struct.unpack("<d", struct.pack("<q", bits ^ 1))[0]


def a_longer_step(call):
    instance, start, step, rest = call.arguments
    return call._replace(arguments=[instance, start, flipped(step), rest])


def another_value(call):
    *given, place = call.arguments
    return call._replace(arguments=[*given, Place(None, [*place.after[:-1], flipped(place.after[-1])])])


@pytest.mark.parametrize(
    "function, mutate",
    [
        ("fmi2DoStep", a_longer_step),
        ("fmi2GetReal", another_value),
        ("fmi2DoStep", lambda call: call._replace(returned=recording.WARNING)),
    ],
)
def test_exact_one_flipped_bit_is_seen(record, packaged, function, mutate):
    calls = list(record("fmpy", "paper"))
    where = next(i for i, call in enumerate(calls) if call.function == function)
    calls[where] = mutate(calls[where])
    line, _recorded, _again = first_difference(calls, packaged("paper").library)
    # A step shows itself in what is read after it.
    assert line - 1 in (where, where + 1)
