"""The FMU of the linear model that `cargo xtask state-space` writes: against its matrices, against the rotor's own FMU, and as a guest."""

import json
import math
import os
import shutil
import subprocess
import sys
from ctypes import c_double, c_uint32
from zipfile import ZipFile

import numpy as np
import pytest
from fmpy import read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from host import DISCARD, MODEL_EXCHANGE, OK, Host
from packaged import unpack
from test_state_space import SCIPY, at

ERROR = 3
SCENE = """
title = "A rotor in two bearings that is pushed at a port"
[rotor]
m = 5.0
Ja = 0.05
Jt = 0.08
[start]
omega = { x = 80.0 }
[[effects.bearing]]
position = -0.2
kxx = 2e4
cxx = 50.0
kyy = 2e4
kzz = 3e4
kyz = 4e3
kzy = -4e3
cyy = 60.0
czz = 60.0
[[effects.bearing]]
position = 0.3
kyy = 3e4
kzz = 2e4
cyy = 60.0
czz = 60.0
[[effects.port]]
position = 0.1
f = { y = 300.0, z = -400.0 }
[solver]
relative_tolerance = 1e-11
[experiment]
stop = 0.1
step = 1e-3
"""
# The motion by the exponential of the augmented matrix, states in their nominals: x, u - u0 and its rate, from a list of cases.
EXPONENTIAL = """
import json, sys
import numpy as np, scipy.linalg
case = json.load(sys.stdin)
size = np.array(case["nominals"])
a, b = (np.array(case[name]) / size[:, None] for name in "AB")
n, m = b.shape
augmented = np.zeros((n + 2 * m, n + 2 * m))
augmented[:n, :n], augmented[:n, n:n + m], augmented[n:n + m, n + m:] = a * size, b, np.eye(m)
print(json.dumps([
    (size * (scipy.linalg.expm(h * augmented) @ np.concatenate([x / size, u, rate]))[:n]).tolist()
    for h, x, u, rate in case["steps"]
]))
"""
STEP = 2e-13  # of a step, in each group of states over its largest number [1], measured 4e-14
SUM = 3e-15  # of sums of products, over the sizes of what is summed [1], measured less than 1e-15
BY_CVODE = 1e-7  # of outputs, over their range [1], measured 3e-8
SQUARE = (3.7, 4.3)  # what is left out of a push over that of half of it [1], measured 3.8 to 3.92
LEFT_OUT = 3e-5  # of a push of 20 N, over the range of each output [1], measured 9e-6
GROUPS = [slice(0, 3), slice(3, 6), slice(6, 8), slice(8, 10)]


def write(xtask, scene, folder, *words):
    """The linear FMU of a scene, unpacked, and its matrices."""
    written = xtask("state-space", scene, "--out", folder, *words)
    assert written.returncode == 0, written.stderr
    (path,) = folder.glob("*_linear.fmu")
    assert str(path) in written.stdout.splitlines()
    return unpack(path, folder / "unpacked"), at(folder)


@pytest.fixture(scope="module")
def written(xtask, tmp_path_factory):
    folder = tmp_path_factory.mktemp("linear")
    scene = folder / "pushed.toml"
    scene.write_text(SCENE, encoding="utf-8")
    return write(xtask, scene, folder)


@pytest.fixture(scope="module")
def coupled(xtask, tmp_path_factory):
    return write(xtask, "coupled", tmp_path_factory.mktemp("coupled"), "--speed", 80)


@pytest.fixture
def linear(written):
    return written[0]


@pytest.fixture
def model(written):
    return written[1]


def names(fmu, causality):
    return [name for name, variable in fmu.variables.items() if variable.causality == causality]


def unknowns(fmu):
    """Names of the states' rates and of the outputs."""
    return [name for name in names(fmu, "local") if name.startswith("der(")] + names(fmu, "output")


