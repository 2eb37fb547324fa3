"""The packaged FMUs give the bits that tests/bits.rs computes from the library: tests/golden/bits.csv."""

import csv
import re
import struct

import project
import pytest
from host import OK

# Communication points lie this far apart [s], exact in binary.
STEP = 1 / 64
STEPS = 128

# The number of each method in the enumeration SolverMethod.
METHODS = {"auto": 1, "dopri5": 2, "dop853": 3, "symplectic": 4, "stiff": 5, "taylor": 6}


def golden():
    """scene, method and hash of each trajectory."""
    lines = (project.ROOT / "tests" / "golden" / "bits.csv").read_text(encoding="utf-8").splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return [(row["scene"], row["method"], row["hash"]) for row in rows]


def fnv_1a(data, value=0xCBF29CE484222325):
    """FNV-1a, 64 bits."""
    for byte in data:
        value = ((value ^ byte) * 0x100000001B3) & 0xFFFFFFFFFFFFFFFF
    return value


def test_hash_is_fnv_1a():
    """A vector of Fowler, Noll and Vo's."""
    assert fnv_1a(b"foobar") == 0x85944171F73967E8


def is_of(name, effects):
    """Whether the library of these effects has a variable of this name too: that of every effect shows the states of the others, and the
    work of loads where there are none.
    """
    if re.search(r"\bstate\.(supplied|dissipated)\b", name):
        return bool(effects - {"asymmetry"})
    found = re.search(r"(\w+)(\[\d\])?\.state\.", name)
    return found is None or found[1] in effects


@pytest.mark.parametrize("scene, method, expected", golden())
def test_golden_bits_of_packaged_fmu(fmus, scene, method, expected):
    """All Real variables of the scene's effects in the order of value references, at t = 0, 1/64, … 2 s."""
    effects = project.effects(scene)
    with fmus[scene].host() as host:
        reals = [v for v in host.variables.values() if v.type == "Real"]
        reals = sorted(v.valueReference for v in reals if is_of(v.name, effects))
        host.set_method(METHODS[method])
        host.start()
        values = host.slave.getReal(reals)
        for i in range(STEPS):
            assert host.step(i * STEP, STEP) == OK
            values += host.slave.getReal(reals)
    assert len(values) == (STEPS + 1) * len(reals)
    assert f"{fnv_1a(struct.pack(f'<{len(values)}d', *values)):016x}" == expected
