//! The linear view: modes, critical speeds and thresholds against closed forms, and against other formulations.

use crate::harness::named::{Named, ROTOR};
use crate::harness::{largest, within};
use nalgebra::{Complex, ComplexField, DMatrix, Vector3};
use oracles::numerics::derivative;
use split_rotor_model::linear::{Campbell, Direction, Machine, Mode, Obstacle};

/// The machine of a scene.
fn machine(text: &str) -> Machine {
    Machine::of(Named::written(text).simulation.parameters()).unwrap_or_else(|obstacle| panic!("{obstacle}"))
}

fn modes(machine: &Machine, speed: f64) -> Vec<Mode> {
    machine.modes(speed, None).unwrap_or_else(|obstacle| panic!("{obstacle}")).1
}

/// Their frequencies [rad/s], negative where they whirl backward, ascending.
fn frequencies(modes: &[Mode]) -> Vec<f64> {
    let mut all: Vec<_> = modes.iter().map(Mode::frequency).collect();
    all.sort_by(f64::total_cmp);
    all
}

fn compare(what: &str, got: &[f64], expected: &[f64], bound: f64) {
    assert_eq!(got.len(), expected.len(), "{what}: {got:?}");
    within(what, largest(got.iter().zip(expected).map(|(a, b)| (a / b - 1.0).abs())), bound);
}

const SUPPORT: &str = "[effects.support]\nc1 = 2000.0\nc2 = 500.0\n";
const GRAVITY: &str = "[effects.gravity]\ng = { z = -9.81 }\n";

/// Frequencies against closed forms [1]: measured 7.3e-13.
const CLOSED: f64 = 3e-12;

#[test]
fn exact_whirl_of_the_papers_rotor() {
    let paper = machine(&format!("{ROTOR}[start]\nr_c = {{ x = 0.75 }}\n{SUPPORT}"));
    // The roots of (C1 − mΩ²)(C2 + l²C1 + JaωΩ − JtΩ²) = (C1 l)², and √(C1/m) along the axis.
    for speed in [0.5, 50.0, 3000.0] {
        let defect = |whirl: f64| {
            let (place, tilt) = (2000.0 - 5.0 * whirl * whirl, 500.0 + 0.75 * 0.75 * 2000.0);
            let turning = tilt + 0.15625 * speed * whirl - 0.078125 * whirl * whirl;
            let pull = 2000.0 * 0.75;
            (place * turning - pull * pull) / (place.abs() * (tilt + turning.abs()) + 1.0)
        };
        let all = modes(&paper, speed);
        let [axial, across]: [Vec<_>; 2] = [true, false]
            .map(|is_axial| all.iter().filter(|mode| (mode.direction == Direction::Axial) == is_axial).collect());
        assert_eq!((axial.len(), across.len()), (1, 4), "at {speed} rad/s");
        within("axial", (axial[0].frequency() / 20.0 - 1.0).abs(), CLOSED);
        let defects = across.iter().map(|mode| defect(mode.frequency()).abs());
        within("whirl", largest(defects), CLOSED);
    }
    let known = [-104.428_91, -10.344_007, 11.668_386, 20.0, 203.104_535];
    compare("at 50 rad/s", &frequencies(&modes(&paper, 50.0)), &known, 1e-7);
}

/// What is left of a small motion beside its lines, over its size [1]: measured 1.1e-13.
const SPECTRUM: f64 = 1e-12;

#[test]
fn exact_spectrum_of_a_small_motion() {
    let text = format!("{ROTOR}[start]\nr_c = {{ x = 0.75, y = 1e-7 }}\nomega = {{ x = 50.0, y = 1e-5 }}\n{SUPPORT}");
    let all = modes(&machine(&text), 50.0);
    let lines: Vec<_> = all.iter().filter(|mode| mode.direction != Direction::Axial).map(Mode::frequency).collect();
    let mut run = Named::written(&text);
    run.set("solver.relative_tolerance", 1e-13);
    run.start();
    const POINTS: usize = 400;
    let times: Vec<_> = (0..POINTS).map(|n| 0.011 * n as f64).collect();
    let mut place = |t: &f64| {
        run.simulation.advance(*t).expect("a calm run");
        Complex::new(run.get("r_c.y"), run.get("r_c.z"))
    };
    let seen = DMatrix::from_iterator(POINTS, 1, times.iter().map(&mut place));
    // y + iz = Σ a_k e^(iΩ_k t): the least squares of what is left.
    let waves = DMatrix::from_fn(POINTS, lines.len(), |n, k| polar(1.0, lines[k] * times[n]));
    let sizes = waves.clone().svd(true, true).solve(&seen, 1e-12).expect("both sides are there");
    within("beside the lines", (&waves * &sizes - &seen).norm() / seen.norm(), SPECTRUM);
    // Each of them is there.
    assert!(sizes.iter().all(|size| size.modulus() > 1e-5 * seen.norm() / 20.0), "{sizes}");
}

