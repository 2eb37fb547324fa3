//! A method at work on a rotor: charts, whole turns of φ, and the answer at any time of the last step.

use super::auto::Auto;
use super::growth::Watch;
use super::method::Method;
use super::plan::Plan;
use super::start::{Motion, tolerance};
use crate::effects::Effects;
use crate::energy::{Ledger, kinetic};
use crate::integrate::{Cost, Fault, Refusal, Tolerance};
use crate::rotation::chart::{azimuth_change, crossed_exactly};
use crate::rotation::{Angle, Chart};
use crate::rotor::{self, Rotor, imposed};
use crate::state::{Coordinates, DISSIPATED, GAMMA, PHI, SUPPLIED, WITH_WORK};
use crate::stored::{Damaged, Stored, Walk, stored, whole};
use crate::variables::{Parameters, Reading, Setup};
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// A rotor with N equations, its method, and how far its answers are wanted.
#[derive(Clone)]
pub(super) struct Integration<E, const N: usize> {
    /// The rotor, in the chart and with the whole turns of the time that the method has reached.
    rotor: Rotor<E>,
    method: Method<N>,
    /// Where it is that of `auto`.
    auto: Option<Auto>,
    tolerance: Tolerance,
    /// So many evaluations a communication step may take.
    most: f64,
    last: LastStep,
    /// The communication point \[s], and when the run stops.
    t: f64,
    stop: f64,
    /// Total energy at the start \[J].
    total_at_start: f64,
    /// Whether |γ| ever exceeded π/2 under a law that has no limit at π.
    tilted: bool,
    watch: Watch,
}

stored!(Integration<E: Effects, const N: usize> {
    rotor, method, auto, tolerance, most, last, t, stop, total_at_start, tilted, watch
});

/// What must be known of the last step to read it.
#[derive(Clone, Copy, Default)]
struct LastStep {
    /// Its chart; the method may go on in the other one.
    chart: Chart,
    /// Whole turns of φ at its start.
    turns: f64,
    /// γ \[rad] at its start.
    gamma: Vector2<f64>,
    /// When \[s] and where \[rad] γ came closest to the origin, if its azimuth turned much.
    closest: Option<(f64, Vector2<f64>)>,
}

impl Stored for LastStep {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let Self { chart, turns, gamma, closest } = self;
        chart.walk(walk)?;
        whole(turns, walk)?;
        gamma.walk(walk)?;
        closest.walk(walk)
    }
}

/// Where the azimuth of γ turns by more than this in a step \[rad], the way past the origin is looked at closely: on a
/// curved path it may have turned by more than π. What whirls steadily turns by less ([`LONGEST_WHIRL`]).
const MUCH: f64 = 1.2;

/// So near −e \[rad], a law that ends close to it makes every step looked at: an axis may go there and back within one.
const NEAR: f64 = 1.0;

/// No step is longer than so many communication steps: a rotor at rest would ask for one without end \[1].
const AHEAD: f64 = 1e6;

/// φ \[rad] advances by at most so much in a step: further, a double near 0 and one so large differ too much in their
/// last place for the remainder of φ to stay exact.
const LONGEST_TURN: f64 = 16.0 * TAU;

/// γ \[rad] advances by about so much at most in a step: through −e it goes nearly straight, and no error estimate would
/// keep the step from growing beyond what its dense output can follow.
const LONGEST_TILT: f64 = 1.0;

/// The azimuth of γ from −e \[rad] advances by about so much at most in a step, so that its turns can be counted.
const LONGEST_WHIRL: f64 = 1.0;

/// Where the ledger leaves over more than this part of all energy that there is, was, came and went, a method without an
/// error estimate has lost the motion \[1].
const LOST: f64 = 0.1;

const TOO_LONG: Refusal = Refusal(
    "the energy is not kept, so the steps of the symplectic method are too long for these forces: shorten \
             solver.step_size, or where it is 0, tighten solver.relative_tolerance or take another solver.method",
);

impl<E: Effects, const N: usize> Integration<E, N> {
    /// A integration from time `t` \[s] of a motion that shows `reading` at its start, for `span` \[s], where that is known.
    pub(super) fn start(start: Motion<E>, reading: &Reading, setup: &Setup, t: f64, span: Option<f64>) -> Self {
        let tolerance = tolerance(setup, &start, t);
        let Motion { rotor, state } = start;
        let mut y = [0.0; N];
        y.copy_from_slice(&state[..N]);
        let plan = Plan::new(&setup.solver, &rotor.effects);
        let method = Method::start(plan, tolerance, &rotor, t, y);
        let last = LastStep { chart: rotor.chart, turns: rotor.turns, gamma: gamma(&y), closest: None };
        let mut integration = Self {
            rotor,
            method,
            auto: matches!(plan, Plan::Auto).then(Auto::default),
            tolerance,
            most: setup.solver.max_evaluations,
            last,
            t,
            stop: span.map_or(f64::INFINITY, |span| t + span),
            total_at_start: reading.ledger.total_at_start,
            ..Self::blank()
        };
        integration.watch_tilt(last.gamma);
        integration.watch.look(&integration.rotor, t, &y);
        integration
    }

