//! The motion that counts as exact: the most accurate method at its limit, cross-checked by a second one.

use super::motion::{Errors, Point, Relative, Sizes};
use super::run::{Run, Setting, Subject};
use super::span::{POINTS, part};
use super::sweep;
use anyhow::{Context, Result};

/// The most accurate method, and the one that checks it: of another order, with other coefficients.
const METHODS: [&str; 2] = ["dop853", sweep::DOPRI5];

/// The motion that counts as exact, as far as two methods agree on it.
pub struct Reference {
    /// By whom.
    pub setting: Setting,
    /// By whom it was checked.
    pub check: Setting,
    /// The start.
    pub start: Point,
    /// The motion.
    pub points: Vec<Point>,
    /// How large it is: seen at the end of every part of the span, since few points could miss where it goes farthest.
    pub sizes: Sizes,
    /// How far the two are apart at the end and at worst.
    pub agreement: [Errors; 2],
    /// How far at worst, over the motion's own size: no smaller error can be told.
    pub floor: Relative,
}

impl Reference {
    /// Both runs, and what they make of each other.
    pub fn of(subject: &Subject) -> Result<Self> {
        let [(setting, exact), (check, second)] = METHODS.map(|method| tightest(subject, method));
        let (exact, second) = (exact?, second?);
        let sizes = Sizes::of(&exact.start, &exact.points);
        let [points, checked] =
            [&exact, &second].map(|run| (1..=POINTS).map(|n| run.points[part(n) - 1]).collect::<Vec<_>>());
        let agreement = Errors::of(&checked, &points);
        let floor = Relative::of(&checked, &exact.start, &points, &sizes);
        Ok(Self { setting, check, start: exact.start, points, sizes, agreement, floor })
    }

    /// The worst errors of these points, over the motion's own size.
    pub fn relative(&self, points: &[Point]) -> Relative {
        Relative::of(points, &self.start, &self.points, &self.sizes)
    }

    /// The largest angle of the axis with e at a communication point \[rad].
    pub fn largest_tilt(&self) -> f64 {
        let tilt = |point: &Point| point.axis[1].hypot(point.axis[2]).atan2(point.axis[0]);
        self.points.iter().map(tilt).fold(0.0, f64::max)
    }

    /// The largest kinetic energy \[J], to which an energy drift compares.
    pub fn energy_scale(&self) -> f64 {
        self.points.iter().map(|point| point.kinetic).fold(0.0, f64::max)
    }
}

/// A run of this method with the tightest tolerance that it accepts; where it accepts none, its word on the last.
fn tightest(subject: &Subject, method: &'static str) -> (Setting, Result<Run>) {
    let mut runs = sweep::tolerances().into_iter().rev().map(|tolerance| {
        let setting = sweep::with_tolerance(method, tolerance);
        (
            setting,
            subject
                .run_in_parts(&setting)
                .with_context(|| format!("no method can run {} to its end", subject.scene.name)),
        )
    });
    let mut last = runs.next().expect("there are tolerances");
    while last.1.is_err()
        && let Some(next) = runs.next()
    {
        last = next;
    }
    last
}

/// A reference for tests.
#[cfg(any(test, feature = "samples"))]
pub mod sample {
    use super::*;
    use nalgebra::Vector3;

    /// Of two points that are alike, with this much that cannot be told of place \[1] and axis \[rad].
    pub fn reference(floor: f64) -> Reference {
        let point = Point {
            r_c: Vector3::x(),
            axis: Vector3::x(),
            turns: 1.0,
            angle: 0.5,
            residual: 0.0,
            energy: 3.0,
            kinetic: 2.0,
        };
        let errors = Errors { r_c: 0.0, axis: 0.1 * floor, phi: 0.0, energy: 0.0 };
        let sizes = Sizes { place: 0.5, axis: 0.0, phi: 0.0 };
        let floor = Relative { place: floor, axis: 0.0, phi: 0.0 };
        let start = Point { r_c: Vector3::new(1.0, 0.5, 0.0), ..point };
        let [setting, check] = METHODS.map(|method| sweep::with_tolerance(method, 1e-14));
        Reference { setting, check, start, points: vec![point; 2], sizes, agreement: [errors; 2], floor }
    }
}
