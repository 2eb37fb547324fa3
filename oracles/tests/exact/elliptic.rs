//! Jacobi's elliptic functions and what is made of them, each against something that it was not made from.

use nalgebra::{Matrix3, Vector2, Vector3};
use oracles::asymmetric::Asymmetric;
use oracles::bounds::{largest, within};
use oracles::elliptic::{carlson, inverse, jacobi, quarter_period};
use oracles::extrapolation;
use oracles::numerics::{derivative, integral};
use oracles::rotation;

/// Moduli from none to next to one, as 1 − k².
const COMPLEMENTS: [f64; 7] = [1.0, 0.9, 0.5, 0.1, 1e-3, 1e-8, 1e-15];

/// Values in print, relative [1]: measured 1.2e-16.
const PRINTED: f64 = 1e-15;

#[test]
fn literature_quarter_periods() {
    // K at k² = 1/2: Γ(1/4)²/(4√π) (OEIS A093341); at k = 0: π/2; near k = 1: ln(4/k′) (DLMF 19.9.1, error k′² ln k′).
    within("lemniscate", (quarter_period(0.5) / 1.854_074_677_301_372 - 1.0).abs(), PRINTED);
    within("circle", (quarter_period(1.0) / std::f64::consts::FRAC_PI_2 - 1.0).abs(), PRINTED);
    within("line", (quarter_period(1e-20) / libm::log(4e10) - 1.0).abs(), PRINTED);
    // R_F(1, 2, 0) (Carlson 1995, table 1).
    within("R_F", (carlson(1.0, 2.0, 0.0) / 1.311_028_777_146_059_8 - 1.0).abs(), PRINTED);
    for m1 in COMPLEMENTS {
        within("K by R_F", (carlson(0.0, m1, 1.0) / quarter_period(m1) - 1.0).abs(), 2.0 * PRINTED);
    }
}

/// sn′ = cn dn, cn′ = −sn dn, dn′ = −k² sn cn and sn² + cn² = 1 [1]: measured 3e-13, 1.2e-12 and 1.3e-11 for
/// the last two moduli, where sines of the descending angles come close to 1.
const DERIVATIVES: f64 = 4e-11;
/// u back from sn u and cn u, times dn u, over K [1]: measured 2.8e-15.
const BACK: f64 = 9e-15;

#[test]
fn exact_jacobi_obeys_its_equations() {
    for m1 in COMPLEMENTS {
        let k = quarter_period(m1);
        let mut worst = [0.0; 2];
        for i in -19..20 {
            let u = 0.1 * f64::from(i) * k;
            let [sn, cn, dn] = jacobi(u, m1);
            let slopes = derivative(|u| jacobi(u, m1), u, 0.1);
            let defects = [slopes[0] - cn * dn, slopes[1] + sn * dn, slopes[2] + (1.0 - m1) * sn * cn];
            let circle = [sn * sn + cn * cn - 1.0, dn * dn + (1.0 - m1) * sn * sn - 1.0];
            worst[0] = largest(defects.into_iter().chain(circle).map(f64::abs).chain([worst[0]]));
            // Where the slope of am u is dn, a rounded sine tells u no better.
            worst[1] = largest([worst[1], (inverse(sn, cn, m1) - u).abs() * dn / k]);
        }
        within(&format!("m1 = {m1:e}: equations"), worst[0], DERIVATIVES);
        within(&format!("m1 = {m1:e}: inverse"), worst[1], BACK);
    }
}

#[test]
fn exact_jacobi_at_the_ends() {
    // k = 0: sine and cosine; k = 1: hyperbolic.
    for u in [-1.4, -0.3, 0.0, 0.7, 1.5] {
        let [sn, cn, dn] = jacobi(u, 1.0);
        let error = largest([sn - libm::sin(u), cn - libm::cos(u), dn - 1.0].map(f64::abs));
        within("circle", error, PRINTED);
        let [sn, cn, dn] = jacobi(u, 1e-30);
        let error = largest([sn - libm::tanh(u), cn - 1.0 / libm::cosh(u), dn - cn].map(f64::abs));
        within("line", error, PRINTED);
    }
}

/// Rotors whose K goes round the axis of the largest and of the smallest moment, whichever of t, y, z that is, and one that
/// starts near its middle axis.
fn rotors() -> Vec<([f64; 3], Asymmetric)> {
    let gamma = Vector2::new(0.5, -0.3);
    let mut rotors: Vec<_> = [[0.3, 0.2, 0.25], [0.2, 0.3, 0.25], [0.2, 0.25, 0.3]]
        .into_iter()
        .flat_map(|j| {
            [Vector3::new(9.0, 2.0, -1.5), Vector3::new(1.0, -8.0, 2.0), Vector3::new(-0.5, 1.0, 7.0)]
                .map(|omega| (j, Asymmetric::new(j, 0.4, &gamma, &omega)))
        })
        .collect();
    let racket = [0.25, 0.2, 0.3];
    rotors.push((racket, Asymmetric::new(racket, 0.0, &Vector2::zeros(), &Vector3::new(10.0, 0.01, 0.0))));
    rotors
}