/// The paper's rotor in gravity as a spherical pendulum: rates of (r, v, t, dt/dt), K·t being S.
fn pendulum(y: &[f64; 12], s: f64) -> [f64; 12] {
    let vector = |first: usize| Vector3::new(y[first], y[first + 1], y[first + 2]);
    let [r, v, t, t_rate] = [0, 3, 6, 9].map(vector);
    let (m, jt, l, [c1, c2]) = (5.0, 0.078125, 0.75, [2000.0, 500.0]);
    let at_a = -c1 * (r - l * t);
    let across = Vector3::x().cross(&t);
    let gamma = across * (libm::atan2(across.norm(), t.x) / across.norm());
    let moment = -l * t.cross(&at_a) - c2 * gamma;
    // d²t/dt² = −|dt/dt|² t + (M × t + S t × dt/dt)/Jt
    let bent = -t_rate.norm_squared() * t + (moment.cross(&t) + s * t.cross(&t_rate)) / jt;
    let v_rate = at_a / m - 9.81 * Vector3::z();
    let mut rates = [0.0; 12];
    for (part, vector) in rates.chunks_exact_mut(3).zip([v, v_rate, t_rate, bent]) {
        part.copy_from_slice(vector.as_slice());
    }
    rates
}

#[test]
fn exact_whirl_about_the_sag() {
    let paper = machine(&format!("{ROTOR}[start]\nr_c = {{ x = 0.75 }}\n{SUPPORT}{GRAVITY}"));
    for speed in [5.0, 50.0, 500.0] {
        let (steady, modes) = paper.modes(speed, None).expect("it hangs in its springs");
        let mut at = [0.0; 12];
        at[..3].copy_from_slice(steady.r.as_slice());
        at[6..9].copy_from_slice(steady.axis.as_slice());
        let s = 0.15625 * speed;
        within("balance", largest(pendulum(&at, s).map(f64::abs)), 1e-11);
        let column = |n: usize| {
            derivative(|x| pendulum(&std::array::from_fn(|k| if k == n { x } else { at[k] }), s), at[n], 1e-2)
        };
        let columns: Vec<_> = (0..12).map(column).collect();
        let values = DMatrix::from_fn(12, 12, |row, column| columns[column][row]).complex_eigenvalues();
        for mode in &modes {
            let nearest = values.iter().map(|value| (value - mode.eigenvalue).modulus()).fold(f64::INFINITY, f64::min);
            within("whirl", nearest / mode.eigenvalue.modulus(), 2e-12);
        }
        assert_eq!(modes.len(), 5, "at {speed} rad/s");
    }
}

#[test]
fn literature_whirl_about_the_sag() {
    let paper = machine(&format!("{ROTOR}[start]\nr_c = {{ x = 0.75 }}\n{SUPPORT}{GRAVITY}"));
    let (steady, modes) = paper.modes(50.0, None).expect("it hangs in its springs");
    within("sag", (steady.gamma.norm() - 0.0734).abs(), 5e-5);
    let sizes: Vec<_> = modes.iter().map(|mode| mode.eigenvalue.im).collect();
    for known in [10.363, 11.684, 104.519, 203.198] {
        within("whirl", sizes.iter().map(|size| (size - known).abs()).fold(f64::INFINITY, f64::min), 1e-3);
    }
}

