//! Compositions: a motion that is the sum of two, each of which can be followed by itself, followed in turns. No allocation.
//!
//! Steps are of one size, which is found, or given as the longest: from time to time a step is compared with two that span it,
//! first each, then ever more rarely, as long as nothing changes; always where laws have events.

mod coefficients;

pub use coefficients::{BLANES_AND_MOAN, KAHAN, SOFRONIOU, STRANG, SUZUKI};

use super::answer::Answer;
use super::power::power;
use super::sizes::{MOST_GROUPS, Sizes, Squares, larger_of, largest_square, noise};
use super::{Cost, Fault, LEAST_FIRST, Refusal, SHRUNK, System, Tolerance, end_of_step};
use crate::scalar::ulp;
use crate::stored::{Damaged, Stored, Walk, choice, stored};
use std::ops::Range;

/// A motion that is the sum of two, on its way through a step.
pub trait Split<const N: usize> {
    /// Follows the one for a time `h` \[s], backwards where it is negative.
    fn drift(&mut self, h: f64);

    /// Follows the other for a time `h` \[s], backwards where it is negative; meanwhile the time stands at `t` \[s].
    fn kick(&mut self, t: f64, h: f64);

    /// The state reached, or why it cannot be, and how often the right-hand side was evaluated on the way.
    fn end(self) -> (Result<[f64; N], Refusal>, f64);
}

/// A system whose motion is the sum of two.
pub trait Splitting<const N: usize>: System<N> {
    /// Its motion through one step.
    type Flow<'s>: Split<N>
    where
        Self: 's;

    /// Sets out from y on a step of size `h` \[s].
    fn flow<'s>(&'s self, y: &[f64; N], composition: &Composition, h: f64) -> Self::Flow<'s>;

    /// Whether the kicks of a step of size `h` \[s] from `y` depend on the place alone, and how fast it moves on the speeds
    /// linearly.
    fn kicks_by_place(&self, _y: &[f64; N], _h: f64) -> bool {
        false
    }

    /// How fast what kicks pull back swings at `y` at time `t` \[s] where nothing dampens it, in a step of size `h` \[s] \[rad/s], and how
    /// fast dies out what kicks dampen \[1/s], where that must not be in a step: 0 elsewhere.
    fn fastest(&self, _t: f64, _y: &[f64; N], _h: f64) -> [f64; 2] {
        [0.0; 2]
    }

    /// Whether one step is like another, as long as they end in places like these.
    fn is_steady(&self) -> bool {
        true
    }

    /// [`System::roundings`] of one part of a step of size `h` \[s] from `y`.
    fn roundings_of_parts(&self, y: &[f64; N], h: f64) -> Squares {
        self.roundings(y, h)
    }

    /// [`System::parts`] of a difference between two ends of a step of size `h` \[s] from `y` at time `t` \[s].
    fn parts_of_ends(&self, t: f64, y: &[f64; N], apart: &[f64; N], _h: f64) -> Squares {
        self.parts(t, y, apart)
    }

    /// How far apart two ends of the same step are.
    fn apart(&self, a: &[f64; N], b: &[f64; N]) -> [f64; N] {
        std::array::from_fn(|n| a[n] - b[n])
    }
}

/// The drifts and kicks of a step, the same from both ends.
#[derive(Debug)]
pub struct Composition {
    /// Its order.
    pub order: u32,
    /// How much of the step each drift is \[1], one more than the kicks between them.
    drifts: &'static [f64],
    /// How much each kick is \[1].
    kicks: &'static [f64],
    /// A step may span so much of the phase of what swings \[rad], or it grows: from the trace of a step of a linear oscillator.
    stable: f64,
    /// The one to take where kicks depend on the place alone.
    nystrom: Option<&'static Composition>,
}

