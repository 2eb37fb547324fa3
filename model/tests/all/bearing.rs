//! Bearings, rotating damping and drag: beside the support, whose law they can say too, and in closed form.

use crate::harness::named::Named;
use crate::harness::{largest, within};
use nalgebra::{Complex, Normed, Vector3};
use oracles::forward_whirl::ForwardWhirl;
use oracles::numerics::exp;

const ROTOR: &str = "[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.75\n";
const SOLVER: &str = "[solver]\nmethod = \"dop853\"\nrelative_tolerance = 1e-13\n";

// ------------------------------------------------------------------------------------------------ beside the support

/// r_c [m], axis [1] and energies over 100 J of the damped rotor of the paper over 2 s: measured 5.7e-15.
const AS_SUPPORT: f64 = 2e-14;
/// The force of the bearings [N]: measured 2.6e-13.
const FORCE: f64 = 1e-12;

#[test]
fn bearings_say_what_a_support_says() {
    let motion =
        "[start]\nr_c = { x = 0.75 }\nomega = { x = 50.0, z = 2.0 }\n[effects.gravity]\ng = { x = 1.0, z = -9.81 }\n";
    let support = "[effects.support]\nc1 = 2000.0\nc2 = 500.0\nd1 = 20.0\nd2 = 0.5\n";
    // The same in two halves.
    let half = "[[effects.bearing]]\nposition = -0.75\nkyy = 1000.0\nkzz = 1000.0\nkxx = 1000.0\nkt = 250.0\n\
                cyy = 10.0\nczz = 10.0\ncxx = 10.0\nct = 0.25\n";
    let mut supported = Named::written(&[ROTOR, motion, support, SOLVER].concat());
    let mut held = Named::written(&[ROTOR, motion, half, half, SOLVER].concat());
    supported.start();
    held.start();
    for i in 1..=20 {
        for named in [&mut supported, &mut held] {
            named.simulation.advance(0.1 * f64::from(i)).expect("a possible motion");
        }
        let mut difference = |name: &str| (supported.get(name) - held.get(name)).abs();
        let moved = ["r_c.x", "r_c.y", "r_c.z", "axis.x", "axis.y", "axis.z"].map(&mut difference);
        let energies = ["energy.total", "energy.dissipated", "energy.potential"].map(|name| 0.01 * difference(name));
        within("beside the support", largest(moved.into_iter().chain(energies)), AS_SUPPORT);
    }
    let force = held.get("bearing[1].F.y") + held.get("bearing[2].F.y");
    within("force", (force - supported.get("support.F.y")).abs(), FORCE);
}

// ------------------------------------------------------------------------------------------------- whirl that grows

/// A rotor that spins upright and whirls with its centre at `z` [m], which moves at λz; y + iz after `t` [s].
fn whirl(spin: f64, effects: &str, z: Complex<f64>, rate: Complex<f64>, t: f64) -> (Complex<f64>, f64) {
    let v = z * rate;
    let start = format!(
        "[start]\nr_c = {{ y = {:?}, z = {:?} }}\nv_c = {{ y = {:?}, z = {:?} }}\nomega = {{ x = {spin:?} }}\n",
        z.re, z.im, v.re, v.im
    );
    let solver = format!("{SOLVER}absolute_tolerance = 1e-18\n");
    let mut named = Named::started(&[ROTOR, &start, effects, &solver].concat());
    named.simulation.advance(t).expect("a possible motion");
    (Complex::new(named.get("r_c.y"), named.get("r_c.z")), named.get("energy.residual"))
}

/// So small that what the whirl takes from the spin does not count [m].
const SMALL: f64 = 1e-6;
/// The place after 1 s, relative to its size [1]: measured 2.1e-11; residual [J], of 200 J: measured 1.0e-12, 5e-15 of it.
const WHIRL: [f64; 2] = [8e-11, 3e-12];
/// Growth rate against the eigenvalue's, and the threshold [1]: measured 5.8e-11 and 7.5e-12.
const GROWTH: f64 = 2e-10;
const THRESHOLD: f64 = 3e-11;