#[test]
fn exact_critical_speed_of_jeffcotts_rotor() {
    let text = "[rotor]\nm = 4.9\nJa = 0.15625\nJt = 0.078125\nl = 0.0\n[effects.support]\nc1 = 2000.0\nd1 = 0.0\n\
                [[effects.unbalance]]\nmass = 0.1\nradius = 0.1\nposition = 0.0\n[effects.imposed_speed]\nw = 20.0\n";
    let jeffcott = machine(text);
    let speeds: Vec<_> = (0..=10).map(|n| 5.0 * f64::from(n)).collect();
    let all = Campbell::of(&jeffcott, &speeds).expect("it is held");
    let critical = all.critical_speeds(1.0).expect("it is held");
    let mut directions: Vec<_> = critical.iter().map(|crossing| crossing.mode.direction.name()).collect();
    directions.sort_unstable();
    assert_eq!(directions, ["axial", "backward", "forward"], "springs that are the same in all directions");
    for crossing in critical {
        within("critical speed", (crossing.speed / 20.0 - 1.0).abs(), 1e-10);
    }
}

/// Unstable beyond 80 rad/s: ω_n (1 + c_ext/c_int).
const INNER: &str = "[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.0\n[effects.support]\nc1 = 2000.0\nc2 = 500.0\n\
                     d1 = 30.0\nd2 = 1.0\n[effects.rotating_damping]\nd = 10.0\n";

/// The rate [1/s] at which the whirl of a run at this speed [rad/s] grows between these times \[s].
fn growth_of_a_run(text: &str, speed: f64, [from, to]: [f64; 2]) -> f64 {
    let start = "[start]\nr_c = { y = 1e-6 }\n";
    let mut run = Named::written(&format!("{text}{start}[effects.imposed_speed]\nw = {speed}\n"));
    run.set("solver.relative_tolerance", 1e-12);
    run.start();
    let size = |t: f64| {
        run.simulation.advance(t).expect("a calm run");
        run.simulation.read().expect("a motion").motion.r_c().yz().norm()
    };
    let [early, late] = [from, to].map(size);
    libm::log(late / early) / (to - from)
}

#[test]
fn exact_threshold_of_rotating_damping() {
    let machine = machine(INNER);
    let speeds: Vec<_> = (0..=20).map(|n| 10.0 * f64::from(n)).collect();
    let all = Campbell::of(&machine, &speeds).expect("it is held");
    let thresholds = all.thresholds().expect("it is held");
    let [threshold] = &thresholds[..] else { panic!("{thresholds:?}") };
    within("threshold", (threshold.speed / 80.0 - 1.0).abs(), 1e-12);
    within("frequency", (threshold.mode.frequency() / 20.0 - 1.0).abs(), 1e-12);
    assert_eq!(threshold.mode.direction, Direction::Forward);
}

#[test]
fn exact_threshold_of_cross_coupling_from_a_table() {
    // m r̈ + c ṙ + (k − iq) r = 0 is at its threshold where q = c √(k/m); between inner nodes of one slope the table is a line.
    let (m, k, c): (f64, f64, f64) = (5.0, 2e5, 35.0);
    let nodes: Vec<_> = (0..6).map(|n| 100.0 * f64::from(n)).collect();
    let of = |value: &dyn Fn(f64) -> f64| format!("{:?}", nodes.iter().map(|speed| value(*speed)).collect::<Vec<_>>());
    let [stiff, damped] = [k, c].map(|constant| of(&|_| constant));
    let (kyz, kzy) = (of(&|speed| 40.0 * speed), of(&|speed| -40.0 * speed));
    let text = format!(
        "[rotor]\nm = {m}\nJa = 0.05\nJt = 0.08\n[[effects.bearing]]\nposition = 0.0\nkt = 800.0\nct = 1.0\nkxx = 1e5\ncxx = 10.0\n\
         speed = {nodes:?}\nkyy = {stiff}\nkzz = {stiff}\nkyz = {kyz}\nkzy = {kzy}\ncyy = {damped}\nczz = {damped}\n"
    );
    let machine = machine(&text);
    let whirl = (k / m).sqrt();
    let exact = c * whirl / 40.0;
    let speeds: Vec<_> = (0..=20).map(|n| 20.0 * f64::from(n)).collect();
    let thresholds = Campbell::of(&machine, &speeds).expect("it is held").thresholds().expect("it is held");
    let [threshold] = &thresholds[..] else { panic!("{thresholds:?}") };
    within("threshold", (threshold.speed / exact - 1.0).abs(), 1e-11);
    within("frequency", (threshold.mode.frequency() / whirl - 1.0).abs(), 1e-11);
    // A run decays below it and grows above, at the rate of the closed form.
    for (part, grows) in [(0.999, false), (1.001, true)] {
        let speed = part * exact;
        let seen = growth_of_a_run(&text, speed, [5.0, 25.0]);
        // λ = (−c + √(c² − 4m(k − iq)))/2m
        let root = Complex::new(c * c - 4.0 * m * k, 4.0 * m * 40.0 * speed).sqrt();
        let told = ((root - c) / (2.0 * m)).re;
        assert_eq!((told > 0.0, seen > 0.0), (grows, grows), "at {speed} rad/s");
        within("growth [1/s]", (seen - told).abs(), 1e-11);
    }
}

