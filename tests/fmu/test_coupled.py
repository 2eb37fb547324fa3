"""examples/coupled.py: bearings as another model, by its one command."""

import subprocess
import sys

import project

# By step [s]: errors at most by what was learnt, and with coefficients that are given. Measured: 1.2e-2, 2.7e-4, 2.1e-5, 3.7e-7; 2e-10.
LEARNT = {1e-3: 3e-2, 2e-4: 3e-4, 1e-4: 1e-4, 1e-5: 1e-4}
GIVEN = 1e-5
# Held forces err by more than this at all steps.
HELD = 1e-2


def test_regress_bearings_as_another_model_are_right_with_nothing_set():
    command = [sys.executable, project.ROOT / "examples" / "coupled.py", project.packaged("rotor")]
    printed = subprocess.run(command, check=True, capture_output=True, encoding="utf-8").stdout
    # fmpy prints warnings of the FMU between the rows.
    assert "the exchange with the models at the ports is wrong" in printed, "held forces at 1 ms"
    head, *rows = [line for line in printed.splitlines() if not line.startswith("[")]
    assert head.split() == ["step", "[s]", "held", "learnt", "given"]
    errors = {row[0]: row[1:] for row in ([float(word) for word in line.split()] for line in rows)}
    assert errors.keys() == LEARNT.keys()
    for step, (held, learnt, given) in errors.items():
        assert held > HELD and learnt < LEARNT[step] and given < GIVEN, printed
