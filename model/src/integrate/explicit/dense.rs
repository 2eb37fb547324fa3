//! The state between the ends of the last step.

use super::Explicit;
use crate::integrate::System;
use crate::integrate::segment::Segment;
use crate::integrate::sizes::{MOST_GROUPS, largest_square};
use crate::integrate::tableau::{Dop853, Dopri5, Pair};

/// A step whose polynomial ends in a term of so many tolerances is of no use between its ends: one that spans many turns of a
/// motion too small to matter there. In sound steps that term is 3 to 30.
const ROUGH: f64 = 100.0;

/// So many evaluations are spent on one state within a step.
const MOST: f64 = 1e5;

impl<const N: usize> Explicit<N> {
    /// The state at a time `t` \[s] within the last step.
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
        let Segment { t: start, y, sizes, .. } = self.segment;
        let mut again = Self { sizes, ..Self::start(self.tableau, self.tolerance, system, start, y) };
        while again.t < t {
            if again.step(system, MOST, t).is_err() {
                // The step as a whole was possible, so what stands in the way of its parts is not worth a word.
                return self.segment.at(t, self.terms());
            }
        }
        self.cost.evaluations += again.cost.evaluations;
        again.y
    }

    /// Prepares the last step for [`Explicit::dense`], which otherwise does so when first asked.
    pub fn prepare_dense(&mut self, system: &impl System<N>) {
        if self.segment.dense {
            return;
        }
        match (self.tableau == Dop853::TABLEAU, system.solves_all()) {
            (true, true) => self.prepare_dense_with::<Dop853, _, true>(system),
            (true, false) => self.prepare_dense_with::<Dop853, _, false>(system),
            (false, true) => self.prepare_dense_with::<Dopri5, _, true>(system),
            (false, false) => self.prepare_dense_with::<Dopri5, _, false>(system),
        }
        self.segment.dense = true;
        self.segment.rough = self.roughness(system) > ROUGH;
    }

    /// Whether the last step, prepared, is of no use between its ends.
    pub fn is_rough(&self) -> bool {
        self.segment.rough
    }

    /// The last term of the polynomial in the middle of the step, in units of the tolerance \[1].
    fn roughness(&self, system: &impl System<N>) -> f64 {
        let Segment { t, h, y, r, .. } = &self.segment;
        let terms = self.terms();
        let weights = self.sizes.weights(system, &self.tolerance, &system.roundings(y, *h), &[0.0; MOST_GROUPS]);
        // eq. 24: σ and 1 − σ are 1/2 in each of its factors
        largest_square(system, &system.parts(*t, y, &r[terms - 1]), &weights).sqrt() / f64::from(1_u32 << terms)
    }

    /// How many terms the polynomial of eq. 24 has after y.
    fn terms(&self) -> usize {
        3 + self.tableau.dense.len()
    }

    /// [`Explicit::prepare_dense`] with the coefficients as constants.
    #[inline(never)]
    fn prepare_dense_with<P: Pair, F: System<N>, const ALL: bool>(&mut self, system: &F) {
        let (t, h, start) = (self.segment.t, self.segment.h, self.segment.y);
        let mut newest = self.k[P::TABLEAU.last];
        macro_rules! stages {
            ($($i:literal)*) => {$(
                if P::TABLEAU.last < $i && $i < const { P::TABLEAU.count() } {
                    newest = self.stage::<_, ALL, false>(system, (t, h, &start), const { P::TABLEAU.stage($i) }, &newest);
                    self.k[$i] = newest;
                }
            )*};
        }
        // Called: they are few, and each step that is read takes them once.
        stages! { 13 14 15 }
        self.cost.evaluations += P::TABLEAU.dense_stages.len() as f64;
        let (first, last) = (self.k[0], self.k[P::TABLEAU.last]);
        let difference = self.segment.r[0];
        // eq. 24: r₃ = h k₁ − Δy, r₄ = 2Δy − h(k₁ + k_last)
        self.segment.r[1] = std::array::from_fn(|n| h * first[n] - difference[n]);
        self.segment.r[2] = std::array::from_fn(|n| 2.0 * difference[n] - h * (first[n] + last[n]));
        macro_rules! rows {
            ($($i:literal)*) => {$(
                if $i < P::TABLEAU.dense.len() {
                    self.segment.r[3 + $i] = self.combined::<F, ALL>(const { P::TABLEAU.row($i) }).map(|sum| h * sum);
                }
            )*};
        }
        rows! { 0 1 2 3 }
    }
}
