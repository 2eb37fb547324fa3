//! `moment`: an unbalance as what a balancing machine tells of it, mass times radius.

use super::problem::Problem;
use super::values::Values;
use crate::variable::units::Unit;
use std::ops::Range;

/// The effect that may have it, its key, its unit and meaning, and the keys in whose place it stands.
pub(super) const EFFECT: &str = "unbalance";
pub(super) const KEY: &str = "moment";
pub(super) static UNIT: Unit = Unit { name: "kg.m", exponents: [1, 1, 0, 0], display: None };
pub(super) const MEANING: &str = "mass times radius, instead of both: a point mass of moment/k at the radius of gyration \
                                  k = sqrt(rotor.Ja/rotor.m); m, Ja, Jt are those of the whole then, and the parameters rotor.* are \
                                  without this point mass";
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
    /// Gives each unbalance that has a moment its mass and radius, and takes these point masses out of the rotor, whose mass and inertias
    /// the scene gives for the whole. What cannot be is a problem.
    pub(super) fn take_moments(&mut self) -> Vec<Problem> {
        let [m, axial] = ["rotor.m", "rotor.Ja"].map(|name| self.start(name));
        let gyration = m.zip(axial).map(|(m, axial)| (axial / m).sqrt()).filter(|k| *k > 0.0 && k.is_finite());
        let (mut points, mut largest) = (Vec::new(), None);
        for Moment { block, value, place } in std::mem::take(&mut self.moments) {
            let of = |value: f64| gyration.map(|k| [value / k, k]);
            let point = value.and_then(of);
            let values = point.map_or([None; 2], |both| both.map(Some));
            for (key, value) in INSTEAD_OF.iter().zip(values) {
                self.give(&format!("{block}.{key}"), value, place.clone());
            }
            let [angle, position] = ["angle", "position"].map(|key| self.start(&format!("{block}.{key}")));
            if let (Some([mass, radius]), Some(angle), Some(position)) = (point, angle, position) {
                points.push(Point { mass, radius, angle, position });
                largest = largest.filter(|(most, _)| *most >= mass).or(Some((mass, place)));
            }
        }
        let Some((_, place)) = largest.filter(|(mass, _)| *mass > 0.0) else { return Vec::new() };
        if self.take_out(&points) {
            return Vec::new();
        }
        // One word of it is enough.
        let rotor = ROTOR.iter().filter_map(|name| self.find(name));
        self.refused.extend(rotor.map(|variable| variable.place.value_reference()).collect::<Vec<_>>());
        let masses: f64 = points.iter().map(|point| point.mass).sum();
        let wrong = format!(
            "[rotor] has m, Ja and Jt of the whole: no rotor is left without the point masses, {masses:.3e} kg, for which the moments stand"
        );
        vec![Problem::at(place, wrong, "give `mass` and `radius` of each unbalance, and m, Ja, Jt without them")]
    }

    /// Takes point masses out of the rotor; false where what is left cannot be.
    fn take_out(&mut self, points: &[Point]) -> bool {
        let sum = |of: &dyn Fn(&Point) -> f64| points.iter().map(|point| point.mass * of(point)).sum::<f64>();
        let square = |x: f64| x * x;
        let about_y = sum(&|point| square(point.position) + square(point.radius * libm::sin(point.angle)));
        let about_z = sum(&|point| square(point.position) + square(point.radius * libm::cos(point.angle)));
        // About y and z where the scene gives both, else about any axis across, in the mean.
        let is_asymmetric = self.find(SECOND).is_some();
        let across = if is_asymmetric { about_y } else { 0.5 * (about_y + about_z) };
        let parts = [sum(&|_| 1.0), sum(&|point| square(point.radius)), across, about_z];
        let before = ROTOR.map(|name| self.start(name));
        let mut left = [None; 4];
        for (n, part) in parts.into_iter().enumerate() {
            left[n] = before[n].map(|value| value - part);
            if let (Some(variable), Some(value)) = (self.find(ROTOR[n]), left[n]) {
                self.starts.insert(variable.place.value_reference(), value);
            }
        }
        let is_disk_at_most = |of: [Option<f64>; 4]| {
            let [_, axial, across, _] = of.map(Option::unwrap_or_default);
            is_asymmetric || axial <= 2.0 * across * (1.0 + ROUNDING)
        };
        // What was impossible before is reported at its own key.
        let is_worse = is_disk_at_most(before) && !is_disk_at_most(left);
        left.iter().zip(before).all(|(left, before)| before.is_none_or(|before| before <= 0.0) || *left > Some(0.0))
            && !is_worse
    }
}

/// What a point mass changes; the last one where the body has it.
const ROTOR: [&str; 4] = ["rotor.m", "rotor.Ja", "rotor.Jt", SECOND];
const SECOND: &str = "asymmetry.Jt2";

/// A point mass \[kg], where it stands in cylindrical coordinates \[m], \[rad].
struct Point {
    mass: f64,
    radius: f64,
    angle: f64,
    position: f64,
}

/// A thin disk may be thinner by so much of its inertia, which is rounded \[1].
const ROUNDING: f64 = 1e-12;
