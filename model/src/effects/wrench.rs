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
    /// No load.
    #[inline(always)]
    pub fn zero() -> Self {
        Self { force: Vector3::zeros(), moment: Vector3::zeros() }
    }
}

impl<S: Scalar> Add for Wrench<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { force: self.force + other.force, moment: self.moment + other.moment }
    }
}
