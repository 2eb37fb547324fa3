//! Dual numbers: a value and its derivatives in D directions, carried exactly through arithmetic.
//!
//! With ε² = 0, f(a + a′ε) = f(a) + f′(a) a′ ε.
#![allow(clippy::suspicious_arithmetic_impl, reason = "the rules of product and quotient mix operations")]

use crate::scalar::Scalar;
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// re + Σ eps_i ε_i, with D directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const D: usize> {
    /// The value.
    pub re: f64,
    /// The derivative in each direction.
    pub eps: [f64; D],
}

impl<const D: usize> Dual<D> {
    /// The independent variable of a direction: value `re`, derivative 1 in `direction` (< D), 0 in the others.
    pub fn variable(re: f64, direction: usize) -> Self {
        let mut eps = [0.0; D];
        eps[direction] = 1.0;
        Self { re, eps }
    }

    /// re with each derivative given by its direction.
    fn with(re: f64, eps: impl FnMut(usize) -> f64) -> Self {
        Self { re, eps: std::array::from_fn(eps) }
    }
}

impl<const D: usize> Scalar for Dual<D> {
    fn constant(re: f64) -> Self {
        Self { re, eps: [0.0; D] }
    }

    fn re(self) -> f64 {
        self.re
    }

    fn sqrt(self) -> Self {
        let root = self.re.sqrt();
        Self::with(root, |i| 0.5 * self.eps[i] / root)
    }
}

impl<const D: usize> Add for Dual<D> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self::with(self.re + b.re, |i| self.eps[i] + b.eps[i])
    }
}

impl<const D: usize> Sub for Dual<D> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self::with(self.re - b.re, |i| self.eps[i] - b.eps[i])
    }
}

impl<const D: usize> Mul for Dual<D> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self::with(self.re * b.re, |i| self.eps[i] * b.re + self.re * b.eps[i])
    }
}

impl<const D: usize> Div for Dual<D> {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let quotient = self.re / b.re;
        Self::with(quotient, |i| (self.eps[i] - quotient * b.eps[i]) / b.re)
    }
}

impl<const D: usize> Neg for Dual<D> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::with(-self.re, |i| -self.eps[i])
    }
}

impl<const D: usize> AddAssign for Dual<D> {
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl<const D: usize> SubAssign for Dual<D> {
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}

impl<const D: usize> MulAssign for Dual<D> {
    fn mul_assign(&mut self, b: Self) {
        *self = *self * b;
    }
}

impl<const D: usize> DivAssign for Dual<D> {
    fn div_assign(&mut self, b: Self) {
        *self = *self / b;
    }
}

impl<const D: usize> Zero for Dual<D> {
    fn zero() -> Self {
        Self::constant(0.0)
    }

    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl<const D: usize> One for Dual<D> {
    fn one() -> Self {
        Self::constant(1.0)
    }
}
