//! Explicit Runge–Kutta pairs with adaptive steps and dense output, for any [`Tableau`]. No allocation.

use super::answer::Answer;
use super::control::Controller;
use super::lanes::{both, nothing, pair, pairs, put};
use super::power::power;
use super::segment::Segment;
use super::tableau::{Combination, DOP853, Dop853, Dopri5, ErrorRule, MOST_STAGES, Pair, Stage, Tableau};
use super::{Cost, Fault, Refusal, System, Tolerance, end_of_step, mean_square};
use crate::scalar::ulp;
use crate::stored::stored;

/// A method at work: where it stands, its last step as a polynomial, and what it spent.
#[derive(Clone, Debug)]
pub struct Explicit<const N: usize> {
    tableau: &'static Tableau,
    tolerance: Tolerance<N>,
    /// The share of each component in the error norm: 1/n of n that count.
    share: f64,
    controller: Controller,
    cost: Cost,
    /// The time reached [s], and the state there.
    t: f64,
    y: [f64; N],
    /// Size of the next step [s].
    h: f64,
    /// The stages k_i of the last step; `k[tableau.last]` is the rate at its end.
    k: [[f64; N]; MOST_STAGES],
    /// Attempts in a row that got nowhere.
    stall: u32,
    segment: Segment<N>,
}

stored!(Explicit<const N: usize> { tableau, tolerance, share, controller, cost, t, y, h, k, stall, segment });

/// A refused step is tried again with this part of it.
const REFUSED: f64 = 0.6;

/// A first step spans at least so many units in the last place of the time.
const LEAST_FIRST: f64 = 100.0;

/// A step whose polynomial ends in a term of so many tolerances is of no use between its ends: one that spans many turns of a
/// motion too small to matter there. In sound steps that term is 3 to 30.
const ROUGH: f64 = 100.0;

/// So many attempts in a row may be shorter than what gets anywhere: a first step may start tiny and grow. Steps that
/// succeed are borne with twice as long, so that the reason told is that of one that did not.
const PATIENCE: u32 = 1000;

impl<const N: usize> Explicit<N> {
    /// Starts at time `t` [s] and state `y`.
    pub fn start(
        tableau: &'static Tableau,
        tolerance: Tolerance<N>,
        system: &impl System<N>,
        t: f64,
        y: [f64; N],
    ) -> Self {
        let mut method = Self {
            tableau,
            share: tolerance.share(),
            tolerance,
            controller: Controller::new(tableau.error_order),
            t,
            y,
            segment: Segment { t, y, ..Segment::blank() },
            ..Self::blank()
        };
        method.k[tableau.last] = method.evaluate(system, t, &y);
        // A first guess may be too short to advance a late time; one too long is rejected.
        method.h = method.first_step(system).max(LEAST_FIRST * ulp(t));
        method
    }

    /// Nothing yet: a place for what was stored.
    pub fn blank() -> Self {
        Self {
            tableau: &DOP853,
            tolerance: Tolerance { absolute: [0.0; N], relative: [0.0; N] },
            share: 0.0,
            controller: Controller::new(DOP853.error_order),
            cost: Cost::default(),
            t: 0.0,
            y: [0.0; N],
            h: 0.0,
            k: [[0.0; N]; MOST_STAGES],
            stall: 0,
            segment: Segment::blank(),
        }
    }

    /// The time reached [s].
    pub fn time(&self) -> f64 {
        self.t
    }

    /// The state at the time reached.
    pub fn state(&self) -> &[f64; N] {
        &self.y
    }

    /// Its rate there.
    pub fn rate(&self) -> &[f64; N] {
        &self.k[self.tableau.last]
    }

    /// Where the last step began [s].
    pub fn start_time(&self) -> f64 {
        self.segment.t
    }

    /// The state where the last step began.
    pub fn start_state(&self) -> &[f64; N] {
        &self.segment.y
    }

    /// The next step will be no longer than this [s].
    pub fn limit_step(&mut self, h: f64) {
        self.h = self.h.min(h);
    }

    /// The size of the next step [s], unless it is limited.
    pub fn next_step(&self) -> f64 {
        self.h
    }

    /// Goes back to a time `t` [s] within the last step, where the state is `y`.
    pub fn go_back(&mut self, system: &impl System<N>, t: f64, y: [f64; N]) {
        self.t = t;
        self.go_on_from(system, y);
    }

    /// Goes on from another description `y` of the state reached. What the last step's dense output needs of the old
    /// one must have been prepared.
    pub fn go_on_from(&mut self, system: &impl System<N>, y: [f64; N]) {
        self.y = y;
        self.k[self.tableau.last] = self.evaluate(system, self.t, &y);
    }