impl Composition {
    /// The composition of this order: 2, 4, 6 or 8.
    pub fn of_order(order: u32) -> Option<&'static Self> {
        ALL.into_iter().find(|composition| composition.order == order)
    }

    /// The composition of this order where kicks depend on the `place` alone, or may not.
    #[inline(always)]
    pub fn of_kicks(&self, place: bool) -> &Self {
        self.nystrom.filter(|_| place).unwrap_or(self)
    }

    /// One step of size `h` \[s] from time `t` \[s].
    #[inline(always)]
    pub fn follow<const N: usize>(&self, motion: &mut impl Split<N>, t: f64, h: f64) {
        // eq. 38: S(h) is drift(h/2), kick(h), drift(h/2); a step is S(γ₁h), S(γ₂h), …, and drifts that meet are one
        let mut reached = 0.0;
        for (drift, kick) in self.drifts.iter().zip(self.kicks) {
            motion.drift(drift * h);
            reached += drift;
            motion.kick(t + reached * h, kick * h);
        }
        motion.drift(self.drifts[self.kicks.len()] * h);
    }
}

impl Stored for &'static Composition {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        choice(self, &ALL, walk)
    }
}

impl PartialEq for Composition {
    /// A composition is itself only.
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

const ALL: [&Composition; 4] = [&STRANG, &SUZUKI, &SOFRONIOU, &KAHAN];

/// A composition at work: where it stands, where its last step began, and what it spent.
#[derive(Clone, Copy, Debug)]
pub struct Composed<const N: usize> {
    composition: &'static Composition,
    /// What its steps must keep; None where every step is exact.
    tolerance: Option<Tolerance>,
    sizes: Sizes<N>,
    /// No step is longer \[s]: infinite where the size is not given.
    longest: f64,
    /// Size of a step \[s].
    size: f64,
    /// Size of the next step \[s], never more.
    h: f64,
    /// Steps since the last that was compared.
    unchecked: u32,
    /// After so many the next is compared.
    every: u32,
    /// Error of the last that was, over the tolerance of the run \[1].
    estimate: f64,
    /// How far compared steps went, group by group, those of long ago less.
    reach: Squares,
    cost: Cost,
    /// The time reached \[s], and the state there.
    t: f64,
    y: [f64; N],
    /// Where the last step began \[s], the state there, and its size \[s].
    start: f64,
    start_y: [f64; N],
    last: f64,
    answer: Answer<N>,
}

stored!(Composed<const N: usize> {
    composition, tolerance, sizes, longest, size, h, unchecked, every, estimate, reach, cost, t, y, start, start_y, last,
    answer
});

/// Comparisons are no further apart than so many steps.
const EVERY: u32 = 48;

/// The error of a step may be this part of the tolerance, since errors add up \[1]; where the motion goes less than its own size in a step,
/// so much less.
const SHARE: f64 = 0.1;

/// But not less than this \[1]: what hardly moves in a step mostly errs to and fro.
const LEAST: f64 = 0.01;

/// A step is compared with two, of which the first is this part of it, a golden section \[1]: halves of a step of four nutations would
/// err by their resonance as the whole does.
const PART: f64 = 0.381_966_011_250_105_15;

/// A step that goes farther than those that were compared, by this factor squared, is compared \[1].
const FARTHER: f64 = 4.0;

/// What they went counts less with each that comes after, by this factor squared, or what has died out could grow anew unseen \[1].
const FORGOTTEN: f64 = 0.8;

/// A step is chosen this much smaller than the error would allow, and grows only where it can grow by this; at most by
/// [`MOST_GROWTH`] at once \[1].
const SAFETY: f64 = 0.8;
const GROWTH: f64 = 1.25;
const MOST_GROWTH: f64 = 6.0;

/// A drift and a kick round about so many sums one after another, at most.
const SUMS: f64 = 4.0;

/// Where every step is exact, its length does not matter \[s].
const FREE: f64 = 1.0;

/// The first step that is tried is no longer than this \[s].
const LONGEST_FIRST: f64 = 1e-2;

impl<const N: usize> Composed<N> {
    /// Starts at time `t` \[s] and state `y`, with steps of this size \[s], of which none is compared.
    pub fn start(composition: &'static Composition, size: f64, t: f64, y: [f64; N]) -> Self {
        Self {
            composition,
            tolerance: None,
            sizes: Sizes::blank(),
            longest: size,
            size,
            h: size,
            unchecked: 0,
            every: 0,
            estimate: 0.0,
            reach: [0.0; MOST_GROUPS],
            cost: Cost::default(),
            t,
            y,
            start: t,
            start_y: y,
            last: 0.0,
            answer: Answer::none(),
        }
    }

