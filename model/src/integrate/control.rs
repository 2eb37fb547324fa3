//! Step size control: a proportional–integral controller (Gustafsson 1991; Hairer, Nørsett and Wanner, Solving
//! Ordinary Differential Equations I, 2nd ed., section IV.2 of volume II and the codes dopri5 and dop853).

use super::power::{exp2, log2, power};
use crate::stored::stored;

/// Proposes step sizes from the error norms of a method.
#[derive(Clone, Copy, Debug)]
pub struct Controller {
    /// Exponent of the present error.
    alpha: f64,
    /// Exponent of the previous error.
    beta: f64,
    /// log₂ of the error norm of the last accepted step.
    previous: f64,
    /// Whether the last attempt was rejected.
    rejected: bool,
}

stored!(Controller { alpha, beta, previous, rejected });

/// A step is chosen this much smaller than the error would allow.
const SAFETY: f64 = 0.9;
/// A step shrinks at most to this part of the last.
const LEAST_FACTOR: f64 = 0.2;
/// A step grows at most to this multiple of the last.
const GREATEST_FACTOR: f64 = 6.0;
/// The share of the integral part.
const BETA: f64 = 0.04;
/// An error norm below this counts as this: a lucky step must not drive the next one.
const LEAST_ERROR: f64 = 1e-4;

impl Controller {
    /// The controller of a method whose error estimate falls with the power `order` of the step.
    pub fn new(order: f64) -> Self {
        Self { alpha: 1.0 / order - 0.75 * BETA, beta: BETA, previous: log2(LEAST_ERROR), rejected: false }
    }

    /// The factor to the next step size after a step of error norm `error` ≤ 1 was accepted.
    pub fn accepted(&mut self, error: f64) -> f64 {
        // eq. 23: h_new = h·clip(safety·err^(−α)·err_prev^β)
        let log = log2(error);
        let factor = SAFETY * exp2(-self.alpha * log) * exp2(self.beta * self.previous);
        let greatest = if self.rejected { 1.0 } else { GREATEST_FACTOR };
        self.previous = log.max(log2(LEAST_ERROR));
        self.rejected = false;
        factor.clamp(LEAST_FACTOR, greatest)
    }

    /// The factor to the next attempt after a step of error norm `error` > 1, or one that cannot be measured, was rejected.
    pub fn rejected(&mut self, error: f64) -> f64 {
        self.rejected = true;
        if error.is_finite() { (SAFETY * power(error, -self.alpha)).clamp(LEAST_FACTOR, SAFETY) } else { LEAST_FACTOR }
    }
}
