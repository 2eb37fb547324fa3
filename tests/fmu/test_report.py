"""The report as a browser shows it, and the numbers that it takes from a run, against motions that are known."""

import json
import subprocess
import sys

import browser
import numpy as np
import project
import pytest

try:
    import tomllib
except ModuleNotFoundError:  # Python 3.10, where pytest brings it
    import tomli as tomllib

PYTHON = project.ROOT / "xtask" / "python"
WIDTHS = (1280, 400)  # [px]
LEAST = 150  # coloured pixels of a picture, measured 192 at least; dots at the ends of a path that is not there have 100
LARGEST = 3_000_000  # [bytes]

needs_browser = pytest.mark.skipif(browser.CHROMIUM is None, reason=browser.MISSING)


@pytest.fixture(scope="session")
def demo(fmus, xtask, tmp_path_factory):
    """Makes a scene's report, with its linear view where it has one; its path. Each is made once."""
    made = {}

    def make(scene):
        if scene not in made:
            out = tmp_path_factory.mktemp("reports") / scene
            done = xtask("campbell", scene)
            campbell = project.ROOT / "target" / "campbell" / scene / "campbell.json"
            view = ["--no-linear", done.stderr] if done.returncode else ["--linear", campbell]
            command = [sys.executable, PYTHON / "demo.py", fmus[scene].path, "--out", out, "--inputs", _inputs(scene), *view]
            done = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
            assert (done.returncode, done.stderr) == (0, "")
            made[scene] = out / "report.html"
        return made[scene]

    return make


def _inputs(scene):
    """The inputs over time of a scene, as the command hands them on."""
    text = (project.ROOT / "scenes" / f"{scene}.toml").read_text(encoding="utf-8")
    return json.dumps(tomllib.loads(text).get("input", []))


def _shows(page, folder):
    for width in WIDTHS:
        found = browser.look(page, width, folder)
        assert found["faults"] == []
        assert found["width"] == width and found["scrolls"] <= width, "no scrolling sideways"
        empty = [title for title, counts in zip(found["titles"], found["canvases"], strict=True) if min(counts, default=0) < LEAST]
        assert empty == [] and all(found["titles"])
        assert all(count is None or count > LEAST for count in found["time"]), "the slider moves the drawings"
        assert found["exaggeration"] > LEAST and found["plays"]
        assert found["paper"] == ["rgb(255, 255, 255)", 680] and min(found["printed"]) >= LEAST


@needs_browser
def test_report_shows_itself_and_moves(demo, tmp_path):
    _shows(demo("paper"), tmp_path)


@pytest.mark.long
@pytest.mark.parametrize("scene", project.SCENES)
def test_report_of_every_scene_shows_itself_and_moves(demo, scene, tmp_path):
    if browser.CHROMIUM is None:
        pytest.fail(browser.MISSING, pytrace=False)
    assert demo(scene).stat().st_size <= LARGEST
    _shows(demo(scene), tmp_path)


def test_report_says_why_it_has_no_linear_view(demo):
    page = demo("rubbing").read_text(encoding="utf-8")
    assert "No critical speeds and no Campbell diagram: " in page and "at 0 rad/s nothing balances" in page
    assert "critical speeds (1×)" not in page and '"Campbell diagram"' not in page


def test_report_begins_with_what_the_linear_view_found(demo):
    page = demo("film_bearings").read_text(encoding="utf-8")
    assert "1\u202f963 · 2\u202f320 · 3\u202f223 · 3\u202f368\u00a0rpm" in page  # 205.6, 242.9, 337.5 and 352.7 rad/s
    assert '<dd class="good">stable</dd>' in page
    assert '"title":"Campbell diagram"' in page


@pytest.fixture
def folder(fmus, demo, tmp_path):
    """As `cargo xtask run` leaves a run: the description and the result."""
    xml = (fmus["paper"].directory / "modelDescription.xml").read_bytes()
    (tmp_path / "modelDescription.xml").write_bytes(xml)
    (tmp_path / "result.csv").write_bytes((demo("paper").parent / "trajectory.csv").read_bytes())
    return tmp_path


