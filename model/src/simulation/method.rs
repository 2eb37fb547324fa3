//! The methods that can drive a rotor, behind one interface.

use super::auto::{Auto, STABLE, SUSPECT, Verdict};
use super::plan::Plan;
use crate::effects::Effects;
use crate::integrate::composition::Composed;
use crate::integrate::explicit::Explicit;
use crate::integrate::stiff::{Differentiable, Stiff};
use crate::integrate::tableau::DOP853;
use crate::integrate::taylor::{Scratch, Taylor};
use crate::integrate::{Cost, Fault, System, Tolerance};
use crate::rotor::Rotor;
use crate::stored::{Damaged, Stored, Walk};
use std::ops::Range;

/// A step of others is looked at in so many places.
const PLACES: u32 = 16;

/// In so many for the largest distance in it.
const PLACES_TO_LOOK: u32 = 8;
const MOST_PLACES: f64 = 4096.0;

/// A method at work.
#[derive(Clone, Copy)]
#[allow(clippy::large_enum_variant, reason = "a method is kept in place, so that it needs no allocation")]
pub(super) enum Method<const N: usize> {
    Explicit(Explicit<N>),
    Composed(Composed<N>),
    Stiff(Stiff<N>),
    Taylor(Taylor<N>),
}

use Method::{Composed as OfComposition, Explicit as OfPair, Stiff as OfCollocation, Taylor as OfSeries};

/// The same call, whichever method it is.
macro_rules! each {
    ($self:ident, $method:ident => $call:expr) => {
        match $self {
            OfPair($method) => $call,
            OfComposition($method) => $call,
            OfCollocation($method) => $call,
            OfSeries($method) => $call,
        }
    };
}

impl<const N: usize> Method<N> {
    /// The method of the plan, at time `t` \[s] and state `y`.
    pub fn start<E: Effects>(plan: Plan, tolerance: Tolerance, rotor: &Rotor<'_, E>, t: f64, y: [f64; N]) -> Self {
        match plan {
            Plan::Explicit(tableau) => OfPair(Explicit::start(tableau, tolerance, rotor, t, y)),
            Plan::Composed(composition, longest) => {
                OfComposition(Composed::start_within(composition, longest, tolerance, rotor, t, y))
            }
            Plan::Free(composition, Some(size)) => OfComposition(Composed::start(composition, size, t, y)),
            Plan::Free(composition, None) => OfComposition(Composed::start_free(composition, t, y)),
            Plan::Stiff => OfCollocation(Stiff::start(tolerance, rotor, t, y)),
            Plan::Auto | Plan::Taylor if rotor.has_series() => OfSeries(Taylor::start(tolerance, rotor, t, y)),
            Plan::Auto | Plan::Taylor => OfPair(Explicit::start(&DOP853, tolerance, rotor, t, y)),
        }
    }

    /// Looks whether `stiff` would now do better than what goes by explicit steps up to time `stop` \[s], or these again, and goes on
    /// with it. The last step can then no more be read.
    pub fn adapt<E: Effects>(&mut self, auto: &mut Auto, tolerance: Tolerance, rotor: &Rotor<'_, E>, stop: f64) {
        let (t, y, size) = (self.time(), *self.state(), System::<N>::depended_on(rotor));
        let jacobian = rotor.jacobian(t, &y);
        let cost = self.cost();
        let h = cost.next_step;
        let (sizes, suspect) = match self {
            OfPair(method) => (method.sizes(), SUSPECT[0] * STABLE),
            OfSeries(method) => (method.sizes(), SUSPECT[1] * method.stable()),
            OfCollocation(method) => {
                if auto.look_at_stiff(t, cost.evaluations, &jacobian, size) == Verdict::Change {
                    let start = Explicit::start(&DOP853, tolerance, rotor, t, y);
                    *self = OfPair(start.instead(h.min(auto.stable_step()), method.sizes(), cost));
                }
                return;
            }
            OfComposition(_) => return,
        };
        if auto.look_at_explicit([h, stop - t, suspect], &jacobian, size) == Verdict::Change {
            *self = OfCollocation(Stiff::start(tolerance, rotor, t, y).instead(h, sizes, cost));
        }
    }
    /// Nothing yet: a place for what was stored.
    pub fn blank() -> Self {
        OfPair(Explicit::blank())
    }

