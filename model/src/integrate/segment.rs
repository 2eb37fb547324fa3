//! The last step of a pair, and the state within it.

use super::answer::Answer;
use super::sizes::Sizes;
use super::tableau::MOST_DENSE;
use crate::stored::stored;

/// The last step.
#[derive(Clone, Copy, Debug)]
pub struct Segment<const N: usize> {
    /// Where it began \[s].
    pub t: f64,
    /// Its size \[s].
    pub h: f64,
    /// The state at its start.
    pub y: [f64; N],
    /// How large the motion was there.
    pub sizes: Sizes<N>,
    /// r_2 and further of eq. 24; the first is there from the start, the others once somebody asked.
    pub r: [[f64; N]; MOST_DENSE - 1],
    /// Whether `r` is filled.
    pub dense: bool,
    /// Whether that polynomial says nothing between its ends.
    pub rough: bool,
    /// What it was then read for.
    pub answer: Answer<N>,
}

stored!(Segment<const N: usize> { t, h, y, sizes, r, dense, rough, answer });

impl<const N: usize> Segment<N> {
    /// None yet.
    pub fn blank() -> Self {
        Self {
            t: 0.0,
            h: 0.0,
            y: [0.0; N],
            sizes: Sizes::blank(),
            r: [[0.0; N]; MOST_DENSE - 1],
            dense: false,
            rough: false,
            answer: Answer::none(),
        }
    }

    /// The state at a time `t` \[s], by the first so many terms.
    pub fn at(&self, t: f64, terms: usize) -> [f64; N] {
        let sigma = (t - self.t) / self.h;
        let mut sum = [0.0; N];
        // eq. 24: y(t₀ + σh) = r₁ + σ(r₂ + (1 − σ)(r₃ + σ(r₄ + (1 − σ)(r₅ + …))))
        for (i, row) in self.r[..terms].iter().enumerate().rev() {
            let factor = if i % 2 == 0 { sigma } else { 1.0 - sigma };
            for (sum, r) in sum.iter_mut().zip(row) {
                *sum = (*sum + r) * factor;
            }
        }
        std::array::from_fn(|n| self.y[n] + sum[n])
    }
}
