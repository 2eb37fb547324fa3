"""Runs: the bits of the FMU, at the points and of the outputs that were asked for."""

import os
import signal
import threading

import fmpy
import numpy as np
import pytest

import split_rotor as sr


@pytest.mark.parametrize("name", ["paper", "rubbing", "run_up"])
def test_exact_bits_of_the_packaged_fmu(name, built, tmp_path):
    scene = sr.Scene.named(name)
    result = sr.run(scene)
    step = float(fmpy.read_model_description(built(name)).defaultExperiment.stepSize)
    for path in [built(name), sr.package(scene, tmp_path / f"{name}.fmu")]:
        of_fmu = fmpy.simulate_fmu(path, output_interval=step)
        assert of_fmu.dtype.names == ("time", *result)
        assert np.array_equal(of_fmu["time"], result.time)
        for output in result:
            assert np.array_equal(of_fmu[output], result[output]), output


def test_exact_bits_with_an_input_that_a_host_sets(turbo, tmp_path):
    result = sr.run(turbo, inputs={"drive.tau": ([0.0, 0.1, 0.1], [20.0, 20.0, -5.0])}, stop=0.2, step=0.01)
    unpacked = fmpy.extract(sr.package(turbo, tmp_path / "turbo.fmu"))
    description = fmpy.read_model_description(unpacked)
    references = {variable.name: variable.valueReference for variable in description.modelVariables}
    fmu = fmpy.fmi2.FMU2Slave(
        guid=description.guid, unzipDirectory=unpacked, modelIdentifier="turbo", instanceName="turbo"
    )
    fmu.instantiate()
    tau = [references["drive.tau"]]
    # an FMU judges what is exchanged; a run that knows its inputs beforehand exchanges nothing
    assert not result["drive.energy_error"].any()
    outputs = [name for name in result if name != "drive.energy_error"]
    fmu.setReal(tau, [20.0])
    fmu.setupExperiment(startTime=0.0, stopTime=0.2)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    for n, t in enumerate(result.time[1:], start=1):
        if n == 11:
            fmu.setReal(tau, [-5.0])
        fmu.doStep(result.time[n - 1], t - result.time[n - 1])
        seen = fmu.getReal([references[name] for name in outputs])
        assert seen == [result[name][n] for name in outputs]
    fmu.terminate()
    fmu.freeInstance()


def test_inputs_stop_step_and_outputs_are_those_of_the_call(turbo):
    outputs = ["probe[1].r.y", "omega_phi"]
    result = sr.run(turbo, inputs={"drive.tau": 8.0}, outputs=outputs, stop=0.5, step=0.125, tolerance=1e-10)
    assert list(result) == outputs and result.time.tolist() == [0.0, 0.125, 0.25, 0.375, 0.5]
    # the unbalance's 4e-5 kg.m times the radius of gyration adds to 0.04 kg.m2
    inertia = 0.04 + 4e-5 * np.sqrt(0.04 / 12.0)
    assert result["omega_phi"] == pytest.approx(8.0 * result.time / inertia, rel=1e-4, abs=1e-9)
    whole = sr.run(turbo, inputs={"drive.tau": 8.0}, stop=0.5, step=0.125, tolerance=1e-10)
    assert all(np.array_equal(whole[name], result[name]) for name in outputs)


def test_methods_agree_within_their_tolerances():
    scene = sr.Scene.named("paper")
    results = [sr.run(scene, method=method, tolerance=1e-11, stop=1.0) for method in ["taylor", "dop853"]]
    assert [result.solver["method"] for result in results] == ["taylor", "dop853"]
    first, second = (result["r_c.x"] for result in results)
    assert not np.array_equal(first, second) and np.abs(first - second).max() < 1e-7  # measured: below 1e-9 m


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"outputs": ["r_c.q"]}, "has no output `r_c.q`: did you mean `r_c.x`"),
        ({"inputs": {"drive.tua": 1.0}}, "did you mean `drive.tau`?"),
        ({"inputs": {"drive.tau": ([0.0, 1.0], [1.0])}}, "has 2 times and 1 values"),
        ({"inputs": {"drive.tau": ([1.0, 0.0], [1.0, 1.0])}}, "times must not descend"),
        ({"inputs": {"drive.tau": float("inf")}}, "it must be a finite number"),
        ({"step": -1.0}, "experiment.step = -1.0 is not possible"),
        ({"method": "euler"}, "unknown solver.method `euler`"),
    ],
)
def test_what_cannot_be_asked_for_is_told(turbo, options, told):
    with pytest.raises(sr.SceneError) as error:
        sr.run(turbo, **options)
    assert told in str(error.value)


