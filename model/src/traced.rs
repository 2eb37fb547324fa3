//! A scalar that carries what went into it: one calculation with it tells what depends on what, whatever the values are.

use crate::scalar::Scalar;
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A value and the sources that went into it, through every operation and both branches of every comparison.
///
/// A coefficient that happens to be zero hides nothing: only the zero of the scalar itself, [`Zero::zero`], is one whatever
/// the parameters are, and what is multiplied by it is nothing.
#[derive(Clone, Copy, Debug)]
pub struct Traced {
    value: f64,
    sources: Sources,
    is_nothing: bool,
}

/// A set of sources, one a bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sources(u128);

/// So many sources can be told apart, numbered from 1.
pub const MOST: usize = u128::BITS as usize - 1;

impl Sources {
    /// No source.
    const NONE: Self = Self(0);

    /// What is not a number: a value with a mark, where the source is no scalar.
    const NOT_A_NUMBER: Self = Self(1);

    fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether there is none.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The numbers of its sources, ascending; 0 stands for what was not a number.
    pub fn numbers(self) -> impl Iterator<Item = usize> {
        (0..=MOST).filter(move |number| self.0 >> number & 1 == 1)
    }
}

impl Traced {
    /// What went into it.
    pub fn sources(self) -> Sources {
        self.sources
    }

    fn of(value: f64, sources: Sources) -> Self {
        Self { value, sources, is_nothing: false }
    }

    fn through(self, function: impl Fn(f64) -> f64) -> Self {
        Self::of(function(self.value), self.sources)
    }

    /// A value of both.
    fn with(self, other: Self, value: f64) -> Self {
        Self::of(value, self.sources.and(other.sources))
    }
}

impl Scalar for Traced {
    /// A number that is none is a mark: so parameters, which are no scalars, are followed to where they enter.
    fn constant(value: f64) -> Self {
        Self::of(value, if value.is_nan() { Sources::NOT_A_NUMBER } else { Sources::NONE })
    }

    fn re(self) -> f64 {
        self.value
    }

    fn sqrt(self) -> Self {
        self.through(f64::sqrt)
    }

    fn sin_cos(self) -> [Self; 2] {
        [self.through(Scalar::sin), self.through(Scalar::cos)]
    }

    fn exp(self) -> Self {
        self.through(Scalar::exp)
    }

    fn tanh(self) -> Self {
        self.through(Scalar::tanh)
    }

    fn atan2(self, x: Self) -> Self {
        self.with(x, Scalar::atan2(self.value, x.value))
    }

    fn powf(self, power: f64) -> Self {
        // The power may be a parameter.
        self.with(Self::constant(power), Scalar::powf(self.value, power))
    }

    fn where_less(self, other: Self, then: Self, otherwise: Self) -> Self {
        let value = self.value.where_less(other.value, then.value, otherwise.value);
        Self::of(value, [other, then, otherwise].into_iter().fold(self.sources, |all, one| all.and(one.sources)))
    }

    fn with_value(self, value: f64) -> Self {
        Self { value, ..self }
    }

    fn jumping(self, value: f64) -> Self {
        self.with_value(value)
    }

    /// The source of this number; 0 is none.
    fn moving(value: f64, number: f64) -> Self {
        let sources = if number == 0.0 { Sources::NONE } else { Sources(1 << number as u32) };
        let constant = Self::constant(value);
        Self { sources: constant.sources.and(sources), ..constant }
    }
}

impl Add for Traced {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self { is_nothing: self.is_nothing && b.is_nothing, ..self.with(b, self.value + b.value) }
    }
}

impl Sub for Traced {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Traced {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        if self.is_nothing || b.is_nothing { Self::zero() } else { self.with(b, self.value * b.value) }
    }
}

impl Div for Traced {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        if self.is_nothing { Self::zero() } else { self.with(b, self.value / b.value) }
    }
}

impl Neg for Traced {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl AddAssign for Traced {
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl SubAssign for Traced {
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}

impl MulAssign for Traced {
    fn mul_assign(&mut self, b: Self) {
        *self = *self * b;
    }
}

impl DivAssign for Traced {
    fn div_assign(&mut self, b: Self) {
        *self = *self / b;
    }
}

impl PartialEq for Traced {
    fn eq(&self, b: &Self) -> bool {
        self.value == b.value
    }
}

impl Zero for Traced {
    fn zero() -> Self {
        Self { value: 0.0, sources: Sources::NONE, is_nothing: true }
    }

    fn is_zero(&self) -> bool {
        self.value == 0.0
    }
}

impl One for Traced {
    fn one() -> Self {
        Self::constant(1.0)
    }
}
