//! The two entire functions from which every function of the tilt θ = |γ| follows, as polynomials in x = θ²/4.
//!
//! No libm, no square root, no special case at θ = 0. The coefficients interpolate P and Q below at Chebyshev nodes of
//! 0 ≤ x ≤ π²/4 (50 digits, rounded once), where c = 1 − x/2 + x² P(x) and j = 1/3 + x Q(x). Measured against exact
//! rationals in `model/tests/exact_series.rs`: error ≤ 1 ulp of 1 (2.2e-16), on the whole interval.

use crate::scalar::Scalar;

/// cos √x.
const COSINE: [f64; 9] = [
    1.0,
    -0.5,
    0.04166666666666666,
    -0.0013888888888884767,
    2.480158729891355e-05,
    -2.7557318573366175e-07,
    2.0876681558867395e-09,
    -1.1466252259718479e-11,
    4.6464359591124806e-14,
];

/// (sin √x / √x − cos √x) / x.
const BESSEL: [f64; 8] = [
    0.3333333333333333,
    -0.033333333333333326,
    0.0011904761904758,
    -2.2045855376655984e-05,
    2.5052107769135844e-07,
    -1.9270781152873893e-09,
    1.0701772790150631e-11,
    -4.372301589135982e-14,
];

/// c = cos(θ/2), of x = θ²/4 in [0, π²/4].
#[inline(always)]
pub fn cosine<S: Scalar>(x: S) -> S {
    horner(&COSINE, x)
}

/// j = (sin(θ/2)/(θ/2) − cos(θ/2))/x, of x = θ²/4 in [0, π²/4]; the spherical Bessel function j₁(θ/2) over θ/2.
#[inline(always)]
pub fn bessel<S: Scalar>(x: S) -> S {
    horner(&BESSEL, x)
}

#[inline(always)]
fn horner<S: Scalar, const N: usize>(coefficients: &[f64; N], x: S) -> S {
    let mut sum = S::constant(coefficients[N - 1]);
    for i in (0..N - 1).rev() {
        sum = sum * x + S::constant(coefficients[i]);
    }
    sum
}
