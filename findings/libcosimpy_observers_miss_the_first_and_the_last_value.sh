#!/usr/bin/env bash
# libcosimpy 0.0.6 (an FMU made by PythonFMU 0.7.0, Python 3.11, seen 2026-11-29): what observers show of an output at both ends of a run.
#
# Guess before the run: before the first step last_real_values returns the start value of the output, or what the FMU shows after its
# initialization; a time series that is read from step 0 on, with room for more samples than there are, has them all.
#
# Seen: before the first step last_real_values returns 0.0, whatever the start value is: the FMUs are initialized in the first call of step().
#   The clock shows 0 then. A time series, read later, has a sample of that time with the right value.
#   time_series_real_samples from step 0 on lacks the newest sample, however many are asked for: after three steps 0, 1 and 2 of the steps
#   0 to 3, and with sample_count=2 one. From step 1 on it has all: 1, 2 and 3.
# A script that answers the motion of a rotor would answer a position of 0 at first: make one step before the first reading, or begin with the
# start values of the model description. To read a whole series, read step 0 and the rest apart.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install libcosimpy==0.0.6 pythonfmu==0.7.0
cd "$folder"
cat > place.py <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Place(Fmi2Slave):
    """An output that starts at 3 and grows with the time."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.r = 3.0
        self.register_variable(Real("r", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.r = 3.0 + current_time + step_size
        return True
PY
"$folder/venv/bin/pythonfmu" build -f place.py >/dev/null
cat > look.py <<'PY'
from libcosimpy.CosimEnums import CosimVariableType
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

log_output_level(CosimLogLevel.ERROR)
execution = CosimExecution.from_step_size(step_size=500_000_000)
slave = execution.add_local_slave(CosimLocalSlave("Place.fmu", "place"))
last, series = CosimObserver.create_last_value(), CosimObserver.create_time_series(buffer_size=10)
execution.add_observer(last)
execution.add_observer(series)
series.start_time_series(slave_index=slave, value_reference=0, variable_type=CosimVariableType.REAL)


def shown():
    """The time of the clock [ns], and the last value."""
    return execution.status().current_time, last.last_real_values(slave_index=slave, variable_references=[0])[0]


def samples(first, count):
    """Times [ns] and values of so many samples from one step on."""
    times, _, values = series.time_series_real_samples(value_reference=0, slave_index=slave, from_step=first, sample_count=count)
    return list(zip(times, values))


print("before", shown())
for _ in range(3):
    assert execution.step()
print("after", shown())
print("from 0", samples(0, 9))
print("from 0, two", samples(0, 2))
print("from 1", samples(1, 9))
PY
"$folder/venv/bin/python" look.py | tee seen.txt
grep -qxF 'before (0, 0.0)' seen.txt
grep -qxF 'after (1500000000, 4.5)' seen.txt
grep -qxF 'from 0 [(0, 3.0), (500000000, 3.5), (1000000000, 4.0)]' seen.txt
grep -qxF 'from 0, two [(0, 3.0)]' seen.txt
grep -qxF 'from 1 [(500000000, 3.5), (1000000000, 4.0), (1500000000, 4.5)]' seen.txt
