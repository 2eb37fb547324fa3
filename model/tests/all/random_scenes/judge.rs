//! How far ours may be from the reference.

use super::play::{Method, Ours, play};
use super::trial::Trial;
use super::truth::{Measures, Truth, over};
use crate::harness::largest;
use std::f64::consts::TAU;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// The tolerances that are tried.
pub const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];

/// Errors may be so many tolerances of how far the motion goes.
const ALLOWED: f64 = 300.0;

/// And as much more as it nutates oftener than this.
const NUTATIONS: f64 = 600.0;

/// What became of a scene at a tolerance.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// At which tolerance.
    pub tolerance: f64,
    /// The method that ran: what `auto` took.
    pub method: String,
    /// Errors over sizes [1], or why there are none.
    pub errors: Result<Measures, String>,
    /// The output that is worst beside the motion, and its error over its size [1].
    pub output: (String, f64),
    /// The worst error over what is allowed [1].
    pub worst: f64,
    /// Evaluations.
    pub evaluations: f64,
    /// What the ledger of the energy leaves over at the end [1].
    pub residual: f64,
    /// What it took after its start [s].
    pub seconds: f64,
}

impl Verdict {
    /// Of a method of ours at a relative tolerance, by how far the motion goes.
    pub fn of(trial: &Trial, truth: &Truth, method: Method, tolerance: f64) -> Self {
        Self::within(trial, truth, method, [tolerance, 0.0])
    }

    /// Of a method of ours at a relative and an absolute tolerance.
    pub fn within(trial: &Trial, truth: &Truth, method: Method, tolerances: [f64; 2]) -> Self {
        let (mut name, mut evaluations, mut residual, mut seconds) = (method.name(), 0.0, 0.0, 0.0);
        let run = || {
            let mut ours = Ours::start(trial, method, tolerances)?;
            let began = Instant::now();
            let shown = play(trial, &mut ours);
            seconds = began.elapsed().as_secs_f64();
            name = ours.auto().unwrap_or(name.clone());
            evaluations = ours.evaluations();
            residual = ours.residual();
            shown
        };
        let shown = catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|_| Err(PANICKED.into()));
        let tolerance = tolerances[0];
        // What is dropped or tilted nutates at Ja/Jt of its spin, and errors add up.
        let nutations = truth.sizes[2] / TAU * trial.machine.Ja / trial.machine.Jt;
        let allowed = ALLOWED * tolerance * truth.growth.max(1.0).max(nutations / NUTATIONS);
        let output = shown.as_ref().map(|shown| truth.worst_output(trial, shown, allowed));
        let output = output.unwrap_or_else(|_| ("nothing".into(), f64::INFINITY));
        let errors = shown.map(|shown| over(truth.differences(trial, &shown), truth.sizes));
        let worst = errors.as_ref().map_or(f64::INFINITY, |errors| largest([largest(*errors), output.1]) / allowed);
        Self { tolerance, method: name, errors, output, worst, evaluations, residual, seconds }
    }

    /// Whether it answers as near as is allowed.
    pub fn is_right(&self) -> bool {
        self.worst <= 1.0
    }

    /// Whether it says that it has no answer.
    pub fn is_refused(&self) -> bool {
        self.errors.as_ref().is_err_and(|why| why != PANICKED)
    }
}

const PANICKED: &str = "panicked";
