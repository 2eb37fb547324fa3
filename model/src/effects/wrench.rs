//! A force and a moment.

use crate::scalar::Scalar;
use nalgebra::Vector3;
use std::ops::Add;

/// A force on the rotor and its moment about c, in O.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<S: Scalar> {
    /// Force [N].
    pub force: Vector3<S>,
    /// Moment about c [N·m].
    pub moment: Vector3<S>,
}

impl<S: Scalar> Wrench<S> {
    /// No load: zeros that leave every sum as it is, −0 + x = x. (+0 does not: +0 + −0 = +0. The compiler would have to add
    /// it.)
    #[inline(always)]
    pub fn zero() -> Self {
        let none = Vector3::repeat(S::constant(-0.0));
        Self { force: none, moment: none }
    }
}

impl<S: Scalar> Add for Wrench<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { force: self.force + other.force, moment: self.moment + other.moment }
    }
}
