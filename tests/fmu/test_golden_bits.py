"""The packaged FMUs give the bits that tests/bits.rs computes from the library: tests/golden/bits.csv."""

import csv
import shutil
import struct
from pathlib import Path

import pytest
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

ROOT = Path(__file__).resolve().parents[2]

# Communication points lie this far apart [s], exact in binary.
STEP = 1 / 64
STEPS = 128

# The number of each method in the enumeration SolverMethod.
METHODS = {"auto": 1, "dopri5": 2, "dop853": 3, "symplectic": 4, "stiff": 5}


def golden():
    """scene, method and hash of each trajectory."""
    lines = (ROOT / "tests" / "golden" / "bits.csv").read_text(encoding="utf-8").splitlines()
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


@pytest.mark.parametrize("scene, method, expected", golden())
def test_golden_bits_of_packaged_fmu(scene, method, expected):
    """All Real variables in the order of value references, at t = 0, 1/64, … 2 s."""
    path = ROOT / "target" / "fmu" / f"{scene}.fmu"
    assert path.is_file(), f"{path} is missing: run `cargo xtask package {scene}` first"
    description = read_model_description(path)
    variables = description.modelVariables
    reals = sorted(variable.valueReference for variable in variables if variable.type == "Real")
    choice = next(variable.valueReference for variable in variables if variable.name == "solver.method")
    folder = extract(path)
    try:
        fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=f"{scene}_{method}",
        )
        # Callbacks of its own: fmpy's default ones log through what an earlier simulate_fmu left behind.
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(lambda *_message: None)
        fmu.instantiate(callbacks=callbacks)
        try:
            fmu.setInteger([choice], [METHODS[method]])
            fmu.setupExperiment(startTime=0.0)
            fmu.enterInitializationMode()
            fmu.exitInitializationMode()
            values = fmu.getReal(reals)
            for i in range(STEPS):
                fmu.doStep(currentCommunicationPoint=i * STEP, communicationStepSize=STEP)
                values += fmu.getReal(reals)
            fmu.terminate()
        finally:
            # Frees the library too, so that the folder can go.
            fmu.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    assert len(values) == (STEPS + 1) * len(reals)
    assert f"{fnv_1a(struct.pack(f'<{len(values)}d', *values)):016x}" == expected
