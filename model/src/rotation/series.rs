//! The two entire functions from which every function of the tilt θ = |γ| follows, as polynomials in x = θ²/4.
//!
//! No libm, no square root, no special case at θ = 0. The coefficients interpolate P and Q below at Chebyshev nodes of
//! 0 ≤ x ≤ π²/4 (50 digits, rounded once), where c = 1 − x/2 + x² P(x) and j = 1/3 + x Q(x). Measured against exact
//! rationals in `model/tests/exact_series.rs`: error ≤ 1 ulp of 1 (2.2e-16), on the whole interval.

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

/// c = cos(θ/2), and a quarter of j = (sin(θ/2)/(θ/2) − cos(θ/2))/x, x = θ²/4, of θ² in [0, π²]. j is the spherical Bessel
/// function j₁(θ/2) over θ/2.
#[inline(always)]
pub fn cosine_and_bessel<S: Scalar>(theta_squared: S) -> [S; 2] {
    S::polynomials(&COSINE_AND_BESSEL, theta_squared)
}
