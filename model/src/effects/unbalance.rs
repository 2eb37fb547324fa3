//! `unbalance`: a point mass on the rotor.

use super::{Effect, Facts, Row};
use crate::body::Shape;
use crate::variable::units::{KILOGRAM, METRE, RADIAN};
use crate::variable::{Bound, parameter};
use nalgebra::Vector3;

/// A point mass that turns with the rotor. c stays the mass centre of the balanced rotor, a point on its axis.
#[derive(Clone, Debug, Default)]
pub struct Unbalance {
    /// Its mass \[kg].
    pub mass: f64,
    /// Its distance from the axis \[m].
    pub radius: f64,
    /// Where it stands about the axis, from y towards z where φ = 0 and γ = 0 \[rad].
    pub angle: f64,
    /// Where it stands along t, from c \[m].
    pub position: f64,
}

impl Effect for Unbalance {
    const LAW: &'static str =
        "a point mass at s = (position, radius cos(angle), radius sin(angle)) in the axes of the body";

    const ROWS: &'static [Row<Self>] = &[
        parameter!(mass, &KILOGRAM, Some(0.0), Bound::NotNegative, "point mass on the rotor"),
        parameter!(radius, &METRE, None, Bound::NotNegative, "distance of the point mass from the axis"),
        parameter!(
            angle,
            &RADIAN,
            Some(0.0),
            Bound::Finite,
            "angle of the point mass about the axis, from y towards z at phi = 0, gamma = 0"
        ),
        parameter!(position, &METRE, None, Bound::Finite, "axial position from the mass centre"),
    ];

    const FACTS: Facts = Facts { pushes: false, could_work: false, shapes: true, ..Facts::USUAL };

    fn shape(&self, body: &mut Shape) {
        let (sine, cosine) = libm::sincos(self.angle);
        // eq. 71: s = (p, ρ cos α, ρ sin α)
        body.add(self.mass, &Vector3::new(self.position, self.radius * cosine, self.radius * sine));
    }
}
