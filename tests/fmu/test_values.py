"""The values of a scene in the library of its effects: any number may be changed without compiling, and nothing else passes for them."""

import shutil

import project
import pytest
from fmpy.simulation import instantiate_fmu
from packaged import MARK

PAPER = (project.ROOT / "scenes" / "paper.toml").read_text(encoding="utf-8")


@pytest.fixture
def refusal(paper, tmp_path):
    """What is logged where the paper's FMU with this library is not instantiated."""
    folder = shutil.copytree(paper.directory, tmp_path / "spoilt")
    library = folder / paper.library.relative_to(paper.directory)

    def of(data):
        library.unlink(missing_ok=True)  # one that is loaded keeps its file
        library.write_bytes(data)
        log = []
        logger = lambda _environment, _instance, _status, _category, message: log.append(message.decode())
        with pytest.raises(Exception, match="Failed to instantiate"):
            instantiate_fmu(str(folder), paper.description, "CoSimulation", logger=logger)
        return log

    return of


def test_exact_there_is_one_section(fmu):
    assert fmu.library.read_bytes().count(MARK) == 1


def test_a_damaged_section_is_refused(paper, refusal):
    """In the room, the GUID, a start value, and in the last byte."""
    whole = paper.library.read_bytes()
    start = whole.index(MARK)
    room = int.from_bytes(whole[start + 24 : start + 28], "little")
    assert room == sum(variable.start is not None for variable in paper.description.modelVariables)
    for place in (24, 40, 100, 70 + 12 * room - 1):
        data = bytearray(whole)
        data[start + place] ^= 1
        assert refusal(bytes(data)) == [
            "fmi2Instantiate: the values of the scene in this library are damaged: their checksum is wrong"
        ]


def test_a_section_that_was_never_written_is_refused(paper, refusal):
    assert refusal(paper.kept.read_bytes()) == [
        "fmi2Instantiate: no values of a scene were written into this library: `cargo xtask package` does that"
    ]


def test_exact_a_changed_number_compiles_nothing_and_is_the_parameter(paper, package):
    kept = {path: path.stat().st_mtime_ns for path in project.KEPT.iterdir()}
    softer = package("softer", PAPER.replace("c1 = 2000.0", "c1 = 1900.0"))
    assert {path: path.stat().st_mtime_ns for path in project.KEPT.iterdir()} == kept
    own = softer.simulate(stop_time=1.0)
    assert (own == paper.simulate(stop_time=1.0, start_values={"support.c1": 1900.0})).all()
    assert (own != paper.simulate(stop_time=1.0)).any()
