//! `moment`: an unbalance as what a balancing machine tells of it, mass times radius.

use super::values::Values;
use crate::variable::units::Unit;
use std::ops::Range;

/// The effect that may have it, its key, its unit and meaning, and the keys in whose place it stands.
pub(super) const EFFECT: &str = "unbalance";
pub(super) const KEY: &str = "moment";
pub(super) static UNIT: Unit = Unit { name: "kg.m", exponents: [1, 1, 0, 0], display: None };
pub(super) const MEANING: &str = "mass times radius, instead of both: a point mass of moment/k at the radius of gyration \
                                  k = sqrt(rotor.Ja/rotor.m), where it changes mass and axial inertia equally little, by moment/(m k)";
pub(super) const INSTEAD_OF: [&str; 2] = ["mass", "radius"];

/// A moment that a file gives.
pub(super) struct Moment {
    /// The block of its unbalance: `unbalance[1]`.
    pub block: String,
    /// None where it is not possible.
    pub value: Option<f64>,
    pub place: Range<usize>,
}

impl Values<'_> {
    /// Gives each unbalance that has a moment its mass and radius.
    pub(super) fn take_moments(&mut self) {
        let [m, axial] = ["rotor.m", "rotor.Ja"].map(|name| self.start(name));
        let gyration = m.zip(axial).map(|(m, axial)| (axial / m).sqrt()).filter(|k| *k > 0.0 && k.is_finite());
        for Moment { block, value, place } in std::mem::take(&mut self.moments) {
            let of = |value: f64| gyration.map(|k| [value / k, k]);
            let values = value.and_then(of).map_or([None; 2], |both| both.map(Some));
            for (key, value) in INSTEAD_OF.iter().zip(values) {
                self.give(&format!("{block}.{key}"), value, place.clone());
            }
        }
    }
}
