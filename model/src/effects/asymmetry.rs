//! `asymmetry`: a rotor whose transverse moments of inertia differ.

use super::{Effect, Facts, Row};
use crate::body::Shape;
use crate::variable::units::KILOGRAM_METRE_SQUARED;
use crate::variable::{Bound, parameter};

/// The moment of inertia about the second transverse axis, which is z where φ = 0 and γ = 0; that about the first stays
/// `rotor.Jt`.
#[derive(Clone, Debug, Default)]
#[allow(non_snake_case, reason = "the paper's symbols")]
pub struct Asymmetry {
    /// About c [kg·m²].
    pub Jt2: f64,
}

impl Effect for Asymmetry {
    const LAW: &'static str = "Jt about the axis of the body that is y at φ = 0, Jt2 about that which is z; ω = J⁻¹ K";

    const ROWS: &'static [Row<Self>] = &[parameter!(
        Jt2,
        &KILOGRAM_METRE_SQUARED,
        None,
        Bound::Positive,
        "moment of inertia about c and the axis that is z at phi = 0, gamma = 0; rotor.Jt is that about y"
    )];

    const FACTS: Facts = Facts { pushes: false, could_work: false, shapes: true, ..Facts::USUAL };

    fn shape(&self, body: &mut Shape) {
        body.Jt2 = Some(self.Jt2);
    }
}
