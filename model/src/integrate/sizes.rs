//! How large a motion is, group by group: an error is compared with the size of its own group, not with a size that somebody
//! thought of beforehand.

use super::System;
use super::lanes::{self, both, nothing, pair, pairs, put, sum};
use crate::stored::stored;
use std::ops::Range;

/// A system has at most so many groups.
pub const MOST_GROUPS: usize = 24;

/// The square of each group's norm, in the square of its unit: the first [`System::GROUPS`] count.
pub type Squares = [f64; MOST_GROUPS];

/// How small the error of a step must be.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Relative to the size of each group \[1].
    pub relative: f64,
    /// No error below this counts.
    pub absolute: Squares,
    /// What a group counts with at least, where nothing is known of its motion yet.
    pub nominal: Squares,
}

stored!(Tolerance { relative, absolute, nominal });

impl Default for Tolerance {
    fn default() -> Self {
        Self { relative: 0.0, absolute: [0.0; MOST_GROUPS], nominal: [0.0; MOST_GROUPS] }
    }
}

impl Tolerance {
    /// So many times as loose.
    pub fn times(self, factor: f64) -> Self {
        let absolute = self.absolute.map(|square| square * factor * factor);
        Self { relative: self.relative * factor, absolute, ..self }
    }
}

/// How large the motion was of late, and ever.
#[derive(Clone, Copy, Debug)]
pub struct Sizes<const N: usize> {
    /// The state from which excursions are counted.
    pub origin: [f64; N],
    /// Of late.
    recent: Squares,
    /// Ever.
    largest: Squares,
}

stored!(Sizes<const N: usize> { origin, recent, largest });

/// After a whole step so much is left of a size that is not reached again \[1].
const KEPT: f64 = 0.9;

/// A size is at least this part of the largest ever \[1]: what has died out need not be followed for ever.
pub const LEAST: f64 = 1e-3;

/// What rounding takes from a step, beside the numbers that go into it \[1].
const ROUNDING: f64 = 3e-16;

impl<const N: usize> Sizes<N> {
    /// Of a motion that begins at `y`, where its rate is `rate`.
    pub fn at_start(tolerance: &Tolerance, system: &impl System<N>, y: &[f64; N], rate: &[f64; N]) -> Self {
        let largest = larger_of(&tolerance.nominal, &system.sizes(y, rate, y));
        let recent = largest.map(|square| LEAST * LEAST * square);
        let mut sizes = Self { origin: *y, recent, largest };
        sizes.take(system, &system.sizes(y, rate, y), 0.0);
        sizes
    }

    /// Nothing yet: a place for what was stored.
    pub fn blank() -> Self {
        Self { origin: [0.0; N], recent: [0.0; MOST_GROUPS], largest: [0.0; MOST_GROUPS] }
    }

    /// From now on excursions of these components count from 0.
    pub fn recount(&mut self, components: Range<usize>) {
        self.origin[components].fill(0.0);
    }

    /// The sizes of the motion at `y`.
    #[inline(always)]
    pub fn seen(&self, system: &impl System<N>, y: &[f64; N], rate: &[f64; N]) -> Squares {
        system.sizes(y, rate, &self.origin)
    }

    /// Goes on to where the motion has the sizes `seen`, over this `share` of a whole step \[1].
    #[inline(always)]
    pub fn take<F: System<N>>(&mut self, _system: &F, seen: &Squares, share: f64) {
        // eq. 80, KEPT^share to first order
        let kept = 1.0 - (1.0 - KEPT * KEPT) * share;
        for p in 0..pairs(F::GROUPS) {
            let now = pair(seen, p);
            let largest = lanes::larger(now, pair(&self.largest, p));
            let least = largest * both(LEAST * LEAST);
            let recent = lanes::larger(lanes::larger(now, pair(&self.recent, p) * both(kept)), least);
            put(&mut self.largest, p, largest);
            put(&mut self.recent, p, recent);
        }
    }

    /// Becomes what these are, where it counts.
    #[inline(always)]
    pub fn copy<F: System<N>>(&mut self, _system: &F, other: &Self) {
        self.origin = other.origin;
        for p in 0..pairs(F::GROUPS) {
            put(&mut self.recent, p, pair(&other.recent, p));
            put(&mut self.largest, p, pair(&other.largest, p));
        }
    }

    /// What the square of one unit of each group's error counts in a step to where the sizes are `seen` that rounds numbers as large as
    /// `rounded`.
    #[inline(always)]
    pub fn weights<F: System<N>>(
        &self,
        _system: &F,
        tolerance: &Tolerance,
        rounded: &Squares,
        seen: &Squares,
    ) -> Squares {
        let mut weights = [0.0; MOST_GROUPS];
        for p in 0..pairs(F::GROUPS) {
            // eq. 22: sc = max(rtol·S, atol·n, ε·R)
            let size =
                lanes::larger(pair(seen, p), pair(&self.recent, p)) * both(tolerance.relative * tolerance.relative);
            let rounded = pair(rounded, p) * both(ROUNDING * ROUNDING);
            // What rounding does in a step without end may not be a number, and says nothing.
            let least = lanes::larger(size, pair(&tolerance.absolute, p)).max(rounded);
            // A load that does not act has no size, and no error.
            put(&mut weights, p, both(1.0) / lanes::larger(least, both(f64::MIN_POSITIVE)));
        }
        // The last pair may reach beyond the groups.
        if F::GROUPS < MOST_GROUPS {
            weights[F::GROUPS] = 0.0;
        }
        weights
    }
}

/// The largest of all groups' errors, whose squares are `parts`, squared \[1]; not a number where one is not.
#[inline(always)]
pub fn largest_square<F: System<N>, const N: usize>(_system: &F, parts: &Squares, weights: &Squares) -> f64 {
    let (mut most, mut all) = (both(0.0), nothing());
    for p in 0..pairs(F::GROUPS) {
        let weighed = pair(parts, p) * pair(weights, p);
        most = lanes::larger(weighed, most);
        all += weighed;
    }
    let [first, second] = most.to_array();
    // A maximum may pass over what is not a number; a sum does not.
    let most = larger(first, second);
    if sum(all).is_finite() { most } else { f64::NAN }
}

/// The squares of what rounding takes from numbers whose squares are `rounded`.
pub fn noise(rounded: &Squares) -> Squares {
    rounded.map(|square| square * (ROUNDING * ROUNDING))
}

fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The larger of two, group by group.
pub fn larger_of(a: &Squares, b: &Squares) -> Squares {
    std::array::from_fn(|group| larger(a[group], b[group]))
}