/// Follows the whirl of each eigenvalue, and finds the threshold where the measured growth is none.
fn follow(
    what: &str,
    threshold: f64,
    rates: impl Fn(f64) -> [Complex<f64>; 2],
    run: impl Fn(f64, Complex<f64>, Complex<f64>) -> (Complex<f64>, f64),
) {
    for part in [0.5, 0.9, 1.0, 1.1, 1.5] {
        for rate in rates(part * threshold) {
            let start = Complex::new(SMALL, 0.0);
            let (found, residual) = run(part * threshold, start, rate);
            let expected = exp(rate) * SMALL;
            within(&format!("{what}: place at {part}"), (found - expected).norm() / expected.norm(), WHIRL[0]);
            within(&format!("{what}: ledger at {part}"), residual.abs(), WHIRL[1]);
        }
    }
    // |z| grows by exp(Re λ) in a second.
    let growth = |at: f64| {
        let [rate, _] = rates(at);
        libm::log(run(at, Complex::new(SMALL, 0.0), rate).0.norm() / SMALL)
    };
    let above = 1.2 * threshold;
    within(&format!("{what}: growth"), (growth(above) / rates(above)[0].re - 1.0).abs(), GROWTH);
    let found = secant(growth, 0.9 * threshold, 1.1 * threshold);
    within(&format!("{what}: threshold"), (found / threshold - 1.0).abs(), THRESHOLD);
}

/// Where f is zero, by a few secants.
fn secant(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    for _ in 0..4 {
        let (fa, fb) = (f(a), f(b));
        (a, b) = (b, b - fb * (b - a) / (fb - fa));
    }
    b
}

#[test]
fn literature_rotating_damping_drives_forward_whirl() {
    let rotor = ForwardWhirl { m: 5.0, k: 2000.0, c: 6.0, d: 4.0, s: 0.0 };
    let effects = "[[effects.bearing]]\nposition = 0.0\nkyy = 2000.0\nkzz = 2000.0\ncyy = 6.0\nczz = 6.0\n\
                   [effects.rotating_damping]\nd = 4.0\n";
    follow(
        "rotating damping",
        rotor.threshold() / rotor.d,
        |spin| rotor.rates(spin),
        |spin, z, rate| whirl(spin, effects, z, rate, 1.0),
    );
}

#[test]
fn literature_cross_coupling_drives_forward_whirl() {
    let rotor = |s: f64| ForwardWhirl { m: 5.0, k: 2000.0, c: 6.0, d: 0.0, s };
    let effects = |s: f64| {
        let minus = -s;
        format!(
            "[[effects.bearing]]\nposition = 0.0\nkyy = 2000.0\nkzz = 2000.0\nkyz = {s:?}\nkzy = {minus:?}\ncyy = 6.0\nczz = 6.0\n"
        )
    };
    follow(
        "cross coupling",
        rotor(0.0).threshold(),
        |s| rotor(s).rates(0.0),
        |s, z, rate| whirl(0.0, &effects(s), z, rate, 1.0),
    );
}

// ---------------------------------------------------------------------------------------------------------- drag

/// The spin over 10 s, relative to the first [1]: measured 1.3e-14; the energy lost, relative [1]: measured 1.4e-14.
const DRAG: [f64; 2] = [4e-14, 5e-14];

#[test]
fn exact_drag_slows_an_upright_rotor() {
    let (ja, spin) = (0.15625, -50.0_f64);
    for (linear, quadratic) in [(0.05, 0.0), (0.0, 0.002), (0.03, 0.001)] {
        let text = format!(
            "{ROTOR}[start]\nomega = {{ x = {spin:?} }}\n[effects.drag]\nlinear = {linear:?}\nquadratic = {quadratic:?}\n{SOLVER}"
        );
        let mut named = Named::started(&text);
        for i in 1..=10 {
            let t = f64::from(i);
            named.simulation.advance(t).expect("a possible motion");
            // Ja dω/dt = −(d₁ + d₂|ω|)ω: 1/|ω| grows as that of a logistic curve.
            let (a, b) = (linear / ja, quadratic / ja);
            let slowed = if a == 0.0 { b * t } else { b / a * libm::expm1(a * t) };
            let expected = spin / (libm::exp(a * t) + spin.abs() * slowed);
            within("spin", ((named.get("omega_phi") - expected) / spin).abs(), DRAG[0]);
            let lost = 0.5 * ja * (spin * spin - expected * expected);
            within("lost", (named.get("energy.dissipated") / lost - 1.0).abs(), DRAG[1]);
            let tau = -(linear + quadratic * expected.abs()) * expected;
            within("torque", (named.get("drag.tau") - tau).abs(), 1e-13);
        }
    }
}

/// K over its size at the start, and the energy lost over that at the start [1]: measured 3.0e-14 and 2.0e-14.
const CONING: f64 = 1e-13;