#[test]
fn exact_growth_of_a_run_on_either_side() {
    for (part, grows) in [(0.999, false), (1.001, true)] {
        let speed = part * 80.0;
        // What whirls backward has died out by then.
        let seen = growth_of_a_run(INNER, speed, [10.0, 110.0]);
        let modes = modes(&machine(INNER), speed);
        let forward = |mode: &&Mode| mode.direction == Direction::Forward && (mode.frequency() - 20.0).abs() < 0.1;
        let told = modes.iter().find(forward).expect("a forward whirl at 20 rad/s").eigenvalue.re;
        assert_eq!((told > 0.0, seen > 0.0), (grows, grows), "at {speed} rad/s");
        // Per second, of a mode that swings by 20 rad in it; the orbit is a circle.
        within("growth [1/s]", (seen - told).abs(), 1e-8);
    }
}

#[test]
fn what_nothing_holds_has_no_steady_state() {
    let text = format!("{ROTOR}{GRAVITY}");
    let machine = Machine::of(Named::written(&text).simulation.parameters()).expect("a machine");
    assert_eq!(machine.steady(10.0, None).err(), Some(Obstacle::NoSteadyState { speed: 10.0 }));
}

fn polar(size: f64, angle: f64) -> Complex<f64> {
    let (sine, cosine) = libm::sincos(angle);
    Complex::new(size * cosine, size * sine)
}

/// A response against a closed form, over its size there [1]: measured 1.5e-13.
const RESPONSE: f64 = 1e-12;

#[test]
fn exact_response_of_jeffcotts_rotor() {
    let (m, k, d, first) = (5.0, 2000.0, 10.0, 0.1 * 0.1);
    let text = format!(
        "[rotor]\nm = 4.9\nJa = 0.15625\nJt = 0.078125\nl = 0.0\n[effects.support]\nc1 = {k}\nc2 = 100.0\nd1 = {d}\n\
         [[effects.unbalance]]\nmass = 0.1\nradius = 0.1\nangle = 0.7\nposition = 0.0\n"
    );
    let jeffcott = machine(&text);
    for speed in [-35.0, 0.0, 1e-3, 5.0, 19.9, 20.0, 20.1, 40.0, 1e4] {
        let orbit = jeffcott.response(speed, None).expect("it is held").orbit(0.0);
        // (k − mω² + idω) Y = U ω² e^(iα)
        let square = speed * speed;
        let turned = polar(first * square, 0.7);
        let y = turned / Complex::new(k - m * square, d * speed);
        let z = y * Complex::new(0.0, -1.0);
        for (got, exact) in [(orbit.y, y), (orbit.z, z)] {
            within(&format!("at {speed} rad/s"), (got - exact).modulus(), RESPONSE * exact.modulus());
        }
        // A circle.
        within("half axis", (orbit.major() - y.modulus()).abs(), RESPONSE * y.modulus());
        assert!(orbit.minor() >= 0.0, "it runs with the spin");
    }
}

