//! A row of the result: a case with one method. Its columns are those of the CSV and the keys of the JSON.

use super::case::{Case, Found};
use super::method::Method;
use serde_json::{Value, json};

/// What came of a run, or why it could not be done.
pub type Outcome = Result<Found, String>;

/// A case with one method.
pub struct Row<'c> {
    /// The case's family.
    pub family: &'static str,
    /// What happens, what is hard about it, and who knows the answer.
    pub case: &'c Case,
    /// By which method.
    pub method: &'c Method,
    /// The bound of its error.
    pub bound: f64,
    /// What came of it.
    pub outcome: Outcome,
    /// What came of the mutant, where it ran.
    pub mutated: Option<Outcome>,
    /// Evaluations of the right-hand side.
    pub evaluations: f64,
    /// How long it took \[s of CPU time].
    pub seconds: f64,
}

impl Row<'_> {
    /// The mutant in words.
    pub fn mutant(&self) -> String {
        let (name, factor) = self.case.mutant;
        format!("{name} × {}", shown(factor))
    }

    /// Whether a run is within the bound; what is not a number is not.
    fn keeps(&self, outcome: &Outcome) -> bool {
        outcome.as_ref().is_ok_and(|found| found.error <= self.bound)
    }

    /// What is wrong with it.
    pub fn complaint(&self) -> Option<String> {
        let (case, method, bound) = (&self.case.name, self.method.label(), self.bound);
        if !self.keeps(&self.outcome) {
            return Some(match &self.outcome {
                Ok(found) => format!("{case}, {method}: error {:.1e} of {}, bound {bound:.1e}", found.error, found.of),
                Err(why) => format!("{case}, {method}: {why}"),
            });
        }
        let survives = self.mutated.as_ref().is_some_and(|outcome| self.keeps(outcome));
        survives.then(|| format!("{case}, {method}: the mutant {} is not seen", self.mutant()))
    }

    /// Each column's name with its unit, and the value, null where there is none.
    pub fn columns(&self) -> Vec<(&'static str, Value)> {
        let found = self.outcome.as_ref().ok();
        let mutated = self.mutated.as_ref().map(|outcome| match outcome {
            Ok(found) => json!(found.error),
            Err(why) => json!(why),
        });
        vec![
            ("family", json!(self.family)),
            ("case", json!(self.case.name)),
            ("hard", json!(self.case.hard)),
            ("oracle", json!(self.case.oracle)),
            ("method", json!(self.method.label())),
            ("error", json!(found.map(|found| found.error))),
            ("error_of", json!(found.map(|found| &found.of))),
            ("bound", json!(self.bound)),
            ("keeps_bound", json!(self.keeps(&self.outcome))),
            ("evaluations", json!(self.evaluations)),
            ("seconds", json!(self.seconds)),
            ("mutant", json!(self.mutant())),
            ("mutant_error", json!(mutated)),
            ("failure", json!(self.outcome.as_ref().err())),
        ]
    }
}

/// A factor as it is typed, or by its power of ten.
fn shown(factor: f64) -> String {
    if factor != 0.0 && factor.abs() < 1e-3 { format!("{factor:e}") } else { format!("{factor}") }
}
