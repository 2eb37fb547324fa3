//! A motion that somebody else integrates: states, rates, and the events at which its chart changes.

use super::ALWAYS_INDICATED;
use super::divergence::{Bounds, Divergence};
use super::events::{Events, indicators};
use super::growth::{Growth, Unjudged, Watch};
use super::met::Met;
use super::start::Motion;
use crate::body::ROTOR;
use crate::effects::{Effects, MOST_INDICATORS};
use crate::energy::kinetic;
use crate::integrate::{Cost, Refusal};
use crate::rotor::{Bodies, gamma, whole_rates};
use crate::stored::stored;
use crate::variables::{Instant, LARGEST_PHI, Parameters};
use nalgebra::Vector2;

/// A rotor whose state a host sets.
#[derive(Clone, Copy)]
pub struct Exchange<const N: usize> {
    bodies: Bodies,
    /// \[s]
    t: f64,
    /// φ with all its turns but those that it gains beside the chart from −e, which the rotor's `turns` count.
    state: [f64; N],
    /// Where the last completed step ended.
    completed: Completed,
    /// The kinetic energy at the event that the host is at \[J]; None between events.
    at_event: Option<f64>,
    /// Total energy at the start \[J].
    total_at_start: f64,
    /// Whether |γ| ever exceeded π/2 under a law that has no limit at π.
    tilted: bool,
    watch: Watch,
    bounds: Bounds,
    met: Met,
    events: Events,
}

stored!(Exchange<const N: usize> {
    bodies, t, state, completed, at_event, total_at_start, tilted, watch, bounds, met, events
});

/// The end of a completed step.
#[derive(Clone, Copy, Default)]
struct Completed {
    /// \[s]
    t: f64,
    /// γ \[rad].
    gamma: Vector2<f64>,
    /// dγ/dt [rad/s].
    rate: Vector2<f64>,
}

stored!(Completed { t, gamma, rate });

/// What an event changed of the state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Settled {
    /// γ and φ: they are written in the other chart.
    pub chart: bool,
    /// The work supplied, by a jump of an imposed speed.
    pub work: bool,
    /// Laws of effects: they go on as others.
    pub law: bool,
}

impl Settled {
    /// Whether a state did.
    pub fn any(self) -> bool {
        self.chart || self.work
    }
}

/// Hosts locate events to about a hundred units in the last place of the time; this part of it is beyond that \[1].
const AHEAD: f64 = 1e-12;

/// Into so many pieces the way between two completed steps is cut to count turns.
const PIECES: u32 = 32;

impl<const N: usize> Exchange<N> {
    /// From a motion that shows `reading` at its start.
    pub(super) fn start<E: Effects>(effects: &E, start: &Motion<N>, instant: &Instant<N>) -> Self {
        let Motion { bodies, state, events, .. } = *start;
        let (total_at_start, t) = (instant.reading.ledger.total_at_start, instant.reading.motion.t);
        let mut exchange = Self { bodies, t, state, total_at_start, events, ..Self::blank() };
        exchange.completed = exchange.here(effects);
        exchange.at_event = Some(exchange.kinetic(effects));
        exchange.watch_tilt(effects);
        exchange.watch.look(&bodies.under(effects), t, &state);
        exchange.bounds = Bounds::of(&bodies.under(effects));
        exchange.met.look(&bodies.under(effects), t, &state);
        exchange
    }

    /// Nothing yet: a place for what was stored.
    pub(super) fn blank() -> Self {
        Self {
            bodies: Bodies::default(),
            t: 0.0,
            state: [0.0; N],
            completed: Completed::default(),
            at_event: None,
            total_at_start: 0.0,
            tilted: false,
            watch: Watch::default(),
            bounds: Bounds::default(),
            met: Met::default(),
            events: Events::default(),
        }
    }

    /// Whether a run of these parameters can be this one: what was saved may have been altered.
    pub(super) fn is_of<E: Effects>(&self, parameters: &Parameters<E>) -> bool {
        self.bodies.is_of(&parameters.shape().inertia(), &parameters.effects)
    }

    /// The time \[s].
    pub fn time(&self) -> f64 {
        self.t
    }

    /// Whether |γ| ever exceeded π/2 under a law that has no limit at π.
    pub(super) fn has_tilted(&self) -> bool {
        self.tilted
    }

