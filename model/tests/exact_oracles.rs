//! Every exact answer in `oracles/` against something that it was not made from.

mod harness;
mod oracles;

use harness::{largest, within};
use nalgebra::{Matrix3, Vector2, Vector3};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use oracles::fixed::Fixed;
use oracles::jeffcott::Jeffcott;
use oracles::motion::{FreeRotor, Oscillator, Whirl, small_whirl};
use oracles::numerics::{derivative, integral, log_slope, root};
use oracles::{paper, rotation, trees};

/// The series keep some 90 digits; the digits in print are 60 [1].
const PRINTED: &str = "0.000000000000000000000000000000000000000000000000000000000001";

#[test]
fn exact_series_agree_with_digits_in_print() {
    // cos 1, sin 1 (OEIS A049470, A049469) and tan(1/2) (A161019).
    let one = Fixed::whole(1);
    let cosine = Fixed::decimal("0.540302305868139717400936607442976603732310420617922227670097");
    let sine = Fixed::decimal("0.841470984807896506652502321630298999622563060798371065672751");
    let ulp = Fixed::decimal(PRINTED);
    assert!((&one.cosine() - &cosine).abs() <= ulp, "cos 1");
    assert!((&one.sinc() - &sine).abs() <= ulp, "sin 1");
    assert!((&one.bessel() - &(&sine - &cosine)).abs() <= &ulp + &ulp, "sin 1 - cos 1");
    assert!((&one.versine() - &(&one - &cosine)).abs() <= ulp, "1 - cos 1");
    // κ(1) = 1 − cot 1, τ(1) = (1 − cos 1)/sin 1
    assert!((&one.kappa() - &(&one - &(&cosine / &sine))).abs() <= &(&ulp + &ulp) + &(&ulp + &ulp), "kappa");
    assert!((&one.tau() - &(&(&one - &cosine) / &sine)).abs() <= &(&ulp + &ulp) + &(&ulp + &ulp), "tau");
}

#[test]
fn exact_two_pi_is_the_period_of_the_series() {
    // sin π/π = 0 and cos 2π = 1: to the 100 places of 2π, the cosine to twice as many.
    let tau = Fixed::tau_circle();
    let pi = &tau / &Fixed::whole(2);
    let limit = &Fixed::of(1e-45) * &Fixed::of(1e-45);
    assert!((&pi * &pi).sinc().abs() < limit);
    assert!((&(&tau * &tau).cosine() - &Fixed::whole(1)).abs() < limit);
}

/// The sum of the series in rationals without rounding, and a bound of what is left out.
fn unrounded_cosine(x: f64) -> (BigRational, BigRational) {
    let x = BigRational::from_float(x).expect("finite");
    let (mut sum, mut term) = (BigRational::zero(), BigRational::from_integer(BigInt::from(1)));
    for k in 1..=40 {
        sum += &term;
        term = -(&term * &x) / BigInt::from(2 * k * (2 * k - 1));
    }
    (sum, term.abs())
}

#[test]
fn exact_series_agree_with_unrounded_rationals() {
    for x in [0.0, f64::from_bits(1), 1e-300, 1e-16, 0.1, 1.0, 2.4] {
        let (sum, rest) = unrounded_cosine(x);
        let difference = (&Fixed::rational(&sum) - &Fixed::of(x).cosine()).abs();
        assert!(difference < &Fixed::of(1e-45) * &Fixed::of(1e-45), "x = {x:e}");
        assert!(rest < BigRational::from_float(1e-90).unwrap(), "x = {x:e}");
    }
}

#[test]
fn exact_fixed_numbers_keep_doubles() {
    for x in [1.0, -0.1, 1e-40, -3.3e9, 2.5e-60] {
        assert_eq!(Fixed::of(x).to_f64(), x);
        assert_eq!(Fixed::ratio(x, 1.0), Fixed::of(x));
    }
    assert_eq!(Fixed::ratio(3e-310, 1.5e-310).to_f64(), 3e-310 / 1.5e-310);
    assert_eq!((Fixed::of(-0.25).floor(), Fixed::of(7.9).floor()), (-1, 7));
}

/// Rodrigues' matrix against quaternions [1]: measured 1e-15.
const RODRIGUES: f64 = 3e-15;

#[test]
fn exact_rotations_agree_among_themselves() {
    let mut worst: f64 = 0.0;
    for i in 0..200 {
        let angle = 0.05 * f64::from(i);
        let n = Vector3::new(libm::cos(angle), libm::sin(3.0 * angle), 0.3 * libm::sin(angle)).normalize();
        let a = n * angle;
        worst = worst.max((rotation::rodrigues(&a) - rotation::matrix(rotation::quaternion(&a))).amax());
    }
    within("Rodrigues against quaternions", worst, RODRIGUES);
    // A quarter turn about z carries x to y.
    let quarter = rotation::rodrigues(&(Vector3::z() * std::f64::consts::FRAC_PI_2));
    within("quarter turn", (quarter * Vector3::x() - Vector3::y()).amax(), RODRIGUES);
}

/// φ and γ out of an attitude [rad]: measured 8.9e-16 up to 3 rad.
const SPLIT: f64 = 3e-15;