    /// Replaces a component of the state on which the rates do not depend.
    pub fn replace(&mut self, component: usize, value: f64) {
        self.y[component] = value;
    }

    /// What the run has cost so far.
    pub fn cost(&self) -> Cost {
        Cost { next_step: self.h, ..self.cost }
    }

    /// One step forward of the method's own choice, but not past time `until` [s]. Where none is possible, the method
    /// stands as before.
    ///
    /// Steps below `least` [s] get nowhere: after [`PATIENCE`] of them in a row, none is possible.
    pub fn step(&mut self, system: &impl System<N>, least: f64, until: f64) -> Result<(), Fault> {
        let (rate, h) = (self.k[self.tableau.last], self.h);
        if !rate.iter().all(|rate| rate.is_finite()) {
            return Err(Fault::NotFinite { t: self.t });
        }
        let (mut obstacle, mut patience) = (None, 2 * PATIENCE);
        loop {
            self.stall = if self.h < least { self.stall + 1 } else { 0 };
            // A step that is not a number does not advance the time either.
            let advances = self.t + 0.1 * self.h > self.t;
            if !advances || self.stall > patience {
                (self.k[self.tableau.last], self.h, self.stall) = (rate, h, 0);
                return Err(
                    obstacle.map_or(Fault::Underflow { t: self.t }, |obstacle: Obstacle| obstacle.fault(self.t))
                );
            }
            let wish = self.h;
            let end = end_of_step(self.t, self.h, until);
            // The step that the rounded times really span, or 10⁷ of them would drift from the time that they claim.
            self.h = end - self.t;
            self.k[0] = rate;
            let (y, error) = self.attempt::<true>(system);
            let mut least_factor = 0.0;
            obstacle = if !error.is_finite() {
                Some(Obstacle::NotFinite)
            } else if error > 1.0 {
                None
            } else if let Err(refusal) = system.admits(end, &y) {
                least_factor = REFUSED;
                Some(Obstacle::Refused(refusal))
            } else {
                let cut = self.h < 0.999 * wish;
                self.accept(end, y, error);
                if cut {
                    // What was cut short says little about the step that may follow.
                    self.h = self.h.max(wish);
                }
                return Ok(());
            };
            patience = PATIENCE;
            self.cost.rejected += 1.0;
            let factor = self.controller.rejected(if obstacle.is_none() { error } else { f64::INFINITY });
            self.h *= factor.max(least_factor);
        }
    }

    /// One step of size `h` [s], whatever its error.
    pub fn fixed_step(&mut self, system: &impl System<N>, h: f64) {
        self.h = h;
        self.k[0] = self.k[self.tableau.last];
        let (y, _) = self.attempt::<false>(system);
        self.accept(self.t + h, y, 0.0);
        self.h = h;
    }

    /// The state at a time `t` [s] within the last step.
    pub fn dense(&mut self, system: &impl System<N>, t: f64) -> [f64; N] {
        if t == self.segment.t || self.segment.h == 0.0 {
            return self.segment.y;
        }
        self.prepare_dense(system);
        if !self.segment.rough {
            return self.segment.at(t, self.terms());
        }
        let known = self.segment.answer.at(t);
        known.unwrap_or_else(|| {
            let y = self.stepped(system, t);
            self.segment.answer.keep(t, y)
        })
    }

    /// The same by steps from where the last one began, for one whose polynomial says nothing.
    fn stepped(&mut self, system: &impl System<N>, t: f64) -> [f64; N] {
        let Segment { t: start, y, .. } = self.segment;
        let mut again = Self::start(self.tableau, self.tolerance, system, start, y);
        while again.t < t {
            if again.step(system, 0.0, t).is_err() {
                // The step as a whole was possible, so what stands in the way of its parts is not worth a word.
                return self.segment.at(t, self.terms());
            }
        }
        self.cost.evaluations += again.cost.evaluations;
        again.y
    }

    fn evaluate(&mut self, system: &impl System<N>, t: f64, y: &[f64; N]) -> [f64; N] {
        self.cost.evaluations += 1.0;
        system.rates(t, y)
    }

    /// All stages of a step of size h from (t, y); the state at its end, and the norm of its error in units of the
    /// tolerance [1], or 0 where it is not asked for.
    fn attempt<const ERROR: bool>(&mut self, system: &impl System<N>) -> ([f64; N], f64) {
        if self.tableau == Dop853::TABLEAU {
            self.attempt_with::<Dop853, _, ERROR>(system)
        } else {
            self.attempt_with::<Dopri5, _, ERROR>(system)
        }
    }

