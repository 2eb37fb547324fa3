"""The 44 functions of FMI 2.0 that the library of every scene exports, and what those do that are not there yet."""

import ctypes

import pytest
from fmpy.fmi2 import FMU2Model, FMU2Slave
from host import ERROR

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


@pytest.mark.parametrize(
    "call, arguments, reason",
    [
        ("serializeFMUstate", (None,), "fmi2SerializedFMUstateSize: the FMU state cannot be serialized yet: "
                                       "canSerializeFMUstate is false"),
        ("deSerializeFMUstate", (b"state",), "fmi2DeSerializeFMUstate: the FMU state cannot be serialized yet: "
                                             "canSerializeFMUstate is false"),
        ("getDirectionalDerivative", ([768], [0], [1.0]), "fmi2GetDirectionalDerivative: there are no directional "
                                                          "derivatives yet: providesDirectionalDerivative is false"),
        ("getRealOutputDerivatives", ([768], [1]), "fmi2GetRealOutputDerivatives: there are no output derivatives "
                                                   "yet: maxOutputDerivativeOrder is 0"),
        ("setRealInputDerivatives", ([0], [1], [0.0]), "fmi2SetRealInputDerivatives: this scene has no inputs"),
        ("cancelStep", (), "fmi2CancelStep: no step is asynchronous, so none can be cancelled"),
    ],
)
def test_exact_what_is_not_claimed_is_refused(host, call, arguments, reason):
    before = host.outputs()
    assert host.refused(call, *arguments) == reason
    assert host.outputs() == before


@pytest.mark.parametrize("name", sorted(set(FUNCTIONS) - WITHOUT_INSTANCE))
def test_exact_a_null_instance_is_refused(paper, name):
    """Its other arguments are zeros here."""
    library = ctypes.CDLL(next((paper.directory / "binaries").glob("*/*")))
    zeros = [ctypes.c_void_p()] * 8
    assert getattr(library, name)(*zeros) == ERROR


def test_exact_model_exchange_is_refused(paper):
    with paper.host(kind=0) as host:
        assert host.slave.component is None
        reason = "fmi2Instantiate: fmuType must be fmi2CoSimulation (1): there is no model exchange yet"
        assert host.log == [(ERROR, "logStatusError", reason, "instance")]
