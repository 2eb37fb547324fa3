//! Methods of integration that know no rotor: they ask a [`System`] of N ordinary differential equations for its rates.

mod answer;
pub mod composition;
pub mod control;
pub mod explicit;
mod lanes;
pub(crate) mod power;
mod segment;
pub mod sizes;
pub mod stiff;
pub mod tableau;
pub mod taylor;

use crate::stored::{Damaged, Stored, Walk, count};
use sizes::{MOST_GROUPS, Squares};

pub use sizes::Tolerance;

/// N ordinary differential equations dy/dt = f(t, y).
pub trait System<const N: usize> {
    /// The rates depend on the first so many components only; the others are quadratures.
    const DEPENDED_ON: usize = N;

    /// The same of a system that is as [usual](System::is_usual).
    const USUALLY_DEPENDED_ON: usize = Self::DEPENDED_ON;

    /// The components after the first so many are solved only where somebody [wants](System::solves_all) them.
    const ALWAYS: usize = N;

    /// So many groups of components are measured, each by a norm of its own: at most [`MOST_GROUPS`].
    const GROUPS: usize = 1;

    /// Whether all components are solved, not only the first [`System::ALWAYS`].
    fn solves_all(&self) -> bool {
        true
    }

    /// On how many of these they depend as the system is now.
    fn depended_on(&self) -> usize {
        Self::DEPENDED_ON.min(N)
    }

    /// How many derivatives of the rates there are to calculate.
    fn differentiated(&self) -> usize {
        self.depended_on()
    }

    /// Whether the system is as it is nearly always: those rates are written into every stage of a step, all others are called, and a
    /// step is compiled for each of both. With both in one step registers run short (9 % more instructions for a free top).
    fn is_usual(&self) -> bool {
        true
    }

    /// f(t, y); where not all are solved, of the first [`System::ALWAYS`] components, and zeros of the others. `USUAL`: the caller
    /// knows that the system [is](System::is_usual), and by `ALL`, whether it solves all.
    fn rates<const ALL: bool, const USUAL: bool>(&self, t: f64, y: &[f64; N]) -> [f64; N];

    /// f(t, y) of what is solved.
    #[inline]
    fn rates_of_all(&self, t: f64, y: &[f64; N]) -> [f64; N] {
        match (self.is_usual(), self.solves_all()) {
            (true, true) => self.rates::<true, true>(t, y),
            (true, false) => self.rates::<false, true>(t, y),
            (false, _) => self.rates::<true, false>(t, y),
        }
    }

    /// Whether a step may end at y; the reason where it may not.
    fn admits(&self, t: f64, y: &[f64; N]) -> Result<(), Refusal>;

    /// How large the motion is at `y`, where its rate is `rate`, if excursions are counted from `origin`: group by group, squared.
    fn sizes(&self, y: &[f64; N], _rate: &[f64; N], _origin: &[f64; N]) -> Squares {
        in_one_group(y)
    }

    /// The parts of a small change of the state at `y` at time `t` \[s], in the same groups, squared.
    fn parts(&self, _t: f64, _y: &[f64; N], change: &[f64; N]) -> Squares {
        in_one_group(change)
    }

    /// How large the numbers are that a step of size `h` \[s] from `y` adds up, in the same groups, squared.
    fn roundings(&self, y: &[f64; N], _h: f64) -> Squares {
        in_one_group(y)
    }
}

/// All numbers as one group.
fn in_one_group<const N: usize>(y: &[f64; N]) -> Squares {
    let mut squares = [0.0; MOST_GROUPS];
    squares[0] = y.iter().map(|y| y * y).sum();
    squares
}

/// Why a state cannot be reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refusal(pub &'static str);

