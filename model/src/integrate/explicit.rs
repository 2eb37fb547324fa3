//! Explicit Runge–Kutta pairs with adaptive steps and dense output, for any [`Tableau`]. No allocation.

mod dense;
mod stages;

use super::answer::Answer;
use super::control::Controller;
use super::lanes::{are_finite, pair, pairs, put};
use super::power::power;
use super::segment::Segment;
use super::sizes::{Sizes, Squares, largest_square};
use super::tableau::{DOP853, MOST_STAGES, Tableau};
use super::{Cost, Fault, LEAST_FIRST, SHRUNK, System, Tolerance, end_of_step};
use crate::scalar::ulp;
use crate::stored::stored;
use std::ops::Range;

/// A method at work: where it stands, its last step as a polynomial, and what it spent.
#[derive(Clone, Copy, Debug)]
pub struct Explicit<const N: usize> {
    tableau: &'static Tableau,
    tolerance: Tolerance,
    sizes: Sizes<N>,
    controller: Controller,
    cost: Cost,
    /// The time reached \[s], and the state there.
    t: f64,
    y: [f64; N],
    /// Size of the next step \[s], and of the longest of late.
    h: f64,
    longest: f64,
    /// The stages k_i of the last step; `k[tableau.last]` is the rate at its end.
    k: [[f64; N]; MOST_STAGES],
    segment: Segment<N>,
}

stored!(Explicit<const N: usize> { tableau, tolerance, sizes, controller, cost, t, y, h, longest, k, segment });

/// After a step the longest of late counts for this part of it, at least as that step \[1].
const SHORTENED: f64 = 0.98;

/// A refused step is tried again with this part of it.
const REFUSED: f64 = 0.6;

/// A first step is guessed from what changes within this time, at most \[s].
const LONGEST_TRIAL: f64 = 1e-2;

impl<const N: usize> Explicit<N> {
    /// Starts at time `t` \[s] and state `y`.
    pub fn start(
        tableau: &'static Tableau,
        tolerance: Tolerance,
        system: &impl System<N>,
        t: f64,
        y: [f64; N],
    ) -> Self {
        let mut method = Self {
            tableau,
            tolerance,
            controller: Controller::new(tableau.error_order),
            t,
            y,
            segment: Segment { t, y, ..Segment::blank() },
            ..Self::blank()
        };
        let rate = method.evaluate(system, t, &y);
        method.k[tableau.last] = rate;
        method.sizes = Sizes::at_start(&tolerance, system, &y, &rate);
        method.segment.sizes = method.sizes;
        // A first guess may be too short to advance a late time; one too long is rejected.
        method.h = method.first_step(system).max(LEAST_FIRST * ulp(t));
        method
    }

    /// Nothing yet: a place for what was stored.
    pub fn blank() -> Self {
        Self {
            tableau: &DOP853,
            tolerance: Tolerance::default(),
            sizes: Sizes::blank(),
            controller: Controller::new(DOP853.error_order),
            cost: Cost::default(),
            t: 0.0,
            y: [0.0; N],
            h: 0.0,
            longest: 0.0,
            k: [[0.0; N]; MOST_STAGES],
            segment: Segment::blank(),
        }
    }

    /// The time reached \[s].
    pub fn time(&self) -> f64 {
        self.t
    }

    /// The state at the time reached.
    pub fn state(&self) -> &[f64; N] {
        &self.y
    }

    /// A motion that swings and does not die out is kept from growing by steps of up to so much of its phase \[rad].
    pub fn swings(&self) -> f64 {
        self.tableau.swings
    }

    /// Its rate there.
    pub fn rate(&self) -> &[f64; N] {
        &self.k[self.tableau.last]
    }

    /// Where the last step began \[s].
    pub fn start_time(&self) -> f64 {
        self.segment.t
    }

    /// The state where the last step began.
    pub fn start_state(&self) -> &[f64; N] {
        &self.segment.y
    }

    /// The next step will be no longer than this \[s].
    pub fn limit_step(&mut self, h: f64) {
        self.h = self.h.min(h);
    }

    /// The size of the next step \[s], unless it is limited.
    pub fn next_step(&self) -> f64 {
        self.h
    }

