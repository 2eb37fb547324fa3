//! A method at work on a rotor: charts, whole turns of φ, and the answer at any time of the last step.

use super::auto::Auto;
use super::by_series::BySeries;
use super::closest::closest_to_origin;
use super::divergence::{Bounds, Divergence};
use super::events::{Events, indicators};
use super::growth::{Growth, Unjudged, Watch};
use super::largest::Looks;
use super::met::Met;
use super::method::Method;
use super::plan::Plan;
use super::rattle::{Rattle, Rattles};
use super::start::{Motion, tolerance};
use crate::body::frame::{Frame, Step};
use crate::body::{BODIES, ROTOR};
use crate::effects::Effects;
use crate::energy::{Ledger, kinetic};
use crate::integrate::taylor::Scratch;
use crate::integrate::{Cost, Fault, Refusal, Tolerance};
use crate::rotation::Chart;
use crate::rotor::{Bodies, Rotor, gamma};
use crate::state::Kinematics;
use crate::stored::stored;
use crate::variables::{Instant, Parameters, Setup, numbers};
use nalgebra::Vector2;

/// A rotor with N equations, its method, and how far its answers are wanted.
#[derive(Clone, Copy)]
pub(super) struct Integration<const N: usize> {
    /// Charts and whole turns are those of the time that the method has reached.
    bodies: Bodies,
    method: Method<N>,
    /// Where it is that of `auto` or `taylor`.
    auto: Option<Auto>,
    /// Where it goes by series as often as the motion has one.
    series: Option<BySeries>,
    tolerance: Tolerance,
    /// So many evaluations a communication step may take.
    most: f64,
    /// The last step, of each body.
    last: [Step; BODIES],
    /// The communication point \[s], and when the run stops.
    t: f64,
    stop: f64,
    /// Total energy at the start \[J].
    total_at_start: f64,
    /// Whether |γ| ever exceeded π/2 under a law that has no limit at π.
    tilted: bool,
    watch: Watch,
    bounds: Bounds,
    rattles: Rattles,
    met: Met,
    events: Events,
    /// Where an input was set since the last communication step.
    held: Option<Held<N>>,
}

stored!(Integration<const N: usize> {
    bodies, method, auto, series, tolerance, most, last, t, stop, total_at_start, tilted, watch, bounds, rattles, met, events, held
});

/// The communication point as it was before an input was set there.
#[derive(Clone, Copy)]
struct Held<const N: usize> {
    y: [f64; N],
    chart: Chart,
    turns: f64,
    /// Kinetic energy \[J], which a jump of an imposed speed changes.
    kinetic: f64,
}

stored!(Held<const N: usize> { y, chart, turns, kinetic });

impl<const N: usize> Default for Held<N> {
    fn default() -> Self {
        Self { y: [0.0; N], chart: Chart::default(), turns: 0.0, kinetic: 0.0 }
    }
}

/// So near −e \[rad], a law that ends close to it makes every step looked at: an axis may go there and back within one.
const NEAR: f64 = 1.0;

/// No step is longer than so many communication steps: a rotor at rest would ask for one without end \[1].
const AHEAD: f64 = 1e6;

/// Nor is an exact one longer than so many \[1]: each communication point within it is reached from where it began.
const EXACT_AHEAD: f64 = 8.0;

/// An exact drift in which events are looked for nutates by at most so much \[rad], so that places in it tell where a station goes.
const LONGEST_LOOK: f64 = 1.0;

/// A step in which events are looked for is halved so often at most.
const MOST_HALVES: u32 = 8;

/// So often laws may switch without a step between.
const MOST_SWITCHES: u32 = 32;

/// Where the ledger leaves over more than this part of all energy that there is, was, came and went, a method without an
/// error estimate has lost the motion \[1].
const LOST: f64 = 0.1;

const AND_STIFF: &str = "; and it takes stiff as long as stability alone would hold it to short steps";

const TOO_LONG: Refusal = Refusal(
    "the energy is not kept, so the steps of the symplectic method are too long for these forces: shorten \
             solver.step_size, or where it is 0, tighten solver.relative_tolerance or take another solver.method",
);

const DIVERGES: Refusal = Refusal("the motion diverges");

