#!/usr/bin/env bash
# PythonFMU 0.7.0, `pythonfmu buildcsv` (driven by fmpy 0.3.32, Python 3.11, seen 2026-11-29): what the FMU of a CSV file shows between
# the rows of its file, and before the first one.
#
# Guess before the run: straight lines between neighbouring rows; before the first row its values; outputs that are continuous or discrete.
#
# Seen: the line goes from the row at or before the time to the first row beyond the next communication point. Rows between are skipped:
#   a file with a row every 0.03 s and a peak of 9 at 0.06 s shows 5.5 at 0.05 s with steps of 0.05 s, where the line between the rows at
#   0.03 and 0.06 s is at 7.77. With steps of 0.01 s it shows 7.77.
#   A file that begins at 0.5 s, read from 0 s on in steps of 0.1 s, shows its last row at 0 s, the one before it at 0.1 s, and so on
#   backwards, until the time of the first row is reached.
#   All outputs are declared constant, though they change.
#   Besides, one hung near the end of its file (not shown here).
# Who feeds a rotor with a measurement through such an FMU lets the file begin at the start time and end a step after the stop, takes no
# step longer than its rows are apart, and does not leave out outputs because they are constant.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install fmpy==0.3.32 pythonfmu==0.7.0 numpy==2.4.6
cd "$folder"
# The FMU looks for the Python that runs it.
export PATH="$folder/venv/bin:$PATH"
python - <<'PY'
def write(name, begin):
    rows = [(begin + 0.03 * n, 9.0 if n == 2 else 5.0 + 0.3 * n) for n in range(12)]
    with open(name, "w") as file:
        file.write("time, tau [real]\n")
        file.writelines(f"{t:.2f}, {tau:.1f}\n" for t, tau in rows)


write("now.csv", 0.0)
write("later.csv", 0.5)
PY
pythonfmu buildcsv -f now.csv --dest . >/dev/null
pythonfmu buildcsv -f later.csv --dest . >/dev/null
cat > run.py <<'PY'
from fmpy import read_model_description, simulate_fmu


def shown(name, step, stop):
    result = simulate_fmu(name, start_time=0.0, stop_time=stop, step_size=step, output_interval=step)
    return {round(float(time), 3): round(float(tau), 3) for time, tau in zip(result["time"], result["tau"])}


peak = shown("Now.fmu", 0.05, 0.2)
print("steps of 0.05 s:", peak)
assert peak[0.05] == 5.5
assert peak[0.1] == 6.0
fine = shown("Now.fmu", 0.01, 0.2)
print("steps of 0.01 s: at 0.05 s", fine[0.05])
assert fine[0.05] == 7.767
backwards = shown("Later.fmu", 0.1, 0.4)
print("before the first row:", backwards)
assert list(backwards.values()) == [8.3, 8.0, 7.7, 7.4, 7.1]
tau = next(v for v in read_model_description("Now.fmu").modelVariables if v.name == "tau")
print("tau is", tau.variability)
assert tau.variability == "constant"
PY
python run.py
