//! The coefficients of an explicit Runge–Kutta pair.

mod dop853;
mod dopri5;

pub use dop853::{DOP853, Dop853};
pub use dopri5::{DOPRI5, Dopri5};

use crate::stored::{Damaged, Stored, Walk, choice};

/// Σ a_j k_j as pairs (j, a_j); what is zero is left out.
pub type Combination = &'static [(usize, f64)];

/// k_i = f(t + c h, y + h Σ a_j k_j).
#[derive(Debug)]
pub struct Stage {
    /// When within the step \[1].
    pub c: f64,
    /// Of which stages before it.
    pub a: Combination,
}

impl Stored for &'static Tableau {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        choice(self, &[&DOPRI5, &DOP853], walk)
    }
}

impl PartialEq for Tableau {
    /// A tableau is itself only.
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

/// A pair with the rate at the end of a step as its last stage, which is the first of the next.
///
/// The sums are made so that what is newest is waited for last: the last entry of each stage's `a` is that of the stage before it, the stage
/// before the last one stands at the end of the step too (c = 1), the weights of the step begin with that of the first stage, and there are at
/// most 13 stages and 4 rows of dense output.
#[derive(Debug)]
pub struct Tableau {
    /// The stages after the first; the last stands at the end of the step.
    pub stages: &'static [Stage],
    /// Number of the last stage, counted from 0.
    pub last: usize,
    /// How the error is estimated.
    pub error: ErrorRule,
    /// What the estimate is multiplied by, so that the tolerance means for every method about the same: that the error of a
    /// smooth run is of its size (measured in `model/tests/all/honest_tolerance.rs`).
    pub calibration: f64,
    /// A motion that swings and does not die out is kept from growing by steps of up to so much of its phase \[rad]: where on the imaginary
    /// axis the stability function first exceeds 1 in size.
    pub swings: f64,
    /// The power of h with which the estimate falls.
    pub error_order: f64,
    /// More stages, which only dense output needs.
    pub dense_stages: &'static [Stage],
    /// r_5 and further of the dense output, over h.
    pub dense: &'static [Combination],
}

impl Tableau {
    /// The stage of this number, counted from 0, those for dense output after the last; the first, which is the rate at the
    /// start, is none of the list.
    pub const fn stage(&self, number: usize) -> &Stage {
        const NONE: &Stage = &Stage { c: 0.0, a: &[(0, 0.0)] };
        match number {
            0 => NONE,
            _ if number <= self.last => &self.stages[number - 1],
            _ if number < self.count() => &self.dense_stages[number - self.last - 1],
            _ => NONE,
        }
    }

    /// How many stages there are, those for dense output too.
    pub const fn count(&self) -> usize {
        1 + self.stages.len() + self.dense_stages.len()
    }

    /// r_5 and further of the dense output over h, counted from 0.
    pub const fn row(&self, number: usize) -> Combination {
        if number < self.dense.len() { self.dense[number] } else { &[] }
    }

    /// One step of size `h` of dy/dt = f(y), from y.
    #[inline(always)]
    pub fn advanced<const N: usize>(&self, mut f: impl FnMut(&[f64; N]) -> [f64; N], y: [f64; N], h: f64) -> [f64; N] {
        let mut k = [[0.0; N]; MOST_STAGES];
        let mut at = y;
        // eq. 21
        for (i, stage) in self.stages.iter().enumerate() {
            k[i] = f(&at);
            at = std::array::from_fn(|n| y[n] + h * stage.a.iter().map(|&(j, a)| a * k[j][n]).sum::<f64>());
        }
        at
    }
}

/// A tableau as a type, for what is compiled for it.
pub trait Pair {
    /// The coefficients.
    const TABLEAU: &'static Tableau;
}

/// How the error of a step is estimated.
#[derive(Debug)]
pub enum ErrorRule {
    /// h·|e|.
    Single(Combination),
    /// h·|fine|²/√(|fine|² + 0.01 |coarse|²), of orders 5 and 3.
    Blend {
        /// Of order 5.
        fine: Combination,
        /// Of order 3.
        coarse: Combination,
    },
}

impl ErrorRule {
    /// Whether the estimate needs this stage.
    pub const fn needs(&self, stage: usize) -> bool {
        match self {
            Self::Single(e) => contains(e, stage),
            Self::Blend { fine, coarse } => contains(fine, stage) || contains(coarse, stage),
        }
    }
}

const fn contains(combination: Combination, stage: usize) -> bool {
    let mut i = 0;
    while i < combination.len() {
        if combination[i].0 == stage {
            return true;
        }
        i += 1;
    }
    false
}

/// The most stages of any tableau, those for dense output included.
pub const MOST_STAGES: usize = 16;

/// The most rows r of any dense output.
pub const MOST_DENSE: usize = 8;
