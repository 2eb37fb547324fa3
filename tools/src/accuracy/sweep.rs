//! Which settings are tried: every method that the FMU lists, from loose to tight.

use super::auto;
use super::motion::Errors;
use super::reference::Reference;
use super::repeats::least_time;
use super::row::{Measured, OURS, Row};
use super::run::{Run, Setting, Subject};
use super::table::power;
use anyhow::Result;
use cpu_time::ThreadTime;
use split_rotor_model::scene::Experiment;
use split_rotor_model::variables::METHODS;

/// What chooses the accuracy of an adaptive method.
pub const TOLERANCE: &str = "solver.relative_tolerance";

/// What chooses that of a method with steps of one size.
pub const STEP: &str = "solver.step_size";

/// The method that checks the reference.
pub const DOPRI5: &str = "dopri5";

/// The method with steps of one size, and its orders.
const SYMPLECTIC: &str = "symplectic";
const ORDERS: [i32; 4] = [2, 4, 6, 8];

/// The method that is one of the others.
pub const AUTO: &str = "auto";

/// A run that takes longer is left out [s of CPU time].
const PATIENCE: f64 = 2.0;

/// Where a run takes longer [s of CPU time], one tolerance in a decade must do, or every other step.
const SLOW: f64 = 0.2;

/// A run that is refused after so long [s of CPU time] is the last of its curve: tighter ones would take longer.
const LATE: f64 = 0.5 * PATIENCE;

/// Steps are so many halves of a halving apart, from four times what suits a tolerance of 1e-6 to a sixteenth of it.
const STEPS: std::ops::RangeInclusive<i32> = -4..=8;

/// 1e-2, 5e-3, 2e-3, 1e-3, … 1e-14: so many of them as fill the powers of ten in between.
pub fn tolerances() -> Vec<f64> {
    // Written out and read, so that each is the number that a user would type.
    let read = |text: String| text.parse().expect("a number");
    let decade = |n: u32| [format!("1e-{n}"), format!("5e-{}", n + 1), format!("2e-{}", n + 1)].map(read);
    (2..14).flat_map(decade).chain([1e-14]).collect()
}

/// The tolerances of the sweep: tighter ones are left to the reference.
pub fn swept_tolerances() -> Vec<f64> {
    tolerances().into_iter().filter(|tolerance| *tolerance >= 1e-13).collect()
}

/// A method with a tolerance.
pub fn with_tolerance(method: &'static str, value: f64) -> Setting {
    Setting { method, order: None, parameter: TOLERANCE, value }
}

/// The methods that the FMU lists; `auto`, which is one of the others, comes last.
fn methods() -> impl Iterator<Item = &'static str> {
    METHODS.items.iter().map(|item| item.1).filter(|method| *method != AUTO).chain([AUTO])
}

/// Those whose accuracy a tolerance chooses.
pub fn with_a_tolerance() -> impl Iterator<Item = &'static str> {
    methods().filter(|method| *method != SYMPLECTIC)
}

/// The settings of all methods, a curve each, from loose to tight.
pub fn curves(subject: &Subject) -> Vec<Vec<Setting>> {
    let mut curves = Vec::new();
    let mean = mean_step(subject);
    for method in methods() {
        if method == SYMPLECTIC {
            for order in ORDERS {
                // At the start it may not see what is to come; and on the way dop853 may follow what it need not.
                curves.push(with_steps(order, step_of(subject, order).unwrap_or(0.0).max(like(mean, order))));
            }
        } else {
            curves.push(swept_tolerances().into_iter().map(|value| with_tolerance(method, value)).collect());
        }
    }
    curves
}

/// The step that `symplectic` would choose at its order for a tolerance of 1e-6 \[s].
fn step_of(subject: &Subject, order: i32) -> Result<f64> {
    subject.first_step(&Setting { order: Some(order), ..with_tolerance(SYMPLECTIC, 1e-6) })
}

/// The mean step that dop853 takes at a tolerance of 1e-6 \[s], 0 where it takes too long.
fn mean_step(subject: &Subject) -> f64 {
    let Experiment { start, stop, .. } = subject.experiment;
    subject.run(&with_tolerance("dop853", 1e-6), 1, PATIENCE).map_or(0.0, |run| (stop - start) / run.costs[0])
}

/// What suits a method of this order where one of order 8 takes steps of this size \[s] for a tolerance of 1e-6: an error goes as
/// the step to the power of the order.
fn like(step: f64, order: i32) -> f64 {
    step * 1e-6_f64.powf(1.0 / f64::from(order) - 1.0 / 8.0)
}

/// `symplectic` with steps about this one \[s], two digits each.
fn with_steps(order: i32, step: f64) -> Vec<Setting> {
    let size = |n: i32| format!("{:.1e}", step * 0.5_f64.powf(0.5 * f64::from(n))).parse().expect("a number");
    STEPS.map(|n| Setting { method: SYMPLECTIC, order: Some(order), parameter: STEP, value: size(n) }).collect()
}

