//! The two entire functions from which every function of the tilt θ = |γ| follows, as polynomials in x = θ²/4; and the
//! arc tangent, which leads back to θ.
//!
//! No libm, no square root, no special case at θ = 0. The coefficients interpolate P and Q below at Chebyshev nodes of
//! 0 ≤ x ≤ π²/4 (50 digits, rounded once), where c = 1 − x/2 + x² P(x) and j = 1/3 + x Q(x). Measured against exact
//! rationals in `model/tests/all/series.rs`: error ≤ 1 ulp of 1 (2.2e-16), on the whole interval.

use crate::scalar::{Scalar, estrin};
use std::f64::consts::PI;

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

/// θ/sin θ of c = cos θ, 0 ≤ θ < π.
#[inline(always)]
pub fn per_sinc(c: f64) -> f64 {
    let (less, more) = (1.0 - c, 1.0 + c);
    if less <= more {
        // θ = 2 arctan √x, x = tan²(θ/2) = (1 − c)/(1 + c); sin θ = √x (1 + c)
        return 2.0 * arctangent(less / more) / more;
    }
    let (sine, x) = ((less * more).sqrt(), more / less);
    (PI - 2.0 * x.sqrt() * arctangent(x)) / sine
}

/// Terms of a backward recurrence that are this small beside the first are not seen \[1].
const UNSEEN: f64 = 1e-17;

/// 1/k.
const PER: [f64; 96] = {
    let mut per = [0.0; 96];
    let mut k = 1;
    while k < per.len() {
        per[k] = 1.0 / k as f64;
        k += 1;
    }
    per
};

/// Below this cos θ the recurrence goes forward: the two solutions then grow alike.
const FORWARD: f64 = 0.3;

/// arcsin √w / √w, interpolated at Chebyshev nodes of 0 ≤ w ≤ 1/16 (60 digits, rounded once): error 3e-18.
const ARCSINE: [f64; 9] = [
    1.0,
    0.16666666666666308,
    0.07500000000153167,
    0.04464285689206594,
    0.030381964973388388,
    0.02237121790366476,
    0.017377988197123058,
    0.013574602068216915,
    0.014731093985552658,
];

/// θ/sin θ of c = cos θ and w = sin² θ, 0 ≤ θ < π: to the last digits near π too, and without a division where the axis leans
/// little.
#[inline(always)]
pub fn per_sinc_of_both(c: f64, w: f64) -> f64 {
    if c > 0.0 && w <= 0.0625 {
        return estrin(&ARCSINE, w);
    }
    if c >= 0.0 {
        // θ = 2 arctan √x, √x = tan(θ/2) = sin θ/(1 + c)
        let more = 1.0 + c;
        return 2.0 * arctangent(w / (more * more)) / more;
    }
    let (sine, less) = (w.sqrt(), 1.0 - c);
    let root = sine / less;
    (PI - 2.0 * root * arctangent(root * root)) / sine
}

/// The terms f_k of f(c + w) = Σ f_k w^k, f being θ/sin θ as a function of c = cos θ, 0 ≤ θ < π: at least two.
pub fn lean_over_sine(c: f64, terms: &mut [f64]) {
    let square = (1.0 - c) * (1.0 + c);
    let first = per_sinc(c);
    // eq. 102: (k + 1)(1 − c²) f_(k+1) = (2k + 1) c f_k + k f_(k−1), less 1 where k = 0
    if c < FORWARD {
        terms[0] = first;
        terms[1] = (c * first - 1.0) / square;
        for k in 1..terms.len() - 1 {
            let of = k as f64;
            terms[k + 1] = ((2.0 * of + 1.0) * c * terms[k] + of * terms[k - 1]) / ((of + 1.0) * square);
        }
        return;
    }
    // Backward f is the solution that grows (Miller 1952): the other is less by (1 − c)/(1 + c) a term.
    let (ratio, mut part, mut k) = ((1.0 - c) / (1.0 + c), 1.0, terms.len());
    while part > UNSEEN && k < PER.len() - 1 {
        (part, k) = (part * ratio, k + 1);
    }
    let (mut above, mut term) = (0.0, 1e-200);
    while k > 0 {
        let below = (square + square * PER[k]) * above - (2.0 * c + c * PER[k]) * term;
        (above, term, k) = (term, below, k - 1);
        if let Some(place) = terms.get_mut(k) {
            *place = term;
        }
    }
    let scale = first / terms[0];
    terms.iter_mut().for_each(|term| *term *= scale);
}
