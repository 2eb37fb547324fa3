//! Which settings are tried: every method that the FMU lists, from loose to tight.

use super::motion::Errors;
use super::reference::Reference;
use super::repeats::least_time;
use super::row::{Measured, OURS, Row};
use super::run::{Run, Setting, Subject};
use anyhow::Result;
use model::variables::METHODS;

/// What chooses the accuracy of an adaptive method.
pub const TOLERANCE: &str = "solver.relative_tolerance";

/// 1e-3, 5e-4, 2e-4, 1e-4, … 1e-14: so many of them as fill the powers of ten in between.
pub fn tolerances() -> Vec<f64> {
    // Written out and read, so that each is the number that a user would type.
    let read = |text: String| text.parse().expect("a number");
    let decade = |n: u32| [format!("1e-{n}"), format!("5e-{}", n + 1), format!("2e-{}", n + 1)].map(read);
    (3..14).flat_map(decade).chain([1e-14]).collect()
}

/// The tolerances of the sweep: tighter ones are left to the reference.
pub fn swept_tolerances() -> Vec<f64> {
    tolerances().into_iter().filter(|tolerance| *tolerance >= 1e-13).collect()
}

/// A method with a tolerance.
pub fn with_tolerance(method: &'static str, value: f64) -> Setting {
    Setting { method, parameter: TOLERANCE, value }
}

/// The settings of all methods.
pub fn settings() -> Vec<Setting> {
    // `auto` is one of the others.
    let methods = METHODS.items.iter().map(|item| item.1).filter(|method| *method != "auto");
    methods.flat_map(|method| swept_tolerances().into_iter().map(move |value| with_tolerance(method, value))).collect()
}

/// One row: a setting's time and errors, or why it cannot be run.
pub fn measure(subject: &Subject, setting: &Setting, reference: &Reference) -> Row {
    let outcome = try_measure(subject, setting, reference).map_err(|error| format!("{error:#}"));
    Row {
        tool: OURS.into(),
        version: env!("CARGO_PKG_VERSION").into(),
        method: setting.method.into(),
        parameter: setting.parameter.into(),
        value: setting.value,
        outcome,
    }
}

fn try_measure(subject: &Subject, setting: &Setting, reference: &Reference) -> Result<Measured> {
    // The first run also warms the machine up.
    let Run { points, costs, .. } = subject.run(setting, 1)?;
    let (cpu_time, repeats) = least_time(|| Ok(subject.run(setting, 1)?.cpu_time))?;
    let [end, worst] = Errors::of(&points, &reference.points);
    let [steps, _, evaluations] = costs;
    Ok(Measured { end, worst, cpu_time, repeats, steps: Some(steps), evaluations: Some(evaluations) })
}

/// How much more a run costs whose communication steps are `substeps` times as many, with as many outputs read.
pub fn cost_of_substeps(subject: &Subject, setting: &Setting, substeps: usize) -> Result<f64> {
    let mut fine = f64::INFINITY;
    // Both in turn, so that a busy machine is unfair to both.
    let (coarse, _) = least_time(|| {
        fine = fine.min(subject.run(setting, substeps)?.cpu_time);
        Ok(subject.run(setting, 1)?.cpu_time)
    })?;
    Ok(fine / coarse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_tolerances_are_those_that_a_user_types() {
        let all = tolerances();
        assert_eq!(all[..4], [1e-3, 5e-4, 2e-4, 1e-4]);
        assert_eq!(all[all.len() - 4..], [1e-13, 5e-14, 2e-14, 1e-14]);
        assert!(all.is_sorted_by(|looser, tighter| looser > tighter));
    }

    #[test]
    fn exact_every_method_is_swept() {
        let swept = settings();
        for (_, method, _) in METHODS.items.iter().filter(|item| item.1 != "auto") {
            assert!(swept.iter().any(|setting| setting.method == *method), "{method}");
        }
    }
}
