#!/usr/bin/env bash
# fmpy 0.3.32, fmpy.ssp.simulation.simulate_ssp (an SSP 1.0 package of two FMUs made by PythonFMU 0.7.0, Python 3.11, seen 2026-11-29):
# which values stand beside which time, where a run ends, and what comes in where nothing else does.
#
# Guess before the run: a row has the values of its time, the first one those of the start; the last step ends at the stop time; an input
# that is not connected keeps the start value of its FMU; a connection is scaled by its LinearTransformation; the values of a
# ParameterBinding in the package are set.
#
# Seen: an input that is not connected gets what the connected input before it in the file gets: "unfed" follows "fed" in every row.
#   The row of t = 0 has the outputs after the first step, each row those of one step later than its time.
#   With a stop time of 1 s and steps of 0.1 s there are 11 steps: the sum 10 * 0.1 is less than 1, and the FMU is driven to 1.1 s.
#   In the first step each input connector is 0.0, whatever its start value is.
#   A factor of 1000 on a connection (LinearTransformation) does nothing, without a word: metres arrive where millimetres were asked for.
#   A ParameterBinding in the package does nothing either; only an argument of simulate_ssp sets parameters.
# Who couples a rotor there lists no connector that nothing feeds, compares rows with a time one step later, scales in a model, and gives
# parameters as an argument.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install fmpy==0.3.32 pythonfmu==0.7.0 numpy==2.4.6
cd "$folder"
cat > source.py <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Source(Fmi2Slave):
    """An output that is the time of the FMU [s]."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.now = 0.0
        self.register_variable(Real("now", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.now = current_time + step_size
        return True
PY
cat > sink.py <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Sink(Fmi2Slave):
    """Outputs that repeat its inputs and its parameter."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.fed, self.unfed, self.gain = 5.0, 7.0, 3.0
        self.of_fed, self.of_unfed, self.of_gain = 5.0, 7.0, 3.0
        for name in ("fed", "unfed"):
            self.register_variable(Real(name, causality=Fmi2Causality.input))
        self.register_variable(Real("gain", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))
        for name in ("of_fed", "of_unfed", "of_gain"):
            self.register_variable(Real(name, causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.of_fed, self.of_unfed, self.of_gain = self.fed, self.unfed, self.gain
        return True
PY
"$folder/venv/bin/pythonfmu" build -f source.py >/dev/null
"$folder/venv/bin/pythonfmu" build -f sink.py >/dev/null
cat > SystemStructure.ssd <<'XML'
<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
  xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon" xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues"
  version="1.0" name="pair">
  <ssd:System name="pair">
    <ssd:Elements>
      <ssd:Component name="source" type="application/x-fmu-sharedlibrary" source="resources/Source.fmu">
        <ssd:Connectors>
          <ssd:Connector name="now" kind="output"><ssc:Real/></ssd:Connector>
        </ssd:Connectors>
      </ssd:Component>
      <ssd:Component name="sink" type="application/x-fmu-sharedlibrary" source="resources/Sink.fmu">
        <ssd:Connectors>
          <ssd:Connector name="fed" kind="input"><ssc:Real/></ssd:Connector>
          <ssd:Connector name="unfed" kind="input"><ssc:Real/></ssd:Connector>
          <ssd:Connector name="of_fed" kind="output"><ssc:Real/></ssd:Connector>
          <ssd:Connector name="of_unfed" kind="output"><ssc:Real/></ssd:Connector>
          <ssd:Connector name="of_gain" kind="output"><ssc:Real/></ssd:Connector>
        </ssd:Connectors>
        <ssd:ParameterBindings>
          <ssd:ParameterBinding>
            <ssd:ParameterValues>
              <ssv:ParameterSet version="1.0" name="values">
                <ssv:Parameters>
                  <ssv:Parameter name="gain"><ssv:Real value="4.0"/></ssv:Parameter>
                </ssv:Parameters>
              </ssv:ParameterSet>
            </ssd:ParameterValues>
          </ssd:ParameterBinding>
        </ssd:ParameterBindings>
      </ssd:Component>
    </ssd:Elements>
    <ssd:Connections>
      <ssd:Connection startElement="source" startConnector="now" endElement="sink" endConnector="fed">
        <ssc:LinearTransformation factor="1000"/>
      </ssd:Connection>
    </ssd:Connections>
  </ssd:System>
</ssd:SystemStructureDescription>
XML
cat > run.py <<'PY'
import zipfile

from fmpy.ssp.simulation import simulate_ssp

with zipfile.ZipFile("pair.ssp", "w") as package:
    package.write("SystemStructure.ssd")
    package.write("Source.fmu", "resources/Source.fmu")
    package.write("Sink.fmu", "resources/Sink.fmu")
rows = simulate_ssp("pair.ssp", stop_time=1.0, step_size=0.1)
for name in rows.dtype.names:
    print(f"{name}: {[round(float(value), 12) for value in rows[name]]}")


def near(value, expected):
    assert abs(float(value) - expected) < 1e-9, (value, expected)


near(rows["time"][0], 0.0)
near(rows["source.now"][0], 0.1)
assert len(rows) == 11
near(rows["time"][-1], 1.0)
near(rows["source.now"][-1], 1.1)
assert list(rows["sink.unfed"]) == list(rows["sink.fed"])
assert list(rows["sink.of_unfed"]) == list(rows["sink.of_fed"])
near(rows["sink.of_fed"][0], 0.0)
near(rows["sink.of_fed"][1], 0.1)
near(rows["sink.of_gain"][-1], 3.0)
PY
if ! "$folder/venv/bin/python" run.py >"$folder/seen" 2>"$folder/errors"; then
    tail -n 5 "$folder/errors"
    exit 1
fi
grep -E '^(time|source|sink)' "$folder/seen"
