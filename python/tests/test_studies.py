"""Campbell diagram and response against closed forms, and that they are what the commands print."""

import numpy as np
import pytest

import split_rotor as sr


def test_exact_critical_speeds_of_the_turbo_rotor(turbo):
    campbell = sr.campbell(turbo)
    # Along its axis: one bearing, and the mass with that of the unbalance, which is part of the scene's.
    mass = 12.0
    axial = np.sqrt(1e6 / mass - (500.0 / (2.0 * mass)) ** 2)
    modes, critical = campbell.modes, campbell.critical_speeds
    assert len(critical.to_pandas()) == len(critical["speed_rad_s"]) and set(critical["held"]) == {""}
    once = critical["speed_rad_s"][(critical["order"] == 1.0) & (critical["direction"] == "axial")]
    assert once == pytest.approx([axial], rel=1e-9)
    assert set(modes) >= {"speed_rad_s", "mode", "frequency_rad_s", "damping_ratio", "direction"}
    assert len(modes["mode"]) == len(modes.to_pandas()) and len(campbell.thresholds) == 0
    assert str(campbell).startswith("turbo: ") and f"| {axial:.3f} |" in str(campbell)


def test_speeds_steps_and_orders_are_those_of_the_call(turbo):
    campbell = sr.campbell(turbo, speeds=(100.0, 400.0), steps=4, orders=[1.0])
    assert sorted(set(campbell.modes["speed_rad_s"])) == [100.0, 200.0, 300.0, 400.0]
    assert set(campbell.critical_speeds["order"]) == {1.0}
    with pytest.raises(RuntimeError, match="the second must be more than the first"):
        sr.campbell(turbo, speeds=(400.0, 100.0))


def test_a_threshold_of_stability_is_found():
    thresholds = sr.campbell(sr.Scene.named("unstable_whirl")).thresholds
    assert len(thresholds["speed_rad_s"]) > 0


def test_a_body_that_is_not_symmetric_has_its_own_view():
    campbell = sr.campbell(sr.Scene.named("jeffcott").with_values({}), steps=11)
    assert isinstance(campbell.thresholds, sr.Columns)
    campbell = sr.campbell(sr.Scene.named("dzhanibekov"), steps=11)
    assert campbell.thresholds.ndim == 1 and set(campbell.modes["direction"]) == {"floquet"}


def test_a_tighter_tolerance_costs_more_and_errs_less():
    accuracy = sr.accuracy(sr.Scene.named("paper").with_values({"experiment.stop": 0.5}))
    rows = accuracy.rows
    errors = [rows["error"][(rows["method"] == "dop853") & (rows["value"] == value)].item() for value in [1e-4, 1e-8]]
    assert errors[1] < 1e-2 * errors[0]
    assert {"dopri5", "dop853", "symplectic", "stiff", "taylor", "auto"} == set(rows["method"])
    assert np.nanmin(rows["cpu_time_s"]) > 0.0 and accuracy.sentences and "| error of at most |" in str(accuracy)


def test_response_far_above_is_the_offset_of_the_mass_centre():
    response = sr.response(sr.Scene.named("jeffcott"), linear=True)
    linear = response.linear
    assert len(response.nonlinear) == 0 and {"speed_rad_s", "station", "major_m"} <= set(linear)
    of_c = linear["station"] == "c"
    assert linear["major_m"][of_c].max() > 3.0 * linear["major_m"][of_c][-1], "it passes a resonance"
    with pytest.raises(RuntimeError, match="nothing is out of balance"):
        sr.response(sr.Scene.named("paper"))
