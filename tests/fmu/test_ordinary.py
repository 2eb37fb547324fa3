"""An ordinary machine at a host's ordinary settings, in the general FMU, by fmpy's CVode: 12 kg on two bearings with an
unbalance, run up from rest. By our own methods: model/tests/all/ordinary.rs."""

import numpy as np
import pytest

RUN_UP = {
    "effects.gravity": False,
    "effects.support": False,
    "effects.unbalance[1]": True,
    "unbalance[1].mass": 0.002,
    "unbalance[1].radius": 0.02,
    "effects.drive": True,
    "drive.tau": 24.0,
    "rotor.m": 12.0,
    "rotor.Ja": 0.04,
    "rotor.Jt": 0.12,
    "rotor.l": 0.0,
    "start.r_c.x": 0.0,
    "start.omega.x": 0.0,
}
for block, position in (("bearing[1]", -0.12), ("bearing[2]", 0.12)):
    values = {"position": position, "kyy": 2e7, "kzz": 1.5e7, "cyy": 2000.0, "czz": 2000.0}
    RUN_UP |= {f"effects.{block}": True} | {f"{block}.{name}": value for name, value in values.items()}
WHIRL, ENDS = 20.492464e-6, 3.3  # [m], [s]


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6])
def test_exact_largest_whirl_in_model_exchange(fmus, tolerance):
    """CVode takes the nominals of the states: with those of 1 m it would show nothing of 20 µm at 1e-4."""
    result = fmus["rotor"].simulate(
        start_values=RUN_UP, stop_time=ENDS, output_interval=1e-4, relative_tolerance=tolerance,
        output=["r_c.y", "r_c.z"], fmi_type="ModelExchange", solver="CVode",
    )
    assert np.hypot(result["r_c.y"], result["r_c.z"]).max() == pytest.approx(WHIRL, rel=0.05)
