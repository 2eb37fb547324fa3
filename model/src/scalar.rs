//! The number that the physics is written over: f64 for values, [`crate::dual::Dual`] for exact derivatives.
//!
//! Elementary functions are those of the pure-Rust `libm` crate: the same bits on every host, in debug and release.

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

    /// Whether it is the coefficient of one power of time: laws then multiply what varies through their motion only.
    const SERIES: bool = false;

    /// A constant: its derivatives are zero.
    fn constant(value: f64) -> Self;

    /// The value without its derivatives.
    fn re(self) -> f64;

    /// The square root, of a value ≥ 0.
    fn sqrt(self) -> Self;

    /// Sine and cosine of an angle \[rad].
    fn sin_cos(self) -> [Self; 2];

    /// e to this power.
    fn exp(self) -> Self;

    /// The hyperbolic tangent.
    fn tanh(self) -> Self;

    /// The azimuth of (x, y) \[rad], `self` being y, in [−π, π]. At the origin it has no limit: 0, and derivatives of 0.
    fn atan2(self, x: Self) -> Self;

    /// A value ≥ 0 to any power. At 0 the derivative is 0 where it would be infinite (a power below 1): that of
    /// `x.positive_part().powf(p)` from the left. So no second derivative of a contact's δ^1.5 is infinite or not a number.
    fn powf(self, power: f64) -> Self;

    /// `then` where this value is less than `other`, else `otherwise`, each with its derivatives. A law that branches by
    /// what moves asks this, [`abs`](Scalar::abs), [`max`](Scalar::max), [`min`](Scalar::min) or
    /// [`positive_part`](Scalar::positive_part), and never `re`, so that `dependencies` sees both branches.
    #[inline(always)]
    fn where_less(self, other: Self, then: Self, otherwise: Self) -> Self {
        if self.re() < other.re() { then } else { otherwise }
    }

    /// The sine of an angle \[rad].
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos()[0]
    }

    /// The cosine of an angle \[rad].
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos()[1]
    }

    /// A whole power, by squaring: the same products in the same order everywhere.
    #[inline(always)]
    fn powi(self, power: i32) -> Self {
        let (mut result, mut square, mut rest) = (Self::one(), self, power.unsigned_abs());
        while rest > 0 {
            if rest % 2 == 1 {
                result *= square;
            }
            rest /= 2;
            // The last square would count for nothing, and may overflow.
            if rest > 0 {
                square *= square;
            }
        }
        if power < 0 { Self::one() / result } else { result }
    }

    /// The size. At 0 its derivative is that from the right.
    #[inline(always)]
    fn abs(self) -> Self {
        self.where_less(Self::zero(), -self, self)
    }

    /// The larger of two; of equals this one, with its derivatives.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.where_less(other, other, self)
    }

    /// The smaller of two; of equals this one, with its derivatives.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        other.where_less(self, other, self)
    }

    /// max(x, 0). At 0 its derivative is that from the right; not a number remains so.
    #[inline(always)]
    fn positive_part(self) -> Self {
        self.where_less(Self::zero(), Self::zero(), self)
    }

    /// Another value with the same derivatives: for what is known better than arithmetic gives it.
    fn with_value(self, value: f64) -> Self;

    /// What follows this value in jumps: its derivatives are zero.
    #[inline(always)]
    fn jumping(self, value: f64) -> Self {
        Self::constant(value)
    }

    /// A value with this derivative in every direction.
    fn moving(value: f64, rate: f64) -> Self;

    /// Of a [series](Scalar::SERIES): what varies, of which this is the coefficient.
    #[inline(always)]
    fn of_power(coefficient: f64) -> Self {
        Self::constant(coefficient)
    }

    /// Of a [series](Scalar::SERIES): the coefficient of what varies; None of a constant.
    #[inline(always)]
    fn in_power(self) -> Option<f64> {
        None
    }

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
pub(crate) fn estrin<T: Copy + Add<Output = T> + Mul<Output = T>>(a: &[T; 9], x: T) -> T {
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
    fn sin_cos(self) -> [Self; 2] {
        libm::sincos(self).into()
    }

    #[inline(always)]
    fn exp(self) -> Self {
        libm::exp(self)
    }

    #[inline(always)]
    fn tanh(self) -> Self {
        libm::tanh(self)
    }

    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        libm::atan2(self, x)
    }

    #[inline(always)]
    fn powf(self, power: f64) -> Self {
        // A ball's contact and its stiffness: a root is cheap, and rounded to the last bit.
        if power == 1.5 {
            self * f64::sqrt(self)
        } else if power == 0.5 {
            f64::sqrt(self)
        } else {
            libm::pow(self, power)
        }
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
