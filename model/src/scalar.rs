//! The number that the physics is written over: f64 for values, [`crate::dual::Dual`] for exact derivatives.

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign};
use num_traits::{One, Zero};
use std::ops::Neg;

/// The unit in the last place of `x`: from |x| to the next double.
pub fn ulp(x: f64) -> f64 {
    x.abs().next_up() - x.abs()
}

/// A real number, perhaps with derivatives attached.
pub trait Scalar:
    nalgebra::Scalar
    + Copy
    + Zero
    + One
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + ClosedDivAssign
    + Neg<Output = Self>
{
    /// A constant: its derivatives are zero.
    fn constant(value: f64) -> Self;

    /// The value without its derivatives.
    fn re(self) -> f64;

    /// The square root, of a value ≥ 0.
    fn sqrt(self) -> Self;

    /// Another value with the same derivatives: for what is known better than arithmetic gives it.
    fn with_value(self, value: f64) -> Self;

    /// A value with this derivative in every direction.
    fn moving(value: f64, rate: f64) -> Self;
}

impl Scalar for f64 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn re(self) -> f64 {
        self
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn with_value(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn moving(value: f64, _rate: f64) -> Self {
        value
    }
}
