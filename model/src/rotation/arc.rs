//! Angles from sines and cosines, and back, without libm.

use super::{exact, series};
use crate::scalar::Scalar;
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};

/// π less its double \[rad].
const PI_LOW: f64 = 1.224_646_799_147_353_2e-16;

/// The azimuth of (x, y) \[rad], in [−π, π]; 0 at the origin.
#[inline(always)]
pub fn atan2(y: f64, x: f64) -> f64 {
    let (across, along) = (y.abs(), x.abs());
    let (less, more) = if across > along { (along, across) } else { (across, along) };
    if more == 0.0 {
        return 0.0;
    }
    let ratio = less / more;
    let angle = ratio * series::arctangent(ratio * ratio);
    let angle = if across > along { FRAC_PI_2 - (angle - 0.5 * PI_LOW) } else { angle };
    let angle = if x < 0.0 { PI - (angle - PI_LOW) } else { angle };
    if y < 0.0 { -angle } else { angle }
}

/// An angle a ≥ 0 \[rad] as β + nπ, |β| ≤ π/2.
#[derive(Clone, Copy, Debug)]
pub struct Reduced {
    /// β \[rad].
    pub beta: f64,
    /// n \[1].
    pub half_turns: f64,
    /// cos β \[1].
    pub cosine: f64,
    /// sin β/β \[1].
    pub sinc: f64,
}

impl Reduced {
    /// Of a \[rad], 0 ≤ a < 10⁹; beyond, the angle itself is not known to a turn's small part.
    #[inline(always)]
    pub fn new(a: f64) -> Self {
        let (mut beta, mut half_turns) = (a, 0.0);
        if a > FRAC_PI_2 {
            half_turns = whole(a * FRAC_1_PI);
            // eq. 34: β = a − nπ, nπ with its rounding error and with what the double of π lacks
            let (high, low) = exact::product(half_turns, PI);
            beta = ((a - high) - low) - half_turns * PI_LOW;
        }
        // eq. 9
        let square = 4.0 * beta * beta;
        let [cosine, j_quarter] = series::cosine_and_bessel(square);
        Self { beta, half_turns, cosine, sinc: cosine + square * j_quarter }
    }

    /// sin a \[1].
    #[inline(always)]
    pub fn sine(&self) -> f64 {
        let sine = self.beta * self.sinc;
        if self.half_turns == 2.0 * whole(0.5 * self.half_turns) { sine } else { -sine }
    }
}

/// Cosine and sine of an angle a \[rad] of any sign, |a| < 10⁹.
#[inline(always)]
pub fn cosine_and_sine<S: Scalar>(angle: S) -> [S; 2] {
    let a = angle.re();
    let half_turns = 2.0 * whole(a * (0.5 * FRAC_1_PI));
    // eq. 34: β = a − nπ, n even
    let (high, low) = exact::product(half_turns, PI);
    let beta = angle.with_value(((a - high) - low) - half_turns * PI_LOW);
    // eq. 9, eq. 10: of the half angle; cos β = c² − ¼β²s², sin β = β s c
    let square = beta * beta;
    let [c, j_quarter] = series::cosine_and_bessel(square);
    let s = c + square * j_quarter;
    [c * c - square * (s * s * S::constant(0.25)), beta * s * c]
}

/// The whole number nearest to a number below 10¹⁵.
#[inline(always)]
fn whole(x: f64) -> f64 {
    const ROUNDED_AWAY: f64 = 6_755_399_441_055_744.0;
    (x + ROUNDED_AWAY) - ROUNDED_AWAY
}
