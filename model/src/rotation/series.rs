//! The two entire functions from which every function of the tilt θ = |γ| follows, as polynomials in x = θ²/4; and the
//! arc tangent, which leads back to θ.
//!
//! No libm, no square root, no special case at θ = 0. The coefficients interpolate P and Q below at Chebyshev nodes of
//! 0 ≤ x ≤ π²/4 (50 digits, rounded once), where c = 1 − x/2 + x² P(x) and j = 1/3 + x Q(x). Measured against exact
//! rationals in `model/tests/all/series.rs`: error ≤ 1 ulp of 1 (2.2e-16), on the whole interval.

use crate::scalar::Scalar;

/// The coefficients of c, and of j/4 beside them, in powers of θ² = 4x: powers of two change no bit.
const COSINE_AND_BESSEL: [[f64; 2]; 9] = [
    [1.0, 0.08333333333333333],
    [-0.125, -0.002083333333333333],
    [0.002604166666666666, 1.8601190476184376e-05],
    [-2.170138888888245e-05, -8.611662256506244e-08],
    [9.688120038638106e-08, 2.4464948993296723e-10],
    [-2.6911443919302906e-10, -4.704780554900853e-13],
    [5.09684608370786e-13, 6.531843743988422e-16],
    [-6.998444982738329e-16, -6.671602766625949e-19],
    [7.089898619251222e-19, 0.0],
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

/// c = cos(θ/2), and a quarter of j = (sin(θ/2)/(θ/2) − cos(θ/2))/x, x = θ²/4, of θ² in [0, π²]. j is the spherical Bessel
/// function j₁(θ/2) over θ/2.
#[inline(always)]
pub fn cosine_and_bessel<S: Scalar>(theta_squared: S) -> [S; 2] {
    S::polynomials(&COSINE_AND_BESSEL, theta_squared)
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