    /// Nothing yet: a place for what was stored.
    pub(super) fn blank() -> Self {
        Self {
            rotor: Rotor::default(),
            method: Method::blank(),
            auto: None,
            tolerance: Tolerance::default(),
            most: 0.0,
            last: LastStep::default(),
            t: 0.0,
            stop: 0.0,
            total_at_start: 0.0,
            tilted: false,
            watch: Watch::default(),
        }
    }

    /// Whether a run of these parameters can be this one: what was saved may have been altered.
    pub(super) fn is_of(&self, parameters: &Parameters<E>) -> bool {
        let most = parameters.setup.solver.max_evaluations;
        let works = N == WITH_WORK;
        self.rotor.body == parameters.shape().inertia() && self.most == most && self.rotor.effects.works() == works
    }

    /// The communication point \[s].
    pub(super) fn time(&self) -> f64 {
        self.t
    }

    /// Whether |γ| ever exceeded π/2 under a law that has no limit at π.
    pub(super) fn has_tilted(&self) -> bool {
        self.tilted
    }

    /// How fast a motion grows [1/s], and since when that is known \[s].
    pub(super) fn growth(&self) -> Option<(f64, f64)> {
        self.watch.found()
    }

    fn watch_tilt(&mut self, gamma: Vector2<f64>) {
        self.tilted |= self.rotor.chart.is_tilted_back(gamma) && self.rotor.effects.needs_gamma();
    }

    /// Moves the communication point to time `t` \[s], `news` being the effects whose inputs were set. On a fault it stands
    /// at the last time reached.
    pub(super) fn advance(&mut self, t: f64, news: Option<&E>) -> Result<(), Fault> {
        assert!(t >= self.t, "the time moves on from {:?}, not to {t:?}", self.t);
        if let Some(effects) = news {
            self.hear(effects)?;
        }
        // Who sets an input often sets it at the next communication point again: the solver does not run ahead of that.
        let until = if news.is_some() { t } else { self.stop.max(t) };
        if self.method.time() >= t {
            self.t = t;
            return Ok(());
        }
        if !matches!(self.method, Method::Composed(_)) {
            return self.run_to(t, until);
        }
        let before = (self.t, self.method.clone(), self.last, self.rotor.chart, self.rotor.turns);
        let outcome = self.run_to(t, until);
        // Where the motion is lost, what stands in its way has another cause.
        if self.keeps_energy() {
            return outcome;
        }
        (self.t, self.method, self.last, self.rotor.chart, self.rotor.turns) = before;
        Err(Fault::Refused { t: self.t, reason: TOO_LONG })
    }

    /// How often `auto` has gone on with another method.
    pub(super) fn changes_of_method(&self) -> u32 {
        self.auto.map_or(0, |auto| auto.changes())
    }

    /// What `auto` does and why.
    pub(super) fn auto(&self) -> String {
        let Some(auto) = &self.auto else {
            return "auto takes symplectic: nothing acts on the rotor, so a step of any length is exact".into();
        };
        let t = self.method.start_time();
        match &self.method {
            Method::Stiff(_) => format!(
                "auto goes on with stiff from t = {t:?} s: what changes at {:.3e} rad/s would hold dop853 to steps of {:.3e} s",
                auto.fastest(),
                auto.stable_step()
            ),
            _ if auto.changes() > 0 => format!("auto goes on with dop853 from t = {t:?} s: stiff no longer saves work"),
            _ => "auto takes dop853, and stiff as long as stability alone would hold dop853 to short steps".into(),
        }
    }

    /// Steps up to time `t` \[s] or past it, but not past `until` \[s]; the communication point is then there, or where steps
    /// came to.
    fn run_to(&mut self, t: f64, until: f64) -> Result<(), Fault> {
        let most = self.method.cost().evaluations + self.most;
        self.method.limit_step(AHEAD * (t - self.t));
        while self.method.time() < t {
            if let Some(auto) = &mut self.auto
                && auto.is_due()
            {
                self.method.adapt(auto, self.tolerance, &self.rotor);
            }
            if let Err(fault) = self.step(most, until) {
                self.t = self.method.time();
                return Err(fault);
            }
            self.settle(t);
        }
        self.watch.look(&self.rotor, self.method.time(), self.method.state());
        self.t = t;
        Ok(())
    }

