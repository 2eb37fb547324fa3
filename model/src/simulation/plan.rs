//! Which method drives a rotor, and with which steps: that of the parameters, or the one that would cost least.

use super::outlook::Outlook;
use crate::effects::Effects;
use crate::integrate::composition::Composition;
use crate::integrate::tableau::{DOP853, DOPRI5, Tableau};
use crate::rotor::Rotor;
use crate::variables::{Solver, numbers};
use std::fmt;

/// A method and what it needs to know.
#[derive(Clone, Copy)]
pub(super) enum Plan {
    /// A pair with adaptive steps.
    Explicit(&'static Tableau),
    /// A composition with steps of this size [s].
    Composed(&'static Composition, f64),
    /// Radau IIA with adaptive steps.
    Stiff,
}

impl Plan {
    /// That of the parameters, which were checked, for a rotor that starts at time `t` [s] and state `y` and runs for `span`
    /// [s], where that is known.
    pub(super) fn new<E: Effects, const N: usize>(
        solver: &Solver,
        rotor: &Rotor<E>,
        t: f64,
        y: &[f64; N],
        span: Option<f64>,
    ) -> Self {
        let outlook = || Outlook::new(solver, rotor, t, y, span);
        let plan = match solver.method {
            numbers::AUTO => Choice::new(&outlook()).plan,
            numbers::DOPRI5 => Plan::Explicit(&DOPRI5),
            numbers::SYMPLECTIC => {
                let composition =
                    Composition::of_order(solver.order.unsigned_abs()).expect("an order that was checked");
                let size = if solver.step_size > 0.0 { solver.step_size } else { outlook().drift(composition) };
                Plan::Composed(composition, size)
            }
            numbers::STIFF => Plan::Stiff,
            _ => Plan::Explicit(&DOP853),
        };
        match (plan, span) {
            // What a step does after the run is lost work.
            (Plan::Composed(composition, size), Some(span)) if span > 0.0 => {
                Plan::Composed(composition, size.min(span))
            }
            _ => plan,
        }
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Plan::Explicit(tableau) => f.write_str(if **tableau == DOP853 { "dop853" } else { "dopri5" }),
            Plan::Composed(composition, size) => {
                write!(f, "symplectic of order {} in steps of {size:.3e} s", composition.order)
            }
            Plan::Stiff => f.write_str("stiff"),
        }
    }
}

/// What `auto` takes, and why.
pub(super) struct Choice {
    pub(super) plan: Plan,
    outlook: Outlook,
    /// What each would take [µs of work a second]: dop853, symplectic, stiff.
    prices: [f64; 3],
}

impl Choice {
    /// The method that would cost least.
    pub(super) fn new(outlook: &Outlook) -> Self {
        let compositions = [2, 4, 6, 8].into_iter().filter_map(Composition::of_order);
        let priced = compositions.map(|composition| (outlook.price_of_drifts(composition), composition));
        let (drifts, composition) = priced.min_by(|a, b| a.0.total_cmp(&b.0)).expect("there are four");
        let prices = [outlook.price_of_dop853(), drifts, outlook.price_of_stiff()];
        let plan = if prices[0] <= prices[1].min(prices[2]) {
            Plan::Explicit(&DOP853)
        } else if prices[1] <= prices[2] {
            Plan::Composed(composition, outlook.drift(composition))
        } else {
            Plan::Stiff
        };
        Self { plan, outlook: *outlook, prices }
    }
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Outlook { fastest, lasting, turns, drifts, .. } = self.outlook;
        let pushes = self.outlook.pushes();
        write!(f, "auto takes {}: ", self.plan)?;
        match (self.plan, turns) {
            (Plan::Composed(..), _) if pushes == 0.0 => {
                write!(f, "no force changes with the place, and drifts are exact")?
            }
            (Plan::Composed(..), Some(turns)) if self.outlook.long() => {
                write!(f, "the run is {turns:.1e} rad long and nothing damps, so only this method keeps the energy")?;
            }
            (Plan::Composed(..), _) => write!(
                f,
                "the fastest motion, {fastest:.3e} rad/s, is the free rotor's, which drifts follow exactly; forces change \
                 at {pushes:.3e} rad/s"
            )?,
            (Plan::Stiff, _) if self.outlook.moving < 1.0 => write!(
                f,
                "all motion dies out in {:.0} % of the run, and what is left changes slowly",
                100.0 * self.outlook.moving
            )?,
            (Plan::Stiff, _) if self.outlook.dies => write!(
                f,
                "what changes at {fastest:.3e} rad/s dies out, and what lasts changes at {lasting:.3e} rad/s"
            )?,
            (Plan::Stiff, _) => write!(
                f,
                "the start does not excite the fastest motion, {fastest:.3e} rad/s, and an implicit method lets it pass"
            )?,
            (Plan::Explicit(_), _) if !drifts => write!(
                f,
                "nothing is stiff, and compositions do not follow an imposed speed and are not priced for an uneven body"
            )?,
            (Plan::Explicit(_), Some(_)) => {
                write!(f, "nothing is stiff, and no motion is so fast or run so long that it would pay")?
            }
            (Plan::Explicit(_), None) => {
                write!(f, "nothing is stiff, no motion is so fast that it would pay, and the run has no stop time")?
            }
        }
        let [explicit, drifts, stiff] = self.prices.map(|price| 1e-3 * price);
        write!(f, " (estimated ms of work a second: dop853 {explicit:.3}, symplectic {drifts:.3}, stiff {stiff:.3})")
    }
}
