//! A hard case: what happens, what is hard about it, who knows the answer, and what must make it fail.

use super::bench::Bench;
use super::method::Method;
use anyhow::Result;
use nalgebra::{Vector2, Vector3};
use oracles::{motion, rotation};
use split_rotor_tools::accuracy::motion::Point;
use std::f64::consts::TAU;

/// Runs a case and tells its error.
pub type Task = Box<dyn Fn(&Bench) -> Result<Found> + Sync>;

/// A name of a variable and its value.
pub type Setting = (&'static str, f64);

/// For communication steps that are meant to be long.
pub const ALL_IT_TAKES: Setting = ("solver.max_evaluations", 1e12);

/// A case, for one method or several.
pub struct Case {
    /// What happens.
    pub name: String,
    /// What is hard about it.
    pub hard: &'static str,
    /// Who knows the answer.
    pub oracle: &'static str,
    /// The scene whose FMU runs.
    pub scene: &'static str,
    /// Each method, and the bound of its error.
    pub methods: Vec<(Method, f64)>,
    /// What must make it fail: a variable that the FMU gets times this.
    pub mutant: Setting,
    /// What is done.
    pub task: Task,
}

/// The error of a case: rad or m, or as `of` says.
#[derive(Clone, Debug)]
pub struct Found {
    /// The largest over all times.
    pub error: f64,
    /// Of what.
    pub of: String,
}

impl Found {
    /// None yet.
    pub fn nothing() -> Self {
        Self { error: 0.0, of: "nothing".into() }
    }

    /// The larger of this and another; what is not a number stays.
    pub fn or(self, error: f64, of: &str) -> Self {
        if error > self.error || error.is_nan() || self.of == "nothing" { Self { error, of: of.into() } } else { self }
    }
}

/// What is known of the motion at a time.
#[derive(Clone, Copy, Debug)]
pub struct Exact {
    /// Position of the mass centre \[m].
    pub r_c: Option<Vector3<f64>>,
    /// The axis.
    pub axis: Vector3<f64>,
    /// φ \[rad].
    pub phi: Phi,
}

/// What is known of φ \[rad].
#[derive(Clone, Copy, Debug)]
pub enum Phi {
    /// All of it.
    Whole(f64),
    /// But for whole turns.
    Part(f64),
    /// Not asked.
    Unasked,
}

impl Exact {
    /// A free rotor at time `t` \[s].
    pub fn of_free(rotor: &motion::FreeRotor, t: f64) -> Self {
        Self { r_c: None, axis: rotor.axis(t), phi: Phi::Whole(rotor.phi_in_closed_form(t)) }
    }

    /// A steady whirl at time `t` \[s].
    pub fn of_whirl(whirl: &motion::Whirl, t: f64) -> Self {
        Self { r_c: Some(whirl.r_c(t)), axis: rotation::axis(&whirl.gamma(t)), phi: Phi::Whole(whirl.phi(t)) }
    }

    /// How far off what is shown is, in units of `scale` but for φ.
    pub fn error(&self, shown: &Point, scale: f64, found: Found) -> Found {
        let phi = match self.phi {
            Phi::Whole(phi) => TAU * shown.turns + shown.angle - phi,
            Phi::Unasked => 0.0,
            Phi::Part(phi) => libm::remainder(shown.angle - phi, TAU),
        };
        let place = self.r_c.map_or(0.0, |r_c| (shown.r_c - r_c).norm());
        found
            .or((shown.axis - self.axis).norm() / scale, "axis")
            .or(phi.abs(), "φ")
            .or(place / scale, "r_c")
            // No number may be missing, whatever is compared.
            .or(if shown.residual.is_finite() { 0.0 } else { f64::NAN }, "energy")
    }
}

/// The task to follow a motion that is known: these settings, and what is known at times \[s] since the start.
pub fn follow(settings: Vec<Setting>, times: Vec<f64>, exact: impl Fn(f64) -> Exact + Sync + 'static) -> Task {
    follow_from(0.0, 1.0, settings, times, exact)
}

/// [`follow`] of a motion that starts at time `start` \[s], with errors of axis and place in units of `scale`.
pub fn follow_from(
    start: f64,
    scale: f64,
    settings: Vec<Setting>,
    times: Vec<f64>,
    exact: impl Fn(f64) -> Exact + Sync + 'static,
) -> Task {
    Box::new(move |bench| {
        let mut rotor = bench.rotor(&settings)?;
        rotor.start(start, start + times[times.len() - 1])?;
        let mut found = exact(0.0).error(&rotor.shown()?, scale, Found::nothing());
        for t in &times {
            rotor.advance(start + t)?;
            found = exact(*t).error(&rotor.shown()?, scale, found);
        }
        Ok(found)
    })
}

/// So many times, evenly up to `end` \[s].
pub fn times(end: f64, count: u32) -> Vec<f64> {
    (1..=count).map(|n| end * f64::from(n) / f64::from(count)).collect()
}

/// Mass, moments of inertia and rod.
pub fn body(m: f64, axial: f64, transverse: f64, l: f64) -> Vec<Setting> {
    vec![("rotor.m", m), ("rotor.Ja", axial), ("rotor.Jt", transverse), ("rotor.l", l)]
}

/// The start: r_c \[m], v_c [m/s], φ \[rad], γ \[rad] and ω [rad/s].
pub fn start(
    r_c: &Vector3<f64>,
    v_c: &Vector3<f64>,
    phi: f64,
    gamma: &Vector2<f64>,
    omega: &Vector3<f64>,
) -> Vec<Setting> {
    vec![
        ("start.r_c.x", r_c.x),
        ("start.r_c.y", r_c.y),
        ("start.r_c.z", r_c.z),
        ("start.v_c.x", v_c.x),
        ("start.v_c.y", v_c.y),
        ("start.v_c.z", v_c.z),
        ("start.phi", phi),
        ("start.gamma.y", gamma.x),
        ("start.gamma.z", gamma.y),
        ("start.omega.x", omega.x),
        ("start.omega.y", omega.y),
        ("start.omega.z", omega.z),
    ]
}

/// A free rotor as it starts, its mass centre at rest.
pub fn of_free(rotor: &motion::FreeRotor) -> Vec<Setting> {
    let still = Vector3::zeros();
    let mut settings = body(5.0, rotor.Ja, rotor.Jt, 0.75);
    settings.extend(start(&still, &still, rotor.phi, &rotor.gamma, &rotor.omega));
    settings
}

/// A rotor on its support as its whirl starts.
pub fn of_whirl(whirl: &motion::Whirl) -> Vec<Setting> {
    let mut settings = body(whirl.m, whirl.Ja, whirl.Jt, whirl.l);
    settings.extend(support(whirl.c1, whirl.c2, -Vector3::x() * whirl.g));
    settings.extend(start(&whirl.r_c(0.0), &whirl.v_c(0.0), 0.0, &whirl.gamma(0.0), &whirl.omega(0.0)));
    settings
}

/// The support's stiffness [N/m, N·m/rad], and gravity [m/s²].
pub fn support(c1: f64, c2: f64, g: Vector3<f64>) -> Vec<Setting> {
    vec![("support.c1", c1), ("support.c2", c2), ("gravity.g.x", g.x), ("gravity.g.y", g.y), ("gravity.g.z", g.z)]
}
