"""The energy ledger of a rotor that loses energy: the paper's, with dampers, as a scene of the user's own."""

import numpy as np
import project
import pytest

RESIDUAL = 1e-11  # [1], of the largest kinetic energy and what was dissipated, measured 8e-13

DAMPED = (project.ROOT / "scenes" / "paper.toml").read_text(encoding="utf-8").replace(
    "c2 = 500.0", "c2 = 500.0\nd1 = 4.0\nd2 = 0.5"
)


@pytest.fixture(scope="module")
def damped(package):
    return package("damped", DAMPED)


@pytest.fixture(scope="module")
def result(damped):
    return damped.simulate()


def test_exact_ledger_closes(result):
    turnover = result["energy.kinetic"].max() + result["energy.dissipated"][-1]
    assert np.abs(result["energy.residual"]).max() <= RESIDUAL * turnover


def test_exact_ledger_is_the_sum_of_its_parts(result):
    total = result["energy.kinetic"] + result["energy.potential"]
    residual = total - total[0] - result["energy.supplied"] + result["energy.dissipated"]
    assert np.array_equal(result["energy.total"], total)
    assert np.array_equal(result["energy.residual"], residual)


def test_exact_dissipation_only_grows(result):
    dissipated = result["energy.dissipated"]
    assert dissipated[0] == 0.0
    assert dissipated[-1] > 1.0, "the dampers do something"
    assert np.all(np.diff(dissipated) > 0.0)
    assert np.all(result["energy.supplied"] == 0.0)


def test_exact_dampers_can_be_switched_off(damped, paper):
    """Without them, the damped scene is the paper's, bit for bit."""
    undamped = damped.simulate(start_values={"support.d1": 0.0, "support.d2": 0.0}, stop_time=1.0)
    own = paper.simulate(stop_time=1.0)
    assert undamped.dtype == own.dtype
    assert np.array_equal(undamped, own)


def test_exact_package_of_a_scene_of_ones_own(damped):
    assert damped.description.modelName == damped.description.coSimulation.modelIdentifier == "damped"
    assert float(damped.variables["support.d1"].start) == 4.0
