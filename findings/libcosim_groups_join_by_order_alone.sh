#!/usr/bin/env bash
# libcosimpy 0.0.6 with two FMUs made by PythonFMU 0.7.0 (Python 3.11, seen 2026-11-30): what a VariableGroupConnection of an OspSystemStructure.xml
# joins.
#
# Guess before the run: a group of forces joined to one of velocities is refused, as OSP-IS has it; in a group of vectors the variables meet by
# their axes; a connection between groups of names that no file has is refused.
#
# Seen: neither kinds nor units nor axes count. Variables meet by the order in which the files list them: a Force [N] feeds a LinearVelocity
#   [m/s], and x feeds y where one file lists y first.
#   Two names that no file has are joined without a word, and nothing is connected.
#   A system without <Algorithm> is refused ("Invalid algorithm choice"), though the schema lets it be left out.
# Who couples a rotor there by groups compares the order of both files, and reads one input of each connection after the first step.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install libcosimpy==0.0.6 pythonfmu==0.7.0
cd "$folder"
cat > station.py <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Station(Fmi2Slave):
    """Two outputs, 1 and 2, and two inputs."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.fx, self.fy, self.vx, self.vy = 1.0, 2.0, 0.0, 0.0
        for name in ("fx", "fy"):
            self.register_variable(Real(name, causality=Fmi2Causality.output))
        for name in ("vx", "vy"):
            self.register_variable(Real(name, causality=Fmi2Causality.input))

    def do_step(self, current_time, step_size):
        return True
PY
"$folder/venv/bin/pythonfmu" build -f station.py >/dev/null
cat > Station_OspModelDescription.xml <<'XML'
<?xml version="1.0" encoding="UTF-8"?>
<OspModelDescription xmlns="https://open-simulation-platform.com/OspModelDescription/1.0.1" version="1.0">
  <UnitDefinitions>
    <Unit name="N"><BaseUnit kg="1" m="1" s="-2"/></Unit>
    <Unit name="m/s"><BaseUnit m="1" s="-1"/></Unit>
  </UnitDefinitions>
  <VariableGroups>
    <Force name="load">
      <Variable ref="fx" unit="N" axis="x"/>
      <Variable ref="fy" unit="N" axis="y"/>
    </Force>
    <LinearVelocity name="velocity">
      <Variable ref="vy" unit="m/s" axis="y"/>
      <Variable ref="vx" unit="m/s" axis="x"/>
    </LinearVelocity>
  </VariableGroups>
</OspModelDescription>
XML
cat > run.py <<'PY'
from pathlib import Path

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver

SYSTEM = """<?xml version="1.0" encoding="UTF-8"?>
<OspSystemStructure xmlns="http://opensimulationplatform.com/MSMI/OSPSystemStructure" version="0.1">
  <BaseStepSize>0.1</BaseStepSize>{algorithm}
  <Simulators><Simulator name="a" source="Station.fmu"/><Simulator name="b" source="Station.fmu"/></Simulators>
  <Connections>
    <VariableGroupConnection>
      <VariableGroup simulator="a" name="{one}"/><VariableGroup simulator="b" name="{other}"/>
    </VariableGroupConnection>
  </Connections>
</OspSystemStructure>
"""


def fed(one, other, algorithm="<Algorithm>fixedStep</Algorithm>"):
    """vx and vy of b after two steps, with these groups joined."""
    Path("OspSystemStructure.xml").write_text(SYSTEM.format(one=one, other=other, algorithm=algorithm), "utf-8")
    execution = CosimExecution.from_osp_config_file(".")
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    for _ in range(2):
        assert execution.step()
    slave = execution.slave_index_from_instance_name("b")
    names = {variable.name.decode(): variable.reference for variable in execution.slave_variables(slave)}
    return [observer.last_real_values(slave, [names[name]])[0] for name in ("vx", "vy")]


log_output_level(CosimLogLevel.WARNING)
joined = fed("load", "velocity")
print(f"forces 1 along x, 2 along y, joined to velocities: vx = {joined[0]}, vy = {joined[1]}")
assert joined == [2.0, 1.0], joined
nowhere = fed("nosuch", "neither")
print(f"two groups that no file has: vx = {nowhere[0]}, vy = {nowhere[1]}")
assert nowhere == [0.0, 0.0], nowhere
try:
    fed("load", "velocity", algorithm="")
except AssertionError as refused:
    print(f"without <Algorithm>: {refused}")
    assert "Invalid algorithm choice" in str(refused), refused
else:
    raise SystemExit("without <Algorithm> it runs")
PY
"$folder/venv/bin/python" run.py
