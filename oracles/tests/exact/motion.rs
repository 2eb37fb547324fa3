//! Motions in closed form, put into Newton's and Euler's equations.

use nalgebra::{Matrix3, Vector2, Vector3};
use oracles::bounds::{largest, within};
use oracles::forward_whirl::ForwardWhirl;
use oracles::jeffcott::Jeffcott;
use oracles::motion::{FreeRotor, Oscillator, Whirl, small_whirl};
use oracles::numerics::{derivative, root};
use oracles::rotation;

fn free_rotor() -> FreeRotor {
    FreeRotor { Ja: 0.3, Jt: 0.2, phi: 0.4, gamma: Vector2::new(0.5, -0.3), omega: Vector3::new(9.0, 2.0, -1.5) }
}

/// dL/dt = ω×L of the closed form [1/s], of 9 rad/s: measured 2.1e-12.
const FREE_RATE: f64 = 8e-12;
/// φ against the attitude [rad]: measured 7.1e-15, an ulp of φ·8.
const FREE_PHI: f64 = 2e-14;

#[test]
fn exact_free_rotor_obeys_euler() {
    let rotor = free_rotor();
    let momentum = rotor.momentum();
    let mut worst: f64 = 0.0;
    for i in 0..20 {
        let t = 0.13 * f64::from(i);
        let rate = derivative(|t| <[f64; 9]>::try_from(rotor.attitude(t).as_slice()).unwrap(), t, 0.02);
        let attitude = rotor.attitude(t);
        let spin = Matrix3::from_column_slice(&rate) * attitude.transpose();
        let omega = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
        // K = R J Rᵀ ω in O must be the same at every time: Euler's equations without a moment.
        let inertia = attitude * Matrix3::from_diagonal(&Vector3::new(0.3, 0.2, 0.2)) * attitude.transpose();
        worst = worst.max((inertia * omega - momentum).amax());
        worst = worst.max((attitude.column(0) - rotor.axis(t)).amax());
    }
    within("K of the closed form", worst, FREE_RATE);
}

#[test]
fn exact_free_rotor_keeps_phi_and_attitude_together() {
    let rotor = free_rotor();
    for i in 0..20 {
        let t = 0.13 * f64::from(i);
        let phi = rotor.phi(t, 100);
        let other = libm::remainder(phi - rotation::phi(&rotor.attitude(t)), std::f64::consts::TAU);
        within("phi modulo a turn", other.abs(), FREE_PHI);
        within("panels", (phi - rotor.phi(t, 50)).abs(), FREE_PHI);
        within("closed form", (phi - rotor.phi_in_closed_form(t)).abs(), FREE_PHI);
        within("backwards", (rotor.phi(-t, 100) - rotor.phi_in_closed_form(-t)).abs(), FREE_PHI);
    }
}

/// Newton and Euler on the closed form, relative to the largest force or moment [1]: measured 1.9e-14.
const WHIRL_DEFECT: f64 = 6e-14;

#[test]
fn exact_whirl_obeys_newton_and_euler() {
    let mut worst: f64 = 0.0;
    for (theta, rate, g, c2) in
        [(0.1, 100.0, 0.0, 500.0), (1.3, 37.0, 0.0, 500.0), (2.5, 100.0, 0.0, 500.0), (0.8, 15.0, 9.81, 0.0)]
    {
        let whirl = Whirl { c2, g, ..Whirl::paper(theta, rate) };
        let t = 0.0123;
        let step = 0.5 / rate;
        let array = |v: Vector3<f64>| [v.x, v.y, v.z];
        let r_rate = Vector3::from(derivative(|t| array(whirl.r_c(t)), t, step));
        let acceleration = Vector3::from(derivative(|t| array(whirl.v_c(t)), t, step));
        let momentum = |t: f64| {
            let (axis, omega) = (rotation::axis(&whirl.gamma(t)), whirl.omega(t));
            array(omega * whirl.Jt + axis * ((whirl.Ja - whirl.Jt) * omega.dot(&axis)))
        };
        let moment = Vector3::from(derivative(momentum, t, step));
        let axis = rotation::axis(&whirl.gamma(t));
        let gamma = whirl.gamma(t);
        let spring = (whirl.r_c(t) - axis * whirl.l) * -whirl.c1;
        let force = spring - Vector3::x() * (whirl.m * g);
        let m_c = (axis * -whirl.l).cross(&spring) - Vector3::new(0.0, gamma.x, gamma.y) * c2;
        let axis_rate = Vector3::from(derivative(|t| array(rotation::axis(&whirl.gamma(t))), t, step));
        // ω_φ of ω as the paper's eq. 5 in closed form, ω·(e + t)/(1 + e·t).
        let omega_phi = whirl.omega(t).dot(&(Vector3::x() + axis)) / (1.0 + axis.x);
        worst = largest([
            worst,
            (r_rate - whirl.v_c(t)).amax() / (whirl.radius().abs() * rate),
            (acceleration * whirl.m - force).amax() / spring.amax(),
            (moment - m_c).amax() / m_c.amax(),
            (axis_rate - whirl.omega(t).cross(&axis)).amax() / rate,
            (omega_phi - whirl.phi(1.0)).abs() / omega_phi.abs(),
        ]);
    }
    within("defect of the whirl", worst, WHIRL_DEFECT);
}

