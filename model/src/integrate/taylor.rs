//! Taylor's series of the motion: as many terms and as long a step as the tolerance allows (Jorba and Zou, "A software package for the
//! numerical integration of ODEs by means of high-order Taylor methods", Experimental Mathematics 14, 2005). No allocation.

use super::lanes::{both, pair, pairs, put};
use super::power::power;
use super::sizes::{Sizes, Squares};
use super::{Cost, Fault, LEAST_FIRST, SHRUNK, System, Tolerance, end_of_step};
use crate::scalar::{Scalar, ulp};
use crate::stored::stored;
use std::ops::Range;
use wide::f64x2;

/// Of so many powers of time the coefficients are kept, beside that of power 0.
pub const MOST_ORDER: usize = 24;

/// Coefficients of the powers of time, of numbers from which the state follows; those of which the rate counts too come first, and
/// have one power more.
pub type Terms<const N: usize> = [[f64; N]; POWERS];

/// So many powers there are, with the one more.
pub const POWERS: usize = MOST_ORDER + 2;

/// Two numbers of each power.
pub type Powers = [f64x2; POWERS];

/// What a series starts with that the state has in another form, and so rounded.
pub type Seed = [f64; 7];

/// What a series of an axis and of θ/sin θ is made of. It is written before it is read, and so no part of
/// the method, nor of anything else that is copied or stored.
#[derive(Debug)]
pub struct Scratch {
    /// See the rotor's expansion for what stands where.
    pub axis: [Powers; 12],
    /// The same.
    pub lean: [Powers; 7],
}

impl Default for Scratch {
    /// Nothing yet.
    fn default() -> Self {
        const NONE: Powers = [f64x2::ZERO; POWERS];
        Self { axis: [NONE; 12], lean: [NONE; 7] }
    }
}

/// A system whose motion has a series.
pub trait Analytic<const N: usize>: System<N> {
    /// So many numbers there are, and of so many of them the rate is needed too.
    const NUMBERS: usize;
    /// See there.
    const RATED: usize;

    /// What a series that begins at `y` at time `t` \[s] is to start with.
    fn seed(&self, t: f64, y: &[f64; N]) -> Seed;

    /// The terms up to this order of the motion that is at `y` at time `t` \[s], within this room; how much of it was needed.
    fn expand(
        &self,
        start: (f64, &[f64; N], &Seed),
        order: usize,
        room: Room,
        scratch: &mut Scratch,
        terms: &mut Terms<N>,
    ) -> Room;

    /// So many levels are needed in a step of size `s` \[s] with these terms, so that less than this part of a change is left out \[1].
    fn levels(&self, terms: &[[f64; N]], s: f64, least: f64) -> u32;

    /// The state, of these numbers and their rates, and what the next series is to start with.
    fn state_of(&self, numbers: &[f64; N], rates: &[f64; N]) -> ([f64; N], Seed);

    /// The norm of what the term of this power adds to the state [1/s^power], squared, where the groups have these weights.
    fn term(&self, y: &[f64; N], terms: &Terms<N>, power: usize, weights: &Squares) -> f64;
}

/// What the products and functions in a series need.
#[derive(Clone, Copy, Debug)]
pub struct Room {
    /// Of so many series coefficients are kept.
    pub rows: u32,
    /// Functions of the tilt go by so many of its powers at least; 0 where there are none.
    pub levels: u32,
    /// So long \[s] the laws have a series.
    pub horizon: f64,
}

stored!(Room { rows, levels, horizon });

/// The method at work: where it stands, its last step as a polynomial, and what it spent.
#[derive(Clone, Copy, Debug)]
pub struct Taylor<const N: usize> {
    tolerance: Tolerance,
    sizes: Sizes<N>,
    cost: Cost,
    room: Room,
    /// So many powers the last expansion has; 0 where there is none yet.
    order: u32,
    /// The time reached \[s], the state there and its rate, and what the last series left.
    t: f64,
    y: [f64; N],
    rate: [f64; N],
    seed: Option<Seed>,
    /// Size of the next step \[s], and how long it may be.
    h: f64,
    limit: f64,
    /// Of the last step: where it began \[s], the state there, its terms, and how large the motion was.
    start: f64,
    y_start: [f64; N],
    terms: Terms<N>,
    sizes_start: Sizes<N>,
}

stored!(Taylor<const N: usize> {
    tolerance, sizes, cost, room, order, t, y, rate, seed, h, limit, start, y_start, terms, sizes_start
});

