//! The two entire functions from which every function of the tilt θ = |γ| follows, as polynomials in x = θ²/4; and the
//! arc tangent, which leads back to θ.
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

/// arctan √x / √x, interpolated at Chebyshev nodes of 0 ≤ x ≤ 1 (60 digits, rounded once).
const ARCTANGENT: [f64; 20] = [
    1.0,
    -0.333333333333307,
    0.1999999999964796,
    -0.14285714266926733,
    0.11111110578002083,
    -0.09090899793217341,
    0.07692198997458294,
    -0.06665764910689723,
    0.058768281144872724,
    -0.052374234719188166,
    0.04668745304848529,
    -0.040811247503178855,
    0.03387126702700675,
    -0.02556862364437174,
    0.01671959606350739,
    -0.00899108054265826,
    0.003751138483965141,
    -0.0011252544302234645,
    0.00021423810738603946,
    -1.93423475928923e-05,
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

/// arctan √x / √x, of x in [0, 1].
#[inline(always)]
pub fn arctangent(x: f64) -> f64 {
    // Every fourth coefficient by itself: a row of twenty products would take its time.
    let (square, fourth) = (x * x, x * x * (x * x));
    let mut sums = [0.0; 4];
    for quadruple in ARCTANGENT.as_chunks::<4>().0.iter().rev() {
        for (sum, coefficient) in sums.iter_mut().zip(quadruple) {
            *sum = *sum * fourth + coefficient;
        }
    }
    (sums[0] + x * sums[1]) + square * (sums[2] + x * sums[3])
}

#[inline(always)]
fn horner<S: Scalar, const N: usize>(coefficients: &[f64; N], x: S) -> S {
    let mut sum = S::constant(coefficients[N - 1]);
    for i in (0..N - 1).rev() {
        sum = sum * x + S::constant(coefficients[i]);
    }
    sum
}
