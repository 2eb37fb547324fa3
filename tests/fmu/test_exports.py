"""The 44 functions of FMI 2.0 that the library of every scene exports, and what those of optional things refuse."""

import ctypes

import pytest
from fmpy.fmi2 import FMU2Model, FMU2Slave
from host import ERROR, MODEL_EXCHANGE

FUNCTIONS = """
    fmi2GetTypesPlatform fmi2GetVersion fmi2SetDebugLogging fmi2Instantiate fmi2FreeInstance fmi2SetupExperiment
    fmi2EnterInitializationMode fmi2ExitInitializationMode fmi2Terminate fmi2Reset
    fmi2GetReal fmi2GetInteger fmi2GetBoolean fmi2GetString fmi2SetReal fmi2SetInteger fmi2SetBoolean fmi2SetString
    fmi2GetFMUstate fmi2SetFMUstate fmi2FreeFMUstate
    fmi2SerializedFMUstateSize fmi2SerializeFMUstate fmi2DeSerializeFMUstate fmi2GetDirectionalDerivative
    fmi2EnterEventMode fmi2NewDiscreteStates fmi2EnterContinuousTimeMode fmi2CompletedIntegratorStep fmi2SetTime
    fmi2SetContinuousStates fmi2GetDerivatives fmi2GetEventIndicators fmi2GetContinuousStates
    fmi2GetNominalsOfContinuousStates
    fmi2SetRealInputDerivatives fmi2GetRealOutputDerivatives fmi2DoStep fmi2CancelStep
    fmi2GetStatus fmi2GetRealStatus fmi2GetIntegerStatus fmi2GetBooleanStatus fmi2GetStringStatus
""".split()
WITHOUT_INSTANCE = {"fmi2GetTypesPlatform", "fmi2GetVersion", "fmi2Instantiate", "fmi2FreeInstance"}
"""Those to which null is no bad instance."""


@pytest.fixture
def host(paper):
    with paper.host() as host:
        yield host.start()


def test_exact_all_functions_are_exported(fmu):
    assert len(FUNCTIONS) == 44
    known = {name for kind in (FMU2Slave, FMU2Model) for name in dir(kind) if name.startswith("fmi2")}
    assert known == set(FUNCTIONS)
    with fmu.host() as host:
        assert [name for name in FUNCTIONS if not hasattr(host.slave.dll, name)] == []
        assert not hasattr(host.slave.dll, "fmi2NoSuchFunction")


def test_exact_platform_and_version(host):
    assert (host.slave.getTypesPlatform(), host.slave.getVersion()) == ("default", "2.0")


R_C_X = "r_c.x (value reference 768)"
STATE = "state.r.x (value reference 1280)"
MASS = "rotor.m (value reference 0)"


@pytest.mark.parametrize(
    "call, arguments, reason",
    [
        ("deSerializeFMUstate", (b"state",),
         "fmi2DeSerializeFMUstate: the bytes are not a serialized state of a split-rotor FMU"),
        ("getDirectionalDerivative", ([768], [0], [1.0]),
         f"fmi2GetDirectionalDerivative: {MASS} is no known: inputs and states are"),
        ("getDirectionalDerivative", ([0], [1280], [1.0]),
         f"fmi2GetDirectionalDerivative: {MASS} is no unknown: outputs, states and derivatives are"),
        ("getDirectionalDerivative", ([768], [1280], [float("nan")]),
         f"fmi2GetDirectionalDerivative: the seed NaN of {STATE} must be a finite number"),
        ("getRealOutputDerivatives", ([768], [2]),
         f"fmi2GetRealOutputDerivatives: order = 2 of {R_C_X} must be 1, maxOutputDerivativeOrder"),
        ("getRealOutputDerivatives", ([1280], [1]), f"fmi2GetRealOutputDerivatives: {STATE} is not an output"),
        ("setRealInputDerivatives", ([768], [1], [0.0]), f"fmi2SetRealInputDerivatives: {R_C_X} is not an input"),
        ("cancelStep", (), "fmi2CancelStep: no step is asynchronous, so none can be cancelled"),
    ],
)
def test_exact_what_cannot_be_is_refused(host, call, arguments, reason):
    before = host.outputs()
    assert host.refused(call, *arguments) == reason
    assert host.outputs() == before


@pytest.mark.parametrize("name", sorted(set(FUNCTIONS) - WITHOUT_INSTANCE))
def test_exact_a_null_instance_is_refused(paper, name):
    """Its other arguments are zeros here."""
    library = ctypes.CDLL(next((paper.directory / "binaries").glob("*/*")))
    zeros = [ctypes.c_void_p()] * 8
    assert getattr(library, name)(*zeros) == ERROR


def test_exact_functions_of_the_other_kind_are_refused(paper, host):
    with paper.host(kind=MODEL_EXCHANGE) as exchange:
        exchange.start()
        for of, name, this, right in (
            (exchange, "fmi2CancelStep", "model exchange", "co-simulation"),
            (host, "fmi2EnterEventMode", "co-simulation", "model exchange"),
        ):
            assert getattr(of.slave.dll, name)(ctypes.c_void_p(of.slave.component)) == ERROR
            assert of.log[-1].text == f"{name}: not legal of an instance for {this}: instantiate for {right}"


def test_exact_an_unknown_kind_is_refused(paper):
    with paper.host(kind=2) as host:
        assert host.slave.component is None
        reason = "fmi2Instantiate: fmuType = 2 must be fmi2ModelExchange (0) or fmi2CoSimulation (1)"
        assert host.log == [(ERROR, "logStatusError", reason, "instance")]
