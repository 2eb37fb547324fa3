//! What the last step was read for.

use crate::stored::stored;

/// A time within the last step and the state there. Asked again it costs nothing, so whoever goes on from a stored state
/// spends as much as whoever goes on without a break.
#[derive(Clone, Copy, Debug)]
pub struct Answer<const N: usize> {
    /// \[s]; not a number where there was no question yet.
    t: f64,
    y: [f64; N],
}

stored!(Answer<const N: usize> { t, y });

impl<const N: usize> Answer<N> {
    /// No question yet.
    pub fn none() -> Self {
        Self { t: f64::NAN, y: [0.0; N] }
    }

    /// The state at a time `t` \[s], if that was the last question.
    pub fn at(&self, t: f64) -> Option<[f64; N]> {
        (t == self.t).then_some(self.y)
    }

    /// Keeps the state `y` at a time `t` \[s], and returns it.
    pub fn keep(&mut self, t: f64, y: [f64; N]) -> [f64; N] {
        *self = Self { t, y };
        y
    }
}