    /// Whether the motion reached has anything to do with the one asked for: steps of a given size estimate no error.
    fn keeps_energy(&self) -> bool {
        let ledger = self.ledger();
        let all = ledger.kinetic + ledger.potential.abs() + ledger.supplied.abs() + ledger.dissipated;
        ledger.residual().abs() <= LOST * (all + ledger.total_at_start.abs())
    }

    /// The ledger of the state that the method has reached.
    fn ledger(&self) -> Ledger<f64> {
        let y = self.method.state();
        let motion = self.rotor.motion(self.method.time(), y);
        Ledger::new(&motion, &self.rotor.effects, work(y), self.total_at_start)
    }

    /// Goes on from the communication point with the inputs of these effects.
    fn hear(&mut self, effects: &E) -> Result<(), Fault> {
        let (mut y, chart, turns) = self.shown();
        self.jump(effects, chart, &mut y);
        self.rotor.effects.hear(effects);
        (self.rotor.chart, self.rotor.turns) = (chart, turns);
        self.method.go_back(&self.rotor, self.t, y);
        self.watch_tilt(gamma(&y));
        let reached = self.rotor.reaches(gamma(&y), Chart::REACH);
        reached.map_err(|reason| Fault::Refused { t: self.t, reason })
    }

    /// A jump of the imposed speed to that of these effects supplies the jump of kinetic energy.
    fn jump(&self, effects: &E, chart: Chart, y: &mut [f64; N]) {
        if E::IMPOSES && N == WITH_WORK {
            let free = self.rotor.free_motion_in(chart, self.t, y);
            let kinetic = |effects| kinetic(&imposed(effects, free));
            y[SUPPLIED] += kinetic(effects) - kinetic(&self.rotor.effects);
        }
    }

    /// A step that keeps to what the chart and the counting of turns allow.
    fn limit_step(&mut self) {
        let Some(rates) = self.method.rate() else { return };
        let (at, rate) = (gamma(self.method.state()), gamma(rates));
        // Mostly nothing limits the step, and products tell: divisions and roots would hold up the next step.
        let (h, turning) = (self.method.next_step(), rates[PHI].abs());
        if h * turning > LONGEST_TURN {
            self.method.limit_step(LONGEST_TURN / turning);
        }
        // A nutation that nothing damps would grow out of rounding, unseen until it is as large as what moves the axis.
        let nutation = Coordinates::from_slice(self.method.state()).k.norm_squared()
            * self.rotor.body.per_jt
            * self.rotor.body.per_jt;
        if let Some(most) = self.method.swings()
            && nutation * h * h > most * most
        {
            self.method.limit_step(most / nutation.sqrt());
        }
        // At its present rate γ stays within reach of its chart.
        let far = at.norm_squared() < (Chart::REACH - LONGEST_TILT) * (Chart::REACH - LONGEST_TILT);
        if !far || rate.norm_squared() * h * h >= LONGEST_TILT * LONGEST_TILT {
            self.method.limit_step((Chart::REACH - at.norm()).min(LONGEST_TILT) / rate.norm());
        }
        if self.rotor.chart == Chart::FromMinusE {
            // dβ/dt = e·(γ×dγ/dt)/|γ|²
            self.method.limit_step(LONGEST_WHIRL * at.norm_squared() / at.perp(&rate).abs());
        }
    }

    fn step(&mut self, most: f64, until: f64) -> Result<(), Fault> {
        self.limit_step();
        // Near −e a step can pass where it may not end; then it is taken back.
        let counts_turns = self.method.counts_turns();
        let before = (self.rotor.chart == Chart::FromMinusE && self.rotor.effects.needs_gamma() && !counts_turns)
            .then(|| (self.method.clone(), self.last));
        let mut limit = f64::INFINITY;
        loop {
            self.method.step(&self.rotor, most, until)?;
            let (from, to) = (gamma(self.method.start_state()), gamma(self.method.state()));
            self.last = LastStep { chart: self.rotor.chart, turns: self.rotor.turns, gamma: from, closest: None };
            let near = before.is_some() && from.norm().min(to.norm()) < NEAR;
            let turned = || !counts_turns && azimuth_change(from, to).abs() > MUCH;
            if self.rotor.chart == Chart::FromMinusE && (near || turned()) {
                self.last.closest = Some(self.closest_to_origin());
            }
            match (&before, self.last.closest) {
                (Some((method, last)), Some((_, closest))) if closest.norm() < rotor::FORBIDDEN => {
                    limit = 0.5 * limit.min(self.method.time() - method.time());
                    (self.method, self.last) = (method.clone(), *last);
                    self.method.limit_step(limit);
                }
                _ => break,
            }
        }
        Ok(())
    }

