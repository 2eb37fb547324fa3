//! The number that the physics is written over: f64 for values, [`crate::dual::Dual`] for exact derivatives.

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign};
use num_traits::{One, Zero};
use std::ops::{Add, Mul, Neg};
use wide::f64x2;

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
    /// Whether it carries derivatives: arithmetic is then so long that laws over it are compiled once, and called.
    const LONG: bool = true;

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

    /// Two polynomials Σ a_i x^i at once, the coefficients of both side by side.
    #[inline(always)]
    fn polynomials(coefficients: &[[f64; 2]; 9], x: Self) -> [Self; 2] {
        [0, 1].map(|which| {
            let a = coefficients.map(|row| Self::constant(row[which]));
            estrin(&a, x)
        })
    }
}

/// Σ a_i x^i by pairs of terms (Estrin 1960): they wait for one another less than in Horner's scheme.
#[inline(always)]
fn estrin<T: Copy + Add<Output = T> + Mul<Output = T>>(a: &[T; 9], x: T) -> T {
    let x2 = x * x;
    let x4 = x2 * x2;
    let two = |i: usize| a[i] + a[i + 1] * x;
    ((two(0) + two(2) * x2) + a[8] * (x4 * x4)) + (two(4) + two(6) * x2) * x4
}

impl Scalar for f64 {
    const LONG: bool = false;

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

    #[inline(always)]
    fn polynomials(coefficients: &[[f64; 2]; 9], x: Self) -> [Self; 2] {
        // Both in the two halves of one register: the same bits in half the time.
        estrin(&coefficients.map(f64x2::new), f64x2::splat(x)).to_array()
    }
}