/// Euler's equations on the closed form, over |ω|² [1]; K in O, relative [1]: measured 7.0e-14 and 6.6e-12, the derivative's.
const EULER: [f64; 2] = [3e-13, 2e-11];

#[test]
fn exact_asymmetric_rotor_obeys_euler() {
    for (j, rotor) in rotors() {
        let inertia = Vector3::from(j);
        let start = rotor.attitude(0.0) * inertia.component_mul(&rotor.body_rates(0.0));
        let mut worst = [0.0; 2];
        for i in 0..40 {
            let t = 0.13 * f64::from(i);
            let w = rotor.body_rates(t);
            let rate = Vector3::from(derivative(|t| <[f64; 3]>::from(rotor.body_rates(t)), t, 0.02));
            let euler = inertia.component_mul(&rate) + w.cross(&inertia.component_mul(&w));
            worst[0] = largest([worst[0], euler.norm() / w.norm_squared()]);
            // ω of the attitude is that of the closed form, and K stays where it is.
            let attitude = rotor.attitude(t);
            let rate = derivative(|t| <[f64; 9]>::try_from(rotor.attitude(t).as_slice()).unwrap(), t, 0.02);
            let spin = attitude.transpose() * Matrix3::from_column_slice(&rate);
            let omega = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
            let k = attitude * inertia.component_mul(&w);
            worst[1] = largest([worst[1], (omega - w).norm() / w.norm(), (k - start).norm() / start.norm()]);
        }
        within(&format!("{j:?}: Euler"), worst[0], EULER[0]);
        within(&format!("{j:?}: attitude"), worst[1], EULER[1]);
    }
}

/// Attitude after 5 s against a quaternion that is integrated [1]: measured 1.3e-13.
const INTEGRATED: f64 = 4e-13;

#[test]
fn exact_asymmetric_rotor_is_where_integration_finds_it() {
    for (j, rotor) in rotors() {
        let rates = |_: f64, y: &[f64; 7]| {
            let (w, q) = (Vector3::new(y[0], y[1], y[2]), (y[3], Vector3::new(y[4], y[5], y[6])));
            let k = Vector3::from(j).component_mul(&w);
            let a = k.cross(&w).component_div(&Vector3::from(j));
            let (s, v) = rotation::product(q, (0.0, w * 0.5));
            [a.x, a.y, a.z, s, v.x, v.y, v.z]
        };
        let w = rotor.body_rates(0.0);
        // γ and φ of `rotors`, or none for the last.
        let first = if w.x == 10.0 { Matrix3::identity() } else { rotation::attitude(0.4, &Vector2::new(0.5, -0.3)) };
        let y = extrapolation::steps(rates, 0.0, &[w.x, w.y, w.z, 1.0, 0.0, 0.0, 0.0], 5.0, 500);
        let norm = y[3..].iter().map(|q| q * q).sum::<f64>().sqrt();
        let attitude = first * rotation::matrix((y[3] / norm, Vector3::new(y[4], y[5], y[6]) / norm));
        within(&format!("{j:?}"), (attitude - rotor.attitude(5.0)).amax(), INTEGRATED);
    }
}

/// Half of the period, after which the middle axis has flipped [rad/s], relative: measured 0.
const FLIP: f64 = 1e-15;

#[test]
fn exact_dzhanibekov_flips_after_half_a_period() {
    let (_, rotor) = rotors().pop().unwrap();
    let (start, half) = (rotor.body_rates(0.0), 0.5 * rotor.period());
    for n in 1..4 {
        let w = rotor.body_rates(f64::from(n) * half);
        let sign = if n % 2 == 1 { -1.0 } else { 1.0 };
        within(&format!("flip {n}"), (w.x / start.x - sign).abs(), FLIP);
    }
    // Before and after it lingers: most of the time, and the flip itself is over in a few tenths of a second.
    assert!(rotor.body_rates(0.25 * half).x > 9.9 && rotor.body_rates(0.75 * half).x < -9.9 && half > 1.0);
}

#[test]
fn exact_azimuth_over_many_periods_is_that_of_one() {
    // The integral over whole halves of the period, once and many times.
    let (_, rotor) = rotors().remove(0);
    let rate = |t: f64| (rotor.attitude(t) * rotor.body_rates(t)).norm();
    assert!(integral(rate, 0.0, 1.0, 10) > 1.0);
    let (period, t) = (rotor.period(), 0.3);
    let turn = rotor.attitude(period) * rotor.attitude(0.0).transpose();
    let hundred = (0..100).fold(rotor.attitude(t), |attitude, _| turn * attitude);
    within("a hundred periods", (rotor.attitude(t + 100.0 * period) - hundred).amax(), INTEGRATED);
}
