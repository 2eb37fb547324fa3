"""Model exchange call by call: states, rates, nominals, and the events at which the chart changes."""

import math
from ctypes import c_double

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from host import DISCARD, MODEL_EXCHANGE, OK

ROUNDING = 3e-14  # of what is shown at a change of chart, relative to the larger of it and 1, measured 1.2e-14 (dzhanibekov)
REASON = "the tilt |gamma| reaches 3.1 rad, and a spring or torque that follows gamma (c2, tau) has no limit at pi"
REACH = (
    "|gamma| of the continuous states exceeds 3.1 rad, too far for their chart: complete a step earlier, so that an event "
    "can change it"
)


@pytest.fixture
def host(fmu):
    """An instance in continuous-time mode, somewhere."""
    with fmu.host(kind=MODEL_EXCHANGE) as host:
        host.start({"start.phi": 20.0, "start.gamma.z": 0.4, "start.v_c.y": 1.0}, startTime=1.0)
        host.slave.enterContinuousTimeMode()
        yield host


def names(host):
    """The states' names, in their order."""
    return [d.variable.derivative.name for d in host.fmu.description.derivatives]


def test_exact_states_and_rates_are_the_variables(host):
    assert host.states() == host.read(*names(host))
    assert host.rates() == host.read(*(f"der({name})" for name in names(host)))
    assert np.any(host.rates())


def test_exact_states_are_what_was_set(host):
    """To the bit, and before the next event no state is touched."""
    states = [x + 0.01 * i for i, x in enumerate(host.states())]
    host.set_states(states)
    assert host.states() == states == host.read(*names(host))
    host.slave.setTime(1.5)
    assert host.slave.completedIntegratorStep() == (False, False)
    assert host.states() == states


def test_exact_nominals(host):
    """They come from the scene, one length and one rate; phi and work count with 1."""
    nominals = dict(zip(names(host), host.nominals()))
    assert all(0.0 < nominal < float("inf") for nominal in nominals.values())
    radius = (float(host.variables["rotor.Jt"].start) / float(host.variables["rotor.m"].start)) ** 0.5
    assert nominals["state.r.y"] / nominals["state.gamma.y"] == pytest.approx(radius, rel=0.5)
    assert {nominal for name, nominal in nominals.items() if name.split(".")[1] in ("phi", "supplied", "dissipated")} == {1.0}


def test_exact_phi_begins_with_all_its_turns(host):
    """Where turns and remainder stand apart in co-simulation, the host integrates their sum."""
    assert host.states()[names(host).index("state.phi")] == pytest.approx(20.0, abs=1e-14)
    assert host.read("turns") == 3.0


def test_exact_the_solver_counts_nothing(host):
    solver = [name for name in host.variables if name.startswith("solver.") and host.variables[name].causality == "output"]
    assert host.read(*solver) == [0.0] * len(solver) and len(solver) == 5


def test_exact_there_are_no_event_indicators(host):
    assert host.fmu.description.numberOfEventIndicators == 0
    assert host.status("getEventIndicators", None, 0) == OK
    assert host.refused("getEventIndicators", None, 1) == (
        "fmi2GetEventIndicators: ni = 1 must be 0: there are no event indicators"
    )


def tilted(host, theta, azimuth=0.7):
    """The states with this γ [rad]."""
    states = dict(zip(names(host), host.states()))
    states |= {"state.gamma.y": theta * math.cos(azimuth), "state.gamma.z": theta * math.sin(azimuth)}
    return states.values()


NO_EVENT = (False, False, False, False, False, 0.0)
STATES_CHANGED = (False, False, False, True, False, 0.0)


def test_exact_a_chart_that_is_left_asks_for_an_event(host):
    shown = [name for name, v in host.variables.items() if v.causality == "output" and "solver" not in name]
    host.set_states(tilted(host, 1.99))
    assert host.slave.completedIntegratorStep() == (False, False)
    for chart in (2, 1, 2):
        host.set_states(tilted(host, 2.01))
        assert host.slave.completedIntegratorStep() == (True, False)
        before, states = np.array(host.read(*shown)), host.states()
        host.slave.enterEventMode()
        assert host.slave.newDiscreteStates() == STATES_CHANGED
        assert host.slave.newDiscreteStates() == NO_EVENT
        host.slave.enterContinuousTimeMode()
        assert host.slave.getInteger([host.reference("state.chart")]) == [chart]
        jump = np.abs(np.array(host.read(*shown)) - before) / np.maximum(1.0, np.abs(before))
        assert jump.max() <= ROUNDING, shown[jump.argmax()]
        changed = {name for name, old, new in zip(names(host), states, host.states()) if old != new}
        assert changed == {"state.gamma.y", "state.gamma.z", "state.phi"}