    /// [`Explicit::attempt`] with the coefficients as constants: every sum is written out by the compiler.
    #[inline(never)]
    fn attempt_with<P: Pair, F: System<N>, const ERROR: bool>(&mut self, system: &F) -> ([f64; N], f64) {
        let (t, h, start) = (self.t, self.h, self.y);
        let mut newest = self.k[0];
        macro_rules! stages {
            ($($i:literal)*) => {$(
                if $i < P::TABLEAU.last {
                    newest = self.stage(system, (t, h, &start), const { P::TABLEAU.stage($i) }, &newest);
                    self.k[$i] = newest;
                }
            )*};
        }
        stages! { 1 2 3 4 5 6 7 8 9 10 11 12 }
        // The last stage stands at the end of the step.
        let y = self.ended(&start, h, const { P::TABLEAU.stage(P::TABLEAU.last) }.a);
        // Where the error does not need that stage, it is begun before it: the next step's size waits for it.
        let early = const { ERROR && !P::TABLEAU.error.needs(P::TABLEAU.last) };
        let late = const { ERROR && P::TABLEAU.error.needs(P::TABLEAU.last) };
        let mut error = if early { self.error_norm::<P>(&y) } else { 0.0 };
        self.k[P::TABLEAU.last] = self.evaluate(system, t + h, &y);
        if late {
            error = self.error_norm::<P>(&y);
        }
        (y, error)
    }

    /// A stage of a step of size h from (t, y), of those before it; `newest` is the last of them.
    #[inline(always)]
    fn stage<F: System<N>>(
        &mut self,
        system: &F,
        (t, h, y): (f64, f64, &[f64; N]),
        stage: &Stage,
        newest: &[f64; N],
    ) -> [f64; N] {
        let there = self.advanced::<F>(y, h, stage.a, newest);
        // eq. 21: k_i = f(t + c_i h, y + h Σ a_ij k_j)
        self.evaluate(system, t + stage.c * h, &there)
    }

    /// y + h Σ b_j k_j as y + h (k₁ + Σ b_j (k_j − k₁)), which is the same because Σ b_j = 1. The sum of the rounded b_j
    /// is not 1: a uniform rotation would run away from its angle by 3e-9 rad in 10⁶ turns.
    #[inline(always)]
    fn ended(&self, y: &[f64; N], h: f64, b: Combination) -> [f64; N] {
        let mut end = [0.0; N];
        for p in 0..pairs(N) {
            let first = pair(&self.k[0], p);
            let mut sum = nothing();
            for &(j, coefficient) in &b[1..] {
                sum += both(coefficient) * (pair(&self.k[j], p) - first);
            }
            put(&mut end, p, pair(y, p) + both(h) * (first + sum));
        }
        end
    }

    /// y + h Σ a_j k_j of what the rates depend on; the last stage of the sum, which is `newest`, comes last, for it is the
    /// one that is waited for.
    #[inline(always)]
    fn advanced<F: System<N>>(&self, y: &[f64; N], h: f64, a: Combination, newest: &[f64; N]) -> [f64; N] {
        let (&(_, last), older) = a.split_last().expect("a stage depends on those before it");
        let mut there = *y;
        for p in 0..pairs(F::DEPENDED_ON) {
            let mut sum = nothing();
            for &(j, coefficient) in older {
                sum += both(h * coefficient) * pair(&self.k[j], p);
            }
            put(&mut there, p, pair(y, p) + (sum + both(h * last) * pair(newest, p)));
        }
        there
    }

    /// Σ a_j k_j.
    #[inline(always)]
    fn combined(&self, a: Combination) -> [f64; N] {
        let mut combined = [0.0; N];
        for p in 0..pairs(N) {
            let mut sum = nothing();
            for &(j, coefficient) in a {
                sum += both(coefficient) * pair(&self.k[j], p);
            }
            put(&mut combined, p, sum);
        }
        combined
    }

    /// The norm of the error of the step that ends at `y`, in units of the tolerance [1].
    #[inline(always)]
    fn error_norm<P: Pair>(&self, y: &[f64; N]) -> f64 {
        let weights = self.tolerance.weights(&std::array::from_fn(|n| self.y[n].abs().max(y[n].abs())));
        let mean_square = |e: Combination| mean_square(&self.combined(e), &weights, self.share);
        let estimate = match const { &P::TABLEAU.error } {
            ErrorRule::Single(e) => mean_square(e).sqrt(),
            ErrorRule::Blend { fine, coarse } => {
                let (fine, coarse) = (mean_square(fine), mean_square(coarse));
                if fine == 0.0 { 0.0 } else { fine / (fine + 0.01 * coarse).sqrt() }
            }
        };
        self.h * P::TABLEAU.calibration * estimate
    }

