//! A force and a moment.

use super::Motion;
use crate::scalar::Scalar;
use crate::state::Kinematics;
use nalgebra::Vector3;
use std::ops::Add;

/// A force on the rotor and its moment about c, in O.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<S: Scalar> {
    /// Force \[N].
    pub force: Vector3<S>,
    /// Moment about c [N·m].
    pub moment: Vector3<S>,
}

impl<S: Scalar> Wrench<S> {
    /// No load: zeros that leave every sum as it is, −0 + x = x. (+0 does not: +0 + −0 = +0. The compiler would have to add
    /// it.)
    #[inline(always)]
    pub fn zero() -> Self {
        let none = Vector3::repeat(-S::zero());
        Self { force: none, moment: none }
    }

    /// A force \[N] at the mass centre G of the whole.
    #[inline(always)]
    pub fn at_centre(motion: &Motion<S>, force: Vector3<S>) -> Self {
        match motion.to_centre() {
            None => Self { force, ..Self::zero() },
            // eq. 73: M_c = L b×F
            Some(to_centre) => Self { force, moment: to_centre.cross(&force) },
        }
    }

    /// Its moment about the mass centre G of the whole [N·m].
    #[inline(always)]
    pub fn about_centre(&self, motion: &Kinematics<S>) -> Vector3<S> {
        // eq. 73: M_G = M_c − L b×F
        motion.to_centre.map_or(self.moment, |to_centre| self.moment - to_centre.cross(&self.force))
    }

    /// A force \[N] at the station at `p` \[m] along t from c.
    #[inline(always)]
    pub fn at_station(motion: &Motion<S>, p: f64, force: Vector3<S>) -> Self {
        // eq. 60: M_c = p t×F
        Self { force, moment: motion.lever(p).cross(&force) }
    }

    /// A moment [N·m].
    #[inline(always)]
    pub fn couple(moment: Vector3<S>) -> Self {
        Self { moment, ..Self::zero() }
    }
}

impl<S: Scalar> Add for Wrench<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { force: self.force + other.force, moment: self.moment + other.moment }
    }
}