    /// After a step on the way to time `t` \[s]: counts whole turns, and goes on in the other chart where this one is left.
    fn settle(&mut self, t: f64) {
        let y = *self.method.state();
        let gamma = gamma(&y);
        self.watch_tilt(gamma);
        let turns = self.turns_at(self.method.time(), gamma);
        let chart = self.rotor.chart;
        if chart.is_left_at(gamma) {
            if t < self.method.time() {
                // The last step is still to be read, in its own chart.
                self.method.prepare_dense(&self.rotor);
            }
            let phi = chart.axial_angle(turns, y[PHI], gamma);
            let crossed = crossed_exactly(gamma);
            self.rotor.chart = chart.other();
            let phi = self.rotor.chart.own_angle(phi, crossed);
            self.rotor.turns = phi.turns;
            let mut y = y;
            y[GAMMA].copy_from_slice(crossed.as_slice());
            y[PHI] = phi.remainder;
            self.method.go_on_from(&self.rotor, y);
            self.method.recount(GAMMA);
        } else {
            let phi = Angle { turns, remainder: y[PHI] }.wrapped();
            self.rotor.turns = phi.turns;
            self.method.replace(PHI, phi.remainder);
        }
    }

    /// The whole turns of φ that go with γ \[rad] at a time `t` \[s] of the last step.
    fn turns_at(&self, t: f64, gamma: Vector2<f64>) -> f64 {
        let LastStep { chart, turns, gamma: from, closest } = self.last;
        if self.method.counts_turns() {
            return turns;
        }
        match closest {
            Some((when, closest)) if when < t => {
                turns + chart.turns_gained(from, closest) + chart.turns_gained(closest, gamma)
            }
            _ => turns + chart.turns_gained(from, gamma),
        }
    }

    /// When \[s] and where \[rad] γ came closest to the origin in the last step, by golden sections of its dense output.
    fn closest_to_origin(&mut self) -> (f64, Vector2<f64>) {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        const SECTIONS: u32 = 40;
        let (mut low, mut high) = (self.method.start_time(), self.method.time());
        let mut at = |t: f64| {
            let gamma = gamma(&self.method.dense(&self.rotor, t));
            // Where kicks on the way there have no limit, the origin is near.
            (t, if gamma.norm().is_nan() { Vector2::zeros() } else { gamma })
        };
        let mut a = at(high - GOLDEN * (high - low));
        let mut b = at(low + GOLDEN * (high - low));
        for _ in 0..SECTIONS {
            if a.1.norm_squared() < b.1.norm_squared() {
                (high, b) = (b.0, a);
                a = at(high - GOLDEN * (high - low));
            } else {
                (low, a) = (a.0, b);
                b = at(low + GOLDEN * (high - low));
            }
        }
        if a.1.norm_squared() < b.1.norm_squared() { a } else { b }
    }

    /// The state at the communication point, its chart, and the whole turns of φ.
    fn shown(&mut self) -> ([f64; N], Chart, f64) {
        if self.t == self.method.time() {
            return (*self.method.state(), self.rotor.chart, self.rotor.turns);
        }
        // The rotor may have gone on in the other chart.
        let chart = std::mem::replace(&mut self.rotor.chart, self.last.chart);
        let y = self.method.dense(&self.rotor, self.t);
        self.rotor.chart = chart;
        (y, self.last.chart, self.turns_at(self.t, gamma(&y)))
    }

    /// What the communication point shows, `news` being the effects whose inputs were set there.
    pub(super) fn read(&mut self, news: Option<&E>) -> Reading {
        let (mut y, chart, turns) = self.shown();
        if let Some(effects) = news {
            self.jump(effects, chart, &mut y);
        }
        let free = self.rotor.free_motion_in(chart, self.t, &y).when(self.t, turns);
        let motion = imposed(news.unwrap_or(&self.rotor.effects), free);
        let spent = self.method.cost();
        let cost = Cost { error_estimate: spent.error_estimate * self.tolerance.relative, ..spent };
        Reading::new(motion, &self.rotor.effects, work(&y), self.total_at_start, cost)
    }
}

fn gamma(y: &[f64]) -> Vector2<f64> {
    Coordinates::from_slice(y).gamma
}

/// The work supplied and lost \[J], where it is solved.
fn work<const N: usize>(y: &[f64; N]) -> [f64; 2] {
    if N == WITH_WORK { [y[SUPPLIED], y[DISSIPATED]] } else { [0.0, 0.0] }
}
