"""recorder.c passes on what it is given, and writes what it passed on: one recorder stands in front of another, which
stands in front of the FMU's library. Each writes a line of every call, so a recording has each line twice."""

import shutil
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
import recording
from fmpy.fmi2 import FMU2Model, FMU2Slave
from recorded import VARIABLE, neighbour
from recording import Place
from replay import Replay, first_difference

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="recorder.c is written for POSIX")

EVERY_CALL = Path(__file__).with_name("every_call.txt")
"""What a host gives to each of the functions, null pointers too; of what it gets, no more than the form."""
THREADS = 8
READINGS = 300


@pytest.fixture
def front(recorder, packaged, tmp_path):
    """Makes so many recorders, one in front of the other, the last in front of the library of paper."""

    def make(recorders):
        libraries = [tmp_path / "rotor.so"]
        while len(libraries) <= recorders:
            libraries.append(neighbour(libraries[-1]))
        for library in libraries[:-1]:
            shutil.copy(recorder, library)
        shutil.copy(packaged("paper").library, libraries[-1])
        return libraries[0]

    return make


@pytest.fixture
def file(tmp_path, monkeypatch):
    """Where the recorders write."""
    file = tmp_path / "recording.txt"
    monkeypatch.setenv(VARIABLE, str(file))
    return file


def given(call):
    return [a.before if isinstance(a, Place) else a for a in call.arguments]


def test_exact_every_call_is_passed_on_and_written(packaged, front, file):
    guid = packaged("paper").description.guid
    wanted = recording.calls(EVERY_CALL.read_text(encoding="ascii").replace("GUID", guid))
    functions = {name for kind in (FMU2Slave, FMU2Model) for name in dir(kind) if name.startswith("fmi2")}
    assert {call.function for call in wanted} == functions
    replay = Replay(front(recorders=2))
    got = [replay.call(call) for call in wanted]
    lines = file.read_text(encoding="ascii").splitlines()
    assert lines[0::2] == lines[1::2]
    written = [recording.call(line) for line in lines[0::2]]
    assert [call.function for call in written] == [call.function for call in wanted]
    assert repr([given(call) for call in written]) == repr([given(call) for call in wanted])
    assert repr([call.result for call in written]) == repr([call.result for call in got])
    assert any(call.accepted for call in written) and not all(call.accepted for call in written)


def test_exact_lines_of_many_threads_stay_whole(packaged, front, file):
    """Each thread runs an instance of its own; the calls of all of them give the same bits one after another."""
    guid = packaged("paper").description.guid
    replay = Replay(front(recorders=1))

    def run(number):
        text = f"""
            fmi2Instantiate "rotor%20{number}" 1 "{guid}" null callbacks 0 0 -> #{number}
            fmi2SetupExperiment #{number} 0 0x0p+0 0x0p+0 0 0x0p+0 -> 0
            fmi2EnterInitializationMode #{number} -> 0
            fmi2ExitInitializationMode #{number} -> 0
        """
        for i in range(READINGS):
            time = (i / 64).hex()
            text += f"fmi2DoStep #{number} {time} 0x1p-6 1 -> 0\n"
            text += f"fmi2GetReal #{number} [768,774,779] 3 =[0x0p+0,0x0p+0,0x0p+0] -> 0\n"
        for call in recording.calls(text.strip()):
            replay.call(call)

    with ThreadPoolExecutor(THREADS) as threads:
        list(threads.map(run, range(1, THREADS + 1)))
    calls = recording.calls(file.read_text(encoding="ascii"))
    assert len(calls) == THREADS * (4 + 2 * READINGS)
    assert all(call.accepted for call in calls)
    assert first_difference(calls, packaged("paper").library) is None