def knowns(fmu):
    """Names of states and inputs."""
    return [name for name in names(fmu, "local") if name.startswith("deviation.")] + names(fmu, "input")


def matrix(model):
    """A and B above C and D."""
    return np.block([[np.array(model[name]).reshape(-1, len(model[of])) for name, of in row] for row in (
        (("A", "x0"), ("B", "u0")), (("C", "x0"), ("D", "u0")),
    )])


@pytest.mark.parametrize("scene", ["coupled", "jeffcott", "rotor"])
def test_exact_fmpy_finds_no_problem(scene, xtask, tmp_path):
    """With inputs, without any, and of the general scene."""
    fmu, model = write(xtask, scene, tmp_path)
    assert validate_fmu(str(fmu.path)) == []
    assert bool(names(fmu, "input")) == (scene == "coupled")
    with Host(fmu) as host:
        host.start()
        assert host.outputs() == model["y0"]
        assert host.step(0.0, 0.1) == OK
        # It stands still.
        assert host.outputs() == model["y0"]


def test_exact_it_has_the_names_units_and_values_of_the_rotors_own(linear, model, xtask, tmp_path):
    scene, description = tmp_path / "pushed.toml", tmp_path / "modelDescription.xml"
    scene.write_text(SCENE, encoding="utf-8")
    description.write_text(xtask("describe", "--xml", scene).stdout, encoding="utf-8")
    variables = read_model_description(str(description), validate=False).modelVariables
    own = {variable.name: variable for variable in variables}
    for causality in ("input", "output"):
        assert names(linear, causality) == model[f"{causality}_names"]
        for name in names(linear, causality):
            for attribute in ("causality", "variability", "initial", "unit", "displayUnit", "description"):
                assert getattr(linear.variables[name], attribute) == getattr(own[name], attribute), name
    for name, steady in zip(model["input_names"], model["u0"]):
        assert float(linear.variables[name].start) == float(own[name].start) == steady
    # States are counted from elsewhere, so they have other names.
    assert not set(names(linear, "local")) & set(own)


def test_exact_dependencies_are_the_entries_that_are_not_zero(written):
    linear, model = written
    entries, index = matrix(model) != 0.0, {name: i for i, name in enumerate(linear.variables, 1)}
    wanted = {
        index[name]: [index[knowns(linear)[j]] for j in np.flatnonzero(row)] for name, row in zip(unknowns(linear), entries)
    }
    for kind in ("Outputs", "Derivatives", "InitialUnknowns"):
        for unknown in linear.xml.findall(f"ModelStructure/{kind}/Unknown"):
            told = [int(word) for word in unknown.get("dependencies").split()]
            assert told == wanted[int(unknown.get("index"))]
    assert len(linear.xml.findall("ModelStructure/InitialUnknowns/Unknown")) == len(wanted)
    # Forces close no loop through places and speeds.
    assert not entries[10:, 10:].any()


def test_exact_directional_derivatives_are_the_matrices(written):
    linear, model = written
    with Host(linear) as host:
        host.start()
        rows, columns = ([host.reference(name) for name in of(linear)] for of in (unknowns, knowns))
        for j, column in enumerate(columns):
            assert host.slave.getDirectionalDerivative(rows, [column], [1.0]) == matrix(model)[:, j].tolist()
        along = np.linspace(-1.0, 2.0, len(columns))
        together = host.slave.getDirectionalDerivative(rows, columns, along)
        assert_summed(together, matrix(model), along)


def assert_summed(found, factors, of, beside=0.0):
    """Asserts that these are `beside` and the products of a matrix and a vector, but for rounding."""
    difference = np.abs(np.array(found) - beside - factors @ of)
    assert np.all(difference <= SUM * (np.abs(factors) @ np.abs(of) + np.abs(beside)))


def nominals(fmu):
    with Host(fmu, MODEL_EXCHANGE) as host:
        numbers = (c_double * 10)()
        host.slave.fmi2GetNominalsOfContinuousStates(host.slave.component, numbers, 10)
        assert list(numbers) == [float(fmu.variables[name].nominal) for name in knowns(fmu)[:10]]
        return np.array(numbers)