impl<const N: usize> Integration<N> {
    /// A integration from time `t` \[s] of a motion that shows `reading` at its start, for `span` \[s], where that is known.
    pub(super) fn start<E: Effects>(
        effects: &E,
        start: &Motion<N>,
        instant: &Instant<N>,
        setup: &Setup,
        span: Option<f64>,
    ) -> Self {
        let t = instant.reading.motion.t;
        let span = span.unwrap_or(f64::INFINITY);
        let tolerance = tolerance(setup, effects, start, t, span);
        let Motion { bodies, state: y, events, .. } = *start;
        let plan = Plan::new(&setup.solver, effects);
        let method = Method::start(plan, tolerance, &bodies.under(effects), t, y);
        let auto = match plan {
            Plan::Auto => Some(Auto::with_stiff()),
            Plan::Taylor => Some(Auto::default()),
            _ => None,
        };
        let last = bodies.frames.each_ref().map(|frame| Step::from(frame, gamma::<E, N>(&y)));
        let mut integration = Self {
            bodies,
            method,
            auto,
            series: auto.map(|_| BySeries::new(&bodies.under(effects))),
            tolerance,
            most: setup.solver.max_evaluations,
            last,
            t,
            stop: t + span,
            total_at_start: instant.reading.ledger.total_at_start,
            bounds: Bounds::of(&bodies.under(effects)),
            events,
            ..Self::blank()
        };
        integration.watch_tilt(effects, gamma::<E, N>(&y));
        integration.watch.look(&bodies.under(effects), t, &y);
        integration.met.look(&bodies.under(effects), t, &y);
        integration
    }

    /// Nothing yet: a place for what was stored.
    pub(super) fn blank() -> Self {
        Self {
            bodies: Bodies::default(),
            method: Method::blank(),
            auto: None,
            series: None,
            tolerance: Tolerance::default(),
            most: 0.0,
            last: Default::default(),
            t: 0.0,
            stop: 0.0,
            total_at_start: 0.0,
            tilted: false,
            watch: Watch::default(),
            bounds: Bounds::default(),
            rattles: Rattles::default(),
            met: Met::default(),
            events: Events::default(),
            held: None,
        }
    }

    /// Whether a run of these parameters can be this one: what was saved may have been altered.
    pub(super) fn is_of<E: Effects>(&self, parameters: &Parameters<E>) -> bool {
        let most = parameters.setup.solver.max_evaluations;
        self.most == most && self.bodies.is_of(&parameters.shape().inertia(), &parameters.effects)
    }

    /// The communication point \[s].
    pub(super) fn time(&self) -> f64 {
        self.t
    }