def test_exact_phi_counts_its_turns_from_step_to_step(host):
    """γ′ goes round −e eight times: φ = φ′ + 2β gains 16 turns, step by step, and back."""
    host.set_states(tilted(host, 2.01))
    host.slave.completedIntegratorStep()
    host.slave.enterEventMode()
    host.slave.newDiscreteStates()
    host.slave.enterContinuousTimeMode()
    host.set_states(tilted(host, 0.5, 0.0))
    host.slave.completedIntegratorStep()
    start = host.read("phi")
    for i in [*range(0, 101), *range(100, -1, -1)]:
        beta = i / 100.0 * 16.0 * math.pi
        host.set_states(tilted(host, 0.5, beta))
        assert host.read("phi") - start == pytest.approx(2.0 * beta, abs=1e-12)
        host.slave.completedIntegratorStep()
        assert host.read("phi") - start == pytest.approx(2.0 * beta, abs=1e-12)


def discarded(host, call, *arguments):
    """The one line that the call logs; it must return fmi2Discard."""
    before = len(host.log)
    with pytest.raises(FMICallException) as refused:
        call(*arguments)
    assert refused.value.status == DISCARD
    (message,) = host.log[before:]
    assert (message.status, message.category) == (DISCARD, "logStatusDiscard")
    return message.text


@pytest.mark.parametrize("wrong, shown", [(math.nan, "NaN"), (math.inf, "inf")])
def test_exact_a_state_that_is_no_number_is_discarded(host, wrong, shown):
    before = host.states()
    n = len(before)
    assert discarded(host, host.set_states, [*before[:-1], wrong]) == (
        f"fmi2SetContinuousStates: state {n} of {n} = {shown} must be a finite number"
    )
    assert host.states() == before


def test_exact_a_state_beyond_the_chart_is_discarded_and_may_be_left(host):
    """As an integrator tries it, too far: it then tries a shorter step."""
    there = list(tilted(host, 0.5))
    host.set_states(there)
    rates, outputs = host.rates(), host.outputs()
    host.set_states(tilted(host, 3.11))
    assert discarded(host, host.rates) == f"fmi2GetDerivatives: {REACH}"
    assert discarded(host, host.read, "phi") == f"fmi2GetReal: {REACH}"
    assert discarded(host, host.slave.completedIntegratorStep) == f"fmi2CompletedIntegratorStep: {REACH}"
    host.set_states(there)
    assert (host.rates(), host.outputs()) == (rates, outputs)


def test_exact_a_state_beyond_the_law_is_discarded(paper):
    """The spring c2 ends at 3.1 rad from e; without it the same state is a state as any other."""
    for stiffness, refused in ((500.0, True), (0.0, False)):
        with paper.host(kind=MODEL_EXCHANGE) as host:
            host.start({"start.gamma.y": 3.0, "support.c2": stiffness}).slave.enterContinuousTimeMode()
            host.set_states(tilted(host, math.pi - 3.11))
            if refused:
                assert discarded(host, host.rates) == f"fmi2GetDerivatives: {REASON}"
                host.set_states(tilted(host, math.pi - 3.09))
            assert np.all(np.isfinite(host.rates()))


def test_exact_a_wrong_number_of_states_is_refused(host):
    n = len(host.states())
    for method, function in (
        ("setContinuousStates", "fmi2SetContinuousStates"),
        ("getContinuousStates", "fmi2GetContinuousStates"),
        ("getDerivatives", "fmi2GetDerivatives"),
        ("getNominalsOfContinuousStates", "fmi2GetNominalsOfContinuousStates"),
    ):
        numbers = (c_double * (n + 1))()
        assert host.refused(method, numbers, n + 1) == (
            f"{function}: nx = {n + 1} must be {n}, the number of continuous states"
        )


@pytest.mark.parametrize(
    "calls, reason",
    [
        (["enterContinuousTimeMode", "enterContinuousTimeMode"],
         'fmi2EnterContinuousTimeMode: not legal in the state "continuous-time mode": call it in event mode, after '
         "fmi2ExitInitializationMode or fmi2EnterEventMode"),
        (["enterEventMode"],
         'fmi2EnterEventMode: not legal in the state "event mode": call fmi2EnterContinuousTimeMode first'),
        (["completedIntegratorStep"],
         'fmi2CompletedIntegratorStep: not legal in the state "event mode": call fmi2EnterContinuousTimeMode first'),
        (["enterContinuousTimeMode", "newDiscreteStates"],
         'fmi2NewDiscreteStates: not legal in the state "continuous-time mode": call it in event mode, after '
         "fmi2ExitInitializationMode or fmi2EnterEventMode"),
    ],
)
def test_exact_a_wrong_sequence_is_refused(paper, calls, reason):
    with paper.host(kind=MODEL_EXCHANGE) as host:
        host.start()
        for call in calls[:-1]:
            assert host.status(call) == OK
        assert host.refused(calls[-1]) == reason
