#!/usr/bin/env bash
# PythonFMU 0.7.0, FMUs built with --handle-state (driven by fmpy 0.3.32, Python 3.11, seen 2026-11-29): what fmi2SetFMUstate restores.
#
# Guess before the run: the whole object, attributes that are no variables too, for canGetAndSetFMUstate is true.
#
# Seen: registered variables that have a setter, and nothing else. A pendulum that shows its position x and keeps its velocity v to itself
#   goes on from the restored x with the velocity of later: 0.773 after the next step, where 0.797 was first. All calls are fmi2OK.
#   With v registered as a local variable both runs are equal to the last bit.
#   fmi2Reset, on the other hand, makes the object anew.
# A master that takes steps back (iterated coupling, redo) is right with such a partner only where each of its states is a variable.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install fmpy==0.3.32 pythonfmu==0.7.0 numpy==2.4.6
cd "$folder"
# The FMU looks for the Python that runs it.
export PATH="$folder/venv/bin:$PATH"
cat > hiding.py <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Hiding(Fmi2Slave):
    """A mass on a spring; only its position is a variable."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.x = 1.0
        self.v = 0.0
        self.register_variable(Real("x", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.v -= step_size * self.x
        self.x += step_size * self.v
        return True
PY
sed -e 's/Hiding/Showing/; s/only its position is a variable/both states are variables/' \
    -e 's/^        self.register_variable.*/&\n        self.register_variable(Real("v", causality=Fmi2Causality.local))/' hiding.py > showing.py
pythonfmu build -f hiding.py --handle-state >/dev/null
pythonfmu build -f showing.py --handle-state >/dev/null
cat > run.py <<'PY'
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave


def begun(name):
    description = read_model_description(name)
    assert description.coSimulation.canGetAndSetFMUstate
    identifier = description.coSimulation.modelIdentifier
    slave = FMU2Slave(
        guid=description.guid, unzipDirectory=extract(name), modelIdentifier=identifier, instanceName=identifier
    )
    slave.instantiate()
    begin(slave)
    return slave


def begin(slave):
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()


def went(slave, first, last):
    """x after each of these steps of 0.1 s."""
    after = []
    for step in range(first, last):
        slave.doStep(0.1 * step, 0.1)
        after.append(slave.getReal([0])[0])
    return after


for name in ["Hiding.fmu", "Showing.fmu"]:
    slave = begun(name)
    start = went(slave, 0, 5)
    state = slave.getFMUstate()
    once = went(slave, 5, 8)
    slave.setFMUstate(state)
    again = went(slave, 5, 8)
    print(name, "first", [round(x, 3) for x in once], "and from the restored state", [round(x, 3) for x in again])
    if name == "Hiding.fmu":
        assert round(once[0], 3) == 0.797
        assert round(again[0], 3) == 0.773
    else:
        assert once == again
    slave.reset()
    begin(slave)
    assert went(slave, 0, 5) == start
PY
python run.py
