#!/usr/bin/env bash
# cofmupy 1.0.0 (FMUs made by PythonFMU 0.6.3, which it can be installed with, Python 3.11, seen 2026-11-30): when its iterations over a loop end.
#
# Guess before the run: with "iterative": true a step is rolled back and repeated until outputs and inputs of the loop agree, relative to their
# size, and a step that does not converge is an error or a warning.
#
# Seen: it ends as soon as no input changes by 1e-3 or more, in whatever unit: two FMUs whose values are 1e-4 step once, and the result is that
#   without iterations, off by half. (Positions of a rotor in m are smaller than that.)
#   After ten iterations it takes what is there: a loop that diverges goes on, with values 57 times and 3300 times too large, and nothing is
#   printed or raised.
# Who iterates there scales the values of a loop to 1 and more, and compares with a shorter step.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
# What it needs for this: with all that it names (a server, Streamlit 1.12) pip had found no versions that agree after eight minutes.
"$folder/venv/bin/pip" -q install fmpy==0.3.20 pythonfmu==0.6.3 networkx==3.2.1 numpy==2.4.6 pandas==3.1.1 scipy==1.17.1 plotly==7.1.0 \
    matplotlib==3.11.2 rich==15.0.0 confluent-kafka==2.16.1
"$folder/venv/bin/pip" -q install --no-deps cofmupy==1.0.0
cd "$folder"
cat > node.py <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Node(Fmi2Slave):
    """shown = gain fed + offset, at once."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.gain, self.offset, self.fed = 0.5, 1.0, 0.0
        for name in ("gain", "offset"):
            self.register_variable(Real(name, causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))
        self.register_variable(Real("fed", causality=Fmi2Causality.input))
        self.register_variable(Real("shown", causality=Fmi2Causality.output, getter=lambda: self.gain * self.fed + self.offset))

    def do_step(self, current_time, step_size):
        return True
PY
"$folder/venv/bin/pythonfmu" build --handle-state -f node.py >/dev/null
cat > run.py <<'PY'
import sys

from cofmupy import Coordinator

iterative, gain, offset = sys.argv[1] == "iterative", float(sys.argv[2]), float(sys.argv[3])


def end(name, variable):
    return {"type": "fmu", "id": name, "variable": variable, "unit": ""}


values = {"gain": gain, "offset": offset}
coordinator = Coordinator()
coordinator.start(
    {
        "cosim_method": "jacobi",
        "iterative": iterative,
        "fmus": [{"id": name, "name": name, "path": "Node.fmu", "initialization": values} for name in "ab"],
        "connections": [{"source": end(a, "shown"), "target": [end(b, "fed")]} for a, b in ("ab", "ba")],
    }
)
for _ in range(2):
    coordinator.do_step(0.5)
print("shown", *(f"{value:.5g}" for value in coordinator.get_results()[("a", "shown")]), "right", f"{offset / (1 - gain):g}")
PY
run() { "$folder/venv/bin/python" run.py "$@" 2>&1 | grep -v Skipping; }
run iterative 0.5 1 | tee large.txt
grep -qx "shown 1.998 1.999 right 2" large.txt
echo "values of 1e-4, with and without iterations:"
run iterative 0.5 1e-4 | tee small.txt
run once 0.5 1e-4 | cmp - small.txt
grep -qx "shown 0.0001 0.00015 right 0.0002" small.txt
echo "a loop that diverges:"
run iterative -1.5 1 | tee diverges.txt
grep -qx "shown -22.666 -1329.7 right 0.4" diverges.txt
