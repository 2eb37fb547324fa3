//! The stages of a step, their sums, and the error that they tell.

use super::{Attempt, Explicit};
use crate::integrate::System;
use crate::integrate::lanes::{both, nothing, pair, pairs, put};
use crate::integrate::sizes::{MOST_GROUPS, Squares, largest_square};
use crate::integrate::tableau::{Combination, Dop853, Dopri5, ErrorRule, Pair, Stage};

impl<const N: usize> Explicit<N> {
    /// All stages of a step of size h from (t, y), and the error where it is asked for.
    pub(super) fn attempt<const ERROR: bool>(&mut self, system: &impl System<N>) -> Attempt<N> {
        if self.tableau == Dop853::TABLEAU {
            self.attempt_by::<Dop853, _, ERROR>(system)
        } else {
            self.attempt_by::<Dopri5, _, ERROR>(system)
        }
    }

    fn attempt_by<P: Pair, F: System<N>, const ERROR: bool>(&mut self, system: &F) -> Attempt<N> {
        match (system.is_usual(), system.solves_all()) {
            (true, true) => self.attempt_with::<P, _, ERROR, true, true>(system),
            (true, false) => self.attempt_with::<P, _, ERROR, false, true>(system),
            // Its rates are called, and zero of what is not solved: it is compiled once.
            (false, _) => self.attempt_with::<P, _, ERROR, true, false>(system),
        }
    }

    /// [`Explicit::attempt`] with the coefficients as constants: every sum is written out by the compiler.
    #[inline(never)]
    fn attempt_with<P: Pair, F: System<N>, const ERROR: bool, const ALL: bool, const USUAL: bool>(
        &mut self,
        system: &F,
    ) -> Attempt<N> {
        let (t, h, start) = (self.t, self.h, self.y);
        let mut newest = self.k[0];
        macro_rules! stages {
            ($($i:literal)*) => {$(
                if $i < P::TABLEAU.last {
                    newest = self.stage::<_, ALL, USUAL>(system, (t, h, &start), const { P::TABLEAU.stage($i) }, &newest);
                    self.k[$i] = newest;
                }
            )*};
        }
        stages! { 1 2 3 4 5 6 7 8 9 10 11 12 }
        // The last stage stands at the end of the step.
        let y = self.ended::<F, ALL>(&start, h, const { P::TABLEAU.stage(P::TABLEAU.last) }.a);
        // Where the error does not need that stage, it is begun before it: the next step's size waits for it. The sizes of the
        // motion are then those of the stage before, which stands at the end of the step too.
        let mut attempt = Attempt { y, error: 0.0, seen: self.sizes.seen(system, &y, &newest) };
        let (early, late) =
            const { if P::TABLEAU.error.needs(P::TABLEAU.last) { (false, ERROR) } else { (ERROR, false) } };
        if early {
            attempt.error = self.error_norm::<P, F, ALL>(system, &attempt.seen);
        }
        self.k[P::TABLEAU.last] = system.rates::<ALL, USUAL>(t + h, &y);
        self.cost.evaluations += P::TABLEAU.last as f64;
        if late {
            attempt.error = self.error_norm::<P, F, ALL>(system, &attempt.seen);
        }
        attempt
    }

    /// A stage of a step of size h from (t, y), of those before it; `newest` is the last of them.
    #[inline(always)]
    pub(super) fn stage<F: System<N>, const ALL: bool, const USUAL: bool>(
        &self,
        system: &F,
        (t, h, y): (f64, f64, &[f64; N]),
        stage: &Stage,
        newest: &[f64; N],
    ) -> [f64; N] {
        let there = self.advanced::<F, USUAL>(y, h, stage.a, newest);
        // eq. 21: k_i = f(t + c_i h, y + h Σ a_ij k_j)
        system.rates::<ALL, USUAL>(t + stage.c * h, &there)
    }

    /// y + h Σ b_j k_j as y + h (k₁ + Σ b_j (k_j − k₁)), which is the same because Σ b_j = 1. The sum of the rounded b_j
    /// is not 1: a uniform rotation would run away from its angle by 3e-9 rad in 10⁶ turns.
    #[inline(always)]
    fn ended<F: System<N>, const ALL: bool>(&self, y: &[f64; N], h: f64, b: Combination) -> [f64; N] {
        let mut end = *y;
        for p in 0..pairs(solved::<F, N, ALL>()) {
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
    fn advanced<F: System<N>, const USUAL: bool>(
        &self,
        y: &[f64; N],
        h: f64,
        a: Combination,
        newest: &[f64; N],
    ) -> [f64; N] {
        let (&(_, last), older) = a.split_last().expect("a stage depends on those before it");
        let mut there = *y;
        for p in 0..pairs(if USUAL { F::USUALLY_DEPENDED_ON } else { F::DEPENDED_ON }) {
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
    pub(super) fn combined<F: System<N>, const ALL: bool>(&self, a: Combination) -> [f64; N] {
        let mut combined = [0.0; N];
        for p in 0..pairs(solved::<F, N, ALL>()) {
            let mut sum = nothing();
            for &(j, coefficient) in a {
                sum += both(coefficient) * pair(&self.k[j], p);
            }
            put(&mut combined, p, sum);
        }
        combined
    }

    /// The norm of the error of a step that ends where the sizes are `seen`, in units of the tolerance \[1].
    #[inline(always)]
    fn error_norm<P: Pair, F: System<N>, const ALL: bool>(&self, system: &F, seen: &Squares) -> f64 {
        // Laws as stiff as the longest step of late allows round a shorter one by less.
        let weights = self.weights(system, self.h.max(self.longest), seen);
        let parts = match const { &P::TABLEAU.error } {
            ErrorRule::Single(e) => self.error_parts::<F, ALL>(system, e),
            ErrorRule::Blend { fine, coarse } => {
                blended(system, self.error_parts::<F, ALL>(system, fine), self.error_parts::<F, ALL>(system, coarse))
            }
        };
        self.h * P::TABLEAU.calibration * largest_square(system, &parts, &weights).sqrt()
    }

    /// The parts of Σ e_j k_j, squared. Inlined, so that these sums are written out too.
    #[inline(always)]
    fn error_parts<F: System<N>, const ALL: bool>(&self, system: &F, e: Combination) -> Squares {
        system.parts(self.t, &self.y, &self.combined::<F, ALL>(e))
    }
}

/// f⁴/(f² + 0.01 c²), of a fine estimate f and a coarse one c, group by group: a group whose motion is a polynomial has no fine
/// estimate, and says nothing of the others.
#[inline(always)]
fn blended<F: System<N>, const N: usize>(_system: &F, fine: Squares, coarse: Squares) -> Squares {
    let mut blended = [0.0; MOST_GROUPS];
    for p in 0..pairs(F::GROUPS) {
        let (fine, coarse) = (pair(&fine, p), pair(&coarse, p));
        // Where both are 0, so is the error.
        put(&mut blended, p, fine * (fine / (both(0.01) * coarse + fine + both(f64::MIN_POSITIVE))));
    }
    blended
}

/// How many components are solved.
#[inline(always)]
const fn solved<F: System<N>, const N: usize, const ALL: bool>() -> usize {
    if ALL { N } else { F::ALWAYS }
}
