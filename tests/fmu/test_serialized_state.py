"""An FMU state as bytes, read in another process: what follows has the same bits."""

import json
import struct
import subprocess
import sys
from pathlib import Path

import project
import pytest
from fmpy.fmi1 import FMICallException
from host import CO_SIMULATION, ERROR, MODEL_EXCHANGE, OK

STEP = 0.013  # [s]
SHORT = 0.003  # [s], of Euler's method
FROM, TO = 7, 27
KINDS = {"co-simulation": CO_SIMULATION, "model exchange": MODEL_EXCHANGE}


def go_on(host, first, last):
    """All Real variables after each step, as bits."""
    names = [name for name, v in host.variables.items() if v.type == "Real"]
    shown = []
    for i in range(first, last):
        if host.kind == CO_SIMULATION:
            assert host.step(i * STEP, STEP) == OK
        else:
            explicit_euler(host, i * SHORT)
        shown.append(struct.pack(f"<{len(names)}d", *host.read(*names)).hex())
    return shown


def explicit_euler(host, time):
    """Coarse, but the same everywhere."""
    states = [x + SHORT * rate for x, rate in zip(host.states(), host.rates())]
    host.slave.setTime(time + SHORT)
    host.set_states(states)
    if host.slave.completedIntegratorStep()[0]:
        host.slave.enterEventMode()
        host.slave.newDiscreteStates()
        host.slave.enterContinuousTimeMode()


def can_go_on(fmu, kind):
    """Euler's method is for gentle scenes."""
    return kind == CO_SIMULATION or fmu.scene in project.GENTLE


def begin(fmu, kind):
    """Under way; the free rotors start far from e."""
    held = "support.c2" in fmu.variables or "bearing[1].kyy" in fmu.variables
    start = {} if held else {"start.gamma.z": 1.5}
    host = fmu.host(kind=kind).start(start)
    if kind == MODEL_EXCHANGE:
        host.slave.enterContinuousTimeMode()
    return host


@pytest.fixture(params=KINDS)
def kind(request):
    return KINDS[request.param]


def serialized(host):
    saved = host.slave.getFMUState()
    written = host.slave.serializeFMUState(saved)
    host.slave.freeFMUState(saved)
    return written


def test_exact_another_process_goes_on_with_the_same_bits(fmu, kind, tmp_path):
    if not can_go_on(fmu, kind):
        return
    with begin(fmu, kind) as host:
        go_on(host, 0, FROM)
        (tmp_path / "state").write_bytes(serialized(host))
        chart = host.slave.getInteger([host.reference("state.chart")])
        expected = go_on(host, FROM, TO)
        if (fmu.scene, kind) == ("tumbling", MODEL_EXCHANGE):
            assert host.slave.getInteger([host.reference("state.chart")]) != chart, "through an event"
    words = [sys.executable, __file__, fmu.path, tmp_path, str(kind)]
    done = subprocess.run(words, capture_output=True, encoding="utf-8", check=False)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == expected


def in_another_process(path, folder, kind):
    """Reads the state, and goes on from it."""
    from conftest import unpack

    fmu = unpack(Path(path), Path(folder) / "unpacked")
    # An instance that was never started: the state brings its own life with it.
    with fmu.host(kind=kind) as host:
        state = host.slave.deserializeFMUState((Path(folder) / "state").read_bytes())
        host.slave.setFMUState(state)
        print(json.dumps(go_on(host, FROM, TO)))
        host.slave.freeFMUState(state)


def test_exact_bytes_come_back_as_they_were(fmu, kind):
    if not can_go_on(fmu, kind):
        return
    with begin(fmu, kind) as host:
        go_on(host, 0, FROM)
        written = serialized(host)
        state = host.slave.deserializeFMUState(written)
        assert host.slave.serializeFMUState(state) == written
        host.slave.freeFMUState(state)


def refusal(host, written):
    """What the host is told of bytes that it must not take."""
    with pytest.raises(FMICallException) as refused:
        host.slave.deserializeFMUState(written)
    assert refused.value.status == ERROR
    return host.log[-1].text.removeprefix("fmi2DeSerializeFMUstate: ")


DAMAGED = "the serialized FMU state is damaged: its checksum or its length is wrong, or its numbers mean nothing"


def test_exact_damaged_bytes_are_refused(paper):
    with begin(paper, CO_SIMULATION) as host:
        go_on(host, 0, FROM)
        written, before = serialized(host), host.outputs()
        for at in range(0, len(written), 7):
            flipped = bytearray(written)
            flipped[at] ^= 0x10
            refusal(host, bytes(flipped))
        for length in (0, 1, 8, 20, 60, len(written) - 8, len(written) - 1):
            refusal(host, written[:length])
        assert refusal(host, written + b"\0") == DAMAGED
        assert refusal(host, written[:-1] + bytes([written[-1] ^ 1])) == DAMAGED
        assert host.outputs() == before
        assert host.step(FROM * STEP, STEP) == OK


def test_exact_bytes_of_another_scene_or_kind_are_refused(fmus):
    paper, driven = fmus["paper"], fmus["driven"]
    with begin(paper, CO_SIMULATION) as host, begin(driven, CO_SIMULATION) as other:
        assert refusal(host, serialized(other)) == (
            f"the serialized FMU state is one of {driven.description.guid}, another FMU: this one is {paper.description.guid}"
        )
    with begin(paper, CO_SIMULATION) as host, begin(paper, MODEL_EXCHANGE) as other:
        assert refusal(host, serialized(other)) == (
            "the FMU state comes from an instance for model exchange, and this one is for co-simulation"
        )


def test_exact_an_input_travels_with_the_state(fmus):
    """Its slope too."""
    with begin(fmus["driven"], CO_SIMULATION) as host, begin(fmus["driven"], CO_SIMULATION) as other:
        tau = [host.reference("drive.tau")]
        host.slave.setReal(tau, [1.0])
        host.slave.setRealInputDerivatives(tau, [1], [5.0])
        go_on(host, 0, FROM)
        other.slave.setFMUState(other.slave.deserializeFMUState(serialized(host)))
        assert other.read("drive.tau") == host.read("drive.tau") > 1.4
        assert go_on(host, FROM, TO) == go_on(other, FROM, TO)


if __name__ == "__main__":
    in_another_process(sys.argv[1], sys.argv[2], int(sys.argv[3]))