    /// What grows, as it was when it was seen first.
    pub(super) fn growth(&self) -> Option<Growth> {
        self.watch.found()
    }

    /// Where the motion diverges, as it was when that was found.
    pub(super) fn divergence(&self) -> Option<Divergence> {
        self.bounds.found()
    }

    /// Where the host's motion stands: time \[s] and state.
    pub(super) fn reached(&self) -> (Bodies, f64, &[f64; N]) {
        (self.bodies, self.t, &self.state)
    }

    /// The lowest and the highest ω_φ so far [rad/s], where a law may be doubtful at some.
    pub(super) fn speeds_met(&self) -> Option<[f64; 2]> {
        self.met.speeds()
    }

    /// Where the search for what grows last failed.
    pub(super) fn unjudged(&self) -> Option<Unjudged> {
        self.watch.unjudged()
    }

    /// The host's time \[s].
    pub fn set_time(&mut self, t: f64) {
        self.t = t;
    }

    /// The state.
    pub fn state(&self) -> &[f64; N] {
        &self.state
    }

    /// The state, to be set by the host.
    pub fn state_mut(&mut self) -> &mut [f64; N] {
        &mut self.state
    }

    /// Whether anything can be calculated of the present state.
    pub(super) fn admits<E: Effects>(&self, effects: &E, reach: f64) -> Result<(), Refusal> {
        if !self.state.iter().all(|number| number.is_finite()) {
            return Err(Refusal("a state is infinite or not a number"));
        }
        if self.state[E::layout::<N>().phi(ROTOR)].abs() > LARGEST_PHI {
            return Err(Refusal("phi of the continuous states is so large that its whole turns cannot be counted"));
        }
        self.bodies.under(effects).reaches(gamma::<E, N>(&self.state), reach)
    }

    /// The host completed a step: counts turns. Whether the chart should now be changed, at an event.
    pub(super) fn complete_step<E: Effects>(&mut self, effects: &E) -> bool {
        self.count_turns(effects);
        self.watch_tilt(effects);
        self.watch.look(&self.bodies.under(effects), self.t, &self.state);
        self.bounds.look(&self.bodies.under(effects), self.t, &self.state);
        self.met.look(&self.bodies.under(effects), self.t, &self.state);
        let motion = self.bodies.under(effects).motion(self.t, &self.state);
        let [frame] = &self.bodies.frames;
        self.events.would_change(effects, &motion, &self.state) || frame.chart.is_left_at(self.completed.gamma)
    }

    /// The indicators of events: of the chart, of γ about −e, of the limit of a law that follows γ, and of the effects. Where one
    /// changes its sign, the host is to come to an event.
    pub(super) fn indicators<E: Effects>(&self, effects: &E) -> [f64; ALWAYS_INDICATED + MOST_INDICATORS] {
        let [frame] = &self.bodies.frames;
        let motion = self.bodies.under(effects).motion(self.t, &self.state);
        let mut all = [0.0; ALWAYS_INDICATED + MOST_INDICATORS];
        let (always, of_effects) = all.split_at_mut(ALWAYS_INDICATED);
        always.copy_from_slice(&frame.indicators(gamma::<E, N>(&self.state), effects.needs_gamma()));
        of_effects.copy_from_slice(&self.events.sided(indicators(effects, &motion, &self.state)));
        all
    }

    /// An event begins.
    pub(super) fn enter_event<E: Effects>(&mut self, effects: &E) {
        self.at_event = Some(self.kinetic(effects));
    }

    /// The event is over.
    pub(super) fn leave_event(&mut self) {
        self.at_event = None;
    }

    /// At an event: goes on in the other chart where this one is left, and books the work of a jump. What of the state
    /// that changed.
    pub(super) fn settle<E: Effects>(&mut self, effects: &mut E) -> Settled {
        let work = self.book_jump(effects);
        // A host that completes no steps comes here where γ has gone on by a quarter of a turn.
        self.count_turns(effects);
        let law = self.switch_laws(effects);
        let settled = Settled { work, law, chart: self.settle_chart(effects) };
        if self.at_event.is_some() {
            self.enter_event(effects);
        }
        settled
    }

