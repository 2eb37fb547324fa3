//! Motions that run away: each call ends after a bounded number of evaluations, with the answer or with the reason.

use super::case::{Case, times};
use super::machine::{Scene, error, started};
use super::method::{Method, at};
use crate::fmu::{DISCARD, Refused};
use anyhow::{Context, Result, ensure};
use nalgebra::Vector3;
use oracles::machine::known::ordinary;
use oracles::machine::{Machine, Start};

/// The family.
pub fn cases() -> Vec<Case> {
    vec![
        asymmetric([4e-11, 2e-10, 5e-10, 4e-11, 3e-9]),
        cross_coupled(1e7, 0.05, [5e-8, 1e-6, 5e-7, 5e-8, 5e-7]),
        cross_coupled(1e8, 0.006, [2e-8, 2e-7, 2e-7, 2e-8, 7e-8]),
    ]
}

/// Evaluations that a call may take here.
const MOST: f64 = 1e6;

/// A method that a call may cost so much.
fn limited(mut method: Method) -> Method {
    method.settings.push(("solver.max_evaluations", MOST));
    method
}

/// The composition of order 8, its step chosen by this tolerance.
fn steps(tolerance: f64) -> Method {
    limited(Method {
        name: "symplectic",
        settings: vec![("solver.order", 8.0), ("solver.relative_tolerance", tolerance)],
    })
}

/// All methods at this tolerance; the last bound is that of the composition.
fn methods(tolerance: f64, bounds: [f64; 5]) -> Vec<(Method, f64)> {
    let adaptive = ["dop853", "dopri5", "stiff", "auto"].map(|name| limited(at(name, tolerance)));
    adaptive.into_iter().chain([steps(tolerance)]).zip(bounds).collect()
}

/// What was not done must be discarded, with a reason, within the evaluations that a call may take.
fn ended(outcome: Result<()>, before: f64, after: f64) -> Result<bool> {
    ensure!(after - before <= 1.01 * MOST, "a call took {:e} evaluations", after - before);
    let Err(error) = outcome else { return Ok(true) };
    let refused = error.downcast_ref::<Refused>().context("it was not a call that failed")?;
    ensure!(refused.status == DISCARD, "status {}: {refused}", refused.status);
    let reasons = ["solver.max_evaluations", "no step", "cannot", "3.1 rad"];
    ensure!(reasons.iter().any(|reason| refused.log.contains(reason)), "no reason: {refused}");
    Ok(false)
}

/// An asymmetric body that falls, with a damper in it that drives its whirl.
fn falling() -> Machine {
    Machine {
        m: 5.0,
        Ja: 0.15625,
        Jt: 0.078125,
        Jt2: Some(0.1),
        l: 0.75,
        start: Start { r_c: Vector3::x() * 0.75, omega: Vector3::new(50.0, 20.0, 0.0), ..Start::default() },
        gravity: Some(Vector3::z() * -9.81),
        rotating_damping: Some([5.0, -0.1]),
        ..Machine::default()
    }
}

/// One call of 1 s.
fn asymmetric(bounds: [f64; 5]) -> Case {
    Case {
        name: "an asymmetric body with rotating damping, one call of 1 s".into(),
        hard: "it turns faster and faster",
        oracle: "the laws in quaternions, extrapolated to order 22",
        scene: "rotor",
        methods: methods(1e-10, bounds),
        mutant: ("rotating_damping.d", 1.01),
        task: Scene::alone(falling(), vec![1.0]).task(|_| Ok(())),
    }
}

/// The ordinary rotor with cross coupling [N/m] that makes it unstable: right until `follow` \[s]; beyond, each call ends.
fn cross_coupled(skew: f64, follow: f64, bounds: [f64; 5]) -> Case {
    let mut machine = ordinary();
    (machine.bearings[0].k[0][1], machine.bearings[0].k[1][0]) = (skew, -skew);
    Case {
        name: format!("an unstable rotor: cross coupling of {skew:e} N/m"),
        hard: "it grows beyond all bounds",
        oracle: "the laws in quaternions; a warning; then an end of each call within 10⁶ evaluations",
        scene: "rotor",
        methods: methods(1e-8, bounds),
        mutant: ("bearing[1].kyz", 1.001),
        task: Box::new(move |bench| {
            let mut rotor = started(bench, &machine, 3.3)?;
            let known = Scene::alone(machine.clone(), times(follow, 50));
            let found = error(&known.shown(&mut rotor)?, &known.exact()?);
            let warned = rotor.journal();
            ensure!(warned.contains("the rotor is unstable"), "no warning: {warned:?}");
            for n in 1..=33 {
                let before = rotor.evaluations()?;
                let outcome = rotor.advance(follow + 0.1 * f64::from(n));
                let after = rotor.evaluations().unwrap_or(before);
                if !ended(outcome, before, after)? {
                    break;
                }
            }
            Ok(found)
        }),
    }
}