    /// How long the run still lasts \[s], infinite where nobody knows.
    pub(super) fn span(&self) -> f64 {
        self.stop - self.t
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

    /// Where contacts are chaotic, as that was when it was found.
    pub(super) fn rattle(&self) -> Option<Rattle> {
        self.rattles.found()
    }

    /// Where the method stands: time \[s] and state.
    pub(super) fn reached(&self) -> (Bodies, f64, &[f64; N]) {
        (self.bodies, self.method.time(), self.method.state())
    }

    /// The lowest and the highest ω_φ so far [rad/s], where a law may be doubtful at some.
    pub(super) fn speeds_met<E: Effects>(&self, effects: &E) -> Option<[f64; 2]> {
        let mut met = self.met;
        // Points within the last step are not looked at one by one.
        if self.t == self.method.time() {
            met.look(&self.bodies.under(effects), self.t, self.method.state());
        }
        met.speeds()
    }

    /// Where the search for what grows last failed.
    pub(super) fn unjudged(&self) -> Option<Unjudged> {
        self.watch.unjudged()
    }

    fn watch_tilt<E: Effects>(&mut self, effects: &E, gamma: Vector2<f64>) {
        let [frame] = &self.bodies.frames;
        self.tilted |= frame.chart.is_tilted_back(gamma) && effects.needs_gamma();
    }

    /// An input will be set at the communication point, under these effects so far: what is there stays.
    pub(super) fn hold<E: Effects>(&mut self, effects: &E) {
        if self.held.is_none() {
            let (y, chart, turns) = self.shown(effects);
            let kinetic = if E::FACTS.imposes { kinetic(&self.motion_in(effects, chart, &y)) } else { 0.0 };
            self.held = Some(Held { y, chart, turns, kinetic });
        }
    }

    /// Moves the communication point to time `t` \[s], if the last step reaches so far.
    #[inline(always)]
    pub(super) fn advance_within_step(&mut self, t: f64) -> bool {
        assert!(t >= self.t, "the time moves on from {:?}, not to {t:?}", self.t);
        let reaches = self.held.is_none() && t <= self.method.time() && !self.method.counts_turns();
        if reaches {
            self.t = t;
        }
        reaches
    }

    /// Moves the communication point to time `t` \[s], where the solver may not have been. On a fault it stands at the last time reached.
    #[inline(never)]
    pub(super) fn advance<E: Effects, L: Looks>(
        &mut self,
        effects: &mut E,
        scratch: &mut Scratch,
        t: f64,
        looks: &mut L,
    ) -> Result<(), Fault> {
        // Who sets an input often sets it at the next communication point again: the solver does not run ahead of that.
        let until = if self.held.is_some() { t } else { self.stop.max(t) };
        self.go_back(effects)?;
        if self.method.time() >= t {
            return self.show_at(effects, t);
        }
        if !matches!(self.method, Method::Composed(_)) {
            return self.run_to(effects, scratch, [t, until], looks);
        }
        let before = (self.t, self.method, self.last, self.bodies, self.events);
        let seen = looks.clone();
        let outcome = self.run_to(effects, scratch, [t, until], looks);
        // Where the motion is lost, what stands in its way has another cause.
        if self.keeps_energy(effects) {
            return outcome.and_then(|()| self.show_at(effects, t));
        }
        (self.t, self.method, self.last, self.bodies, self.events) = before;
        *looks = seen;
        let y = self.method.state();
        let motion = self.bodies.under(effects).motion(self.method.time(), y);
        self.events.tell(effects, &motion, y);
        Err(Fault::Refused { t: self.t, reason: TOO_LONG })
    }

    /// Moves the communication point to time `t` \[s] within the last step, if there is a state to show.
    fn show_at<E: Effects>(&mut self, effects: &E, t: f64) -> Result<(), Fault> {
        let before = std::mem::replace(&mut self.t, t);
        if self.shown(effects).0.iter().all(|y| y.is_finite()) {
            return Ok(());
        }
        self.t = before;
        Err(effects.no_limit().map_or(Fault::NotFinite { t }, |reason| Fault::Refused { t, reason: Refusal(reason) }))
    }

    /// How often the run has gone on otherwise: with another method, or in shorter steps than those given, or in these again.
    pub(super) fn changes(&self) -> u32 {
        let [auto, series] = [self.auto.map(|auto| auto.changes()), self.series.map(|series| series.changes())];
        let shortened = u32::from(self.method.given().is_some_and(|[size, given]| size < given));
        auto.unwrap_or(0).saturating_add(series.unwrap_or(0)).saturating_add(shortened)
    }

    /// What the run goes on with and why; None where that is what was asked for.
    pub(super) fn goes_on<E: Effects>(&self, parameters: &Parameters<E>) -> Option<String> {
        let is_auto = parameters.setup.solver.method_in_force() == numbers::AUTO;
        let t = self.method.start_time();
        if let Some([size, given]) = self.method.given() {
            let words = if size < given {
                format!(
                    "{size:.3e} s from t = {t:?} s: steps of {given:?} s, as given, would err too much for solver.relative_tolerance or grow from rounding"
                )
            } else {
                format!("{given:?} s, as given, from t = {t:?} s")
            };
            // They are so from the start where nothing was said.
            return (self.method.cost().steps > 0.0).then(|| format!("symplectic goes on in steps of {words}"));
        }
        if let (Some(auto), true) = (&self.auto, self.method.is_stiff()) {
            return Some(format!(
                "auto goes on with stiff from t = {t:?} s: what changes at {:.3e} rad/s would hold explicit steps to some {:.3e} s",
                auto.fastest(),
                auto.stable_step()
            ));
        }
        let Some(series) = self.series else {
            const FREE: &str =
                "auto takes symplectic: nothing acts on the rotor but its weight, so a step of any length is exact";
            return (is_auto && self.method.is_free()).then(|| FREE.into());
        };
        let (who, also) = if is_auto { ("auto", AND_STIFF) } else { ("taylor", "") };
        let is_series = self.method.is_series();
        let what = match (is_series, who) {
            (true, "auto") => "taylor",
            (true, _) => "power series",
            (false, _) => "dop853",
        };
        let why = series.words(is_series, &self.bodies.under(&parameters.effects));
        Some(match self.changes() {
            0 => format!("{who} takes {what}: {why}{also}"),
            _ => format!("{who} goes on with {what} from t = {t:?} s: {why}"),
        })
    }

    /// Steps up to time `t` \[s] or past it, but not past `until` \[s]; the communication point is then there, or where steps
    /// came to.
    fn run_to<E: Effects, L: Looks>(
        &mut self,
        effects: &mut E,
        scratch: &mut Scratch,
        [t, until]: [f64; 2],
        looks: &mut L,
    ) -> Result<(), Fault> {
        looks.look(self, effects, self.method.time());
        let most = self.method.cost().work() + self.most;
        let ahead = if self.method.is_free() { EXACT_AHEAD } else { AHEAD };
        self.method.limit_step(ahead * (t - self.t));
        let mut switched = 0;
        while self.method.time() < t {
            // What lies ahead of the communication point may still come otherwise.
            self.met.look(&self.bodies.under(effects), self.method.time(), self.method.state());
            if let Some(auto) = &mut self.auto
                && auto.is_due()
            {
                self.method.adapt(auto, self.tolerance, &self.bodies.under(effects), self.stop);
            }
            if let Some(number) = self.events.due() {
                let (t, y) = (self.method.time(), *self.method.state());
                let rotor = self.bodies.under(effects);
                let (motion, switch) = (rotor.motion(t, &y), self.rattles.switches(&rotor, t, &y, number));
                self.events.switch(effects, &motion, &y);
                self.rattles.switched(&self.bodies.under(effects), t, &y, switch);
                self.method.go_on_under(&self.bodies.under(effects));
                if let Some(series) = &mut self.series {
                    series.look(&self.bodies.under(effects));
                }
            }
            if let Some(series) = &mut self.series
                && !self.method.is_stiff()
            {
                let held = self.auto.is_some_and(|auto| auto.holds_steps());
                series.choose(&mut self.method, &self.bodies.under(effects), held);
            }
            let before = self.method.time();
            // Laws that switch to and fro in one place must still go on.
            let outcome = if switched < MOST_SWITCHES {
                self.step_to_event(effects, scratch, most, until)
            } else {
                self.step(effects, scratch, most, until)
            };
            if let Some(series) = &mut self.series
                && !self.method.is_stiff()
            {
                series.hear(self.method.is_series());
            }
            let moved = self.method.time() > before;
            switched = if moved { 0 } else { switched + 1 };
            if let Err(fault) = outcome {
                self.t = self.method.time();
                return Err(fault);
            }
            // Where a law only switched, the turns of the step before are counted already.
            if moved {
                looks.look(self, effects, t.min(self.method.time()));
                if E::FACTS.indicators > 0 {
                    let ends = [self.method.start_state(), self.method.state()];
                    self.rattles.follow(&self.bodies.under(effects), self.last_step(), ends);
                }
                self.settle(effects, t);
            }
            if looks.looks() {
                self.bounds.look(&self.bodies.under(effects), self.method.time(), self.method.state());
                if self.bounds.found().is_some() {
                    self.t = self.method.time();
                    return Err(Fault::Refused { t: self.t, reason: DIVERGES });
                }
            }
        }
        self.watch.look(&self.bodies.under(effects), self.method.time(), self.method.state());
        self.bounds.look(&self.bodies.under(effects), self.method.time(), self.method.state());
        self.t = t;
        if effects.is_doubtful() {
            let (y, chart, _) = self.shown(effects);
            self.met = self.met.with(self.motion_in(effects, chart, &y).axial_rate());
        }
        Ok(())
    }

    /// Whether the motion reached has anything to do with the one asked for: steps of a given size estimate no error.
    fn keeps_energy<E: Effects>(&self, effects: &E) -> bool {
        let ledger = self.ledger(effects);
        let all = ledger.kinetic + ledger.potential.abs() + ledger.supplied.abs() + ledger.dissipated;
        ledger.residual().abs() <= LOST * (all + ledger.total_at_start.abs())
    }

    /// The ledger of the state that the method has reached.
    fn ledger<E: Effects>(&self, effects: &E) -> Ledger<f64> {
        let y = self.method.state();
        let motion = self.bodies.under(effects).motion(self.method.time(), y);
        let layout = E::layout::<N>();
        Ledger::new(&motion, &y[layout.own()], effects, layout.read_work(y), self.total_at_start)
    }

    /// Goes back to what it was `before`, where an input was set; what it has spent since is spent.
    pub(super) fn take_back<E: Effects>(&mut self, before: &Self, effects: &mut E) {
        let mut method = self.method;
        method.take_back(before.method);
        *self = Self { method, tilted: self.tilted || before.tilted, ..*before };
        let y = self.method.state();
        self.events.tell(effects, &self.bodies.under(effects).motion(self.method.time(), y), y);
    }

    /// Where inputs were set, goes on from the communication point under these effects.
    fn go_back<E: Effects>(&mut self, effects: &mut E) -> Result<(), Fault> {
        let Some(held) = self.held.take() else { return Ok(()) };
        if self.t < self.method.time() {
            self.events.forget();
            self.rattles.restart();
        }
        let y = self.jumped(effects, &held);
        if E::FACTS.imposes {
            let motion = self.motion_in(effects, held.chart, &y);
            self.events.jump(effects, &motion, &y);
        }
        let [frame] = &mut self.bodies.frames;
        (frame.chart, frame.turns) = (held.chart, held.turns);
        self.method.go_back(&self.bodies.under(effects), self.t, y);
        if let (true, Some(series)) = (E::FACTS.partners > 0, &mut self.series) {
            series.look_again(&self.bodies.under(effects));
        }
        self.watch_tilt(effects, gamma::<E, N>(&y));
        let reached = self.bodies.under(effects).reaches(gamma::<E, N>(&y), Chart::REACH);
        reached.map_err(|reason| Fault::Refused { t: self.t, reason })
    }

    /// The state that was held: a jump of the imposed speed to that of these effects supplies the jump of kinetic energy.
    fn jumped<E: Effects>(&self, effects: &E, held: &Held<N>) -> [f64; N] {
        let mut y = held.y;
        if E::FACTS.imposes && self.bodies.active.works {
            let now = kinetic(&self.motion_in(effects, held.chart, &y));
            y[E::layout::<N>().work()][0] += now - held.kinetic;
        }
        y
    }

    fn motion_in<E: Effects>(&self, effects: &E, chart: Chart, y: &[f64; N]) -> Kinematics<f64> {
        self.bodies.under(effects).motion_in(chart, self.t, y)
    }

    /// A step that keeps to what the chart and the counting of turns allow.
    fn limit_step<E: Effects>(&mut self, effects: &E) {
        let Some(rates) = self.method.rate() else {
            if self.bodies.active.has_events() {
                self.method.limit_step(LONGEST_LOOK / self.nutation::<E>().sqrt());
            }
            if E::FACTS.own > 0 {
                let decay = effects.active().map(|block| block.own_decay()).fold(0.0, f64::max);
                self.method.limit_step(1.0 / decay);
            }
            return;
        };
        let ([frame], h) = (&self.bodies.frames, self.method.next_step());
        let (at, rate, turning) =
            (gamma::<E, N>(self.method.state()), gamma::<E, N>(rates), rates[E::layout::<N>().phi(ROTOR)]);
        let longest = frame.longest_step(h, at, rate, turning, self.method.is_series());
        // A nutation that nothing damps would grow out of rounding, unseen until it is as large as what moves the axis.
        let nutation = self.nutation::<E>();
        if let Some(most) = self.method.swings()
            && nutation * h * h > most * most
        {
            self.method.limit_step(most / nutation.sqrt());
        }
        if longest < h {
            self.method.limit_step(longest);
        }
    }

    /// The square of the rate at which the axis nutates [1/s²].
    #[inline(always)]
    fn nutation<E: Effects>(&self) -> f64 {
        let ([frame], k) = (&self.bodies.frames, E::layout::<N>().read(self.method.state(), ROTOR).k);
        k.norm_squared() * frame.body.per_jt * frame.body.per_jt
    }

    /// A step, or the part of it up to the first event.
    fn step_to_event<E: Effects>(
        &mut self,
        effects: &E,
        scratch: &mut Scratch,
        most: f64,
        until: f64,
    ) -> Result<(), Fault> {
        // Not `then_some`: so much is copied only where it is needed, here and below.
        let looks = E::FACTS.indicators > 0 && self.bodies.active.has_events();
        let before = if looks { Some((self.method, self.last)) } else { None };
        self.step(effects, scratch, most, until)?;
        let Some((method, last)) = before else { return Ok(()) };
        let rotor = self.bodies.under(effects);
        // Each place of a step that is too long for its polynomial would be a motion of its own.
        for _ in 0..MOST_HALVES {
            if !self.method.is_rough(&rotor) {
                break;
            }
            let h = 0.5 * (self.method.time() - self.method.start_time());
            self.method.take_back(method);
            self.last = last;
            self.method.limit_step(h);
            self.step(effects, scratch, most, until)?;
        }
        let (from, to) = (self.method.start_time(), self.method.time());
        let (method_now, active) = (&mut self.method, &self.bodies.active);
        let watched = (0..E::FACTS.indicators).filter(|number| active.watches(*number));
        let places = method_now.places();
        let found = self.events.first(watched, [from, to], places, |t| {
            let y = if t == to { *method_now.state() } else { method_now.dense(&rotor, t) };
            indicators(effects, &rotor.motion(t, &y), &y)
        });
        let Some((t, number)) = found else { return Ok(()) };
        if t < to {
            self.method.take_back(method);
            self.last = last;
            // A law that has just switched may have to switch back.
            if self.method.time() + 0.1 * (t - self.method.time()) > self.method.time() {
                self.step(effects, scratch, most, t)?;
            }
        }
        if self.method.time() >= t || self.method.time() == from {
            self.events.expect(number);
        }
        Ok(())
    }

    fn step<E: Effects>(&mut self, effects: &E, scratch: &mut Scratch, most: f64, until: f64) -> Result<(), Fault> {
        self.limit_step(effects);
        let rotor = self.bodies.under(effects);
        // Near −e a step can pass where it may not end; then it is taken back.
        let counts_turns = self.method.counts_turns();
        let frame = &rotor.frame;
        let may_pass = frame.chart == Chart::FromMinusE && effects.needs_gamma() && !counts_turns;
        let before = if may_pass { Some((self.method, self.last)) } else { None };
        let mut limit = f64::INFINITY;
        loop {
            self.method.step(&rotor, scratch, most, until)?;
            let (from, to) = (gamma::<E, N>(self.method.start_state()), gamma::<E, N>(self.method.state()));
            let mut last = Step::from(frame, from);
            let near = before.is_some() && from.norm().min(to.norm()) < NEAR;
            if frame.chart == Chart::FromMinusE && (near || !counts_turns && last.turns_much(to)) {
                last.closest = Some(self.closest_to_origin(&rotor));
            }
            self.last = [last];
            match (&before, last.closest) {
                (Some((method, last)), Some((_, closest))) if closest.norm() < Chart::FORBIDDEN => {
                    limit = 0.5 * limit.min(self.method.time() - method.time());
                    self.method.take_back(*method);
                    self.last = *last;
                    self.method.limit_step(limit);
                }
                _ => break,
            }
        }
        Ok(())
    }

    /// After a step on the way to time `t` \[s]: counts whole turns, and goes on in the other chart where this one is left.
    fn settle<E: Effects>(&mut self, effects: &E, t: f64) {
        let (y, layout) = (*self.method.state(), E::layout::<N>());
        let gamma = gamma::<E, N>(&y);
        self.watch_tilt(effects, gamma);
        let turns = self.turns_at(self.method.time(), gamma);
        let [frame] = &self.bodies.frames;
        if t < self.method.time() && frame.chart.is_left_at(gamma) {
            // The last step is still to be read, in its own chart.
            self.method.prepare_dense(&self.bodies.under(effects));
        }
        let [frame] = &mut self.bodies.frames;
        frame.turns = turns;
        if let Some((crossed, phi)) = frame.leave(gamma, y[layout.phi(ROTOR)]) {
            self.rattles.restart();
            let mut y = y;
            y[layout.gamma(ROTOR)].copy_from_slice(crossed.as_slice());
            y[layout.phi(ROTOR)] = phi;
            self.method.go_on_from(&self.bodies.under(effects), y);
            self.method.recount(layout.gamma(ROTOR));
        } else {
            let phi = frame.wrap(y[layout.phi(ROTOR)]);
            self.method.replace(layout.phi(ROTOR), phi);
        }
    }

    /// The whole turns of φ that go with γ \[rad] at a time `t` \[s] of the last step.
    fn turns_at(&self, t: f64, gamma: Vector2<f64>) -> f64 {
        let [last] = &self.last;
        if self.method.counts_turns() { last.turns } else { last.turns_at(t, gamma) }
    }

    /// When \[s] and where \[rad] γ came closest to the origin in the last step.
    fn closest_to_origin<E: Effects>(&mut self, rotor: &Rotor<'_, E>) -> (f64, Vector2<f64>) {
        let (from, to) = (self.method.start_time(), self.method.time());
        closest_to_origin(from, to, |t| {
            let gamma = gamma::<E, N>(&self.method.dense(rotor, t));
            // Where kicks on the way there have no limit, the origin is near.
            if gamma.norm().is_nan() { Vector2::zeros() } else { gamma }
        })
    }

    /// The state at the communication point, its chart, and the whole turns of φ, under the effects of the last step.
    fn shown<E: Effects>(&mut self, effects: &E) -> ([f64; N], Chart, f64) {
        if self.t == self.method.time() {
            let [Frame { chart, turns, .. }] = self.bodies.frames;
            return (*self.method.state(), chart, turns);
        }
        // The rotor may have gone on in the other chart.
        let (mut bodies, [Step { chart, .. }]) = (self.bodies, self.last);
        let [frame] = &mut bodies.frames;
        frame.chart = chart;
        let y = self.method.dense(&bodies.under(effects), self.t);
        (y, chart, self.turns_at(self.t, gamma::<E, N>(&y)))
    }

    /// When the last step began and ended \[s].
    pub(super) fn last_step(&self) -> [f64; 2] {
        [self.method.start_time(), self.method.time()]
    }

    /// The last step is looked at in so many places, between which a distance neither rises and falls twice.
    pub(super) fn places_to_look<E: Effects>(&self) -> u32 {
        let [start, end] = self.last_step();
        let ([Frame { body, .. }], nutation) = (&self.bodies.frames, self.nutation::<E>().sqrt());
        // An unbalance turns with the body, by up to |K|/Ja.
        let turning =
            if body.asymmetric.is_some() { nutation * (1.0 + body.spin.abs() / body.per_jt) } else { nutation };
        self.method.places_to_look((end - start) * turning)
    }

    /// The motion at a time `t` \[s] of the last step.
    pub(super) fn motion_at<E: Effects>(&mut self, effects: &E, t: f64) -> Kinematics<f64> {
        self.t = t;
        let (y, chart, turns) = self.shown(effects);
        self.motion_in(effects, chart, &y).when(t, turns)
    }

    /// What the communication point shows under these effects.
    pub(super) fn read<E: Effects>(&mut self, effects: &E) -> Instant<N> {
        let (y, chart, turns) = match &self.held {
            Some(held) => (self.jumped(effects, held), held.chart, held.turns),
            None => self.shown(effects),
        };
        let motion = self.motion_in(effects, chart, &y).when(self.t, turns);
        let spent = self.method.cost();
        let cost = Cost { error_estimate: spent.error_estimate * self.tolerance.relative, ..spent };
        Instant::new(motion, y, effects, self.total_at_start, cost)
    }
}
