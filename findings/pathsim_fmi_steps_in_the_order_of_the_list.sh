#!/usr/bin/env bash
# pathsim-fmi 0.1.1 with pathsim 0.27.1 (an FMU made by PythonFMU 0.7.0, Python 3.11, seen 2026-11-30): which values two co-simulation blocks
# feed to each other, and what a step of the simulation does to them that is no part of theirs.
#
# Guess before the run: of two blocks that feed each other, each is given what the other showed before the step; a block of 0.1 s in a simulation
# with steps of 0.03 s is stepped at 0.1, 0.2, 0.3 s, for which the solver shortens its steps.
#
# Seen: at the clock's t both FMUs have been stepped to t + 0.1 s already. The block that is first in the list of blocks was given what the other
#   one showed for t, the second one what the first one shows for t + 0.1 s: to exchange both in the list changes the results.
#   With the default solver (fixed steps of 0.03 s) a block of 0.1 s is stepped at 0.12, 0.21 and 0.3 s of the clock, and is given the inputs of
#   these times for its own 0.1, 0.2 and 0.3 s, without a word. A solver that chooses its steps meets 0.1, 0.2 and 0.3 s.
# Who couples two FMUs there takes steps of which the blocks' own are multiples, and names first the block whose answer may be old.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install pathsim-fmi==0.1.1 pathsim==0.27.1 fmpy==0.3.32 pythonfmu==0.7.0 numpy==2.4.6
cd "$folder"
cat > clock.py <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Clock(Fmi2Slave):
    """The time of the FMU [s], and what it was given for its last step."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.now, self.seen, self.fed = 0.0, -1.0, 0.0
        self.register_variable(Real("now", causality=Fmi2Causality.output))
        self.register_variable(Real("seen", causality=Fmi2Causality.output))
        self.register_variable(Real("fed", causality=Fmi2Causality.input, start=0.0))

    def do_step(self, current_time, step_size):
        self.now, self.seen = current_time + step_size, self.fed
        return True
PY
venv/bin/pythonfmu build -f clock.py > /dev/null
cat > run.py <<'PY'
import numpy as np
from pathsim import Connection, Simulation
from pathsim.blocks import Scope, Source
from pathsim.solvers import RKCK54
from pathsim_fmi import CoSimulationFMU


def clock(name):
    return CoSimulationFMU("Clock.fmu", instance_name=name, dt=0.1)


def shown(scope):
    times, values = scope.read()
    return np.vstack([times, values]).T


def circle(first_is_a):
    """Time, and of each of two blocks that feed each other its own time and what it was given."""
    a, b, scope = clock("a"), clock("b"), Scope()
    lines = [Connection(a[0], b, scope[0]), Connection(a[1], scope[1])]
    lines += [Connection(b[0], a, scope[2]), Connection(b[1], scope[3])]
    blocks = [a, b, scope] if first_is_a else [b, a, scope]
    Simulation(blocks, lines, dt=0.1, log=False).run(0.5)
    return shown(scope)


def given(**solver):
    """Of each step of a block in a simulation of 0.03 s: its time at the end, and the clock that its input says."""
    block, source, scope = clock("a"), Source(lambda t: t), Scope()
    lines = [Connection(source, block), Connection(block[0], scope[0]), Connection(block[1], scope[1])]
    Simulation([block, source, scope], lines, dt=0.03, log=False, **solver).run(0.35)
    return sorted({(round(float(now), 6), round(float(seen), 6)) for _, now, seen in shown(scope)})


a_first, b_first = circle(True), circle(False)
print("a is first", a_first[3], "b is first", b_first[3])
for way in (a_first, b_first):
    assert np.allclose(way[:, 1], way[:, 0] + 0.1)
    assert np.allclose(way[:, 3], way[:, 0] + 0.1)
assert np.allclose(a_first[:, 2], a_first[:, 0])
assert np.allclose(a_first[:, 4], a_first[:, 0] + 0.1)
assert np.allclose(b_first[:, 2], b_first[:, 0] + 0.1)
assert np.allclose(b_first[:, 4], b_first[:, 0])

fixed, chosen = given(), given(Solver=RKCK54)
print("fixed steps", fixed, "chosen steps", chosen)
assert fixed == [(0.1, 0.0), (0.2, 0.12), (0.3, 0.21), (0.4, 0.3)], fixed
assert chosen == [(0.1, 0.0), (0.2, 0.1), (0.3, 0.2), (0.4, 0.3)], chosen
PY
venv/bin/python run.py
