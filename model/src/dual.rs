//! Dual numbers: a value and its derivatives in D directions, carried exactly through arithmetic.
//!
//! With ε² = 0, f(a + a′ε) = f(a) + f′(a) a′ ε. Over duals instead of f64 they give second derivatives.
#![allow(clippy::suspicious_arithmetic_impl, reason = "the rules of product and quotient mix operations")]

use crate::scalar::Scalar;
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// re + Σ eps_i ε_i, with D directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const D: usize, S = f64> {
    /// The value.
    pub re: S,
    /// The derivative in each direction.
    pub eps: [S; D],
}

/// A value and its derivative in one direction.
pub type Tangent = Dual<1>;

impl<const D: usize, S: Scalar> Dual<D, S> {
    /// The independent variable of a direction: value `re`, derivative 1 in `direction` (< D), 0 in the others.
    pub fn variable(re: S, direction: usize) -> Self {
        let mut eps = [S::zero(); D];
        eps[direction] = S::one();
        Self { re, eps }
    }

    /// re with each derivative given by its direction.
    fn with(re: S, eps: impl FnMut(usize) -> S) -> Self {
        Self { re, eps: std::array::from_fn(eps) }
    }

    /// A function of this value, which has this value and this slope there.
    fn chained(self, re: S, slope: S) -> Self {
        Self::with(re, |i| slope * self.eps[i])
    }
}

impl<S: Scalar> Dual<1, S> {
    /// A value that changes at this rate.
    pub fn along(re: S, rate: S) -> Self {
        Self { re, eps: [rate] }
    }
}

impl<const D: usize, S: Scalar> Scalar for Dual<D, S> {
    fn constant(re: f64) -> Self {
        Self { re: S::constant(re), eps: [S::zero(); D] }
    }

    fn re(self) -> f64 {
        self.re.re()
    }

    fn sqrt(self) -> Self {
        let root = self.re.sqrt();
        self.chained(root, S::constant(0.5) / root)
    }

    fn sin_cos(self) -> [Self; 2] {
        let [sine, cosine] = self.re.sin_cos();
        [self.chained(sine, cosine), self.chained(cosine, -sine)]
    }

    fn exp(self) -> Self {
        let value = self.re.exp();
        self.chained(value, value)
    }

    fn tanh(self) -> Self {
        let value = self.re.tanh();
        // d tanh x = 1 − tanh² x
        self.chained(value, (S::one() - value) * (S::one() + value))
    }

    fn atan2(self, x: Self) -> Self {
        let square = x.re * x.re + self.re * self.re;
        let angle = self.re.atan2(x.re);
        if square.re() == 0.0 {
            return Self::constant(angle.re());
        }
        // dβ = (x dy − y dx)/(x² + y²)
        let (per_y, per_x) = (x.re / square, self.re / square);
        Self::with(angle, |i| per_y * self.eps[i] - per_x * x.eps[i])
    }

    fn powf(self, power: f64) -> Self {
        let is_flat = self.re() == 0.0 && power < 1.0;
        let slope = if is_flat { S::zero() } else { S::constant(power) * self.re.powf(power - 1.0) };
        self.chained(self.re.powf(power), slope)
    }

    fn with_value(self, value: f64) -> Self {
        Self { re: self.re.with_value(value), ..self }
    }

    fn moving(value: f64, rate: f64) -> Self {
        Self { re: S::moving(value, rate), eps: [S::constant(rate); D] }
    }
}

impl<const D: usize, S: Scalar> Add for Dual<D, S> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self::with(self.re + b.re, |i| self.eps[i] + b.eps[i])
    }
}

impl<const D: usize, S: Scalar> Sub for Dual<D, S> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self::with(self.re - b.re, |i| self.eps[i] - b.eps[i])
    }
}

impl<const D: usize, S: Scalar> Mul for Dual<D, S> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self::with(self.re * b.re, |i| self.eps[i] * b.re + self.re * b.eps[i])
    }
}

impl<const D: usize, S: Scalar> Div for Dual<D, S> {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let quotient = self.re / b.re;
        Self::with(quotient, |i| (self.eps[i] - quotient * b.eps[i]) / b.re)
    }
}

impl<const D: usize, S: Scalar> Neg for Dual<D, S> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::with(-self.re, |i| -self.eps[i])
    }
}

impl<const D: usize, S: Scalar> AddAssign for Dual<D, S> {
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl<const D: usize, S: Scalar> SubAssign for Dual<D, S> {
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}

impl<const D: usize, S: Scalar> MulAssign for Dual<D, S> {
    fn mul_assign(&mut self, b: Self) {
        *self = *self * b;
    }
}

impl<const D: usize, S: Scalar> DivAssign for Dual<D, S> {
    fn div_assign(&mut self, b: Self) {
        *self = *self / b;
    }
}

impl<const D: usize, S: Scalar> Zero for Dual<D, S> {
    fn zero() -> Self {
        Self::constant(0.0)
    }

    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl<const D: usize, S: Scalar> One for Dual<D, S> {
    fn one() -> Self {
        Self::constant(1.0)
    }
}
