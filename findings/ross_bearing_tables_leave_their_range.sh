#!/usr/bin/env bash
# ROSS 2.3.0 (ross-rotordynamics, Python 3.11, seen 2026-11-28): what a bearing's coefficients are between and beyond the speeds of
# their table.
#
# Guess before the run: straight lines between the nodes, and beyond the last one the last value or the last line.
#
# Seen: one cubic spline through five nodes, which goes on beyond both ends without a warning.
#   1e6, 2e6, 4e6, 4.2e6, 1e6 N/m at 0 ... 400 rad/s: -6.90e6 N/m at 500 and -7.18e7 N/m at 800 rad/s. A spring has become a negative one.
#   4e6 ... 1.2e6 N/m, which falls: 1.0e6 N/m at 600 and 1.6e6 N/m at 800 rad/s. It rises again.
#   1e6 four times, then 5e6 N/m: 8.12e5 N/m at 250 rad/s, between two nodes of 1e6 N/m.
#   At the nodes themselves it may be off by 1e-6 of the value: the spline smooths.
# Who compares critical speeds with ROSS gives both sides tables that reach beyond the highest speed, with nodes close together.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install ross-rotordynamics==2.3.0 plotly==5.24.1 numpy==2.4.6 scipy==1.17.1
cat > "$folder/tables.py" <<'PY'
import warnings

import ross

SPEEDS = [0.0, 100.0, 200.0, 300.0, 400.0]


def stiffness(table, speed):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        bearing = ross.BearingElement(n=0, kxx=table, cxx=[0.0] * 5, frequency=SPEEDS)
        value = float(bearing.K(speed)[0, 0])
    assert not said, said
    print(f"{table} at {speed} rad/s: {value:.4g} N/m")
    return value


def near(value, expected):
    assert abs(value / expected - 1.0) < 1e-3, (value, expected)


peaked = [1e6, 2e6, 4e6, 4.2e6, 1e6]
near(stiffness(peaked, 500.0), -6.900e6)
near(stiffness(peaked, 800.0), -7.180e7)
falling = [4e6, 3e6, 2.2e6, 1.6e6, 1.2e6]
near(stiffness(falling, 600.0), 1.0e6)
near(stiffness(falling, 800.0), 1.6e6)
level = [1e6, 1e6, 1e6, 1e6, 5e6]
near(stiffness(level, 250.0), 8.125e5)
at_node = stiffness(level, 100.0)
assert at_node != 1e6
assert abs(at_node / 1e6 - 1.0) < 1e-5
PY
# Other packages print on both streams as they are loaded.
if ! "$folder/venv/bin/python" "$folder/tables.py" >"$folder/seen" 2>"$folder/errors"; then
    tail -n 5 "$folder/errors"
    exit 1
fi
grep 'rad/s' "$folder/seen"