/// An independent program gave four and five digits [rad/s].
const WHIRL_RATES: [(f64, f64); 4] = [(-104.43, 0.005), (-10.34, 0.005), (11.67, 0.005), (203.1, 0.05)];

#[test]
fn literature_small_whirl_rates() {
    for (computed, (printed, digit)) in small_whirl(&Whirl::paper(0.0, 0.0), 50.0).into_iter().zip(WHIRL_RATES) {
        within("small whirl", (computed - printed).abs(), digit * (1.0 + 1e-9));
    }
}

/// The oscillator's equation, relative [1]: measured 7.5e-14.
const OSCILLATOR: f64 = 3e-13;

#[test]
fn exact_oscillator_obeys_newton() {
    for d in [0.0, 0.7, 4.0, 9.0] {
        // m = 1, c = 4: critical at d = 4.
        let oscillator = Oscillator { m: 1.0, d, c: 4.0, x: 0.3, v: -1.1 };
        let (x, v) = oscillator.at(0.8);
        let rate = derivative(|t| <[f64; 2]>::from(oscillator.at(t)), 0.8, 0.1);
        within("dx/dt", (rate[0] - v).abs(), OSCILLATOR);
        within("dv/dt", (rate[1] + d * v + 4.0 * x).abs(), OSCILLATOR);
        assert_eq!(oscillator.at(0.0), (0.3, -1.1));
    }
}

/// Where forward whirl stops dying out, relative [1].
const THRESHOLD: f64 = 1e-11;

#[test]
fn exact_forward_whirl_grows_above_its_threshold() {
    let still = ForwardWhirl { m: 5.0, k: 2000.0, c: 6.0, d: 0.0, s: 0.0 };
    let turning = ForwardWhirl { d: 4.0, ..still };
    let spin = root(|spin| turning.rates(spin)[0].re, 10.0, 200.0);
    within("rotating damping", (spin * turning.d / turning.threshold() - 1.0).abs(), THRESHOLD);
    let s = root(|s| ForwardWhirl { s, ..still }.rates(0.0)[0].re, 1.0, 500.0);
    within("cross coupling", (s / still.threshold() - 1.0).abs(), THRESHOLD);
}

/// Newton's law of Jeffcott's rotor, relative to what pushes it [1]; and its steady whirl, relative [1].
const JEFFCOTT: [f64; 2] = [1e-9, 1e-11];

#[test]
fn exact_unbalanced_rotor_obeys_newton() {
    let (natural, damping, eccentricity) = (20.0, 0.05, 0.002);
    let through = Jeffcott { natural, damping, eccentricity, speed: 10.0, acceleration: 2.0 };
    let place = |t: f64| through.place(t);
    for t in [1.0, 4.0, 9.0] {
        let parts = |t: f64| [place(t).re, place(t).im];
        let speeds = |t: f64| derivative(parts, t, 0.02);
        let (z, v, a) = (parts(t), speeds(t), derivative(speeds, t, 0.02));
        let mass =
            derivative(|t| derivative(|t| [libm::cos(through.phi(t)), libm::sin(through.phi(t))], t, 0.02), t, 0.02);
        for n in 0..2 {
            let defect = a[n] + 2.0 * damping * natural * v[n] + natural * natural * z[n] + eccentricity * mass[n];
            within("Newton", defect.abs() / (eccentricity * 400.0), JEFFCOTT[0]);
        }
    }
    // What is left of the start after 30 s: e^(−30).
    for speed in [12.0, 20.0, 45.0] {
        let steady = Jeffcott { natural, damping, eccentricity, speed, acceleration: 0.0 };
        let (below, lost) = (natural * natural - speed * speed, 2.0 * damping * natural * speed);
        let radius = eccentricity * speed * speed / libm::hypot(below, lost);
        let z = steady.place(30.0);
        within("radius", (libm::hypot(z.re, z.im) / radius - 1.0).abs(), JEFFCOTT[1]);
    }
}