/// How long a step may be.
#[derive(Clone, Copy)]
struct Wish {
    /// It itself \[s].
    size: f64,
    /// So long \[s] that the last term would be what it may be.
    last: f64,
    /// By so much terms fall from one power to the next, in a step of 1 s \[1/s].
    fall: f64,
}

impl Wish {
    /// Whether the coefficients were too large for numbers, or their squares, as those of a motion that is too fast.
    fn overflows(&self) -> bool {
        self.size.is_nan() || self.size == 0.0
    }
}

/// The last terms may be this part s of the tolerance: long steps err in the same direction, one after the other \[1].
const SAFETY: f64 = 0.1;

/// A refused step is tried again with this part of it.
const REFUSED: f64 = 0.6;

/// A step is at most so many times as long as the last.
const GREATEST: f64 = 6.0;

/// A short step needs so many powers at least.
const LEAST_ORDER: usize = 6;

/// Terms fall by this from one power to the next at least, seen over [`APART`] powers, or something that is still below the tolerance
/// has no series for so long a step \[1].
const FALL: f64 = 0.5;
const APART: usize = 4;

/// Terms may be so many times as large as they are foreseen, or a step must be shortened \[1].
const MARGIN: f64 = 10.0;

/// A series that lasts for less than this part of a step is not worth its while \[1].
const HELD: f64 = 0.2;

/// Levels beyond this part of the tolerance are not seen \[1].
const UNSEEN: f64 = 1e-2;

/// A polynomial of order p stays within 1 in modulus, as the exponential function, about so many times p from 0, on the imaginary axis and
/// left of it \[rad]: 6.3, 9.5 and 10.3 of 14, 22 and 24.
const STABLE: f64 = 0.43;

/// The first is at most so long \[s].
const LONGEST_FIRST: f64 = 1.0;

impl<const N: usize> Taylor<N> {
    /// Starts at time `t` \[s] and state `y`.
    pub fn start(tolerance: Tolerance, system: &impl Analytic<N>, t: f64, y: [f64; N]) -> Self {
        let mut method = Self { tolerance, t, y, start: t, y_start: y, h: LONGEST_FIRST / GREATEST, ..Self::blank() };
        method.rate = method.evaluate(system, t, &y);
        method.sizes = Sizes::at_start(&tolerance, system, &y, &method.rate);
        method.sizes_start = method.sizes;
        method
    }

