"""`cargo xtask ssv`: with a scene's parameter set the general FMU is that scene."""

import numpy as np
import project
import pytest
from fmpy.ssp.ssd import read_ssv

# The others are long, or have tables, which the general FMU has not.
SCENES = [scene for scene in project.GENTLE if scene in project.PACKAGED and scene not in project.GENERAL]


@pytest.fixture(scope="module")
def parameter_set(xtask, tmp_path_factory):
    """The parameters of a scene, read back by fmpy, which also checks them against the schema."""

    def read(scene):
        folder = tmp_path_factory.mktemp("ssv")
        written = xtask("ssv", scene, "--out", str(folder))
        assert written.returncode == 0, written.stderr
        return read_ssv(written.stdout.strip()).parameters

    return read


@pytest.mark.parametrize("scene", SCENES)
def test_exact_general_fmu_with_a_scenes_parameters(scene, fmus, parameter_set):
    general, own = fmus["rotor"], fmus[scene]
    parameters = parameter_set(scene)
    for parameter in parameters:
        variable = general.variables[parameter.name]
        assert variable.causality in ("parameter", "input")
        assert (parameter.unit or None) == variable.unit
        assert parameter.type == variable.type
    # ecos refuses an Enumeration: the method stands as its number.
    assert "solver.method_number" in {parameter.name for parameter in parameters}
    values = {parameter.name: parameter.value for parameter in parameters}
    columns = ["time", "r_c.x", "r_c.y", "r_c.z", "axis.x", "axis.y", "axis.z", "phi"]
    runs = [
        fmu.simulate(start_values=start_values, stop_time=0.5, output_interval=0.01, output=columns[1:])
        for fmu, start_values in ((general, values), (own, {}))
    ]
    for column in columns:
        assert np.array_equal(*(run[column] for run in runs)), column


def test_regress_what_the_general_fmu_lacks_is_named(xtask, tmp_path):
    text = (project.ROOT / "scenes" / "paper.toml").read_text(encoding="utf-8")
    bearing = "[[effects.bearing]]\nposition = 0.1\nkyy = 1.0\n"
    (tmp_path / "three.toml").write_text(text + 3 * bearing, encoding="utf-8")
    refused = xtask("ssv", str(tmp_path / "three.toml"))
    assert refused.returncode != 0
    assert "the general FMU has no bearing[3].position" in refused.stderr
