"""The capability flags of the XML are all that docs/fmi.md promises. That what they promise works is tested call by call: in Rust
(tests/interface/state.rs, serialized.rs, derivatives.rs, stepping.rs, inputs.rs), and of each packaged FMU in C (tests/c)."""

import pytest

BOTH = [
    "canNotUseMemoryManagementFunctions", "canGetAndSetFMUstate", "canSerializeFMUstate", "providesDirectionalDerivative",
]
PROMISES = {
    "ModelExchange": BOTH,
    "CoSimulation": [*BOTH, "canHandleVariableCommunicationStepSize", "canInterpolateInputs", "maxOutputDerivativeOrder"],
}


@pytest.mark.parametrize("kind", PROMISES)
def test_fmi_what_works_is_claimed_and_nothing_else(fmu, kind):
    """What is false is the standard's default."""
    claimed = dict(fmu.xml.find(kind).attrib)
    assert claimed.pop("modelIdentifier") == fmu.scene
    assert claimed == {flag: "1" if flag == "maxOutputDerivativeOrder" else "true" for flag in PROMISES[kind]}
