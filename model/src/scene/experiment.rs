//! `[experiment]`: when and how finely a scene is looked at.

use crate::variable::units::{ONE, SECOND, Unit};
use crate::variable::{Bound, Kind};
use crate::variables::TOLERANCES;

/// The default experiment of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Experiment {
    /// Start time \[s].
    pub start: f64,
    /// Stop time \[s].
    pub stop: f64,
    /// Communication step \[s].
    pub step: f64,
    /// Relative tolerance \[1].
    pub tolerance: f64,
}

/// A key of `[experiment]`.
pub(super) struct Key {
    pub name: &'static str,
    pub unit: &'static Unit,
    /// What it is where it is not given, in words.
    pub default: &'static str,
    /// What it must be, in words.
    pub bound: &'static str,
    pub meaning: &'static str,
    /// Its value.
    pub get: fn(&Experiment) -> f64,
}

/// The keys, in the order in which they are settled: each default and bound follows from those before.
pub(super) const KEYS: [Key; 4] = [
    Key {
        name: "start",
        unit: &SECOND,
        default: "0",
        bound: "",
        meaning: "start time",
        get: |experiment| experiment.start,
    },
    Key {
        name: "stop",
        unit: &SECOND,
        default: "start + 10 s",
        bound: "later than start",
        meaning: "stop time",
        get: |experiment| experiment.stop,
    },
    Key {
        name: "step",
        unit: &SECOND,
        default: "(stop - start)/1000",
        bound: "> 0, at most stop - start",
        meaning: "communication step",
        get: |experiment| experiment.step,
    },
    Key {
        name: "tolerance",
        unit: &ONE,
        default: "solver.relative_tolerance",
        bound: "as solver.relative_tolerance",
        meaning: "relative tolerance that the FMU recommends to a host",
        get: |experiment| experiment.tolerance,
    },
];

impl Experiment {
    /// Of these values where they are given; `tolerance` stands in for its own. Of what is not possible the number among the keys, and
    /// what it must be.
    pub(super) fn of(given: [Option<f64>; 4], tolerance: f64) -> (Self, Vec<(usize, String)>) {
        let mut wrong = Vec::new();
        let mut settle = |n: usize, default: f64, bound: Bound, words: String| match given[n] {
            Some(value) if bound.holds(value) => value,
            Some(_) => {
                wrong.push((n, words));
                default
            }
            None => default,
        };
        let start = settle(0, 0.0, Bound::Finite, "a finite number in s".into());
        let after_start = Bound::Within(start + f64::MIN_POSITIVE.max(start.abs() * f64::EPSILON), f64::MAX);
        let stop = settle(1, start + 10.0, after_start, format!("later than experiment.start = {start:?} s"));
        let within = Bound::Within(f64::MIN_POSITIVE, stop - start);
        let right = format!("a number of seconds > 0, at most stop - start = {:?} s", stop - start);
        let step = settle(2, (stop - start) / 1000.0, within, right);
        let tolerance = settle(3, tolerance, TOLERANCES, TOLERANCES.words(Kind::Real));
        (Self { start, stop, step, tolerance }, wrong)
    }
}