    fn accept(&mut self, end: f64, y: [f64; N], error: f64) {
        let segment = &mut self.segment;
        (segment.t, segment.h, segment.y, segment.dense) = (self.t, self.h, self.y, false);
        if segment.rough {
            // Only such a step is read by what an answer keeps.
            (segment.rough, segment.answer) = (false, Answer::none());
        }
        // The segment ends at y: r_2 holds the difference until the rest is asked for.
        segment.r[0] = std::array::from_fn(|n| y[n] - self.y[n]);
        self.t = end;
        self.y = y;
        self.cost.steps += 1.0;
        self.cost.error_estimate += error;
        self.h *= self.controller.accepted(error);
    }

    /// Prepares the last step for [`Explicit::dense`], which otherwise does so when first asked.
    pub fn prepare_dense(&mut self, system: &impl System<N>) {
        if self.segment.dense {
            return;
        }
        if self.tableau == Dop853::TABLEAU {
            self.prepare_dense_with::<Dop853, _>(system);
        } else {
            self.prepare_dense_with::<Dopri5, _>(system);
        }
        self.segment.dense = true;
        self.segment.rough = self.roughness() > ROUGH;
    }

    /// The last term of the polynomial in the middle of the step, in units of the tolerance [1].
    fn roughness(&self) -> f64 {
        let Segment { y, r, .. } = &self.segment;
        let terms = self.terms();
        let size = std::array::from_fn(|i| y[i].abs().max((y[i] + r[0][i]).abs()));
        // eq. 24: σ and 1 − σ are 1/2 in each of its factors
        self.tolerance.norm(&r[terms - 1], &size) / f64::from(1_u32 << terms)
    }

    /// How many terms the polynomial of eq. 24 has after y.
    fn terms(&self) -> usize {
        3 + self.tableau.dense.len()
    }

    /// [`Explicit::prepare_dense`] with the coefficients as constants.
    #[inline(never)]
    fn prepare_dense_with<P: Pair, F: System<N>>(&mut self, system: &F) {
        let (t, h, start) = (self.segment.t, self.segment.h, self.segment.y);
        let mut newest = self.k[P::TABLEAU.last];
        macro_rules! stages {
            ($($i:literal)*) => {$(
                if P::TABLEAU.last < $i && $i < const { P::TABLEAU.count() } {
                    newest = self.stage(system, (t, h, &start), const { P::TABLEAU.stage($i) }, &newest);
                    self.k[$i] = newest;
                }
            )*};
        }
        stages! { 13 14 15 }
        let (first, last) = (self.k[0], self.k[P::TABLEAU.last]);
        let difference = self.segment.r[0];
        // eq. 24: r₃ = h k₁ − Δy, r₄ = 2Δy − h(k₁ + k_last)
        self.segment.r[1] = std::array::from_fn(|n| h * first[n] - difference[n]);
        self.segment.r[2] = std::array::from_fn(|n| 2.0 * difference[n] - h * (first[n] + last[n]));
        macro_rules! rows {
            ($($i:literal)*) => {$(
                if $i < P::TABLEAU.dense.len() {
                    self.segment.r[3 + $i] = self.combined(const { P::TABLEAU.row($i) }).map(|sum| h * sum);
                }
            )*};
        }
        rows! { 0 1 2 3 }
    }

    /// A first step from the sizes of y, dy/dt and the change of dy/dt (Hairer, Nørsett and Wanner I, section II.4).
    fn first_step(&mut self, system: &impl System<N>) -> f64 {
        let (t, y, rate) = (self.t, self.y, self.k[self.tableau.last]);
        let weights = self.tolerance.weights(&y.map(f64::abs));
        let share = self.share;
        let norm = |v: &[f64; N]| mean_square(v, &weights, share).sqrt();
        let (size, speed) = (norm(&y), norm(&rate));
        let trial = if size < 1e-5 || speed < 1e-5 { 1e-6 } else { 0.01 * size / speed };
        let ahead: [f64; N] = std::array::from_fn(|n| y[n] + trial * rate[n]);
        let rate_ahead = self.evaluate(system, t + trial, &ahead);
        let change: [f64; N] = std::array::from_fn(|n| rate_ahead[n] - rate[n]);
        let curvature = norm(&change) / trial;
        let largest = speed.max(curvature);
        let step = if largest <= 1e-15 {
            (trial * 1e-3).max(1e-6)
        } else {
            power(0.01 / largest, 1.0 / self.tableau.error_order)
        };
        if step.is_finite() { step.min(100.0 * trial) } else { trial }
    }
}

/// What stood in the way of an attempt, besides its error.
#[derive(Clone, Copy, Debug)]
enum Obstacle {
    NotFinite,
    Refused(Refusal),
}

impl Obstacle {
    fn fault(self, t: f64) -> Fault {
        match self {
            Obstacle::NotFinite => Fault::NotFinite { t },
            Obstacle::Refused(reason) => Fault::Refused { t, reason },
        }
    }
}