/// The rows of a curve. Beyond the first that takes too long none is tried.
pub fn measure(subject: &Subject, curve: &[Setting], reference: &Reference, done: impl Fn()) -> Vec<Row> {
    rows(curve, |setting| try_measure(subject, setting, reference), done)
}

fn rows(curve: &[Setting], mut try_it: impl FnMut(&Setting) -> Result<Measured>, done: impl Fn()) -> Vec<Row> {
    let (mut is_slow, mut too_slow) = (false, None);
    let mut rows = Vec::new();
    for (n, setting) in curve.iter().enumerate() {
        let is_between =
            if setting.parameter == TOLERANCE { !power(setting.value).starts_with("1e") } else { n % 2 == 1 };
        let skipped = is_slow && is_between;
        if !skipped {
            let outcome = match &too_slow {
                Some(value) => Err(format!("left out: {} takes too long", power(*value))),
                None => {
                    let began = ThreadTime::now();
                    let outcome = try_it(setting).map_err(|error| format!("{error:#}"));
                    let took = began.elapsed().as_secs_f64();
                    let time = outcome.as_ref().map_or(took, |measured| measured.cpu_time);
                    is_slow |= time > SLOW;
                    too_slow = (outcome.is_err() && took > LATE).then_some(setting.value);
                    outcome
                }
            };
            rows.push(row(setting, outcome));
        }
        done();
    }
    rows
}

fn row(setting: &Setting, outcome: Result<Measured, String>) -> Row {
    Row {
        tool: OURS.into(),
        version: env!("CARGO_PKG_VERSION").into(),
        vector_widths: [None; 2],
        method: setting.method.into(),
        order: setting.order,
        parameter: setting.parameter.into(),
        value: setting.value,
        outcome,
    }
}

fn try_measure(subject: &Subject, setting: &Setting, reference: &Reference) -> Result<Measured> {
    let Run { points, costs, cpu_time, said, .. } = subject.run(setting, 1, PATIENCE)?;
    let (cpu_time, repeats) = least_time(cpu_time, || Ok(subject.run(setting, 1, PATIENCE)?.cpu_time))?;
    let [end, worst] = Errors::of(&points, &reference.points);
    let [steps, _, evaluations] = costs;
    Ok(Measured {
        relative: reference.relative(&points),
        told: points.len(),
        end,
        worst,
        cpu_time,
        repeats,
        is_interleaved: false,
        steps: Some(steps),
        evaluations: Some(evaluations),
        taken: auto::taken(&said),
    })
}

/// How much more a run costs whose communication steps are `substeps` times as many, with as many outputs read.
pub fn cost_of_substeps(subject: &Subject, setting: &Setting, substeps: usize) -> Result<f64> {
    let run = |substeps| Ok(subject.run(setting, substeps, f64::INFINITY)?.cpu_time);
    let mut fine = run(substeps)?;
    // Both in turn, so that a busy machine is unfair to both.
    let (coarse, _) = least_time(run(1)?, || {
        fine = fine.min(run(substeps)?);
        run(1)
    })?;
    Ok(fine / coarse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances_are_those_that_a_user_types() {
        let all = tolerances();
        assert_eq!(all[..4], [1e-2, 5e-3, 2e-3, 1e-3]);
        assert_eq!(all[all.len() - 4..], [1e-13, 5e-14, 2e-14, 1e-14]);
        assert!(all.is_sorted_by(|looser, tighter| looser > tighter));
    }

    #[test]
    fn steps_of_lower_orders_err_as_much_as_those_of_order_8() {
        assert_eq!(like(0.3, 8), 0.3);
        for order in [2, 4, 6] {
            let ratio = like(0.3, order).powi(order) / 0.3_f64.powi(order);
            assert!((ratio / 1e-6_f64.powf(1.0 - f64::from(order) / 8.0) - 1.0).abs() < 1e-12, "{ratio}");
        }
    }

    #[test]
    fn beyond_a_run_that_takes_too_long_none_is_tried() {
        let curve: Vec<_> = swept_tolerances().into_iter().map(|value| with_tolerance("m", value)).collect();
        let mut tried = Vec::new();
        let refused = rows(
            &curve,
            |setting| {
                tried.push(setting.value);
                if setting.value < 1e-5 {
                    let began = ThreadTime::now();
                    while began.elapsed().as_secs_f64() <= LATE {}
                }
                anyhow::bail!("refused")
            },
            || (),
        );
        // Down to 1e-5, and the first below it.
        assert_eq!((tried.len(), tried.last()), (11, Some(&5e-6)));
        // Then one in a decade is named.
        assert_eq!(refused.len(), 11 + 8);
        let last = refused.last().unwrap();
        assert_eq!((last.value, last.outcome.as_ref().unwrap_err().as_str()), (1e-13, "left out: 5e-6 takes too long"));
    }

    #[test]
    fn steps_are_those_that_a_user_types() {
        let steps: Vec<_> = with_steps(4, 0.01).iter().map(|setting| setting.value).collect();
        assert_eq!((steps.len(), &steps[..5]), (13, [0.04, 0.028, 0.02, 0.014, 0.01].as_slice()));
        assert!(steps.is_sorted_by(|longer, shorter| longer > shorter));
    }
}