    /// The same with steps of any size, since each is exact.
    pub fn start_free(composition: &'static Composition, t: f64, y: [f64; N]) -> Self {
        Self { longest: f64::INFINITY, ..Self::start(composition, FREE, t, y) }
    }

    /// The same with steps that keep the tolerance, none longer than `longest` \[s], where that is given.
    pub fn start_within(
        composition: &'static Composition,
        longest: Option<f64>,
        tolerance: Tolerance,
        system: &impl System<N>,
        t: f64,
        y: [f64; N],
    ) -> Self {
        let tolerance = tolerance.times(SHARE);
        let rate = system.rates_of_all(t, &y);
        let sizes = Sizes::at_start(&tolerance, system, &y, &rate);
        let size = longest.unwrap_or_else(|| {
            let rounded = system.roundings(&y, f64::INFINITY);
            let weights = sizes.weights(system, &tolerance, &rounded, &sizes.seen(system, &y, &rate));
            let speed = largest_square(system, &system.parts(t, &y, &rate), &weights).sqrt();
            // In which some size changes by a hundredth; what is too long is rejected.
            (0.01 / (tolerance.relative * speed)).min(LONGEST_FIRST).max(LEAST_FIRST * ulp(t))
        });
        let longest = longest.unwrap_or(f64::INFINITY);
        Self { tolerance: Some(tolerance), sizes, longest, ..Self::start(composition, size, t, y) }
    }

    /// Nothing yet: a place for what was stored.
    pub fn blank() -> Self {
        Self::start(&STRANG, 0.0, 0.0, [0.0; N])
    }

    /// The time reached \[s].
    pub fn time(&self) -> f64 {
        self.t
    }

    /// The state at the time reached.
    pub fn state(&self) -> &[f64; N] {
        &self.y
    }

    /// Where the last step began \[s].
    pub fn start_time(&self) -> f64 {
        self.start
    }

