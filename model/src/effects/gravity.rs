//! `gravity`: uniform gravity on the mass centre.

use super::{Effect, Row, Wrench};
use crate::scalar::Scalar;
use crate::state::Kinematics;
use crate::variable::units::METRE_PER_SECOND_SQUARED;
use crate::variable::{Bound, parameter};
use nalgebra::Vector3;

/// Uniform gravity.
#[derive(Clone, Debug, Default)]
pub struct Gravity {
    /// Acceleration of gravity g in O [m/s²].
    pub g: Vector3<f64>,
}

impl Effect for Gravity {
    const ROWS: &'static [Row<Self>] = &[
        parameter!("g.x", g.x, &METRE_PER_SECOND_SQUARED, Some(0.0), Bound::Finite, "acceleration of gravity along x"),
        parameter!("g.y", g.y, &METRE_PER_SECOND_SQUARED, Some(0.0), Bound::Finite, "acceleration of gravity along y"),
        parameter!("g.z", g.z, &METRE_PER_SECOND_SQUARED, Some(0.0), Bound::Finite, "acceleration of gravity along z"),
    ];

    const FOLLOWS_PLACE: bool = false;

    const COULD_WORK: bool = false;

    #[inline(always)]
    fn load<S: Scalar>(&self, motion: &Kinematics<S>) -> Wrench<S> {
        // eq. 13: F = m g, at the mass centre of the whole
        Wrench::at_centre(motion, (self.g * motion.body.m).map(S::constant))
    }

    #[inline(always)]
    fn potential<S: Scalar>(&self, motion: &Kinematics<S>) -> S {
        // eq. 13: V = −m g·r
        -(self.g * motion.body.m).map(S::constant).dot(&motion.at.r)
    }
}
