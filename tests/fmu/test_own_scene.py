"""A scene of the user's own, packaged: the paper's rotor with dampers."""

import numpy as np
import project
import pytest

DAMPED = (project.ROOT / "scenes" / "paper.toml").read_text(encoding="utf-8").replace(
    "c2 = 500.0", "c2 = 500.0\nd1 = 4.0\nd2 = 0.5"
)


@pytest.fixture(scope="module")
def damped(package):
    return package("damped", DAMPED)


def test_exact_package_of_a_scene_of_ones_own(damped):
    assert damped.description.modelName == damped.description.coSimulation.modelIdentifier == "damped"
    assert float(damped.variables["support.d1"].start) == 4.0


def test_exact_dampers_can_be_switched_off(damped, paper):
    """Without them, the damped scene is the paper's, bit for bit."""
    undamped = damped.simulate(start_values={"support.d1": 0.0, "support.d2": 0.0}, stop_time=1.0)
    own = paper.simulate(stop_time=1.0)
    assert undamped.dtype == own.dtype
    assert np.array_equal(undamped, own)