def drawn(fmu):
    """Cases of step size, states, inputs less their steady values, and rates of inputs; at each size all have their part in the step."""
    random, sizes = np.random.default_rng(1), nominals(fmu)
    push = np.array([1.0 if ".f." in name else 0.1 for name in names(fmu, "input")])
    for h in (1e-9, 1e-5, 1e-3, 0.01, 0.1, 1.0):
        yield h, sizes * random.normal(size=10), push * random.normal(size=len(push)), push / h * random.normal(size=len(push))


@pytest.mark.parametrize("which", ["written", "coupled"])
def test_exact_steps_are_those_of_the_exponential(which, request):
    """From far below the fastest motion to many of the slowest."""
    fmu, model = request.getfixturevalue(which)
    n, cases, found, inputs, steady = 10, [], [], names(fmu, "input"), np.array(model["u0"])
    a, b, c, d = (np.array(model[name]) for name in "ABCD")
    for h, x, u, rate in drawn(fmu):
        with Host(fmu) as host:
            told = steady + u
            u = told - steady
            host.start(dict(zip(knowns(fmu), [*x, *told])))
            host.slave.setRealInputDerivatives([host.reference(name) for name in inputs], [1] * len(inputs), rate)
            outputs = [host.reference(name) for name in names(fmu, "output")]
            shown = host.slave.getRealOutputDerivatives(outputs, [1] * len(outputs))
            # dy/dt = C (A x + B u) + D du/dt
            through = np.hstack([c @ a, c @ b, d])
            assert_summed(shown, through, np.concatenate([x, u, rate]))
            assert host.step(0.0, h) == OK
            assert np.allclose(host.read(*inputs), told + h * rate, rtol=1e-15, atol=0.0)
            state = np.array(host.read(*knowns(fmu)[:n]))
            deviation = np.concatenate([state, told + h * rate - steady])
            assert_summed(host.outputs(), np.hstack([c, d]), deviation, np.array(model["y0"]))
            found.append(state)
            cases.append([part if isinstance(part, float) else part.tolist() for part in (h, x, u, rate)])
    case = {"A": model["A"], "B": model["B"], "nominals": nominals(fmu).tolist(), "steps": cases}
    run = subprocess.run([SCIPY, "-c", EXPONENTIAL], input=json.dumps(case), capture_output=True, encoding="utf-8", check=True)
    assert_states(found, json.loads(run.stdout))


def assert_states(found, exact):
    """Asserts that states of cases are these, but for rounding."""
    found, exact = np.array(found), np.array(exact)
    for group in GROUPS:
        assert np.all(np.abs(found - exact)[:, group].max(axis=1) < STEP * np.abs(exact)[:, group].max(axis=1)), group


def test_exact_many_steps_are_one(linear):
    """Of sizes that change, with an input that is linear in time: set anew each time, or sent once with its rate."""
    push, ends = "port[1].f.y", [0.001, 0.002, 0.01, 0.02, 0.021, 0.1]
    shown = []
    for every in (True, False):
        with Host(linear) as host:
            host.start()
            reference, t = host.reference(push), 0.0
            for end in ends if every else [0.1]:
                if every:
                    host.set({push: 300.0 + 1000.0 * t})
                host.slave.setRealInputDerivatives([reference], [1], [1000.0])
                assert host.step(t, end - t) == OK
                t = end
            shown.append(host.read(*knowns(linear)[:10]))
    assert_states(shown[:1], shown[1:])


def test_exact_an_input_alone_is_held(linear):
    push = "port[1].f.y"
    with Host(linear) as host:
        host.start()
        host.slave.setRealInputDerivatives([host.reference(push)], [1], [1000.0])
        host.set({push: 310.0})
        assert host.step(0.0, 0.01) == OK
        assert host.read(push) == pytest.approx(320.0)
        host.set({push: 320.0})
        assert host.step(0.01, 0.01) == OK
        assert host.read(push) == 320.0


