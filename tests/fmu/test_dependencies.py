"""What ModelStructure says that a variable depends on, against what the packaged FMU does near its start.

All that has a derivative is listed; that nothing else is, at random motions, and what depends on parameters at the start,
model/tests/all/dependencies.rs and dependencies_of_draws.rs test of the lists that the XML is written from.
"""

import numpy as np
import project
import pytest
from host import MODEL_EXCHANGE

ROUNDING = 1e-12
ASKEW = {"start.gamma.y": 0.4, "start.gamma.z": -0.3, "start.omega.y": 2.0, "start.omega.z": 1.0, "start.v_c.y": 0.5}
"""A motion without symmetry."""


def names_of(fmu, *causalities):
    """The Real variables of these causalities."""
    return [v.name for v in fmu.description.modelVariables if v.causality in causalities and v.type == "Real"]


@pytest.fixture
def calculated(fmu):
    """The outputs, the states and their derivatives."""
    if fmu.scene in project.GENERAL:
        pytest.skip("its switches are tried in model/tests/all/dependencies.rs")
    return names_of(fmu, "output", "local")


@pytest.fixture
def observed_later(fmu, calculated):
    """The pairs (output or derivative, state or input) with a derivative of the first by the second."""
    states = [d.variable.derivative.name for d in fmu.description.derivatives]
    unknowns = [name for name in calculated if name not in states and name != "state.chart"]
    pairs = set()
    with fmu.host(kind=MODEL_EXCHANGE) as host:
        host.slave.setBoolean([host.reference("start.at_rest")], [False])
        host.start(ASKEW).slave.enterContinuousTimeMode()
        references = [host.reference(name) for name in unknowns]
        for name in states + names_of(fmu, "input"):
            column = host.slave.getDirectionalDerivative(references, [host.reference(name)], [1.0])
            pairs.update((unknowns[i], name) for i in np.flatnonzero(np.abs(column) > ROUNDING))
    return pairs


def listed(unknowns):
    """The pairs that modelDescription.xml lists."""
    return {(u.variable.name, v.name) for u in unknowns for v in u.dependencies}


def test_exact_dependencies_later(fmu, observed_later):
    assert observed_later
    in_xml = listed(fmu.description.outputs) | listed(fmu.description.derivatives)
    assert sorted(observed_later - in_xml) == [], "not listed"


def test_exact_positions_and_angles_depend_on_no_input(fmus):
    """Or a partner's solver would see an algebraic loop where there is none."""
    driven = fmus["driven"].description
    on_input = {u.variable.name for u in driven.outputs if "drive.tau" in [v.name for v in u.dependencies]}
    assert on_input == {"drive.a"}
    on_input = {u.variable.name for u in driven.derivatives if "drive.tau" in [v.name for v in u.dependencies]}
    assert on_input == {"der(state.K.x)", "der(state.K.y)", "der(state.K.z)", "der(state.supplied)"}