    /// Nothing yet: a place for what was stored.
    pub fn blank() -> Self {
        Self {
            tolerance: Tolerance::default(),
            sizes: Sizes::blank(),
            cost: Cost::default(),
            room: Room { rows: 0, levels: 0, horizon: f64::INFINITY },
            order: 0,
            t: 0.0,
            y: [0.0; N],
            rate: [0.0; N],
            seed: None,
            h: 0.0,
            limit: f64::INFINITY,
            start: 0.0,
            y_start: [0.0; N],
            terms: [[0.0; N]; POWERS],
            sizes_start: Sizes::blank(),
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

    /// Its rate there.
    pub fn rate(&self) -> &[f64; N] {
        &self.rate
    }

    /// Where the last step began \[s].
    pub fn start_time(&self) -> f64 {
        self.start
    }

    /// The state where the last step began.
    pub fn start_state(&self) -> &[f64; N] {
        &self.y_start
    }

    /// The next step will be no longer than this \[s].
    pub fn limit_step(&mut self, h: f64) {
        self.limit = self.limit.min(h);
    }

    /// The next step is not known before its series is: it may be of any size \[s], unless it is limited.
    pub fn next_step(&self) -> f64 {
        self.limit
    }

    /// Steps may span so much of the phase of what dies out or swings \[rad], or it grows.
    pub fn stable(&self) -> f64 {
        STABLE * order(&self.tolerance) as f64
    }

    /// Goes back to a time `t` \[s] within the last step, where the state is `y`.
    pub fn go_back(&mut self, system: &impl Analytic<N>, t: f64, y: [f64; N]) {
        let is_within = t < self.t;
        let share = (t - self.start) / (self.t - self.start);
        self.t = t;
        self.go_on_from(system, y);
        if is_within {
            // The sizes of what lies ahead are forgotten.
            self.sizes = self.sizes_start;
            self.sizes.take(system, &self.sizes.seen(system, &y, &self.rate), share);
        }
    }

    /// Goes on from another description `y` of the state reached, or under another law.
    pub fn go_on_from(&mut self, system: &impl Analytic<N>, y: [f64; N]) {
        (self.y, self.seed) = (y, None);
        self.rate = self.evaluate(system, self.t, &y);
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

    /// The same in place of another method at the same state, with its sizes and its cost, and after a step of `h` \[s].
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
    /// evaluations, other work counted as such; false where the laws have a series for too short a time. Where no step is possible, the method stands where it
    /// stood, and its last step is forgotten.
    pub fn step(
        &mut self,
        system: &impl Analytic<N>,
        scratch: &mut Scratch,
        most: f64,
        until: f64,
    ) -> Result<bool, Fault> {
        // The terms of the last step go: it ends where it began.
        (self.start, self.y_start, self.sizes_start) = (self.t, self.y, self.sizes);
        let (wish, first) = self.expand(system, scratch, until - self.t);
        if wish.overflows() || self.room.horizon < HELD * first {
            return Ok(false);
        }
        let first = first.min(self.room.horizon);
        let (mut h, mut obstacle) = (first, None);
        loop {
            let advances = self.t + 0.1 * h > self.t && h > SHRUNK * first;
            if !advances || self.cost.work() > most {
                return Err(Fault::of_no_step(self.t, advances, obstacle));
            }
            let end = end_of_step(self.t, h, until);
            let (y, seed) = self.after(system, end - self.t);
            obstacle = match system.admits(end, &y) {
                _ if !y.iter().all(|y| y.is_finite()) => Some(Fault::NotFinite { t: self.t }),
                Err(reason) => Some(Fault::Refused { t: self.t, reason }),
                Ok(()) => {
                    // What was refused ahead keeps the next step short.
                    let size = if obstacle.is_some() { h } else { wish.size };
                    self.accept(system, end, (y, seed), h, Wish { size, ..wish });
                    return Ok(true);
                }
            };
            self.cost.rejected += 1.0;
            h *= REFUSED;
        }
    }

    /// The terms from here on, made again until there was room for all: so long a step may be, and so long \[s] the next is at most.
    fn expand<A: Analytic<N>>(&mut self, system: &A, scratch: &mut Scratch, left: f64) -> (Wish, f64) {
        let order = self.order_within(left);
        let seed = self.seed.unwrap_or_else(|| system.seed(self.t, &self.y));
        loop {
            let had = self.room;
            let start = (self.t, &self.y, &seed);
            self.room = system.expand(start, order, had, scratch, &mut self.terms);
            self.cost.evaluations += order as f64;
            // A longer series may have left more of them.
            self.terms[order + 1][A::RATED..].fill(0.0);
            if self.room.rows > had.rows {
                self.room.levels = had.levels;
                continue;
            }
            self.order = order as u32;
            let wish = self.longest_step(system, order);
            let first = wish.size.max(LEAST_FIRST * ulp(self.t)).min(GREATEST * self.h).min(self.limit);
            if self.room.levels > 0 {
                self.room.levels = system.levels(&self.terms[..=order], first, UNSEEN * self.tolerance.relative);
            }
            if self.room.levels <= had.levels || wish.overflows() {
                return (wish, first);
            }
        }
    }

    /// The state at a time `t` \[s] within the last step.
    pub fn dense(&self, system: &impl Analytic<N>, t: f64) -> [f64; N] {
        if t == self.start { self.y_start } else { self.after(system, t - self.start).0 }
    }

    fn evaluate(&mut self, system: &impl System<N>, t: f64, y: &[f64; N]) -> [f64; N] {
        self.cost.evaluations += 1.0;
        system.rates_of_all(t, y)
    }

    /// The state a time `s` \[s] after the start of the last step, and what a series from there is to start with.
    fn after(&self, system: &impl Analytic<N>, s: f64) -> ([f64; N], Seed) {
        state_after(system, &self.terms, self.last_order(), s)
    }

    /// So many powers the last expansion has: what was stored may have been altered.
    fn last_order(&self) -> usize {
        (self.order as usize).min(MOST_ORDER)
    }

    /// Of how many terms a step that is at most `left` \[s] long needs no more, as far as the last one tells.
    fn order_within(&self, left: f64) -> usize {
        let (most, last, h) = (order(&self.tolerance), self.last_order(), left.min(self.limit));
        if last == 0 || h >= self.h {
            return most;
        }
        // eq. 109: terms as those of an exponential function, ‖y_n‖ = (v h)ⁿ/(n! s rtol), of which the last one was 1
        let tolerance = SAFETY * self.tolerance.relative;
        let reach = power(FACTORIALS[last] * tolerance, 1.0 / last as f64) * (h / self.h);
        let mut term = MARGIN / tolerance;
        for n in 1..most {
            term *= reach / n as f64;
            if term <= 1.0 {
                return (n + 1).max(LEAST_ORDER);
            }
        }
        most
    }

    /// So long that neither of the last two terms is beyond its part of the tolerance, and that terms fall.
    fn longest_step(&self, system: &impl Analytic<N>, order: usize) -> Wish {
        let seen = self.sizes.seen(system, &self.y, &self.rate);
        let weights = self.sizes.weights(system, &self.tolerance, &system.roundings(&self.y, self.h), &seen);
        let square = |n: usize| system.term(&self.y, &self.terms, n, &weights) / (SAFETY * SAFETY);
        // eq. 107: h = min (s/‖y_n‖)^(1/n), n = p − 1, p
        let [a, b] = [order - 1, order].map(|n| power(square(n), -0.5 / n as f64));
        // Not `min`, which passes over what is not a number.
        let size = if a < b { a } else { b };
        // eq. 110: q⁴ = max ‖y_n‖ hⁿ/max ‖y_m‖ hᵐ, m = n − 4, where the larger of the last two is 1
        let [a, b] = [order - 1 - APART, order - APART].map(|m| square(m) * Scalar::powi(size * size, m as i32));
        let fall =
            if size < f64::INFINITY { power(if a > b { a } else { b }, -0.5 / APART as f64) / size } else { 0.0 };
        Wish { size: if size * fall > FALL { FALL / fall } else { size }, last: size, fall }
    }

    fn accept(&mut self, system: &impl Analytic<N>, end: f64, (y, seed): ([f64; N], Seed), h: f64, wish: Wish) {
        let step = end - self.t;
        (self.t, self.y, self.seed, self.limit) = (end, y, Some(seed), f64::INFINITY);
        self.rate = self.evaluate(system, end, &y);
        let seen = self.sizes.seen(system, &y, &self.rate);
        self.sizes.take(system, &seen, step / h);
        // What is cut short says little about the steps that may follow.
        self.h = if wish.size.is_finite() { wish.size } else { h };
        self.cost.steps += 1.0;
        // eq. 111: the terms that are left out as a geometric series
        let ratio = (wish.fall * step).min(FALL);
        self.cost.error_estimate += SAFETY * Scalar::powi(step / wish.last, self.order as i32) * ratio / (1.0 - ratio);
    }
}

/// Of how many terms a tolerance is reached soonest: measured, and flat. What a step costs beside its terms makes it more than Jorba
/// and Zou count.
fn order(tolerance: &Tolerance) -> usize {
    match tolerance.relative {
        loose if loose >= 1e-3 => 14,
        usual if usual >= 1e-9 => 22,
        _ => MOST_ORDER,
    }
}

/// n!
const FACTORIALS: [f64; MOST_ORDER + 1] = {
    let mut factorials = [1.0; MOST_ORDER + 1];
    let mut n = 1;
    while n <= MOST_ORDER {
        factorials[n] = factorials[n - 1] * n as f64;
        n += 1;
    }
    factorials
};

/// The state a time `s` \[s] after the start of the series, and what the next one is to start with.
#[inline(always)]
fn state_after<A: Analytic<N>, const N: usize>(system: &A, terms: &Terms<N>, order: usize, s: f64) -> ([f64; N], Seed) {
    let (mut changes, mut rate_changes) = ([both(0.0); N], [both(0.0); N]);
    let (changes, rate_changes) = (&mut changes[..pairs(A::NUMBERS)], &mut rate_changes[..pairs(A::RATED)]);
    let (mut power, s) = (both(s), both(s));
    // These sums wait for no power, as those of Horner's scheme do; what is largest is added last.
    for (n, term) in terms[..=order + 1].iter().enumerate().skip(2) {
        let rated = power * both(n as f64);
        power *= s;
        rate_changes.iter_mut().enumerate().for_each(|(p, change)| *change += pair(term, p) * rated);
        changes.iter_mut().enumerate().for_each(|(p, change)| *change += pair(term, p) * power);
    }
    let (mut numbers, mut rates) = ([0.0; N], [0.0; N]);
    for (p, change) in changes.iter().enumerate() {
        put(&mut numbers, p, pair(&terms[0], p) + (pair(&terms[1], p) * s + *change));
    }
    for (p, change) in rate_changes.iter().enumerate() {
        put(&mut rates, p, pair(&terms[1], p) + *change);
    }
    system.state_of(&numbers, &rates)
}
