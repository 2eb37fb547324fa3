//! The heavy top's closed forms, put into the equations that they solve.

use nalgebra::{Complex, ComplexField, Vector2, Vector3};
use oracles::bounds::{largest, within};
use oracles::extrapolation;
use oracles::motion::Whirl;
use oracles::numerics::derivative;
use oracles::rotation;
use oracles::top::{Lagrange, Upright};

/// The paper's rotor on its rod, upright, its weight m g l [N·m], and its inertia about the pivot [kg·m²].
const UPRIGHT: Upright = Upright { m: 5.0, Ja: 0.15625, Jt: 0.078125, l: 0.75, c1: 1e4, g: 9.81, spin: 120.0 };
const WEIGHT: f64 = 5.0 * 9.81 * 0.75;
const INERTIA: f64 = 0.078125 + 5.0 * 0.75 * 0.75;

/// u̇² against the cubic, over 10 /s² [1]: measured 4.8e-13.
const CUBIC: f64 = 1.5e-12;
/// cos θ after 3 s against the axis' own equation, integrated [1]: measured 6.0e-14.
const INTEGRATED: f64 = 2e-13;

#[test]
fn exact_lagrange_obeys_its_equations() {
    for (spin, theta) in [(140.0, 0.6), (60.0, 1.2), (300.0, 0.1)] {
        let (momentum, start) = (0.15625 * spin, libm::cos(theta));
        let top = Lagrange::new(INERTIA, momentum, WEIGHT, theta);
        within("start", (top.cosine(0.0) - start).abs(), 1e-15);
        for i in 1..20 {
            let (t, lambda) = (0.1 * f64::from(i), momentum * momentum / (4.0 * INERTIA * WEIGHT));
            let (u, rate) = (top.cosine(t), derivative(|t| [top.cosine(t)], t, 0.02)[0]);
            let cubic = 2.0 * WEIGHT / INERTIA * (start - u) * (1.0 - u * u - 2.0 * lambda * (start - u));
            within("cubic", (rate * rate - cubic).abs() / 10.0, CUBIC);
        }
        // A t×ẗ + Ja ω ṫ = m g l t×(−e), with momentum along t constant.
        let rates = |_: f64, y: &[f64; 6]| {
            let (t, v) = (Vector3::new(y[0], y[1], y[2]), Vector3::new(y[3], y[4], y[5]));
            let moment = t.cross(&-Vector3::x()) * WEIGHT - v * momentum;
            let a = (moment / INERTIA).cross(&t) - t * v.norm_squared();
            [v.x, v.y, v.z, a.x, a.y, a.z]
        };
        let y = [start, libm::sin(theta), 0.0, 0.0, 0.0, 0.0];
        let end = extrapolation::steps(rates, 0.0, &y, 3.0, 600);
        within("integrated", (end[0] - top.cosine(3.0)).abs(), INTEGRATED);
    }
}

/// The frequency equation at its roots, over its largest term [1]: measured 1e-15.
const ROOT: f64 = 1e-14;

#[test]
fn exact_upright_rates_solve_the_frequency_equation() {
    for (spin, c1) in [(0.0, 1e4), (120.0, 1e4), (140.0, 1e9), (50.0, 2e3)] {
        let top = Upright { spin, c1, ..UPRIGHT };
        for rate in top.rates() {
            let square = rate * rate;
            let spring = -square * top.m + c1;
            let tilt = -square * top.Jt + rate * (top.Ja * spin) + (top.l * top.l * c1 - WEIGHT);
            let right = (c1 * top.l) * (c1 * top.l);
            let size = right + (spring * tilt).modulus();
            within(&format!("{spin} rad/s: {rate}"), (spring * tilt - right).modulus() / size, ROOT);
        }
    }
}

#[test]
fn exact_upright_rates_are_those_of_small_steady_whirl() {
    // A real rate is one at which the tilted top whirls steadily, however small its tilt.
    let top = Upright { spin: 200.0, ..UPRIGHT };
    for rate in top.rates() {
        within("sleeps", rate.im.abs(), 1e-12);
        let Upright { m, Ja, Jt, l, c1, g, .. } = top;
        let whirl = Whirl { m, Ja, Jt, l, c1, c2: 0.0, g, theta: 1e-9, rate: rate.re };
        within("spin", (whirl.axial_spin() / top.spin - 1.0).abs(), 1e-12);
        within("shape", (whirl.radius() / 1e-9 / top.shape(rate).re - 1.0).abs(), 1e-12);
    }
}

/// On a stiff pivot the threshold is the rigid one's, but for O(1/c1) of its square [1]: measured 5e-7 at 1e9 N/m.
const THRESHOLD: f64 = 1e-5;

#[test]
fn literature_top_sleeps_above_lagranges_spin() {
    let at = |part: f64| {
        let top = Upright { c1: 1e9, ..UPRIGHT };
        Upright { spin: part * top.sleeps_from(), ..top }.fastest_growing().im
    };
    assert!(at(1.0 + THRESHOLD) > -1e-6, "it sleeps: {}", at(1.0 + THRESHOLD));
    assert!(at(1.0 - THRESHOLD) < -1e-3, "it wakes: {}", at(1.0 - THRESHOLD));
    // Growth of a rigid one: σ² = m g l/A − (Ja ω/(2A))².
    let spin: f64 = 100.0;
    let sigma = (WEIGHT / INERTIA - libm::pow(0.15625 * spin / (2.0 * INERTIA), 2.0)).sqrt();
    let elastic = Upright { c1: 1e9, spin, ..UPRIGHT }.fastest_growing();
    within("growth", largest([(elastic.im + sigma).abs()]), 1e-6);
    within("shape", (UPRIGHT.shape(Complex::from(0.0)).re - 0.75).abs(), 0.0);
    assert_eq!(rotation::axis(&Vector2::zeros()), Vector3::x());
}