    /// Whether its steps follow φ with all the turns that φ from e gains; else those beside the chart are counted from γ.
    pub fn counts_turns(&self) -> bool {
        matches!(self, OfComposition(_))
    }

    /// The time reached \[s].
    #[inline(always)]
    pub fn time(&self) -> f64 {
        each!(self, method => method.time())
    }

    /// The state at the time reached.
    pub fn state(&self) -> &[f64; N] {
        each!(self, method => method.state())
    }

    /// Its rate there; None where the method needs none.
    pub fn rate(&self) -> Option<&[f64; N]> {
        match self {
            OfPair(method) => Some(method.rate()),
            OfComposition(_) => None,
            OfCollocation(method) => Some(method.rate()),
            OfSeries(method) => Some(method.rate()),
        }
    }

    /// Steps may span so much of the phase of a motion that does not die out \[rad], or it grows; None where none does.
    pub fn swings(&self) -> Option<f64> {
        if let OfPair(method) = self { Some(method.swings()) } else { None }
    }

    /// Where the last step began \[s].
    pub fn start_time(&self) -> f64 {
        each!(self, method => method.start_time())
    }

    /// The state where the last step began.
    pub fn start_state(&self) -> &[f64; N] {
        each!(self, method => method.start_state())
    }

    /// The next step will be no longer than this \[s].
    pub fn limit_step(&mut self, h: f64) {
        each!(self, method => method.limit_step(h));
    }

    /// The size of the next step \[s], unless it is limited.
    pub fn next_step(&self) -> f64 {
        each!(self, method => method.next_step())
    }

    /// Goes back to a time `t` \[s] within the last step, where the state is `y`.
    pub fn go_back<E: Effects>(&mut self, rotor: &Rotor<'_, E>, t: f64, y: [f64; N]) {
        match self {
            OfPair(method) => method.go_back(rotor, t, y),
            OfComposition(method) => method.go_back(t, y),
            OfCollocation(method) => method.go_back(rotor, t, y),
            OfSeries(method) => method.go_back(rotor, t, y),
        }
    }

    /// Goes on from another description `y` of the state reached. What the last step's dense output needs of the old one
    /// must have been prepared.
    pub fn go_on_from<E: Effects>(&mut self, rotor: &Rotor<'_, E>, y: [f64; N]) {
        match self {
            OfPair(method) => method.go_on_from(rotor, y),
            OfComposition(method) => method.go_on_from(y),
            OfCollocation(method) => method.go_on_from(rotor, y),
            OfSeries(method) => method.go_on_from(rotor, y),
        }
    }

    /// Goes on from the state reached under another law.
    pub fn go_on_under<E: Effects>(&mut self, rotor: &Rotor<'_, E>) {
        let y = *self.state();
        match self {
            OfPair(method) => method.go_on_from(rotor, y),
            OfComposition(method) => method.go_on_under(),
            OfCollocation(method) => method.go_on_under(rotor, y),
            OfSeries(method) => method.go_on_from(rotor, y),
        }
    }

    /// Replaces a component of the state on which the rates do not depend.
    pub fn replace(&mut self, component: usize, value: f64) {
        each!(self, method => method.replace(component, value));
    }

    /// What the run has cost so far.
    pub fn cost(&self) -> Cost {
        each!(self, method => method.cost())
    }

    /// Goes back to what it was `before`; what it has spent since is spent.
    pub fn take_back(&mut self, before: Self) {
        let spent = self.cost();
        *self = before;
        each!(self, method => method.charge(spent));
    }

    /// One step forward of the method's own choice, but not past time `until` \[s], while the run has taken at most `most`
    /// evaluations. Where none is possible, the method stands as before.
    pub fn step<E: Effects>(
        &mut self,
        rotor: &Rotor<'_, E>,
        scratch: &mut Scratch,
        most: f64,
        until: f64,
    ) -> Result<(), Fault> {
        match self {
            OfPair(method) => method.step(rotor, most, until),
            OfComposition(method) => method.step(rotor, most, until),
            OfCollocation(method) => method.step(rotor, most, until),
            OfSeries(method) => {
                if method.step(rotor, scratch, most, until)? {
                    return Ok(());
                }
                self.leave_series(rotor);
                self.step(rotor, scratch, most, until)
            }
        }
    }

