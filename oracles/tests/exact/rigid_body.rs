//! The oracle of a rigid body without charts, and the extrapolation that integrates it, against closed forms.

use nalgebra::{Vector2, Vector3};
use oracles::bounds::{largest, within};
use oracles::extrapolation::{step, steps};
use oracles::motion::{FreeRotor, Whirl};
use oracles::numerics::log_slope;
use oracles::rigid_body::RigidBody;
use oracles::rotation;

/// A step of an oscillator by half a radian [1]: measured 6.7e-16.
const OSCILLATOR: f64 = 2e-15;
/// The order of the error of one step, 17, within this [1]: measured 0.08.
const ORDER: f64 = 0.2;
/// ∫7t⁶dt up to 1.5⁷ = 17 [1]: measured 1.9e-13.
const TIME: f64 = 6e-13;

#[test]
fn exact_extrapolation_has_its_order() {
    let rates = |_: f64, y: &[f64; 2]| [y[1], -y[0]];
    let error = |h: f64| {
        let reached = step(rates, 0.0, &[0.0, 1.0], h);
        largest([reached[0] - libm::sin(h), reached[1] - libm::cos(h)].map(f64::abs))
    };
    within("oscillator", error(0.5), OSCILLATOR);
    let errors: Vec<_> = [2.0, 2.3, 2.6, 3.0].map(|h| (h, error(h))).into();
    let slope = log_slope(&errors);
    within(&format!("order {slope:.2}"), (slope - 17.0).abs(), ORDER);
    // Time enters too: y = t⁷.
    let [reached] = steps(|t, _: &[f64; 1]| [7.0 * t * t * t * t * t * t], 1.0, &[1.0], 0.5, 3);
    within("time", (reached - libm::pow(1.5, 7.0)).abs(), TIME);
}

/// The paper's rotor with nothing acting on it.
fn free() -> RigidBody {
    RigidBody::free(5.0, [0.15625, 0.078125, 0.078125], 0.75)
}

/// The same on its springs, under gravity.
fn held() -> RigidBody {
    RigidBody { g: Vector3::z() * -9.81, c: [2000.0, 500.0], ..free() }
}

/// Axis, attitude [1] and φ [rad] of a free rotor after 3 s: measured 2.9e-13.
const FREE: f64 = 1e-12;

#[test]
fn exact_free_body_is_a_free_rotor() {
    let (gamma, omega) = (Vector2::new(-0.6, 1.1), Vector3::new(12.0, 10.0, 15.0));
    let closed = FreeRotor { Ja: 0.15625, Jt: 0.078125, phi: 2.0, gamma, omega };
    let start = free().start(Vector3::zeros(), Vector3::x(), 2.0, gamma, omega);
    let end = free().run(0.0, &start, 3.0, 300);
    within("axis", (end.axis() - closed.axis(3.0)).norm(), FREE);
    within("attitude", (end.attitude() - closed.attitude(3.0)).amax(), FREE);
    within("phi", (end.phi - closed.phi(3.0, 400)).abs(), FREE);
    within("path", (end.r - Vector3::x() * 3.0).norm(), FREE);
}

/// r_c [m], axis [1] and φ [rad] of a steady whirl after ten periods: measured 1.8e-13.
const WHIRL: f64 = 1e-12;

#[test]
fn exact_whirling_body_is_a_whirl() {
    let whirl = Whirl { g: 3.0, ..Whirl::paper(0.1, 100.0) };
    let body = RigidBody { g: Vector3::x() * -3.0, ..held() };
    let start = body.start(whirl.r_c(0.0), whirl.v_c(0.0), 0.0, whirl.gamma(0.0), whirl.omega(0.0));
    let end = body.run(0.0, &start, 0.6, 600);
    within("r_c", (end.r - whirl.r_c(0.6)).norm(), WHIRL);
    within("axis", (end.axis() - rotation::axis(&whirl.gamma(0.6))).norm(), WHIRL);
    within("phi", (end.phi - whirl.phi(0.6)).abs(), WHIRL);
}

/// Energy, beside work supplied less work lost [J], of some 200 J: measured 9.7e-13.
const LEDGER: f64 = 3e-12;

#[test]
fn exact_work_is_the_change_of_energy() {
    let masses = vec![(0.3, Vector3::new(0.1, 0.05, 0.0)), (0.2, Vector3::new(-0.2, -0.03, 0.08))];
    let even = RigidBody { d: [20.0, 0.5], tau: [3.0, -4.0, 0.0], ..held() };
    for body in [RigidBody { masses, moments: Vector3::new(0.15625, 0.078125, 0.1), ..even.clone() }, even] {
        let start =
            body.start(Vector3::x() * 0.75, Vector3::z(), 1.0, Vector2::new(0.5, -0.3), Vector3::new(50.0, 3.0, -2.0));
        let end = body.run(0.0, &start, 2.0, 800);
        let energy = |moving| body.energy(moving);
        within("ledger", (energy(&end) - energy(&start) - end.work[0] + end.work[1]).abs(), LEDGER);
        assert!(end.work[1] > 10.0 && end.work[0].abs() > 10.0, "{:?}", end.work);
    }
}
