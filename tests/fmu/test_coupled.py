"""examples/coupled.py: bearings as another model, by its one command."""

import subprocess
import sys

import project
from host import OK, Host

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


STEP = 1e-4  # [s]
MOVING = {"port[1].position": 0.0, "rotor.l": 0.0, "start.r_c.x": 0.0, "start.r_c.y": 1e-4}
PLACE, VELOCITY, FORCE = ([f"port[1].{of}.{axis}" for axis in "xyz"] for of in "rvf")


def test_what_was_said_of_a_port_goes_with_a_saved_state(fmus):
    with Host(fmus["rotor"], log=[]) as host:
        host.slave.setDebugLogging(True, ["logEvents"])
        host.slave.setBoolean([host.reference(name) for name in ("effects.port[1]", "effects.support")], [True, False])
        host.start(MOVING, startTime=0.0)

        def go(steps):
            for n in steps:
                motion = zip(host.read(*PLACE), host.read(*VELOCITY))
                host.set(dict(zip(FORCE, [-1e6 * r - 100.0 * v for r, v in motion])))
                assert host.step(n * STEP, STEP) == OK
            return sum("what was learnt" in message for message in host.log)

        assert go(range(3)) == 0
        before = host.slave.getFMUState()
        assert go(range(3, 20)) == 1, host.log
        after = host.slave.getFMUState()
        host.slave.setFMUState(before)
        assert go(range(3, 20)) == 2, "it had not been said then"
        host.slave.setFMUState(after)
        assert go(range(20, 40)) == 2, "it had been said then"
        for state in (before, after):
            host.slave.freeFMUState(state)
