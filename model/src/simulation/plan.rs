//! Which method drives a rotor, and with which steps.

use crate::effects::Effects;
use crate::integrate::composition::{Composition, STRANG};
use crate::integrate::tableau::{DOP853, DOPRI5, Tableau};
use crate::variables::{Solver, numbers};

/// A method and what it needs to know.
#[derive(Clone, Copy)]
pub(super) enum Plan {
    /// A pair with adaptive steps.
    Explicit(&'static Tableau),
    /// A composition, with steps no longer than this \[s] where it is given.
    Composed(&'static Composition, Option<f64>),
    /// The same where nothing acts but the weight, so that every step is exact.
    Free(&'static Composition, Option<f64>),
    /// Radau IIA with adaptive steps.
    Stiff,
    /// Taylor's series, and dop853 where there is none, or where stability holds its steps.
    Taylor,
    /// As `Taylor`, and Radau IIA where that saves work.
    Auto,
}

impl Plan {
    /// That of the parameters, which were checked, under these effects.
    pub(super) fn new<E: Effects>(solver: &Solver, effects: &E) -> Self {
        match solver.method_in_force() {
            // Whatever may act is followed by methods that estimate their error.
            numbers::AUTO if effects.push() => Plan::Auto,
            numbers::AUTO => Plan::Free(&STRANG, None),
            numbers::DOPRI5 => Plan::Explicit(&DOPRI5),
            numbers::SYMPLECTIC => {
                let composition =
                    Composition::of_order(solver.order.unsigned_abs()).expect("an order that was checked");
                let longest = Some(solver.step_size).filter(|size| *size > 0.0);
                let plan = if effects.push() { Plan::Composed } else { Plan::Free };
                plan(composition, longest)
            }
            numbers::STIFF => Plan::Stiff,
            numbers::TAYLOR => Plan::Taylor,
            numbers::DOP853 => Plan::Explicit(&DOP853),
            other => unreachable!("there is no method {other}: it was checked"),
        }
    }
}
