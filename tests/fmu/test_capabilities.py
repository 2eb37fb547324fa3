"""The capability flags of the XML are all that INTERFACE.md promises, and what each promises is called."""

from ctypes import byref, c_size_t

import numpy as np
import pytest
from host import CO_SIMULATION, MODEL_EXCHANGE, OK

KINDS = {"ModelExchange": MODEL_EXCHANGE, "CoSimulation": CO_SIMULATION}
STEP = 0.01  # [s]


def started(fmu, kind):
    """An instance that is under way."""
    host = fmu.host(kind=kind).start()
    if kind == MODEL_EXCHANGE:
        host.slave.enterContinuousTimeMode()
    return host


def references(host, causality):
    return [v.valueReference for v in host.variables.values() if v.causality == causality and v.type == "Real"]


def saves_and_restores(host):
    saved = host.slave.getFMUstate()
    before = host.outputs()
    go_on(host)
    after = host.outputs()
    assert after != before
    host.slave.setFMUstate(saved)
    assert host.outputs() == before
    go_on(host)
    assert host.outputs() == after
    host.slave.freeFMUstate(saved)


def go_on(host):
    """Somewhere else."""
    if host.kind == CO_SIMULATION:
        assert host.step(0.0, STEP) == OK
    else:
        host.set_states(np.add(host.states(), 0.01))


def serializes(host):
    before = host.outputs()
    saved = host.slave.getFMUstate()
    size = c_size_t()
    host.slave.fmi2SerializedFMUstateSize(host.slave.component, saved, byref(size))
    written = host.slave.serializeFMUstate(saved)
    assert len(written) == size.value > 0
    go_on(host)
    read = host.slave.deSerializeFMUstate(written)
    host.slave.setFMUstate(read)
    assert host.outputs() == before
    for state in (saved, read):
        host.slave.freeFMUstate(state)


def differentiates(host):
    state = host.reference("state.v.x")
    rate = host.reference("der(state.r.x)")
    assert host.slave.getDirectionalDerivative([rate], [state], [3.0]) == [3.0]


def steps_by_any_length(host):
    time = 0.0
    for size in (0.1, 1e-4, 0.0317, 0.5):
        assert host.step(time, size) == OK
        time += size


def interpolates_inputs(host):
    inputs = references(host, "input")
    host.slave.setReal(inputs, [0.0] * len(inputs))
    for order in (1, 2):
        host.slave.setRealInputDerivatives(inputs, [order] * len(inputs), [4.0] * len(inputs))
    assert host.step(0.0, 0.5) == OK
    assert host.slave.getReal(inputs) == [0.5 * 4.0 + 0.125 * 4.0] * len(inputs)


def tells_output_derivatives(host):
    outputs = references(host, "output")
    assert np.all(np.isfinite(host.slave.getRealOutputDerivatives(outputs, [1] * len(outputs))))
    (rate,) = host.slave.getRealOutputDerivatives([host.reference("r_c.x")], [1])
    assert rate == host.read("v_c.x")


def needs_no_memory_functions(host):
    with host.fmu.host(kind=host.kind, memory_functions=False) as bare:
        assert bare.start().outputs() == host.outputs()


BOTH = {
    "canNotUseMemoryManagementFunctions": needs_no_memory_functions,
    "canGetAndSetFMUstate": saves_and_restores,
    "canSerializeFMUstate": serializes,
    "providesDirectionalDerivative": differentiates,
}
PROMISES = {
    "ModelExchange": BOTH,
    "CoSimulation": BOTH | {
        "canHandleVariableCommunicationStepSize": steps_by_any_length,
        "canInterpolateInputs": interpolates_inputs,
        "maxOutputDerivativeOrder": tells_output_derivatives,
    },
}


@pytest.mark.parametrize("kind, flag", [(kind, flag) for kind, flags in PROMISES.items() for flag in flags])
def test_fmi_a_claimed_capability_works(fmu, kind, flag):
    with started(fmu, KINDS[kind]) as host:
        PROMISES[kind][flag](host)


@pytest.mark.parametrize("kind", KINDS)
def test_fmi_what_works_is_claimed_and_nothing_else(fmu, kind):
    """What is false is the standard's default."""
    claimed = dict(fmu.xml.find(kind).attrib)
    assert claimed.pop("modelIdentifier") == fmu.scene
    assert claimed == {flag: "1" if flag == "maxOutputDerivativeOrder" else "true" for flag in PROMISES[kind]}
