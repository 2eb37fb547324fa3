#!/usr/bin/env bash
# ecospy 0.7.2 (two FMUs made by PythonFMU 0.7.0, Python 3.11, libtbb12 of Debian 12, seen 2026-11-29): what a model with a longer step shows
# meanwhile, and which slips of a host are silent.
#
# Guess before the run: a model whose step_size_hint is three steps of the simulation keeps its first values until t = 0.3 s, and then shows
# those of 0.3 s; to start with a parameter set of a name that was never added fails; so does a second connection to one input.
#
# Seen: the slow model is stepped from 0 to 0.3 s in the first step of 0.1 s. At t = 0.1 s a connected fast model is fed what the slow one
#   shows for 0.3 s, and at 0.4 s what it shows for 0.6 s: values of a time that has not come yet.
#   init(parameter_set=NAME) with a name that was never added returns True, and every value is as the FMU has it.
#   A second connection to an input takes the place of the first one, without a word.
#   step_until(1.05) with steps of 0.1 s ends before its time, at 1.0 s.
# Who couples a rotor and a slower partner there gives both one step, checks the name of the parameter set, and feeds an input once.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install ecospy==0.7.2 pythonfmu==0.7.0
cd "$folder"
cat > clock.py <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Clock(Fmi2Slave):
    """An output that is the time of the FMU [s], an input, and a parameter."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.now, self.fed, self.gain = 0.0, 5.0, 3.0
        self.register_variable(Real("now", causality=Fmi2Causality.output))
        self.register_variable(Real("fed", causality=Fmi2Causality.input))
        self.register_variable(Real("gain", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))

    def do_step(self, current_time, step_size):
        self.now = current_time + step_size
        return True
PY
"$folder/venv/bin/pythonfmu" build -f clock.py >/dev/null
cat > run.py <<'PY'
from ecospy import EcosSimulation, EcosSimulationStructure


def near(value, expected):
    assert abs(value - expected) < 1e-9, (value, expected)


with EcosSimulationStructure() as structure:
    structure.add_model("fast", "Clock.fmu")
    structure.add_model("slow", "Clock.fmu", 0.3)
    structure.make_real_connection("slow::now", "fast::fed")
    structure.add_parameter_set("mine", {"fast::gain": 4.0})
    with EcosSimulation(step_size=0.1, structure=structure) as simulation:
        assert simulation.init(parameter_set="another")
        near(simulation.get_real("fast::gain"), 3.0)
        rows = []
        for _ in range(6):
            simulation.step(1)
            rows.append([simulation.get_real(name) for name in ("fast::now", "fast::fed", "slow::now")])
            print("time %.1f, fed with %.1f, the slow model is at %.1f" % tuple(rows[-1]))
        simulation.step_until(1.05)
        end = simulation.get_real("fast::now")
        print(f"stepped until 1.05: {end:.2f}")
near(rows[0][0], 0.1)
near(rows[0][1], 0.3)
near(rows[3][0], 0.4)
near(rows[3][1], 0.6)
near(end, 1.0)
with EcosSimulationStructure() as structure:
    for name in ("first", "second", "third"):
        structure.add_model(name, "Clock.fmu")
    structure.make_real_connection("first::now", "third::fed")
    structure.make_real_connection("second::gain", "third::fed")
    with EcosSimulation(step_size=0.1, structure=structure) as simulation:
        assert simulation.init()
        simulation.step(1)
        print(f"two connections, of 0.1 and of 3.0: {simulation.get_real('third::fed'):.1f}")
        near(simulation.get_real("third::fed"), 3.0)
PY
"$folder/venv/bin/python" run.py
