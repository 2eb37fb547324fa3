//! `gravity`: uniform gravity on the mass centre.

use super::{Act, Effect, Facts, Motion, Row, Wrench};
use crate::scalar::Scalar;
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
    const LAW: &'static str = "F = m g at the mass centre of the whole";

    const ROWS: &'static [Row<Self>] = &[
        parameter!("g.x", g.x, &METRE_PER_SECOND_SQUARED, Some(0.0), Bound::Finite, "acceleration of gravity along x"),
        parameter!("g.y", g.y, &METRE_PER_SECOND_SQUARED, Some(0.0), Bound::Finite, "acceleration of gravity along y"),
        parameter!("g.z", g.z, &METRE_PER_SECOND_SQUARED, Some(0.0), Bound::Finite, "acceleration of gravity along z"),
    ];

    const WHERE_EMPTY: &'static [(&'static str, f64)] = &[("g.z", -9.81)];

    const FACTS: Facts = Facts { could_work: false, pushes: false, ..Facts::USUAL };

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let weight = (self.g * motion.mass()).map(S::constant);
        // eq. 13: F = m g, at the mass centre of the whole, V = −m g·r
        Act { load: Wrench::at_centre(motion, weight), stored: -weight.dot(motion.centre()), ..Act::none() }
    }
}