def _report(folder):
    return subprocess.run([sys.executable, PYTHON / "run.py", folder], capture_output=True, encoding="utf-8", check=False)


def test_a_run_without_an_fmu_is_reported_alike(folder, demo):
    done = _report(folder)
    assert (done.returncode, done.stderr) == (0, "")
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "0.0693 % at 2.7 s" in page, "the largest of samples 0.01 s apart"
    assert "exact: 499.977124 rad" in page
    assert "CPU time" not in page and "CPU time" in demo("paper").read_text(encoding="utf-8")


def test_report_says_why_it_has_no_orbits(demo, fmus, tmp_path):
    """At the steps of its experiment a run-up has too few samples; at those of the demo it has enough."""
    scene = fmus["film_bearings"]
    (tmp_path / "modelDescription.xml").write_bytes((scene.directory / "modelDescription.xml").read_bytes())
    (tmp_path / "result.csv").write_bytes((demo("film_bearings").parent / "trajectory.csv").read_bytes())
    assert _report(tmp_path).returncode == 0
    pages = [path.read_text(encoding="utf-8") for path in (tmp_path / "report.html", demo("film_bearings"))]
    said = "No orbits, paths and frequencies: they need 6 samples a turn, and the fastest has 1.9: make experiment.step smaller."
    assert [said in page for page in pages] == [True, False]
    assert ['"title":"Orbits"' in page for page in pages] == [False, True]