#[test]
fn exact_response_that_tilts() {
    // Springs in c, which the added mass leaves a little behind the mass centre; nothing damps, so y is in phase with the mass.
    let (mass, radius, place, [c1, c2]) = (0.02, 0.1, 0.3, [2000.0, 500.0]);
    let text = format!(
        "[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.0\n[effects.support]\nc1 = {c1}\nc2 = {c2}\n\
         [[effects.unbalance]]\nmass = {mass}\nradius = {radius}\nposition = {place}\n"
    );
    let machine = machine(&text);
    let m = 5.0 + mass;
    let centre = mass * place / m;
    let jt = 0.078125 + mass * place * place - m * centre * centre;
    for speed in [3.0, 15.0, 60.0, 400.0] {
        let square: f64 = speed * speed;
        // F = −c1 (r + a θ), M = −c2 θ + a F with a = −x_G
        let arm = -centre;
        let place_of = |r: f64, theta: f64| r + arm * theta;
        let first = mass * radius * square;
        let couple = first * (place - centre);
        // [c1 − mω², c1 a; c1 a, c2 + c1 a² − (Jt − Ja)ω²] (r, θ) = (U ω², W ω²)
        let [a, b, d] = [c1 - m * square, c1 * arm, c2 + c1 * arm * arm - (jt - 0.15625) * square];
        let determinant = a * d - b * b;
        let (r, theta) = ((d * first - b * couple) / determinant, (a * couple - b * first) / determinant);
        let response = machine.response(speed, None).expect("it is held");
        for position in [-0.4, 0.0, 0.5] {
            let exact = place_of(r, theta) + position * theta;
            let orbit = response.orbit(position);
            let size = r.abs() + theta.abs();
            within("y", (orbit.y - Complex::from(exact)).modulus() / size, 1e-11);
            within("z", (orbit.z - Complex::new(0.0, -exact)).modulus() / size, 1e-11);
        }
    }
}

#[test]
fn exact_response_of_a_run() {
    // A small unbalance, bearings that are not the same across, and a sag: what the run does once its start has died out.
    let speed = 120.0;
    let text = "[rotor]\nm = 5.0\nJa = 0.05\nJt = 0.08\nl = 0.0\n[effects.gravity]\ng = { x = -3.0, z = -9.81 }\n\
                [[effects.bearing]]\nposition = -0.2\nkyy = 2e5\nkzz = 1e5\nkyz = 1e4\nkzy = 1e4\ncyy = 400.0\nczz = 300.0\nkxx = 1e5\ncxx = 300.0\n\
                [[effects.bearing]]\nposition = 0.3\nkyy = 1e5\nkzz = 2e5\ncyy = 300.0\nczz = 400.0\n\
                [[effects.unbalance]]\nmass = 1e-3\nradius = 1e-3\nangle = 0.4\nposition = 0.1\n\
                [[effects.probe]]\nposition = 0.25\n";
    let orbit = machine(text).response(speed, None).expect("it is held").orbit(0.25);
    let mut run = Named::written(&format!("{text}[effects.imposed_speed]\nw = {speed}\n"));
    run.set("solver.relative_tolerance", 1e-12);
    run.start();
    // The first harmonic over a revolution.
    const POINTS: u32 = 64;
    let mut seen = [Complex::from(0.0); 2];
    for n in 0..POINTS {
        let t = 3.0 + std::f64::consts::TAU / speed * f64::from(n) / f64::from(POINTS);
        run.simulation.advance(t).expect("a calm run");
        let back = polar(2.0 / f64::from(POINTS), -run.get("phi"));
        seen[0] += back * run.get("probe[1].r.y");
        seen[1] += back * run.get("probe[1].r.z");
    }
    for (got, expected) in seen.iter().zip([orbit.y, orbit.z]) {
        within("first harmonic", (got - expected).modulus() / orbit.major(), 2e-6);
    }
}

#[test]
fn resonance_without_damping_has_no_bound() {
    let text = "[rotor]\nm = 4.9\nJa = 0.15625\nJt = 0.078125\nl = 0.0\n[effects.support]\nc1 = 2000.0\n\
                [[effects.unbalance]]\nmass = 0.1\nradius = 0.1\nposition = 0.0\n";
    assert_eq!(machine(text).response(20.0, None).err(), Some(Obstacle::Resonant { speed: 20.0 }));
}
