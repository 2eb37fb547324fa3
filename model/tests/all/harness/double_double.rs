//! A scalar of twice the precision: the sum of two doubles, some 32 digits (Dekker 1971; Knuth). With it the model's own
//! lines give values whose rounding is out of sight.

use num_traits::{One, Zero};
use split_rotor_model::rotation::exact;
use split_rotor_model::scalar::Scalar;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// high + low.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    /// The nearest double.
    pub high: f64,
    /// What it lacks.
    pub low: f64,
}

impl DoubleDouble {
    fn of((high, low): (f64, f64)) -> Self {
        let (high, low) = exact::sum(high, low);
        Self { high, low }
    }
}

impl Scalar for DoubleDouble {
    fn with_value(self, value: f64) -> Self {
        Self::constant(value)
    }

    fn moving(value: f64, _rate: f64) -> Self {
        Self::constant(value)
    }

    fn constant(high: f64) -> Self {
        Self { high, low: 0.0 }
    }

    fn re(self) -> f64 {
        self.high
    }

    fn sin_cos(self) -> [Self; 2] {
        unimplemented!("in twice the precision")
    }

    fn exp(self) -> Self {
        unimplemented!("in twice the precision")
    }

    fn tanh(self) -> Self {
        unimplemented!("in twice the precision")
    }

    fn atan2(self, _x: Self) -> Self {
        unimplemented!("in twice the precision")
    }

    fn powf(self, _power: f64) -> Self {
        unimplemented!("in twice the precision")
    }

    fn sqrt(self) -> Self {
        let root = Self::constant(self.high.sqrt());
        root + (self - root * root) / (root + root)
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        let (sum, low) = exact::sum(self.high, b.high);
        Self::of((sum, low + self.low + b.low))
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let (product, low) = exact::product(self.high, b.high);
        Self::of((product, low + self.high * b.low + self.low * b.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let first = Self::constant(self.high / b.high);
        let rest = self - first * b;
        first + Self::constant(rest.high / b.high)
    }
}

macro_rules! assign {
    ($($trait:ident $method:ident $operator:tt;)*) => {
        $(impl $trait for DoubleDouble {
            fn $method(&mut self, b: Self) {
                *self = *self $operator b;
            }
        })*
    };
}

assign! { AddAssign add_assign +; SubAssign sub_assign -; MulAssign mul_assign *; DivAssign div_assign /; }

impl Zero for DoubleDouble {
    fn zero() -> Self {
        Self::constant(0.0)
    }

    fn is_zero(&self) -> bool {
        self.high == 0.0
    }
}

impl One for DoubleDouble {
    fn one() -> Self {
        Self::constant(1.0)
    }
}
