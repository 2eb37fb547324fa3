#!/usr/bin/env bash
# cofmupy 1.0.0 (FMUs made by PythonFMU 0.6.3, which it can be installed with, Python 3.11, seen 2026-11-30): in which order it steps FMUs, and
# of which time the values are that it passes on and returns.
#
# Guess before the run: with cosim_method "gauss_seidel" FMUs step in the order of the configuration, each fed with what those before it show; "jacobi"
# feeds each with what the others showed at the end of the step before, at first with their start values; a row of the results has the time
# of its values.
#
# Seen: within a loop the order is that of a Python set of the ids, so the same configuration gives two results, by PYTHONHASHSEED, which Python
#   draws anew for each run.
#   An FMU outside of a loop is fed, by "jacobi" too, with the values at the end of its own step, of a time that it has not reached. A connection
#   back, whatever it carries, makes the first one a step later.
#   In a loop the first step is fed with 0, not with the start value 5 that the other FMU shows.
#   In the results the time of a row is that of the start of the step, its values are those of the end: all are stamped a step too early.
# Who couples a rotor there sets PYTHONHASHSEED, gives inputs their first values by "initialization", and adds a step to the time.
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
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Node(Fmi2Slave):
    """An output one more than what is fed, 5 at the start, what was fed, and the time [s]."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.shown, self.seen, self.now, self.fed = 5.0, 0.0, 0.0, 0.0
        for name in ("shown", "seen", "now"):
            self.register_variable(Real(name, causality=Fmi2Causality.output))
        self.register_variable(Real("fed", causality=Fmi2Causality.input))

    def do_step(self, current_time, step_size):
        self.seen, self.shown, self.now = self.fed, self.fed + 1.0, current_time + step_size
        return True
PY
"$folder/venv/bin/pythonfmu" build -f node.py >/dev/null
cat > run.py <<'PY'
import sys

from cofmupy import Coordinator

method, links = sys.argv[1], [link.split(">") for link in sys.argv[2:]]


def end(text):
    name, variable = text.split(".")
    return {"type": "fmu", "id": name, "variable": variable, "unit": ""}


coordinator = Coordinator()
coordinator.start(
    {
        "cosim_method": method,
        "fmus": [{"id": name, "name": name, "path": "Node.fmu"} for name in ("rotor", "motor")],
        "connections": [{"source": end(source), "target": [end(target)]} for source, target in links],
    }
)
for _ in range(3):
    coordinator.do_step(0.5)
results = coordinator.get_results()
for name in ("rotor", "motor"):
    print(name, *(f"{value:g}" for value in results[(name, "seen")]))
print("time", *(f"{value:g}" for value in results["time"]))
print("now", *(f"{value:g}" for value in results[("motor", "now")]))
PY
run() { "$folder/venv/bin/python" run.py "$@" 2>/dev/null | grep -v Skipping; }
loop=("rotor.shown>motor.fed" "motor.shown>rotor.fed")
for seed in 0 1 2 3 4 5 6 7; do
    PYTHONHASHSEED=$seed run gauss_seidel "${loop[@]}" | head -2 | paste -sd ' '
done | sort | uniq -c | tee orders.txt
grep -q "rotor 0 2 4 motor 1 3 5" orders.txt
grep -q "rotor 1 3 5 motor 0 2 4" orders.txt
echo "a chain:"
run jacobi "rotor.now>motor.fed" | tee chain.txt
grep -qx "motor 0.5 1 1.5" chain.txt
echo "the same, and a connection back:"
run jacobi "rotor.now>motor.fed" "motor.seen>rotor.fed" | tee back.txt
grep -qx "motor 0 0.5 1" back.txt
echo "a loop:"
run jacobi "${loop[@]}" | tee loop.txt
grep -qx "motor 0 1 2" loop.txt
grep -qx "time 0 0.5 1" loop.txt
grep -qx "now 0.5 1 1.5" loop.txt