    /// Goes back to a time `t` \[s] within the last step, where the state is `y`.
    pub fn go_back(&mut self, system: &impl System<N>, t: f64, y: [f64; N]) {
        let Segment { t: start, h, sizes, .. } = self.segment;
        let is_within = t < self.t;
        self.t = t;
        self.go_on_from(system, y);
        if is_within {
            // The sizes of what lies ahead are forgotten.
            self.sizes = sizes;
            self.sizes.take(system, &sizes.seen(system, &y, self.rate()), (t - start) / h);
        }
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

    /// How small the error of a step must be.
    pub fn tolerance(&self) -> Tolerance {
        self.tolerance
    }

    /// How large the motion is.
    pub fn sizes(&self) -> Sizes<N> {
        self.sizes
    }

    /// The same in place of another method at the same state, with its sizes and its cost, and with a next step of `h` \[s].
    pub fn instead(self, h: f64, sizes: Sizes<N>, cost: Cost) -> Self {
        Self { h, sizes, cost: self.cost.after(cost), ..self }
    }

    /// From now on excursions of these components count from 0.
    pub fn recount(&mut self, components: Range<usize>) {
        self.sizes.recount(components);
    }

    /// What the run has cost so far.
    pub fn cost(&self) -> Cost {
        Cost { next_step: self.h, ..self.cost }
    }

    /// So much was spent until now.
    pub fn charge(&mut self, spent: Cost) {
        self.cost.charge(spent);
    }

    /// One step forward of the method's own choice, but not past time `until` \[s], while the run has taken at most `most`
    /// evaluations, other work counted as such. Where none is possible, the method stands as before.
    pub fn step(&mut self, system: &impl System<N>, most: f64, until: f64) -> Result<(), Fault> {
        let (rate, h) = (self.k[self.tableau.last], self.h);
        if !are_finite(&rate) {
            return Err(Fault::NotFinite { t: self.t });
        }
        let mut obstacle = None;
        loop {
            // A step that is not a number does not advance the time either.
            let advances = self.t + 0.1 * self.h > self.t && self.h > SHRUNK * h;
            if !advances || self.cost.work() > most {
                (self.k[self.tableau.last], self.h) = (rate, h);
                return Err(Fault::of_no_step(self.t, advances, obstacle));
            }
            let wish = self.h;
            let end = end_of_step(self.t, self.h, until);
            // The step that the rounded times really span, or 10⁷ of them would drift from the time that they claim.
            self.h = end - self.t;
            self.k[0] = rate;
            let Attempt { y, error, seen } = self.attempt::<true>(system);
            let mut least_factor = 0.0;
            obstacle = if !error.is_finite() {
                Some(Fault::NotFinite { t: self.t })
            } else if error > 1.0 {
                None
            } else if let Err(refusal) = system.admits(end, &y) {
                least_factor = REFUSED;
                Some(Fault::Refused { t: self.t, reason: refusal })
            } else {
                let share = if self.h < 0.999 * wish { self.h / wish } else { 1.0 };
                self.accept(system, end, y, error, &seen, share);
                if share < 1.0 {
                    // What was cut short says little about the step that may follow.
                    self.h = self.h.max(wish);
                }
                return Ok(());
            };
            self.cost.rejected += 1.0;
            let factor = self.controller.rejected(if obstacle.is_none() { error } else { f64::INFINITY });
            self.h *= factor.max(least_factor);
        }
    }

    /// One step of size `h` \[s], whatever its error.
    pub fn fixed_step(&mut self, system: &impl System<N>, h: f64) {
        self.h = h;
        self.k[0] = self.k[self.tableau.last];
        let Attempt { y, seen, .. } = self.attempt::<false>(system);
        self.accept(system, self.t + h, y, 0.0, &seen, 1.0);
        self.h = h;
    }

    fn evaluate(&mut self, system: &impl System<N>, t: f64, y: &[f64; N]) -> [f64; N] {
        self.cost.evaluations += 1.0;
        system.rates_of_all(t, y)
    }

    fn accept(&mut self, system: &impl System<N>, end: f64, y: [f64; N], error: f64, seen: &Squares, share: f64) {
        let segment = &mut self.segment;
        (segment.t, segment.h, segment.y, segment.dense) = (self.t, self.h, self.y, false);
        segment.sizes.copy(system, &self.sizes);
        self.sizes.take(system, seen, share);
        self.longest = self.h.max(SHORTENED * self.longest);
        if segment.rough {
            // Only such a step is read by what an answer keeps.
            (segment.rough, segment.answer) = (false, Answer::none());
        }
        // The segment ends at y: r_2 holds the difference until the rest is asked for.
        (0..pairs(N)).for_each(|p| put(&mut segment.r[0], p, pair(&y, p) - pair(&self.y, p)));
        self.t = end;
        self.y = y;
        self.cost.steps += 1.0;
        self.cost.error_estimate += error;
        self.h *= self.controller.accepted(error);
    }

    /// A first step from the rate of the state and the change of that rate (Hairer, Nørsett and Wanner I, section II.4).
    fn first_step(&mut self, system: &impl System<N>) -> f64 {
        let (t, y, rate) = (self.t, self.y, self.k[self.tableau.last]);
        let weights = self.weights(system, f64::INFINITY, &self.sizes.seen(system, &y, &rate));
        let norm = |v: &[f64; N]| largest_square(system, &system.parts(t, &y, v), &weights).sqrt();
        let speed = norm(&rate);
        // In which time some size changes by a hundredth.
        let trial = (0.01 / (self.tolerance.relative * speed)).min(LONGEST_TRIAL);
        let ahead: [f64; N] = std::array::from_fn(|n| y[n] + trial * rate[n]);
        let rate_ahead = self.evaluate(system, t + trial, &ahead);
        let change: [f64; N] = std::array::from_fn(|n| rate_ahead[n] - rate[n]);
        let largest = speed.max(norm(&change) / trial);
        let step = power(0.01 / largest, 1.0 / self.tableau.error_order);
        if step.is_finite() { step.min(100.0 * trial) } else { trial }
    }

    /// What each group's error counts in a step of size `h` \[s] that ends where the sizes are `seen`.
    #[inline(always)]
    fn weights(&self, system: &impl System<N>, h: f64, seen: &Squares) -> Squares {
        self.sizes.weights(system, &self.tolerance, &system.roundings(&self.y, h), seen)
    }
}

/// What came of a step that was tried.
struct Attempt<const N: usize> {
    /// The state at its end.
    y: [f64; N],
    /// The norm of its error in units of the tolerance \[1], or 0 where it is not asked for.
    error: f64,
    /// The sizes of the motion there.
    seen: Squares,
}