    /// Whether it is `stiff`.
    pub fn is_stiff(&self) -> bool {
        matches!(self, OfCollocation(_))
    }

    /// Whether steps of any size are exact, and none is given.
    pub fn is_free(&self) -> bool {
        matches!(self, OfComposition(method) if method.is_free())
    }

    /// The size of its steps and the one that was given \[s], where they are to keep a tolerance.
    pub fn given(&self) -> Option<[f64; 2]> {
        if let OfComposition(method) = self { method.given() } else { None }
    }

    /// In so many places a step is looked at for events: a series spans as much as three steps of other methods.
    pub fn places(&self) -> u32 {
        if self.is_series() { 3 * PLACES } else { PLACES }
    }

    /// In so many places a step must be looked at to follow a distance in it, in which the rotor turns by `turning` \[rad]: steps of
    /// pairs span up to a turn of the fastest motion, a series up to three. Compositions take shorter ones, but where they are exact.
    pub fn places_to_look(&self, turning: f64) -> u32 {
        match self {
            OfPair(_) | OfCollocation(_) => PLACES_TO_LOOK,
            OfSeries(_) => 3 * PLACES_TO_LOOK,
            OfComposition(_) => (2.0 * turning).ceil().clamp(1.0, MOST_PLACES) as u32,
        }
    }

    /// Whether it goes by series.
    pub fn is_series(&self) -> bool {
        matches!(self, OfSeries(_))
    }

    /// Goes on with dop853 where it went by series.
    pub fn leave_series<E: Effects>(&mut self, rotor: &Rotor<'_, E>) {
        if let OfSeries(method) = self {
            let start = Explicit::start(&DOP853, method.tolerance(), rotor, method.time(), *method.state());
            let h = start.next_step();
            *self = OfPair(start.instead(h, method.sizes(), method.cost()));
        }
    }

    /// Goes on by series, where it can.
    pub fn take_series<E: Effects>(&mut self, rotor: &Rotor<'_, E>) {
        if let OfPair(method) = self {
            let start = Taylor::start(method.tolerance(), rotor, method.time(), *method.state());
            *self = OfSeries(start.instead(method.next_step(), method.sizes(), method.cost()));
        }
    }

    /// From now on excursions of these components count from 0.
    pub fn recount(&mut self, components: Range<usize>) {
        each!(self, method => method.recount(components));
    }

    /// Prepares the last step for [`Method::dense`] where the rotor will be written in another chart.
    pub fn prepare_dense<E: Effects>(&mut self, rotor: &Rotor<'_, E>) {
        if let OfPair(method) = self {
            method.prepare_dense(rotor);
        }
    }

    /// Whether the last step is too long to be read by its polynomial, so that each state within it takes steps of its own.
    pub fn is_rough<E: Effects>(&mut self, rotor: &Rotor<'_, E>) -> bool {
        self.prepare_dense(rotor);
        if let OfPair(method) = self { method.is_rough() } else { false }
    }

    /// The state at a time `t` \[s] within the last step, of the rotor in the chart of that step.
    pub fn dense<E: Effects>(&mut self, rotor: &Rotor<'_, E>, t: f64) -> [f64; N] {
        each!(self, method => method.dense(rotor, t))
    }
}

impl<const N: usize> Stored for Method<N> {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let mut kind = match self {
            OfPair(_) => 0,
            OfComposition(_) => 1,
            OfCollocation(_) => 2,
            OfSeries(_) => 3,
        };
        kind.walk(walk)?;
        match (kind, &self) {
            (0, OfPair(_)) | (1, OfComposition(_)) | (2, OfCollocation(_)) | (3, OfSeries(_)) => {}
            (0, _) => *self = OfPair(Explicit::blank()),
            (1, _) => *self = OfComposition(Composed::blank()),
            (2, _) => *self = OfCollocation(Stiff::blank()),
            (3, _) => *self = OfSeries(Taylor::blank()),
            _ => return Err(Damaged),
        }
        each!(self, method => method.walk(walk))
    }
}
