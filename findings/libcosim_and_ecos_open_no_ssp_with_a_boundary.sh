#!/usr/bin/env bash
# libcosimpy 0.0.6 and ecospy 0.7.2 (SSP 1.0 packages of two FMUs made by PythonFMU 0.7.0, valid by the schemas that fmpy 0.3.32 has;
# Python 3.11, seen 2026-11-30): which packages they open, and which parameter sets.
#
# Guess before the run: both open a package whose system has connectors of its own, and leave these free or 0; ecos applies the parameter
# set that a component is bound to.
#
# Seen: with one connection to the boundary of the system, which has no startElement or no endElement, neither opens the package: libcosim says
#   "No such node (<xmlattr>.endElement)", ecos "No element named", with the name of the model at the other end. Without it both run the package.
#   libcosim applies the set that is bound. ecos applies none until `init` is given its name, and says nothing.
# Who writes a package for them leaves out the boundary, and gives all parameter sets one name. A type of variable beside Real in a package can
# end the process of libcosim; what does is left out here.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install fmpy==0.3.32 pythonfmu==0.7.0 libcosimpy==0.0.6 ecospy==0.7.2 numpy==2.4.6
cd "$folder"
cat > source.py <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Source(Fmi2Slave):
    """An output that is a parameter."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.level = self.out = 1.0
        self.register_variable(Real("level", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))
        self.register_variable(Real("out", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.out = self.level
        return True
PY
cat > sink.py <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Sink(Fmi2Slave):
    """An output that repeats the input."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.fed = self.seen = 0.0
        self.register_variable(Real("fed", causality=Fmi2Causality.input))
        self.register_variable(Real("seen", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.seen = self.fed
        return True
PY
"$folder/venv/bin/pythonfmu" build -f source.py >/dev/null
"$folder/venv/bin/pythonfmu" build -f sink.py >/dev/null
cat > write.py <<'PY'
import zipfile

from fmpy.ssp.ssd import read_ssd

SSD = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
  xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon" version="1.0" name="pair">
  <ssd:System name="pair">
    {connectors}
    <ssd:Elements>
      <ssd:Component name="source" type="application/x-fmu-sharedlibrary" source="resources/Source.fmu">
        <ssd:Connectors><ssd:Connector name="out" kind="output"><ssc:Real/></ssd:Connector></ssd:Connectors>
        <ssd:ParameterBindings><ssd:ParameterBinding source="resources/level.ssv"/></ssd:ParameterBindings>
      </ssd:Component>
      <ssd:Component name="sink" type="application/x-fmu-sharedlibrary" source="resources/Sink.fmu">
        <ssd:Connectors>
          <ssd:Connector name="fed" kind="input"><ssc:Real/></ssd:Connector>
          <ssd:Connector name="seen" kind="output"><ssc:Real/></ssd:Connector>
        </ssd:Connectors>
      </ssd:Component>
    </ssd:Elements>
    <ssd:Connections>
      <ssd:Connection startElement="source" startConnector="out" endElement="sink" endConnector="fed"/>
      {connections}
    </ssd:Connections>
  </ssd:System>
</ssd:SystemStructureDescription>
"""
SSV = """<?xml version="1.0" encoding="UTF-8"?>
<ssv:ParameterSet xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" version="1.0" name="values">
  <ssv:Parameters><ssv:Parameter name="level"><ssv:Real value="4.0"/></ssv:Parameter></ssv:Parameters>
</ssv:ParameterSet>
"""
OUT = '<ssd:Connectors><ssd:Connector name="seen" kind="output"><ssc:Real/></ssd:Connector></ssd:Connectors>'
TO_OUT = '<ssd:Connection startElement="sink" startConnector="seen" endConnector="seen"/>'
plain = {"connectors": "", "connections": ""}
packages = {
    "inside": plain,
    "boundary": plain | {"connectors": OUT, "connections": TO_OUT},
}
for name, words in packages.items():
    with zipfile.ZipFile(f"{name}.ssp", "w") as package:
        package.writestr("SystemStructure.ssd", SSD.format(**words))
        package.writestr("resources/level.ssv", SSV)
        for fmu in ("Source.fmu", "Sink.fmu"):
            package.write(fmu, f"resources/{fmu}")
    # Raises where the schemas are not kept.
    read_ssd(f"{name}.ssp")
PY
cat > libcosim.py <<'PY'
import sys

from libcosimpy._internal import get_last_error_message
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver

try:
    execution = CosimExecution.from_ssp_file(sys.argv[1], 100_000_000)
except AssertionError:
    sys.exit(f"not opened: {get_last_error_message()}")
observer = CosimObserver.create_last_value()
execution.add_observer(observer)
for _ in range(3):
    assert execution.step()
sink = execution.slave_index_from_instance_name("sink")
reference = next(of.reference for of in execution.slave_variables(sink) if of.name == b"seen")
print(f"runs: seen {observer.last_real_values(sink, [reference])[0]}")
PY
cat > ecos.py <<'PY'
import sys

from ecospy import EcosLib, EcosSimulation

EcosLib.set_log_level("off")
try:
    simulation = EcosSimulation(ssp_path=sys.argv[1], step_size=0.1)
except Exception as refused:
    sys.exit(f"not opened: {refused}")
assert simulation.init(**({"parameter_set": sys.argv[2]} if len(sys.argv) > 2 else {}))
simulation.step(3)
print(f"runs: seen {simulation.get_real('sink::seen')}")
PY
"$folder/venv/bin/python" write.py
# see MASTER PACKAGE [SET]: the last words of the run.
see() {
    local name="$1 $2${3:+ $3}"
    "$folder/venv/bin/python" "$1.py" "$2.ssp" ${3:+"$3"} >"$folder/out" 2>&1 || true
    grep -E '^(runs|not opened)' "$folder/out" | sed -e "s|^|$name: |" | tee -a "$folder/seen"
}
for package in inside boundary; do
    see libcosim "$package"
done
for package in inside boundary; do
    see ecos "$package" values
done
see ecos inside
expect() {
    grep -qF "$1" "$folder/seen" || { echo "not seen: $1" && exit 1; }
}
expect "libcosim inside: runs: seen 4.0"
expect "libcosim boundary: not opened: No such node (<xmlattr>.endElement)"
expect "ecos inside values: runs: seen 4.0"
expect "ecos boundary values: not opened: No element named: sink"
expect "ecos inside: runs: seen 1.0"
