//! Methods of integration that know no rotor: they ask a [`System`] of N ordinary differential equations for its rates.

mod answer;
pub mod composition;
pub mod control;
pub mod explicit;
mod lanes;
mod power;
mod segment;
pub mod stiff;
pub mod tableau;

use crate::stored::stored;
use lanes::{both, nothing, pair, pairs, put, sum};

/// N ordinary differential equations dy/dt = f(t, y).
pub trait System<const N: usize> {
    /// The rates depend on the first so many components only; the others are quadratures.
    const DEPENDED_ON: usize = N;

    /// On how many of these they depend as the system is now.
    fn depended_on(&self) -> usize {
        Self::DEPENDED_ON.min(N)
    }

    /// f(t, y).
    fn rates(&self, t: f64, y: &[f64; N]) -> [f64; N];

    /// Whether a step may end at y; the reason where it may not.
    fn admits(&self, t: f64, y: &[f64; N]) -> Result<(), Refusal>;
}

/// Why a state cannot be reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refusal(pub &'static str);

/// How large the error of a step may be, component by component: absolute + relative·|y|.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance<const N: usize> {
    /// In the component's unit; infinite where the component's error does not count.
    pub absolute: [f64; N],
    /// Relative to the component's size [1].
    pub relative: [f64; N],
}

stored!(Tolerance<const N: usize> { absolute, relative });

impl<const N: usize> Tolerance<N> {
    /// The share of each component in an error norm: 1/n of n that count.
    fn share(&self) -> f64 {
        1.0 / self.absolute.iter().filter(|absolute| absolute.is_finite()).count() as f64
    }

    /// What one unit of each component counts in the error norm, at a state of this `size`.
    #[inline(always)]
    fn weights(&self, size: &[f64; N]) -> [f64; N] {
        let mut weights = [0.0; N];
        for p in 0..pairs(N) {
            // eq. 22: sc_i = atol_i + rtol_i·max(|y0_i|, |y1_i|)
            put(&mut weights, p, both(1.0) / (pair(&self.absolute, p) + pair(&self.relative, p) * pair(size, p)));
        }
        weights
    }

    /// The root mean square of `v` in units of the tolerance at a state of this `size` [1].
    fn norm(&self, v: &[f64; N], size: &[f64; N]) -> f64 {
        mean_square(v, &self.weights(size), self.share()).sqrt()
    }
}

/// The mean square of `v`, each component by its weight, and with this share [1].
#[inline(always)]
fn mean_square<const N: usize>(v: &[f64; N], weights: &[f64; N], share: f64) -> f64 {
    let mut squares = nothing();
    for p in 0..pairs(N) {
        let weighted = pair(v, p) * pair(weights, p);
        squares += weighted * weighted;
    }
    // eq. 22: err² = (1/n) Σ (err_i/sc_i)²
    sum(squares) * share
}

/// Why a step could not be done; the state is that of the last step that could.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// Every step, however short, ends where the system refuses to be.
    Refused {
        /// The last time reached [s].
        t: f64,
        /// The system's reason.
        reason: Refusal,
    },
    /// The rates overflow or are undefined, however short the step.
    NotFinite {
        /// The last time reached [s].
        t: f64,
    },
    /// No step that advances the time keeps the tolerance.
    Underflow {
        /// The last time reached [s].
        t: f64,
    },
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Fault::Refused { t, reason } => write!(f, "no step is possible beyond t = {t:?} s: {}", reason.0),
            Fault::NotFinite { t } => {
                write!(f, "no step is possible beyond t = {t:?} s: a force or a rate is infinite or not a number")
            }
            Fault::Underflow { t } => write!(
                f,
                "no step that advances the time beyond t = {t:?} s keeps the tolerance: loosen \
                 solver.relative_tolerance, or soften what changes so fast"
            ),
        }
    }
}

/// What a run has cost so far. Counters are f64: an integer could overflow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Steps accepted.
    pub steps: f64,
    /// Steps rejected.
    pub rejected: f64,
    /// Evaluations of the right-hand side.
    pub evaluations: f64,
    /// The step that the method would like next [s].
    pub next_step: f64,
    /// Sum of the accepted steps' error norms, in units of the tolerance [1].
    pub error_estimate: f64,
}

stored!(Cost { steps, rejected, evaluations, next_step, error_estimate });

/// Where a step of size `h` [s] from `t` [s] ends that may not pass `until` [s]: it reaches it, or leaves half of a short
/// rest.
fn end_of_step(t: f64, h: f64, until: f64) -> f64 {
    let rest = until - t;
    if h >= rest {
        until
    } else if 2.0 * h > rest {
        t + 0.5 * rest
    } else {
        t + h
    }
}
