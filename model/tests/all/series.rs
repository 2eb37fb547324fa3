//! The polynomials of `rotation/series.rs`, and what the motion makes of them, against exact rationals
//! (`oracles/src/fixed.rs`).

use crate::harness::{largest, within};
use nalgebra::{Vector2, Vector3};
use oracles::fixed::{Fixed, decoded};
use split_rotor_model::rotation::{Chart, Tilt, series};
use std::f64::consts::PI;

/// Where c and j are asked for: 0, numbers that vanish beside 1, and 2000 points of [0, π²/4] with both ends.
fn points() -> Vec<f64> {
    let end = 0.25 * PI * PI;
    let small = [0.0, f64::from_bits(1), 1e-310, f64::MIN_POSITIVE, 1e-300, 1e-100, 1e-16, 1e-12, 1e-8, 1e-4];
    // Odd multiples of the golden ratio: no point is a round number.
    let even = (0..=1000).map(|i| end * f64::from(i) / 1000.0);
    let spread = (1..=1000).map(|i| end * (f64::from(i) * 0.618_033_988_749_894_9 % 1.0));
    small.into_iter().chain(even).chain(spread).collect()
}

/// |computed − exact| in units of the last place of the larger of the value and 1/2.
fn ulps(computed: f64, exact: &Fixed) -> f64 {
    let (_, exponent) = decoded(exact.to_f64().abs().max(0.5));
    (&Fixed::of(computed) - exact).abs().to_f64() / libm::ldexp(1.0, exponent)
}

/// c [ulp of the larger of the value and 1/2]: measured 1.41 here.
const COSINE: f64 = 2.0;
/// j [ulp of the larger of the value and 1/2]: measured 1.13 here.
const BESSEL: f64 = 1.5;
/// s = c + x j [ulp of the larger of the value and 1/2]: measured 2.41 here, 2.66 on 150 000 points.
const SINC: f64 = 3.0;

#[test]
fn exact_polynomials_hold_on_the_whole_interval() {
    let (mut cosine, mut bessel, mut sinc) = (0.0_f64, 0.0_f64, 0.0_f64);
    for x in points() {
        // 4x and j/4: exact.
        let ([c, j], exact) = (series::cosine_and_bessel(4.0 * x), Fixed::of(x));
        let j = 4.0 * j;
        cosine = largest([cosine, ulps(c, &exact.cosine())]);
        bessel = largest([bessel, ulps(j, &exact.bessel())]);
        sinc = largest([sinc, ulps(c + x * j, &exact.sinc())]);
    }
    within("c", cosine, COSINE);
    within("j", bessel, BESSEL);
    within("s = c + x j", sinc, SINC);
}

#[test]
fn exact_polynomials_at_zero() {
    for x in [0.0, -0.0, f64::from_bits(1), 1e-310, 1e-300, 1e-17] {
        assert_eq!(series::cosine_and_bessel(x), [1.0, 1.0 / 12.0], "x = {x:e}");
    }
}

/// Relative errors of τ and κ as the public rates show them [1], at tilts up to the one given first [rad]: measured
/// 2.0e-16 and 2.5e-16; 3.1e-16 and 3.5e-16; 3.2e-16 and 3.4e-16; 4.1e-15 and 4.2e-15 (c falls to zero at π).
const RATES: [(f64, f64, f64); 4] =
    [(1e-3, 4e-16, 5e-16), (1.0, 6e-16, 7e-16), (2.0, 8e-16, 8e-16), (3.1, 1e-14, 1e-14)];

/// Relative error of `computed`/`unit` [1].
fn relative(computed: f64, unit: f64, exact: &Fixed) -> f64 {
    (&(&Fixed::ratio(computed, unit) - exact) / exact).abs().to_f64()
}

/// Relative errors of (τ, κ) at γ [1].
fn errors(gamma: Vector2<f64>) -> (f64, f64) {
    let tilt = Tilt::new(Chart::FromE, gamma);
    let (y, z) = (Fixed::of(gamma.x), Fixed::of(gamma.y));
    let theta_squared = &(&y * &y) + &(&z * &z);
    // With ω along y, g·ω = γ_z: ω_φ = τ γ_z, and the z component of dγ/dt is κ γ_z γ_y.
    let omega = Vector3::y();
    let tau = relative(tilt.axial_rate(&omega), gamma.y, &theta_squared.tau());
    let over_y = &Fixed::ratio(tilt.gamma_rate(&omega).y, gamma.y) / &y;
    let exact = theta_squared.kappa();
    (tau, (&(&over_y - &exact) / &exact).abs().to_f64())
}

#[test]
fn exact_rates_keep_full_precision_at_any_tilt() {
    let mut from = 0.0;
    for (up_to, tau_allowed, kappa_allowed) in RATES {
        let (mut tau, mut kappa) = (0.0_f64, 0.0_f64);
        for i in 0..300 {
            // Small tilts over 30 decades, the others evenly.
            let part = (f64::from(i) + 0.5) / 300.0;
            let theta = if from == 0.0 { up_to * libm::pow(10.0, -30.0 * part) } else { from + (up_to - from) * part };
            let azimuth = 0.1 + 0.9 * f64::from(i);
            let errors = errors(Vector2::new(theta * libm::cos(azimuth), theta * libm::sin(azimuth)));
            tau = largest([tau, errors.0]);
            kappa = largest([kappa, errors.1]);
        }
        within(&format!("tau up to {up_to} rad"), tau, tau_allowed);
        within(&format!("kappa up to {up_to} rad"), kappa, kappa_allowed);
        from = up_to;
    }
}

#[test]
fn exact_rates_without_tilt() {
    for gamma in [Vector2::zeros(), Vector2::new(-0.0, 0.0), Vector2::new(f64::from_bits(1), 0.0)] {
        let (tilt, omega) = (Tilt::new(Chart::FromE, gamma), Vector3::new(50.0, 3.0, -4.0));
        assert_eq!(tilt.axial_rate(&omega), 50.0);
        assert_eq!(tilt.gamma_rate(&omega), Vector2::new(3.0, -4.0));
        assert_eq!(tilt.axis, Vector3::new(1.0, gamma.y, -gamma.x));
    }
    // A tilt of 1e-300 rad and a spin of 1: dγ/dt = −g, exactly.
    let tilt = Tilt::new(Chart::FromE, Vector2::new(3e-300, 1e-300));
    assert_eq!(tilt.gamma_rate(&Vector3::x()), Vector2::new(-1e-300, 3e-300));
    assert_eq!(tilt.axis, Vector3::new(1.0, 1e-300, -3e-300));
}

/// θ/sin θ by cos θ and sin² θ, relative [1]: measured 4.5e-16.
const PER_SINC: f64 = 1.5e-15;

#[test]
fn exact_lean_of_sine_and_cosine() {
    let worst = largest((1..=3140).map(|i| {
        let theta = 1e-3 * f64::from(i);
        let (sine, cosine) = (libm::sin(theta), libm::cos(theta));
        (series::per_sinc_of_both(cosine, sine * sine) * sine / theta - 1.0).abs()
    }));
    within("θ/sin θ", worst, PER_SINC);
    assert_eq!(series::per_sinc_of_both(1.0, 0.0), 1.0);
}