def errors(rotor, linear, model, push):
    """Of the linear FMU against the rotor's own: each output's largest, and its range, under a step of the force."""
    shown = model["output_names"]
    steady = dict(zip(shown, model["y0"]))
    start = {f"start.{name}": steady[name] for name in ("r_c.x", "r_c.y", "r_c.z", "gamma.y", "gamma.z", "omega.x", "omega.y", "omega.z")}
    # No moment: it would have a part along an axis that leans, and change the spin.
    pushed = {"port[1].f.y": 300.0 + push, "port[1].f.z": 0.5 * push - 400.0}
    exact, found = (
        fmu.simulate(start_values=pushed | own, output=shown, fmi_type="CoSimulation", stop_time=0.1, output_interval=1e-3)
        for fmu, own in ((rotor, start), (linear, {}))
    )
    assert len(exact) == len(found) == 101
    return {name: (np.abs(found[name] - exact[name]).max(), np.ptp(exact[name])) for name in shown}


def test_exact_what_is_left_out_goes_with_the_square_of_the_push(linear, model, package):
    # Over the list of all effects, whose library is there.
    rotor = package("pushed", "general = true\n" + SCENE)
    small, large = (errors(rotor, linear, model, push) for push in (20.0, 40.0))
    moved = ["r_c.y", "r_c.z", "v_c.y", "gamma.y", "gamma.z", "omega.y", "K_c.z", "bearing[1].F.y", "port[1].r.z", "port[1].theta.y"]
    for name in moved:
        (left, span), (more, _) = small[name], large[name]
        assert SQUARE[0] < more / left < SQUARE[1], name
        assert left < LEFT_OUT * span, name


def test_exact_model_exchange_is_co_simulation(linear, model):
    """Under a step of force and moment, from beside the steady state."""
    start = {"port[1].f.y": 350.0, "port[1].m.y": 5.0, "deviation.v.x": 0.1, "deviation.gamma.y": 1e-3}
    options = {"start_values": start, "stop_time": 0.1, "output_interval": 1e-3, "output": model["output_names"]}
    exchanged = linear.simulate(fmi_type="ModelExchange", relative_tolerance=1e-10, **options)
    stepped = linear.simulate(fmi_type="CoSimulation", **options)
    assert len(exchanged) == len(stepped) == 101
    for name in model["output_names"]:
        difference = np.abs(exchanged[name] - stepped[name]).max()
        assert difference <= BY_CVODE * np.ptp(stepped[name]), name