    /// The state where the last step began.
    pub fn start_state(&self) -> &[f64; N] {
        &self.start_y
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
    pub fn go_back(&mut self, t: f64, y: [f64; N]) {
        (self.t, self.y) = (t, y);
        // What acts now may act otherwise. A given size need not be found again, and what throws the rotor farther is seen.
        if !self.is_given() {
            self.every = 0;
        }
    }

    /// Goes on from the state reached under another law.
    pub fn go_on_under(&mut self) {
        self.every = 0;
    }

    /// Whether steps of any size are exact, and none is given.
    pub fn is_free(&self) -> bool {
        self.tolerance.is_none() && !self.is_given()
    }

    /// The size of its steps and the longest that they may have \[s], where that is given and they keep a tolerance.
    pub fn given(&self) -> Option<[f64; 2]> {
        (self.is_given() && self.tolerance.is_some()).then_some([self.size, self.longest])
    }

    /// Whether the size of steps is given.
    fn is_given(&self) -> bool {
        self.longest.is_finite()
    }

    /// Goes on from another description `y` of the state reached.
    pub fn go_on_from(&mut self, y: [f64; N]) {
        self.y = y;
    }

    /// Replaces a component of the state.
    pub fn replace(&mut self, component: usize, value: f64) {
        self.y[component] = value;
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

    /// One step forward, but not past time `until` \[s], while the run has taken at most `most` evaluations. One that cannot be
    /// done is tried again with half its size; where none is possible, the method stands as before.
    pub fn step(&mut self, system: &impl Splitting<N>, most: f64, until: f64) -> Result<(), Fault> {
        self.keep_stable(system);
        let mut h = self.h;
        let mut fault = None;
        loop {
            // A step that is not a number does not advance the time either.
            let advances = self.t + 0.1 * h > self.t && h > SHRUNK * self.h;
            if !advances || self.cost.work() > most {
                return Err(Fault::of_no_step(self.t, advances, fault));
            }
            let end = end_of_step(self.t, h, until);
            // The step that the rounded times really span, or 10⁷ of them would drift from the time that they claim.
            let span = end - self.t;
            let from = self.y;
            let followed = self.followed(system, self.t, &from, span);
            let mut smaller = 0.5;
            fault = match followed.and_then(|y| system.admits(end, &y).map(|()| y)) {
                Ok(y) if y.iter().all(|y| y.is_finite()) => match self.checked(system, &y, span) {
                    Some(factor) if factor < 1.0 => {
                        (smaller, self.every) = (factor, 0);
                        None
                    }
                    factor => {
                        // Where a longer step was just refused, it does not grow.
                        let is_first = h == self.h;
                        // A step in between errs as the last that was compared, a shorter one less.
                        let share = factor.map_or(span / self.size, |_| 1.0);
                        self.cost.error_estimate += self.estimate * share;
                        self.accept(end, y, span);
                        match factor {
                            Some(factor) if is_first => self.resize(self.size, span, factor),
                            Some(_) => self.resize(h, span, 1.0),
                            None => {}
                        }
                        return Ok(());
                    }
                },
                Ok(_) => Some(Fault::NotFinite { t: self.t }),
                Err(reason) => Some(Fault::Refused { t: self.t, reason }),
            };
            self.cost.rejected += 1.0;
            h = smaller * span;
        }
    }

    /// Where a size is new or the law is, a step is not so long that what swings would grow from rounding, unseen between comparisons.
    fn keep_stable(&mut self, system: &impl Splitting<N>) {
        if self.tolerance.is_none() || self.every > 0 {
            return;
        }
        let composition = self.composition.of_kicks(system.kicks_by_place(&self.y, self.size));
        let [swings, dies] = system.fastest(self.t, &self.y, self.size);
        // eq. 112: h = φ_max/ω_max, and h = 1/λ_max
        let longest = (composition.stable / swings).min(1.0 / dies);
        if self.size > longest {
            self.size = longest;
            self.limit_step(longest);
        }
    }

    /// By which factor a step may grow \[1] that ends at `y` after a time `h` \[s]: it must shrink by one below 1, and is right
    /// otherwise. None where that is not asked now.
    fn checked(&mut self, system: &impl Splitting<N>, y: &[f64; N], h: f64) -> Option<f64> {
        let tolerance = self.tolerance?;
        let (from, way) = (self.y, system.parts(self.t, &self.y, &system.apart(y, &self.y)));
        let farther = |group: usize| way[group] > FARTHER * self.reach[group];
        if self.unchecked < self.every && system.is_steady() && !(0..MOST_GROUPS).any(farther) {
            return None;
        }
        let part = PART * h;
        let middle = self.followed(system, self.t, &from, part);
        let parts = middle.and_then(|middle| self.followed(system, self.t + part, &middle, h - part));
        let Ok(in_parts) = parts else { return Some(0.5) };
        let end = self.t + h;
        let rate = system.rates_of_all(end, y);
        self.cost.evaluations += 1.0;
        let seen = self.sizes.seen(system, y, &rate);
        let sums = self.composition.kicks.len() as f64;
        let rounded = system.roundings_of_parts(&self.y, h).map(|square| square * sums * sums);
        // The two parts together round twice as often.
        let noise = noise(&rounded.map(|square| 4.0 * square));
        let rounded = rounded.map(|square| square * SUMS * SUMS);
        let weights = |tolerance| self.sizes.weights(system, tolerance, &rounded, &seen);
        let speed = largest_square(system, &system.parts(end, y, &rate), &weights(&tolerance)).sqrt();
        // eq. 45: b = min(1, max(0.01, ν h)), since errors of short steps add up as those of long ones do
        let budget = (tolerance.relative * speed * h).clamp(LEAST, 1.0);
        let weights = weights(&tolerance.times(budget));
        // eq. 45
        let apart = system.apart(y, &in_parts);
        let parts = system.parts_of_ends(self.t, &self.y, &apart, h);
        let error = largest_square(system, &parts, &weights).sqrt();
        if !error.is_finite() {
            return Some(0.5);
        }
        // What a step of another size may err changes with it.
        let order = f64::from(self.composition.order + u32::from(budget >= 1.0));
        let factor = |error| SAFETY * power(error, -1.0 / order);
        if error > 1.0 {
            return Some(factor(error).max(0.1));
        }
        self.sizes.take(system, &seen, 1.0);
        self.reach = larger_of(&self.reach.map(|square| FORGOTTEN * square), &way);
        self.estimate = error * budget * SHARE;
        // What rounding alone may do says nothing of the step.
        let told = std::array::from_fn(|group| if parts[group] > noise[group] { parts[group] } else { 0.0 });
        Some(factor(largest_square(system, &told, &weights).sqrt()).clamp(1.0, MOST_GROWTH))
    }

    /// One step of size `h` \[s], wherever it ends.
    pub fn fixed_step(&mut self, system: &impl Splitting<N>, h: f64) {
        let y = self.y;
        let y = self.followed(system, self.t, &y, h).unwrap_or([f64::NAN; N]);
        self.accept(self.t + h, y, h);
    }

    /// The state at a time `t` \[s] within the last step: a step of its own from where that began, as good as the method
    /// and without a gap at either end. `system` as it was in the last step.
    pub fn dense(&mut self, system: &impl Splitting<N>, t: f64) -> [f64; N] {
        if t == self.start || self.last == 0.0 {
            return self.start_y;
        }
        if let Some(answer) = self.answer.at(t) {
            return answer;
        }
        // On the way other places are come to than in the whole step: where one has no limit, shorter steps follow the motion more closely.
        let mut answer = [f64::NAN; N];
        for parts in [1, 2, 4, 8, 16, 32, 64] {
            let size = (t - self.start) / f64::from(parts);
            let start = self.start;
            let end =
                (0..parts).try_fold(self.start_y, |y, n| self.followed(system, start + f64::from(n) * size, &y, size));
            if let Ok(y) = end
                && y.iter().all(|y| y.is_finite())
            {
                answer = y;
                break;
            }
        }
        self.answer.keep(t, answer)
    }

    fn followed(&mut self, system: &impl Splitting<N>, t: f64, y: &[f64; N], h: f64) -> Result<[f64; N], Refusal> {
        let mut motion = system.flow(y, self.composition, h);
        self.composition.of_kicks(system.kicks_by_place(y, h)).follow(&mut motion, t, h);
        let (y, evaluations) = motion.end();
        self.cost.evaluations += evaluations;
        y
    }

    /// Goes on to time `end` \[s] and state `y` after a time `h` \[s].
    fn accept(&mut self, end: f64, y: [f64; N], h: f64) {
        (self.start, self.start_y, self.last) = (self.t, self.y, h);
        (self.t, self.y, self.h) = (end, y, self.size);
        self.answer = Answer::none();
        self.unchecked = self.unchecked.saturating_add(1);
        self.cost.steps += 1.0;
    }

    /// The size of steps from here on, after one of size `wish` \[s], of which `h` \[s] were left, may grow by `factor` \[1]. Errors
    /// add up least where steps are of one size, so it is changed only where that pays.
    fn resize(&mut self, wish: f64, h: f64, factor: f64) {
        let is_whole = h >= 0.999 * wish;
        let grows = is_whole && factor >= GROWTH && wish < self.longest;
        self.size = if grows { (factor * h).min(self.longest) } else { wish };
        self.unchecked = 0;
        // A part of a step says nothing of a size that is to be found.
        let is_settled = !grows && (is_whole || self.is_given());
        self.every = if is_settled { self.every.saturating_mul(2).clamp(1, EVERY) } else { 0 };
        self.h = self.size;
    }
}
