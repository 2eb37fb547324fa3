//! What cannot be done: the FMU must say why, know how far it came, and stay usable.

use super::case::{Case, Found, Setting, Task, start, support};
use super::method::{Method, at, symplectic};
use crate::fmu::{DISCARD, ERROR, Refused};
use anyhow::{Context, Result, ensure};
use nalgebra::{Vector2, Vector3};

/// The family.
pub fn cases() -> Vec<Case> {
    vec![
        no_advance(),
        past_the_limit(),
        absurd_springs(),
        absurd_start(),
        late_fast_motion(),
        too_long_steps(),
        too_short_steps(),
    ]
}

/// Every method.
fn all() -> Vec<Method> {
    vec![at("dop853", 1e-10), at("dopri5", 1e-10), at("stiff", 1e-8), symplectic(6, 1e-3), at("auto", 1e-8)]
}

fn with(bound: f64) -> Vec<(Method, f64)> {
    all().into_iter().map(|method| (method, bound)).collect()
}

/// A rotor at rest in this place \[m], tilted by θ \[rad], with ω [rad/s].
fn placed(place: Vector3<f64>, theta: f64, omega: Vector3<f64>) -> Vec<Setting> {
    start(&place, &Vector3::zeros(), 0.0, &Vector2::new(0.0, theta), &omega)
}

/// The paper's rotor tilted by 0.1 rad.
fn tilted() -> Vec<Setting> {
    placed(Vector3::x() * 0.75, 0.1, Vector3::x() * 50.0)
}

/// t + h = t.
fn no_advance() -> Case {
    Case {
        name: "a step of 10⁻⁹ s at t = 10⁹ s".into(),
        hard: "t + h = t",
        oracle: "fmi2Error that names the step and what is needed",
        scene: "paper",
        methods: with(0.0),
        mutant: ("communication step", 1e3),
        task: Box::new(|bench| {
            let mut rotor = bench.rotor(&tilted())?;
            rotor.start(1e9, 2e9)?;
            let found = refused(
                rotor.step(bench.number("communication step", 1e-9)),
                ERROR,
                &["1e-9", "too small", "is needed"],
            )?;
            // It stays usable.
            rotor.step(0.25)?;
            ensure!(rotor.shown()?.residual.is_finite(), "no number after the refusal");
            Ok(found)
        }),
    }
}

/// Tumbling at 10 rad/s towards −e with a tilt spring, which ends at 3.1 rad: refused at 0.31 s.
fn past_the_limit() -> Case {
    let mut settings = support(0.0, 1e-300, Vector3::zeros());
    settings.extend(placed(Vector3::zeros(), 0.0, Vector3::z() * 10.0));
    Case {
        name: "a tilt spring carried past 3.1 rad".into(),
        hard: "its direction has no limit at −e",
        oracle: "fmi2Discard at the time when 10 t = 3.1",
        scene: "paper",
        methods: with(4e-14),
        mutant: ("support.c2", 0.0),
        task: discarded(settings, |t| (t - 0.31).abs(), &["3.1 rad"]),
    }
}

/// Springs whose force overflows.
fn absurd_springs() -> Case {
    let mut settings = support(1e300, 500.0, Vector3::zeros());
    settings.extend(placed(Vector3::new(1.0, 0.5, 0.0), 0.0, Vector3::x() * 50.0));
    Case {
        name: "a support of 10³⁰⁰ N/m, stretched".into(),
        hard: "no step is short enough",
        oracle: "fmi2Discard before anything moves",
        scene: "paper",
        methods: with(1e-6),
        mutant: ("support.c1", 1e-297),
        // Where springs alone move it, steps that are stable are possible, but too many.
        task: discarded(settings, |t| t, &["no step", "too fast to be followed"]),
    }
}

/// An energy beyond all doubles.
fn absurd_start() -> Case {
    let settings = placed(Vector3::x() * 0.75, 0.0, Vector3::new(50.0, 1e200, 0.0));
    Case {
        name: "a start of 10²⁰⁰ rad/s".into(),
        hard: "its energy overflows",
        oracle: "fmi2Error that names start.omega.y",
        scene: "paper",
        methods: with(0.0),
        mutant: ("start.omega.y", 1e-200),
        task: Box::new(move |bench| {
            let mut rotor = bench.rotor(&settings)?;
            refused(rotor.start(0.0, 1.0), ERROR, &["start.omega.y"])
        }),
    }
}