#[test]
fn exact_split_of_an_attitude_comes_back() {
    let mut worst: f64 = 0.0;
    for i in 1..60 {
        let (theta, azimuth) = (0.05 * f64::from(i), 0.7 * f64::from(i));
        let gamma = Vector2::new(libm::cos(azimuth), libm::sin(azimuth)) * theta;
        let phi = libm::remainder(0.37 * f64::from(i), std::f64::consts::TAU);
        let attitude = rotation::attitude(phi, &gamma);
        let axis = attitude.column(0).into_owned();
        worst = largest([
            worst,
            (rotation::gamma(&axis) - gamma).norm(),
            libm::remainder(rotation::phi(&attitude) - phi, std::f64::consts::TAU).abs(),
            (axis - rotation::axis(&gamma)).norm(),
        ]);
    }
    within("phi and gamma of an attitude", worst, SPLIT);
}

/// Extrapolated derivative of e^x sin 3x [1]: measured 6e-14.
const DERIVATIVE: f64 = 2e-13;
/// Gauss's rule on a known integral [1]: measured 0.
const INTEGRAL: f64 = 1e-15;

#[test]
fn exact_numerics_agree_with_known_values() {
    let slope = derivative(|x| [libm::exp(x) * libm::sin(3.0 * x)], 0.7, 0.1)[0];
    let known = libm::exp(0.7) * (libm::sin(2.1) + 3.0 * libm::cos(2.1));
    within("derivative", (slope - known).abs(), DERIVATIVE);
    within("integral", (integral(libm::exp, 0.0, 1.0, 4) - libm::expm1(1.0)).abs(), INTEGRAL);
    within("root", (root(|x| x * x - 2.0, 0.0, 2.0) - std::f64::consts::SQRT_2).abs(), f64::EPSILON);
    let points: Vec<_> = (1..9).map(|i| (f64::from(i), 3.0 * libm::pow(f64::from(i), 2.5))).collect();
    within("slope", (log_slope(&points) - 2.5).abs(), f64::EPSILON);
}

#[test]
fn literature_trees_are_as_many_as_cayley_counted() {
    let trees = trees::trees(8);
    let counts: Vec<_> = (1..=8).map(|n| trees.iter().filter(|tree| tree.order() == n).count()).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20, 48, 115]);
    let distinct: std::collections::BTreeSet<_> = trees.iter().collect();
    assert_eq!(distinct.len(), trees.len());
    // 1/γ of the classical method of Kutta (1901), which has order 4 and not 5.
    let a = [[0.0; 4], [0.5, 0.0, 0.0, 0.0], [0.0, 0.5, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]].map(Vec::from);
    let b = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];
    let defect = |tree: &trees::Tree| {
        let sum: f64 = tree.weights(&a).iter().zip(&b).map(|(w, b)| w * b).sum();
        (sum - 1.0 / tree.density()).abs()
    };
    assert!(trees.iter().filter(|tree| tree.order() <= 4).all(|tree| defect(tree) < 1e-15));
    assert!(trees.iter().any(|tree| tree.order() == 5 && defect(tree) > 1e-3));
}

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
        let whirl = Whirl { m: 5.0, Ja: 0.15625, Jt: 0.078125, l: 0.75, c1: 2000.0, c2, g, theta, rate };
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

/// ORACLES.md 5 gives four and five digits [rad/s].
const WHIRL_RATES: [(f64, f64); 4] = [(-104.43, 0.005), (-10.34, 0.005), (11.67, 0.005), (203.1, 0.05)];

#[test]
fn literature_small_whirl_rates() {
    let scene = harness::Scene::paper();
    let body = scene.body;
    let rotor = Whirl {
        m: body.m,
        Ja: body.Ja,
        Jt: body.Jt,
        l: body.l,
        c1: scene.c1,
        c2: scene.c2,
        g: 0.0,
        theta: 0.0,
        rate: 0.0,
    };
    for (computed, (printed, digit)) in small_whirl(&rotor, 50.0).into_iter().zip(WHIRL_RATES) {
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
        // The loss d v² is what the energy falls by.
        let lost = integral(|t| d * oscillator.at(t).1 * oscillator.at(t).1, 0.0, 2.0, 50);
        within("energy", (oscillator.energy(0.0) - oscillator.energy(2.0) - lost).abs(), OSCILLATOR);
    }
}

/// The reference's energy [J] and K_c·t [kg·m²/s] at double precision, relative: measured 4.4e-16 (ω_φ).
const REFERENCE: f64 = 2e-15;

#[test]
fn literature_reference_keeps_what_is_constant() {
    let scene = harness::Scene::paper();
    for instant in paper::instants() {
        let t = rotation::axis(&instant.gamma);
        let omega =
            instant.k_c / scene.body.Jt + t * ((1.0 / scene.body.Ja - 1.0 / scene.body.Jt) * instant.k_c.dot(&t));
        let r_a = instant.r_c - t * scene.body.l;
        let energy = 0.5 * scene.body.m * instant.v_c.norm_squared()
            + 0.5 * omega.dot(&instant.k_c)
            + 0.5 * scene.c1 * r_a.norm_squared()
            + 0.5 * scene.c2 * instant.gamma.norm_squared()
            - scene.body.m * scene.g.dot(&instant.r_c);
        let omega_phi = omega.dot(&(Vector3::x() + t)) / (1.0 + t.x);
        within("energy", (energy / 195.3125 - 1.0).abs(), REFERENCE);
        within("energy column", (instant.energy / 195.3125 - 1.0).abs(), REFERENCE);
        within("K·t", (instant.k_c.dot(&t) / 7.8125 - 1.0).abs(), REFERENCE);
        within("omega_phi", (omega_phi / instant.omega_phi - 1.0).abs(), REFERENCE);
    }
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