def test_exact_a_saved_state_gives_the_same_bits(linear):
    def on(host):
        shown = []
        for n in range(5):
            host.slave.setRealInputDerivatives([host.reference("port[1].m.y")], [1], [n - 2.0])
            assert host.step(0.01 + 0.01 * n, 0.01) == OK
            shown.append(np.array(host.outputs()).tobytes())
        return shown

    with Host(linear) as host, Host(linear) as other, Host(linear, MODEL_EXCHANGE) as exchange:
        host.start({"port[1].f.y": 350.0, "deviation.v.z": 0.1})
        assert host.step(0.0, 0.01) == OK
        saved = host.slave.getFMUstate()
        written = host.slave.serializeFMUstate(saved)
        first = on(host)
        host.slave.setFMUstate(saved)
        assert on(host) == first
        # In another instance, of another phase, from bytes.
        read = other.slave.deSerializeFMUstate(written)
        other.slave.setFMUstate(read)
        assert on(other) == first
        refused(exchange, "fmi2SetFMUstate", "other type", lambda: exchange.slave.setFMUstate(saved))
        shorter, longer = written[:-1], written + b"\0"
        flipped = [written[:at] + bytes([written[at] ^ 1]) + written[at + 1:] for at in (0, 40, len(written) // 2, len(written) - 1)]
        for damaged in (shorter, longer, *flipped):
            refused(other, "fmi2DeSerializeFMUstate", "damaged", lambda: other.slave.deSerializeFMUstate(damaged))
        assert np.array(other.outputs()).tobytes() == first[-1]
        for instance, state in ((host, saved), (other, read)):
            instance.slave.freeFMUstate(state)


def refused(host, call, told, act):
    """Asserts that a call gives fmi2Error, with one line in the log that says so."""
    host.log.clear()
    with pytest.raises(FMICallException) as error:
        act()
    assert error.value.status == ERROR
    assert len(host.log) == 1 and host.log[0].startswith(f"{call}: ") and told in host.log[0], host.log


def test_exact_what_is_wrong_is_an_error_and_changes_nothing(linear):
    push, place = "port[1].f.y", "r_c.y"
    with Host(linear) as host:
        slave, component = host.slave, host.slave.component
        refused(host, "fmi2DoStep", "not legal", lambda: slave.doStep(0.0, 0.01))
        refused(host, "fmi2SetupExperiment", "no span", lambda: slave.setupExperiment(startTime=1.0, stopTime=0.0))
        refused(host, "fmi2SetupExperiment", "no span", lambda: slave.setupExperiment(startTime=math.nan))
        host.start(stopTime=0.05)
        force, there = host.reference(push), host.reference(place)
        before = host.outputs()
        one = (c_double * 1)(1.0)
        for call, told, act in (
            ("fmi2SetReal", "not finite", lambda: host.set({push: math.nan})),
            ("fmi2SetReal", "not finite", lambda: slave.setReal([force, force], [1.0, math.inf])),
            ("fmi2SetReal", place, lambda: host.set({place: 1.0})),
            ("fmi2SetReal", "deviation.r.x", lambda: host.set({"deviation.r.x": 1.0})),
            ("fmi2SetReal", "value reference 9999 (no variable)", lambda: slave.setReal([force, 9999], [1.0, 1.0])),
            ("fmi2GetReal", "no variable", lambda: slave.getReal([9999])),
            ("fmi2GetReal", "null pointer", lambda: slave.fmi2GetReal(component, None, 1, one)),
            ("fmi2GetReal", "null pointer", lambda: slave.fmi2GetReal(component, (c_uint32 * 1)(there), 1, None)),
            ("fmi2GetInteger", place, lambda: slave.getInteger([there])),
            ("fmi2SetBoolean", push, lambda: slave.setBoolean([force], [True])),
            ("fmi2SetRealInputDerivatives", "order 2", lambda: slave.setRealInputDerivatives([force], [2], [1.0])),
            ("fmi2SetRealInputDerivatives", "not finite", lambda: slave.setRealInputDerivatives([force], [1], [math.inf])),
            ("fmi2SetRealInputDerivatives", place, lambda: slave.setRealInputDerivatives([there], [1], [1.0])),
            ("fmi2GetRealOutputDerivatives", push, lambda: slave.getRealOutputDerivatives([force], [1])),
            ("fmi2GetDirectionalDerivative", push, lambda: slave.getDirectionalDerivative([force], [force], [1.0])),
            ("fmi2GetDirectionalDerivative", place, lambda: slave.getDirectionalDerivative([there], [there], [1.0])),
            ("fmi2GetFMUstate", "null pointer", lambda: slave.fmi2GetFMUstate(component, None)),
            ("fmi2SetFMUstate", "null pointer", lambda: slave.fmi2SetFMUstate(component, None)),
            ("fmi2DoStep", "must be a finite number > 0", lambda: slave.doStep(0.0, 0.0)),
            ("fmi2DoStep", "must be a finite number > 0", lambda: slave.doStep(0.0, -0.01)),
            ("fmi2DoStep", "must be a finite number > 0", lambda: slave.doStep(0.0, math.nan)),
            ("fmi2DoStep", "must be a finite number > 0", lambda: slave.doStep(0.0, math.inf)),
            ("fmi2DoStep", "where the last one ended", lambda: slave.doStep(0.01, 0.01)),
            ("fmi2DoStep", "past the stop time", lambda: slave.doStep(0.0, 0.06)),
            ("fmi2CancelStep", "asynchronous", lambda: slave.cancelStep()),
            ("fmi2GetIntegerStatus", "no status", lambda: slave.getIntegerStatus(0)),
            ("fmi2EnterInitializationMode", "not legal", lambda: slave.enterInitializationMode()),
        ):
            refused(host, call, told, act)
        assert host.outputs() == before
        assert host.read(push) == 300.0
        assert host.step(0.0, 0.05) == OK
        refused(host, "fmi2DoStep", "past the stop time", lambda: slave.doStep(0.05, 0.01))
    with Host(linear, MODEL_EXCHANGE) as host:
        host.start()
        refused(host, "fmi2SetContinuousStates", "not legal", lambda: host.set_states([0.0] * 10))
        host.slave.enterContinuousTimeMode()
        refused(host, "fmi2SetContinuousStates", "not finite", lambda: host.set_states([math.nan] * 10))
        refused(host, "fmi2SetContinuousStates", "10 states, not 9", lambda: host.set_states([0.0] * 9))
        refused(host, "fmi2SetTime", "not finite", lambda: host.slave.setTime(math.inf))
        assert host.states() == [0.0] * 10


def test_exact_a_wrong_guid_gives_null(linear):
    log = []
    host = Host(linear, guid="{00000000-0000-0000-0000-000000000000}", log=log)
    assert not host.slave.component
    assert log == [f"fmi2Instantiate: the GUID must be {linear.description.guid}"]


def test_exact_a_step_that_overflows_is_discarded(linear):
    """No model is unstable enough; states near the largest number are."""
    with Host(linear) as host:
        host.start({"deviation.r.y": 1.7e308})
        before = host.read("deviation.r.y", "deviation.v.y")
        host.log.clear()
        assert host.step(0.0, 0.01) == DISCARD
        assert len(host.log) == 1 and host.log[0].startswith("fmi2DoStep: number "), host.log
        assert host.slave.getBooleanStatus(3) and host.slave.getRealStatus(2) == 0.0
        assert host.read("deviation.r.y", "deviation.v.y") == before


def test_exact_reset_forgets(linear, model):
    with Host(linear) as host:
        host.start({"deviation.r.y": 1e-3, "port[1].f.y": 0.0})
        assert host.step(0.0, 0.01) == OK
        host.slave.terminate()
        refused(host, "fmi2DoStep", "not legal", lambda: host.slave.doStep(0.01, 0.01))
        host.slave.reset()
        host.start()
        assert host.outputs() == model["y0"]


def test_exact_it_is_written_alike_each_time_and_another_at_another_speed(coupled, xtask, tmp_path):
    first = coupled[0]
    again, _ = write(xtask, "coupled", tmp_path, "--speed", 80)
    assert again.path.read_bytes() == first.path.read_bytes()
    shutil.rmtree(tmp_path)
    other, _ = write(xtask, "coupled", tmp_path, "--speed", 81)
    assert other.description.guid != first.description.guid


def test_exact_without_a_compiler_the_rest_is_written(xtask, tmp_path, monkeypatch):
    monkeypatch.setenv("CC", "no-such-compiler")
    written = xtask("state-space", "coupled", "--out", tmp_path)
    assert written.returncode == 0, written.stderr
    fmu = tmp_path / "coupled_linear.fmu"
    told = f"{fmu} holds its sources, but no library: `no-such-compiler` is needed (Debian: apt-get install gcc)\n"
    assert written.stderr == told
    assert (tmp_path / "state_space.mat").is_file() and (tmp_path / "state_space.json").is_file()
    with ZipFile(fmu) as archive:
        assert [name for name in archive.namelist() if name.startswith("binaries")] == []
        assert "sources/linear.c" in archive.namelist()


def cc(*words):
    return subprocess.run([os.environ.get("CC", "cc"), *map(str, words)], capture_output=True, encoding="utf-8", check=False)


@pytest.mark.skipif(sys.platform != "linux", reason="the linker's options are GNU's")
def test_exact_the_sources_are_c99_and_ask_for_the_c_library_only(linear, coupled, tmp_path):
    strict = ["-std=c99", "-O2", "-fPIC", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror"]
    objects = []
    for fmu in (linear, coupled[0]):
        source = fmu.directory / "sources/linear.c"
        objects.append(tmp_path / f"{fmu.description.coSimulation.modelIdentifier}.o")
        made = cc(*strict, "-c", source, "-o", objects[-1])
        assert made.returncode == 0, made.stderr
    # Two models in one program, each under its own name, and nothing else.
    made = cc("-shared", *objects, "-Wl,-z,defs", "-o", tmp_path / "both.so")
    assert made.returncode == 0, made.stderr
    packaged = exported(linear.directory / "binaries/linux64/pushed_linear.so")
    assert len(packaged) == 44 and all(name.startswith("fmi2") for name in packaged)
    both = {f"{model}_linear_{name}" for model in ("pushed", "coupled") for name in packaged}
    assert exported(tmp_path / "both.so") == both
    # As CMake compiles a library of the sources.
    source, library = linear.directory / "sources/linear.c", tmp_path / "plain.so"
    made = cc(*strict, "-shared", "-Dpushed_linear_EXPORTS", source, "-o", library)
    assert made.returncode == 0, made.stderr
    assert exported(library) == packaged


# Counts what is allocated in steps of two sizes and in reading an output.
ALLOCATIONS = """
#include "fmi2.h"
#include "matrices.h"
#include <stdio.h>
#define DECLARE(result, name, arguments) result fmi2##name arguments;
FMI2_FUNCTIONS(DECLARE)
static int count;
void *__real_malloc(size_t), *__real_calloc(size_t, size_t);
void *__wrap_malloc(size_t size) { count++; return __real_malloc(size); }
void *__wrap_calloc(size_t n, size_t size) { count++; return __real_calloc(n, size); }
int main(void)
{
    fmi2CallbackFunctions callbacks = {0};
    fmi2Component one = fmi2Instantiate("one", fmi2CoSimulation, GUID, NULL, &callbacks, 0, 0);
    fmi2ValueReference last = COLUMNS + ROWS - 1;
    fmi2Real value;
    int before = count;
    fmi2EnterInitializationMode(one);
    fmi2ExitInitializationMode(one);
    int wrong = fmi2DoStep(one, 0.0, 0.1, 1) | fmi2DoStep(one, 0.1, 0.2, 1) | fmi2GetReal(one, &last, 1, &value);
    printf("%d %d %d", before, count - before, wrong);
    return 0;
}
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the linker's options are GNU's")
def test_exact_a_step_allocates_nothing(linear, tmp_path):
    host, program, sources = tmp_path / "host.c", tmp_path / "host", linear.directory / "sources"
    host.write_text(ALLOCATIONS, encoding="utf-8")
    wrapped = ["-Wl,--wrap=malloc,--wrap=calloc", "-DFMI2_OVERRIDE_FUNCTION_PREFIX="]
    made = cc("-std=c99", "-I", sources, *wrapped, host, sources / "linear.c", "-o", program)
    assert made.returncode == 0, made.stderr
    counted = subprocess.run([program], capture_output=True, encoding="utf-8", check=True)
    assert counted.stdout == "1 0 0"


def exported(library):
    """What a shared library offers."""
    listed = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, encoding="utf-8", check=True)
    return {line.split()[-1] for line in listed.stdout.splitlines()}