def test_a_folder_without_a_run_is_an_error(folder):
    text = (folder / "result.csv").read_text(encoding="utf-8")
    for wrong, reason in (
        (text.replace("energy.residual", "energy.rest"), "no column energy.residual"),
        (text.split("\n")[0] + "\n", "at least two rows are needed"),
        (text[: len(text) // 2].rsplit(",", 1)[0], "all as long as the header"),
        (text.replace("0.01,", "a word,", 1), "could not convert string to float: 'a word'"),
    ):
        (folder / "result.csv").write_text(wrong, encoding="utf-8")
        done = _report(folder)
        assert done.returncode == 1
        assert done.stderr.startswith(f"error: {folder}") and reason in done.stderr and done.stderr.count("\n") == 1
    (folder / "result.csv").unlink()
    assert "No such file" in _report(folder).stderr


@pytest.fixture
def report(monkeypatch):
    """The report's modules."""
    monkeypatch.syspath_prepend(str(PYTHON))
    import report.linear
    import report.machine
    import report.measure
    import report.pack
    import report.spectrum
    import report.stations
    import report.turns

    return report


FORWARD, BACKWARD, LAG, SAG = 3e-5, 1e-5, 0.7, 2e-4  # [m], [m], [rad], [m]


def whirling(speed, per_turn, sense=1.0):
    """A run of 40 turns on an orbit with these parts, at this speed [rad/s]; c whirls, the axis stays upright."""
    time = np.linspace(0.0, 40.0 * 2.0 * np.pi / speed, 40 * per_turn + 1)
    phi = sense * speed * time
    forward, backward = FORWARD * np.exp(1j * (phi - sense * LAG)), BACKWARD * np.exp(-1j * phi)
    offset, rate = forward + backward - 1j * SAG, 1j * sense * speed * (forward - backward)
    names = ["time", "phi", *(f"{v}.{c}" for v in ("r_c", "v_c", "axis", "omega") for c in "xyz")]
    columns = np.zeros(len(time), dtype=[(name, float) for name in names])
    columns["time"], columns["phi"], columns["axis.x"], columns["omega.x"] = time, phi, 1.0, sense * speed
    columns["r_c.y"], columns["r_c.z"], columns["v_c.y"], columns["v_c.z"] = offset.real, offset.imag, rate.real, rate.imag
    return columns


CUBIC = 5e-4  # of the amplitude, at 12 samples a turn; measured 2e-4


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_exact_turns_take_a_whirl_apart(report, sense):
    from report.stations import Station

    turns = report.turns.turns(Station("c", 0.0), whirling(300.0, 12, sense))
    assert len(turns.time) == 40 and turns.speed == pytest.approx(np.full(40, 300.0))
    assert turns.order(1) == pytest.approx(np.full(40, FORWARD * np.exp(-1j * LAG)), abs=CUBIC * FORWARD)
    assert np.abs(turns.order(-1)) == pytest.approx(np.full(40, BACKWARD), abs=CUBIC * FORWARD)
    assert turns.whirl == pytest.approx(np.full(40, FORWARD + BACKWARD), rel=2e-3)  # at one of 64 angles
    assert turns.synchronous()[-1].all()
    assert report.turns.turns(Station("c", 0.0), whirling(300.0, 5, sense)) is None, "too few samples"
    # Where it turned back a little before, and does once more at the end, what lies between is looked at.
    whole = whirling(300.0, 12, sense)
    before, after = whole[6:0:-1].copy(), whole[-2:-8:-1].copy()
    before["time"], after["time"] = -before["time"], 2.0 * whole["time"][-1] - after["time"]
    again = report.turns.turns(Station("c", 0.0), np.concatenate([before, whole, after]))
    assert np.array_equal(again.offset, turns.offset) and np.array_equal(again.time, turns.time)


def test_exact_another_whirl_does_not_pass_for_one_that_goes_round_with_the_rotor(report):
    from report.stations import Station

    columns = whirling(300.0, 12)
    # Seen from a rotor that turns by a quarter faster, the same motion goes round 0.8 times a turn.
    columns["phi"] *= 1.25
    turns = report.turns.turns(Station("c", 0.0), columns)
    assert np.abs(turns.order(1)).min() > 0.5 * FORWARD and not turns.synchronous()[-1].any()


def test_exact_energy_adds_up_but_for_rounding(report):
    names = [f"energy.{name}" for name in ("kinetic", "potential", "supplied", "dissipated", "residual")]
    columns = np.zeros(3, dtype=[(name, float) for name in names])
    columns["energy.potential"] = -3.6e-3
    for residual, holds in ((8.7e-19, True), (1e-16, False)):
        columns["energy.residual"] = residual
        assert report.measure.energy_balance(columns, 1e-8).holds == holds


def test_exact_samples_follow_a_motion_or_do_not(report):
    assert report.stations.is_followed(whirling(300.0, 12))
    assert not report.stations.is_followed(whirling(300.0, 3))
    assert not report.stations.is_followed(whirling(300.0, 40)[::40]), "a turn apart it seems to stand"


def test_exact_stations_move_with_the_axis(report):
    from report.stations import Station

    columns = whirling(300.0, 12)
    lean, rate = 0.01, 300.0
    columns["axis.y"] = lean * np.cos(columns["phi"])
    columns["axis.z"] = lean * np.sin(columns["phi"])
    # ω × t = dt/dt of an axis that cones at the spin; its part along t does not matter.
    columns["omega.x"] = rate
    station = Station("probe[1]", 0.3)
    offset, velocity = station.offset(columns), station.velocity(columns)
    differences = np.gradient(offset, columns["time"], edge_order=2)
    assert velocity[1:-1] == pytest.approx(differences[1:-1], rel=0.05)  # of second order: (2π/12)²/6


def test_exact_spectrum_tells_forward_from_backward(report):
    columns = whirling(2.0 * np.pi * 50.0, 40)
    offset = columns["r_c.y"] + 1j * columns["r_c.z"]
    frequency, amplitude = report.spectrum.full(columns["time"], offset)
    for at, expected in ((50.0, FORWARD), (-50.0, BACKWARD)):
        near = np.abs(frequency - at) < 5.0
        assert amplitude[near].max() == pytest.approx(expected, rel=0.01)
        assert frequency[near][amplitude[near].argmax()] == pytest.approx(at, abs=1.0)
    _, rows, fall = report.spectrum.waterfall(columns["time"], offset, 120.0, 0.1)
    assert rows[fall.argmax(axis=0)] == pytest.approx(np.full(fall.shape[1], 50.0), abs=1.5)
    assert fall.max() == pytest.approx(FORWARD, rel=0.01)


def test_exact_body_has_the_mass_and_inertia_of_the_rotor(report, fmus):
    from report.scene import Scene

    for name in ("turbo", "paper", "dzhanibekov"):
        scene = Scene.of(fmus[name].description)
        body = report.machine._body(scene)
        m, length, corners = scene.value("rotor.m"), body["length"], np.array(body["outline"])
        if len(corners) == 4:
            y, z = np.ptp(corners, axis=0)
            found = [y**2 + z**2, length**2 + z**2, length**2 + y**2]
            expected = [scene.value(n) for n in ("rotor.Ja", "rotor.Jt", "asymmetry.Jt2")]
        else:
            found = [6.0 * body["radius"] ** 2, 3.0 * body["radius"] ** 2 + length**2]
            expected = [scene.value(n) for n in ("rotor.Ja", "rotor.Jt")]
        assert m / 12.0 * np.array(found) == pytest.approx(expected, rel=1e-4)  # outlines have six decimals


def test_exact_linear_view_leaves_out_what_no_unbalance_drives(report, xtask):
    assert xtask("campbell", "jeffcott").returncode == 0
    view = report.linear.read(project.ROOT / "target" / "campbell" / "jeffcott" / "campbell.json")
    critical = [crossing["speed_rad_s"] for crossing in view.critical]
    assert critical == pytest.approx([20.0 * np.sqrt(1.0 - 0.05**2)] * 2)
    assert {rows[0]["direction"] for _, rows in view.branches()} == {"forward", "backward"}
    assert report.linear.decrement(0.05) == pytest.approx(2.0 * np.pi * 0.05 / np.sqrt(1.0 - 0.05**2))
    assert np.isnan(report.linear.decrement(1.0))


def test_exact_growth_of_an_asymmetric_body_is_looked_for_at_all_speeds_of_a_run(report):
    rates = {100.0: -1.0, 1700.0: 3.0, 1800.0: 2.0, 2500.0: -2.0}
    modes = [{"speed_rad_s": speed, "mode": 1, "growth_rate_1_s": rate} for speed, rate in rates.items()]
    view = report.linear.Linear(modes, [], [(1581.0, "", 0), (2000.0, "", 0)], True, (1700.0, 1800.0))
    assert view.fastest_growth(0.0, 2100.0) == (1700.0, 3.0)
    assert view.fastest_growth(1750.0, 1750.0) == (1700.0, 3.0), "both are as near"
    assert view.fastest_growth(0.0, 50.0) == (100.0, -1.0)
    assert view.fastest_growth(2300.0, 2400.0) == (2500.0, -2.0)


def test_exact_thinned_curves_keep_their_extremes(report):
    curve = np.sin(np.linspace(0.0, 50.0, 100_000))
    curve[[12_345, 67_890]] = 5.0, -7.0
    kept = report.pack.extremes(curve)
    assert {0, 12_345, 67_890, 99_999} <= set(kept) and len(kept) < 2_000
    packed = report.pack.packed([1.0, np.nan, -2.5])
    values = [None if n is None else packed["from"] + packed["step"] * n for n in packed["whole"]]
    assert values[1] is None and [values[0], values[2]] == pytest.approx([1.0, -2.5])


def test_report_says_nothing_of_speeds_at_which_nobody_looked(demo):
    """The tumbling rotor's rate goes up to 9 550 rpm where it passes −e; its modes were looked for up to 0.716 rpm."""
    page = demo("tumbling").read_text(encoding="utf-8")
    assert "at 0.477\u00a0rpm to 0.716\u00a0rpm" in page