def test_a_run_that_ends_early_keeps_what_was_reached():
    # It tumbles, held by next to no spring, whose law ends at 3.1 rad.
    values = {"start.omega.x": 0.0, "start.omega.y": 4.9, "gravity.g.z": 0.0, "support.c1": 0.0, "support.c2": 1e-300}
    scene = sr.Scene.named("paper").with_values(values)
    with pytest.raises(sr.RunError, match=r"the tilt \|gamma\| reaches 3.1 rad") as ended, pytest.warns(UserWarning, match="pi/2"):
        sr.run(scene)
    result = ended.value.result
    assert result.time[-1] == pytest.approx(3.1 / 4.9, abs=1e-9) and len(result["r_c.x"]) == len(result.time) == 65


WHIRL = """
[rotor]
m = 2.0
Ja = 0.02
Jt = 0.03
[start]
r_c.y = 12e-6
v_c.y = 1e-3
[[effects.bearing]]
position = 0.0
kyy = 8e4
kzz = 8e4
kt = 1e3
[[effects.probe]]
position = 0.1
[experiment]
tolerance = 1e-9
stop = 0.07
step = 0.0142
"""


def test_exact_largest_deflections_do_not_depend_on_the_samples():
    # 200 rad/s, sampled 2.2 times in a period
    result = sr.run(sr.Scene.from_toml(WHIRL), outputs=["r_c.y"])
    assert list(result.deflections) == ["r_c", "probe[1]"]
    for deflection in result.deflections.values():
        assert deflection.largest == pytest.approx(13e-6, rel=1e-7)
        assert np.tan(200.0 * deflection.at) == pytest.approx(5.0 / 12.0, abs=1e-3)
    assert np.abs(result["r_c.y"]).max() < 12.99e-6
    assert str(result.deflections["r_c"]).startswith("13 µm at 0.0")


def test_regress_a_run_that_diverges_ends_and_keeps_what_was_reached():
    scene = sr.Scene.from_toml(WHIRL).with_values({"bearing[1].kyy": -8e4, "experiment.stop": 100.0})
    with pytest.raises(sr.RunError, match="the motion diverges: at t = .* s the rotor is .* m off") as ended, pytest.warns(UserWarning, match="unstable"):
        sr.run(scene)
    result = ended.value.result
    assert 0.1 < result.time[-1] < 0.3 and np.isfinite(result["r_c.y"]).all()


def test_what_the_fmu_would_warn_of_is_a_warning():
    with pytest.warns(UserWarning, match="the rotor is unstable: small motions about its state at t = "):
        result = sr.run(sr.Scene.named("unstable_whirl"))
    assert any("unstable" in words for words in result.log)


def test_others_run_meanwhile_and_end_it():
    # The timer needs Python's lock while the run goes on.
    threading.Timer(0.2, os.kill, [os.getpid(), signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        sr.run(sr.Scene.named("paper"), outputs=["phi"], stop=3e4, step=1.0)


def test_results_become_tables_with_units(turbo):
    result = sr.run(turbo, outputs=["omega_phi", "r_c.y"], stop=0.1)
    frame, dataset = result.to_pandas(), result.to_xarray()
    assert frame.index.name == "time" and list(frame) == ["omega_phi", "r_c.y"]
    assert np.array_equal(frame["r_c.y"], result["r_c.y"]) and frame.attrs["units"] == {"omega_phi": "rad/s", "r_c.y": "m"}
    assert dataset["omega_phi"].attrs["units"] == "rad/s" and dataset["time"].attrs["units"] == "s"
    assert np.array_equal(dataset["r_c.y"], result["r_c.y"]) and np.array_equal(dataset["time"], result.time)
