//! The coefficient of one power of time: laws that add what moves and multiply it by constants give it as they stand.
#![allow(clippy::suspicious_arithmetic_impl, reason = "what is no such law gives what is not a number")]

use crate::scalar::Scalar;
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A constant, or the coefficient of one power of time of what varies: of its zeroth power, the value itself, or of a higher one,
/// to which constants add nothing. What is neither, such as a product of two that vary, is not a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficient<const HIGHER: bool> {
    value: f64,
    varies: bool,
}

impl<const HIGHER: bool> Coefficient<HIGHER> {
    /// Of what varies.
    #[inline(always)]
    pub const fn varying(value: f64) -> Self {
        Self { value, varies: true }
    }

    /// What no law of this kind gives.
    pub const NONE: Self = Self::varying(f64::NAN);

    /// Whether it is that of what varies.
    #[inline(always)]
    pub fn varies(self) -> bool {
        self.varies
    }

    /// The coefficient, of a constant too.
    #[inline(always)]
    pub fn coefficient(self) -> f64 {
        if HIGHER && !self.varies { 0.0 } else { self.value }
    }

    /// A function of constants only.
    #[inline(always)]
    fn of_constant(self, function: impl Fn(f64) -> f64) -> Self {
        if self.varies { Self::NONE } else { Self::constant(function(self.value)) }
    }

    /// The sum, or the difference.
    #[inline(always)]
    fn with(self, other: Self, sum: impl Fn(f64, f64) -> f64) -> Self {
        if self.varies == other.varies {
            return Self { value: sum(self.value, other.value), ..self };
        }
        Self::varying(match (HIGHER, self.varies) {
            (false, _) => sum(self.value, other.value),
            (true, true) => self.value,
            (true, false) => sum(-0.0, other.value),
        })
    }
}

impl<const HIGHER: bool> Scalar for Coefficient<HIGHER> {
    const LONG: bool = false;

    const SERIES: bool = true;

    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self { value, varies: false }
    }

    #[inline(always)]
    fn re(self) -> f64 {
        if self.varies { f64::NAN } else { self.value }
    }

    fn sqrt(self) -> Self {
        self.of_constant(f64::sqrt)
    }

    fn sin_cos(self) -> [Self; 2] {
        [self.of_constant(Scalar::sin), self.of_constant(Scalar::cos)]
    }

    fn exp(self) -> Self {
        self.of_constant(Scalar::exp)
    }

    fn tanh(self) -> Self {
        self.of_constant(Scalar::tanh)
    }

    fn atan2(self, x: Self) -> Self {
        if x.varies { Self::NONE } else { self.of_constant(|y| Scalar::atan2(y, x.value)) }
    }

    fn powf(self, power: f64) -> Self {
        self.of_constant(|value| Scalar::powf(value, power))
    }

    #[inline(always)]
    fn where_less(self, other: Self, then: Self, otherwise: Self) -> Self {
        if self.varies || other.varies {
            return Self::NONE;
        }
        if self.value < other.value { then } else { otherwise }
    }

    fn with_value(self, _value: f64) -> Self {
        Self::NONE
    }

    fn moving(value: f64, _rate: f64) -> Self {
        Self::constant(value)
    }

    #[inline(always)]
    fn of_power(coefficient: f64) -> Self {
        Self::varying(coefficient)
    }

    #[inline(always)]
    fn in_power(self) -> Option<f64> {
        self.varies.then_some(self.value)
    }
}

impl<const HIGHER: bool> Add for Coefficient<HIGHER> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        self.with(b, |a, b| a + b)
    }
}

impl<const HIGHER: bool> Sub for Coefficient<HIGHER> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        self.with(b, |a, b| a - b)
    }
}

impl<const HIGHER: bool> Mul for Coefficient<HIGHER> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        if self.varies && b.varies {
            return Self::NONE;
        }
        Self { value: self.value * b.value, varies: self.varies || b.varies }
    }
}

impl<const HIGHER: bool> Div for Coefficient<HIGHER> {
    type Output = Self;
    #[inline(always)]
    fn div(self, b: Self) -> Self {
        if b.varies { Self::NONE } else { Self { value: self.value / b.value, ..self } }
    }
}

impl<const HIGHER: bool> Neg for Coefficient<HIGHER> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl<const HIGHER: bool> AddAssign for Coefficient<HIGHER> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl<const HIGHER: bool> SubAssign for Coefficient<HIGHER> {
    #[inline(always)]
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}

impl<const HIGHER: bool> MulAssign for Coefficient<HIGHER> {
    #[inline(always)]
    fn mul_assign(&mut self, b: Self) {
        *self = *self * b;
    }
}

impl<const HIGHER: bool> DivAssign for Coefficient<HIGHER> {
    #[inline(always)]
    fn div_assign(&mut self, b: Self) {
        *self = *self / b;
    }
}

impl<const HIGHER: bool> Zero for Coefficient<HIGHER> {
    #[inline(always)]
    fn zero() -> Self {
        Self::constant(0.0)
    }

    #[inline(always)]
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl<const HIGHER: bool> One for Coefficient<HIGHER> {
    #[inline(always)]
    fn one() -> Self {
        Self::constant(1.0)
    }
}