    /// At an event: laws of effects go on as the indicators say. Where one is zero but for rounding, it is to be on the side to which
    /// the motion goes.
    fn switch_laws<E: Effects>(&mut self, effects: &mut E) -> bool {
        if E::FACTS.indicators == 0 {
            return false;
        }
        let motion = self.bodies.under(effects).motion(self.t, &self.state);
        let rates = whole_rates(effects, &motion, &self.state);
        let h = AHEAD * (self.t.abs() + AHEAD.sqrt());
        let ahead: [f64; N] = std::array::from_fn(|n| self.state[n] + h * rates[n]);
        let motion = self.bodies.under(effects).motion(self.t + h, &ahead);
        self.events.take_sides(effects, &motion, &ahead)
    }

    /// A jump of an imposed speed supplies the jump of kinetic energy. Between events it could not be told from a host's
    /// trials, so only those at events are booked. Whether there was one.
    fn book_jump<E: Effects>(&mut self, effects: &E) -> bool {
        let Some(before) = self.at_event else { return false };
        let jump = self.kinetic(effects) - before;
        if !E::FACTS.imposes || jump == 0.0 {
            return false;
        }
        self.state[E::layout::<N>().work()][0] += jump;
        true
    }

    /// \[J]
    fn kinetic<E: Effects>(&self, effects: &E) -> f64 {
        kinetic(&self.bodies.under(effects).motion(self.t, &self.state))
    }

    /// Counts the turns up to the present γ, and goes on counting from there.
    fn count_turns<E: Effects>(&mut self, effects: &E) {
        let turns = self.turns(effects);
        let [frame] = &mut self.bodies.frames;
        frame.turns = turns;
        self.completed = self.here(effects);
    }

    /// Goes on in the other chart where this one is left, which changes the state. Whether it did. Turns were counted.
    fn settle_chart<E: Effects>(&mut self, effects: &E) -> bool {
        let ([frame], now) = (&mut self.bodies.frames, gamma::<E, N>(&self.state));
        let layout = E::layout::<N>();
        let Some((crossed, phi)) = frame.leave(now, self.state[layout.phi(ROTOR)]) else { return false };
        self.state[layout.gamma(ROTOR)].copy_from_slice(crossed.as_slice());
        self.state[layout.phi(ROTOR)] = frame.unwrap(phi);
        self.completed = self.here(effects);
        true
    }

    /// What the present state shows.
    pub(super) fn read<E: Effects>(&self, effects: &E) -> Instant<N> {
        let motion = self.bodies.under(effects).motion(self.t, &self.state).when(self.t, self.turns(effects));
        Instant::new(motion, self.state, effects, self.total_at_start, Cost::default())
    }

    /// The turns that go with the present γ: those that it gained since the last completed step. A host that completes no
    /// step while γ goes around the origin loses count.
    fn turns<E: Effects>(&self, effects: &E) -> f64 {
        // Near −e a rate may have no limit; a host's state there is refused, and counts no turn.
        let [frame] = &self.bodies.frames;
        frame.turns + frame.chart.turns_gained(self.completed.gamma, self.path(effects))
    }

    /// The way of γ \[rad] since the last completed step, in pieces.
    fn path<E: Effects>(&self, effects: &E) -> impl Iterator<Item = Vector2<f64>> {
        let (start, end) = (self.completed, self.here(effects));
        let h = end.t - start.t;
        (1..=PIECES).map(move |piece| {
            let s = f64::from(piece) / f64::from(PIECES);
            let r = 1.0 - s;
            // eq. 33: γ(σ) = (1 − σ)²((1 + 2σ)γ₀ + σhγ̇₀) + σ²((3 − 2σ)γ₁ − (1 − σ)hγ̇₁)
            (start.gamma * (1.0 + 2.0 * s) + start.rate * (s * h)) * (r * r)
                + (end.gamma * (3.0 - 2.0 * s) - end.rate * (r * h)) * (s * s)
        })
    }

    /// Where the motion is now.
    fn here<E: Effects>(&self, effects: &E) -> Completed {
        let motion = self.bodies.under(effects).motion(self.t, &self.state);
        Completed { t: self.t, gamma: motion.at.gamma, rate: motion.gamma_rate() }
    }

    fn watch_tilt<E: Effects>(&mut self, effects: &E) {
        let [frame] = &self.bodies.frames;
        self.tilted |= frame.chart.is_tilted_back(gamma::<E, N>(&self.state)) && effects.needs_gamma();
    }
}