/// Why a step could not be done; the state is that of the last step that could.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// Every step, however short, ends where the system refuses to be.
    Refused {
        /// The last time reached \[s].
        t: f64,
        /// The system's reason.
        reason: Refusal,
    },
    /// The rates overflow or are undefined, however short the step.
    NotFinite {
        /// The last time reached \[s].
        t: f64,
    },
    /// All evaluations that may be spent are.
    Spent {
        /// The last time reached \[s].
        t: f64,
    },
    /// No step that advances the time keeps the tolerance.
    Underflow {
        /// The last time reached \[s].
        t: f64,
    },
}

impl Fault {
    /// Why no step is possible beyond time `t` \[s]: what stood in the way of the last one that was tried, or that none `advances` the
    /// time, or may still be paid for.
    fn of_no_step(t: f64, advances: bool, obstacle: Option<Fault>) -> Fault {
        match obstacle {
            Some(refused @ Fault::Refused { .. }) => refused,
            Some(fault) if !advances => fault,
            _ if advances => Fault::Spent { t },
            _ => Fault::Underflow { t },
        }
    }
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Fault::Refused { t, reason } => write!(f, "no step is possible beyond t = {t:?} s: {}", reason.0),
            Fault::NotFinite { t } => {
                write!(f, "no step is possible beyond t = {t:?} s: a force or a rate is infinite or not a number")
            }
            Fault::Spent { t } => write!(
                f,
                "at t = {t:?} s this communication step has taken all the work that solver.max_evaluations allows: what \
                 moves here is too fast to be followed for so long; take shorter communication steps, a looser \
                 solver.relative_tolerance, a longer solver.step_size where one is given, another solver.method or more \
                 evaluations"
            ),
            Fault::Underflow { t } => write!(
                f,
                "no step that advances the time beyond t = {t:?} s keeps the tolerance: loosen \
                 solver.relative_tolerance, or soften what changes so fast"
            ),
        }
    }
}

impl std::error::Error for Fault {}

/// What a run has cost so far. Counters are f64: an integer could overflow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Steps accepted.
    pub steps: f64,
    /// Steps rejected.
    pub rejected: f64,
    /// Evaluations of the right-hand side.
    pub evaluations: f64,
    /// Work besides these, as that of so many explicit evaluations.
    pub besides: f64,
    /// The step that the method would like next \[s].
    pub next_step: f64,
    /// Sum of the accepted steps' error norms, in units of the tolerance \[1].
    pub error_estimate: f64,
}

impl Cost {
    /// The work so far, as that of so many explicit evaluations: what `solver.max_evaluations` bounds. It counts what is done, and
    /// not how long that takes, so that a run ends at the same step on every machine.
    pub fn work(&self) -> f64 {
        self.evaluations + self.besides
    }

    /// The same with what another method had spent before.
    fn after(self, before: Self) -> Self {
        let evaluations = before.evaluations + self.evaluations;
        Self { evaluations, besides: before.besides + self.besides, ..before }
    }

    /// Goes back to what it was, but that what was `spent` stays so.
    fn charge(&mut self, spent: Self) {
        (self.evaluations, self.besides) = (spent.evaluations, spent.besides);
    }
}

impl Stored for Cost {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let Self { steps, rejected, evaluations, besides, next_step, error_estimate } = self;
        count(steps, walk)?;
        count(rejected, walk)?;
        count(evaluations, walk)?;
        count(besides, walk)?;
        next_step.walk(walk)?;
        error_estimate.walk(walk)
    }
}

/// A first step spans at least so many units in the last place of the time.
const LEAST_FIRST: f64 = 100.0;

/// A step that was tried in vain is tried again shorter, down to this part of it \[1].
const SHRUNK: f64 = 1e-12;

/// Where a step of size `h` \[s] from `t` \[s] ends that may not pass `until` \[s]: it reaches it, or leaves half of a short
/// rest.
fn end_of_step(t: f64, h: f64, until: f64) -> f64 {
    let rest = until - t;
    if h >= rest {
        until
    } else if 2.0 * h > rest {
        t + 0.5 * rest
    } else {
        t + h
    }
}