/// Motion so fast that a double of the time cannot tell its steps apart.
fn late_fast_motion() -> Case {
    let mut settings = support(1e16, 500.0, Vector3::zeros());
    settings.extend(tilted());
    Case {
        name: "a support of 10¹⁶ N/m at t = 10⁹ s".into(),
        hard: "its own periods are below the last place of the time",
        oracle: "fmi2Discard that says so",
        scene: "paper",
        methods: vec![(at("dop853", 1e-10), 0.0), (at("dopri5", 1e-10), 0.0), (at("auto", 1e-8), 0.0)],
        mutant: ("support.c1", 1e-13),
        task: Box::new(move |bench| {
            let mut rotor = bench.rotor(&settings)?;
            rotor.start(1e9, 2e9)?;
            refused(rotor.step(0.25), DISCARD, &["no step"])
        }),
    }
}

/// A step of the symplectic method that springs make unstable: it is shortened, at a price that is refused here.
fn too_long_steps() -> Case {
    let mut settings = support(1e9, 0.0, Vector3::zeros());
    settings.extend(tilted());
    settings.extend([("solver.max_evaluations", 1e3), ("solver.relative_tolerance", 1e-3)]);
    Case {
        name: "symplectic steps too long for a support of 10⁹ N/m".into(),
        hard: "shorter ones cost more than a host allows",
        oracle: "fmi2Discard that says so",
        scene: "paper",
        methods: [2, 4, 6, 8].map(|order| (symplectic(order, 1e-3), 0.01)).into(),
        mutant: ("support.c1", 1e-6),
        task: discarded(settings, |t| t, &["solver.max_evaluations", "the energy is not kept"]),
    }
}

/// Steps of the symplectic method of which a run would take for ever.
fn too_short_steps() -> Case {
    Case {
        name: "symplectic steps of 10⁻¹⁵ s".into(),
        hard: "10¹⁵ of them a second: a hang",
        oracle: "fmi2Discard that says so",
        scene: "paper",
        methods: vec![(Method { name: "symplectic", settings: vec![] }, 1e-6)],
        mutant: ("solver.step_size", 1e12),
        task: discarded([tilted(), vec![("solver.step_size", 1e-15)]].concat(), |t| t, &["a longer solver.step_size"]),
    }
}

/// Runs for a second, in steps of a hundredth, and must be discarded with this reason; the time reached decides.
fn discarded(
    settings: Vec<Setting>,
    off: impl Fn(f64) -> f64 + Sync + 'static,
    reasons: &'static [&'static str],
) -> Task {
    Box::new(move |bench| {
        let mut rotor = bench.rotor(&settings)?;
        rotor.start(0.0, 1.0)?;
        for n in 1..=100 {
            let Err(error) = rotor.advance(f64::from(n) / 100.0) else { continue };
            let said = error.to_string();
            ensure!(reasons.iter().any(|reason| said.contains(reason)), "{said} has none of {reasons:?}");
            refused(Err(error), DISCARD, &[])?;
            // What it shows are numbers, or a refusal that says why not.
            if let Err(error) = rotor.shown() {
                refused(Err(error), DISCARD, &["is infinite or undefined here"])?;
            }
            return Ok(Found { error: off(rotor.last_successful_time()?), of: "time".into() });
        }
        anyhow::bail!("every step was done")
    })
}

/// The outcome must be this status, with a message that holds these words.
fn refused(outcome: Result<()>, status: i32, words: &[&str]) -> Result<Found> {
    let error = outcome.err().context("it was done")?;
    let refused = error.downcast_ref::<Refused>().context("it was not a call that failed")?;
    ensure!(refused.status == status, "status {} instead of {status}: {refused}", refused.status);
    ensure!(words.iter().all(|word| refused.log.contains(word)), "{refused} lacks one of {words:?}");
    Ok(Found { error: 0.0, of: "refused".into() })
}