/// A free rotor that cones: M = −c ω_a t, so d(K·t)/dt = −(c/Ja) K·t, and the part of K across t keeps its size.
#[test]
fn exact_drag_brakes_the_spin_and_not_the_coning() {
    let (ja, linear) = (0.15625, 0.05);
    let text = format!(
        "{ROTOR}[start]\ngamma = {{ y = 0.5, z = -0.2 }}\nomega = {{ x = 30.0, y = 8.0, z = -5.0 }}\n\
         [effects.drag]\nlinear = {linear:?}\n{SOLVER}"
    );
    let mut named = Named::started(&text);
    let parts = |named: &mut Named| {
        let (k, axis) = (named.vector("K_c"), named.vector("axis"));
        let along = k.dot(&axis);
        [along, (k - axis * along).norm()]
    };
    let [along, across] = parts(&mut named);
    let size = libm::hypot(along, across);
    for i in 1..=10 {
        let t = f64::from(i);
        named.simulation.advance(t).expect("a possible motion");
        let expected = along * libm::exp(-linear * t / ja);
        let found = parts(&mut named);
        within("along t", (found[0] - expected).abs() / size, CONING);
        within("across t", (found[1] - across).abs() / size, CONING);
        let lost = 0.5 * (along * along - expected * expected) / ja;
        within("lost", (named.get("energy.dissipated") - lost).abs() / (0.5 * along * along / ja), CONING);
        within("torque", (named.get("drag.tau") + linear * expected / ja).abs(), CONING);
    }
}

/// The axis [1], and what is lost [J]: measured 2.5e-13 and 1.7e-21.
const PASSING: f64 = 1e-12;

/// A rotor without spin turns its axis on a great circle, past −e by 1 mrad, whatever the drag.
#[test]
fn exact_drag_has_no_limit_at_the_antipode() {
    let start = Vector3::new(libm::cos(2.5), 0.0, -libm::sin(2.5));
    let omega = (Vector3::y() + start.cross(&Vector3::y()) * 1e-3) * 3.0;
    let text = format!(
        "{ROTOR}[start]\ngamma = {{ y = 2.5 }}\nomega = {{ x = {:?}, y = {:?}, z = {:?} }}\n\
         [effects.drag]\nlinear = 0.5\nquadratic = 0.1\n{SOLVER}",
        omega.x, omega.y, omega.z
    );
    let mut named = Named::started(&text);
    let mut nearest = 1.0;
    for i in 1..=100 {
        let t = 0.01 * f64::from(i);
        named.simulation.advance(t).expect("no limit at -e");
        let (sin, cos) = libm::sincos(omega.norm() * t);
        let expected = start * cos + omega.normalize().cross(&start) * sin;
        let found = named.vector("axis");
        within("axis", (found - expected).norm(), PASSING);
        within("lost", named.get("energy.dissipated").abs(), PASSING);
        nearest = f64::min(nearest, (found + Vector3::x()).norm());
    }
    assert!(nearest < 0.04, "it passes -e: {nearest}");
}

/// Moment of momentum about the line of the stator over its size, the ledger over the energy [1]: measured 2.0e-15 and 1.9e-14.
const UNFELT: f64 = 1e-13;

/// What damps within the rotor puts no torque on the stator about its line, and has no limit at −e.
#[test]
fn exact_rotating_damping_leaves_the_stator_alone() {
    let text = format!(
        "{ROTOR}[start]\nr_c = {{ y = 0.1, z = -0.05 }}\ngamma = {{ y = 2.5, z = 0.05 }}\n\
         omega = {{ x = 0.3, y = 3.0, z = 0.2 }}\n[effects.rotating_damping]\nd = 2.0\nposition = 0.3\n{SOLVER}"
    );
    let mut named = Named::started(&text);
    let about_line = |named: &mut Named| {
        let [r, v, k] = ["r_c", "v_c", "K_c"].map(|name| named.vector(name));
        5.0 * (r.y * v.z - r.z * v.y) + k.x
    };
    let (first, size, energy) = (about_line(&mut named), named.vector("K_c").norm(), named.get("energy.total"));
    let mut nearest = 1.0;
    for i in 1..=100 {
        named.simulation.advance(0.01 * f64::from(i)).expect("no limit at -e");
        within("about the line", (about_line(&mut named) - first).abs() / size, UNFELT);
        within("ledger", (named.get("energy.residual") / energy).abs(), UNFELT);
        nearest = f64::min(nearest, (named.vector("axis") + Vector3::x()).norm());
    }
    assert!(nearest < 0.04, "beyond 3.1 rad: {nearest}");
    assert!(named.get("energy.dissipated") > 0.01 * energy, "it damps");
}
