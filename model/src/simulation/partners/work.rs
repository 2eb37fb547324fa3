//! What a coupling does wrong: the work of the loads that acted over a communication step, beside that of the partner's answers.

use super::{Exchanges, POINTS};
use crate::effects::partner::{LOADS, Loads, Shown};
use crate::effects::{Acting, Law};
use crate::stored::stored;
use nalgebra::SVector;

/// Work at a port over the last communication steps, of which each counts a little less than the one after it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Work {
    /// What acts from the last exchange on, as coefficients of the powers of the time since then: inputs alone, without a law.
    acting: Acting,
    /// What loads did over the last communication steps, the latest first \[J].
    done: SVector<f64, POINTS>,
    /// By how much that was more than the answers would have done, and how much went through \[J].
    excess: f64,
    exchanged: f64,
    /// Over how many steps.
    steps: u32,
    /// Whether a law was in force.
    has_law: bool,
    /// Where the last step ended that was done again.
    redone: Option<End>,
}

stored!(Work { acting, done, excess, exchanged, steps, has_law, redone });

/// Where a step ends that was done again.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct End {
    /// \[s]
    pub t: f64,
    /// Place and motion.
    pub at: Shown,
    /// What the partner answers to that.
    pub answer: Loads,
}

stored!(End { t, at, answer });

/// A step counts by this part of the one after it \[1].
const FADES: f64 = 0.99;

/// Minimum number of steps.
const LASTING: u32 = 8;

/// Gauss's nodes and weights over a step, exact for the power of a parabola in force and velocity.
const NODES: [[f64; 2]; 3] =
    [[0.112_701_665_379_258_3, 5.0 / 18.0], [0.5, 4.0 / 9.0], [0.887_298_334_620_741_7, 5.0 / 18.0]];

impl Work {
    /// What the inputs are from the last exchange on.
    pub fn begin(&mut self, acting: Acting) {
        self.acting = acting;
    }

    /// Of a partner that is another from here on.
    pub fn forget(&mut self) {
        *self = Self { acting: self.acting, done: self.done, redone: self.redone, ..Self::default() };
    }

    /// A law is in force: what held loads did before the first one is past.
    pub fn follow_law(&mut self) {
        if !self.has_law {
            self.forget();
            self.has_law = true;
        }
    }

    /// Counts the communication step that ends with the latest of these exchanges, under this law; the measures of `loads`, which
    /// answer what was shown `lag` steps before, with what the partner was `late` steps before. Returns by how much loads did more than the
    /// answers would have done in the last step of which that is known, and how much went through \[J].
    pub fn count(&mut self, exchanges: &Exchanges, law: &Law, loads: &Loads, [lag, late]: [usize; 2]) -> [f64; 2] {
        let over = |from: usize, power: &dyn Fn(f64, &Path) -> f64| exchanges.path(from).work(power);
        // eq. 126: ∫ f·v dt, f = Σ f_n s^n + J (x − x_s)
        let acting = |part: f64, path: &Path| {
            let s = part * path.step;
            let mut force = after(&self.acting, s);
            if law.is_on {
                force += law.change(law.since + s, path.at(part));
            }
            force.dot(&path.velocity(part))
        };
        let done = over(0, &acting);
        let all = &mut self.done;
        all.as_mut_slice().rotate_right(1);
        all[0] = done;
        if exchanges.known < lag + 2 {
            return [0.0; 2];
        }
        // The answer to where the place was, if it was shown ahead
        let [to, from] = [0, 1].map(|n| {
            exchanges.loads[n].component_div(loads) + law.slopes * (exchanges.at(n + late) - exchanges.shown[n + lag])
        });
        let answered = |part: f64, path: &Path| {
            let mut force = from + (to - from) * part;
            if law.is_on {
                force += law.slopes * (path.at(part) - path.from - (path.to - path.from) * part);
            }
            force.dot(&path.velocity(part))
        };
        // eq. 126: ΔW = ∫ (f − a)·v dt
        let excess = self.done[late] - over(late, &answered);
        let exchanged = over(late, &|part, path| answered(part, path).abs());
        [excess, exchanged]
    }

    /// Counts the step up to this end, which was done again under these inputs from there on: by how much they did more than the answers
    /// would have done, and how much went through \[J].
    pub fn redo(&mut self, end: End, acting: &Acting) -> [f64; 2] {
        let Some(from) = self.redone.replace(end).filter(|from| end.t > from.t) else { return [0.0; 2] };
        let path = Path { from: from.at, to: end.at, step: end.t - from.t };
        let answered =
            |part: f64, path: &Path| (from.answer + (end.answer - from.answer) * part).dot(&path.velocity(part));
        // eq. 126: ΔW = ∫ (f − a)·v dt
        let excess = |part: f64, path: &Path| {
            after(acting, (part - 1.0) * path.step).dot(&path.velocity(part)) - answered(part, path)
        };
        [path.work(&excess), path.work(&|part, path| answered(part, path).abs())]
    }

    /// Whether steps are done again.
    pub fn is_redone(&self) -> bool {
        self.redone.is_some()
    }

    /// Adds a step that was counted.
    pub fn sum(&mut self, excess: f64, exchanged: f64) {
        (self.excess, self.exchanged) = (FADES * self.excess + excess, FADES * self.exchanged + exchanged);
        self.steps += 1;
    }

    /// The part by which the coupling does too much or too little work, of what goes through \[1]; 0 where that is not known yet.
    pub fn wrong(&self) -> f64 {
        let known = self.steps >= LASTING && self.exchanged > 0.0;
        if known { (self.excess / self.exchanged).abs() } else { 0.0 }
    }
}

/// What inputs are after this time \[s].
fn after([value, rate, bend, third]: &Acting, s: f64) -> Loads {
    value + (rate + (bend + third * s) * s) * s
}

/// The way from one exchange to the next.
pub(super) struct Path {
    pub from: Shown,
    pub to: Shown,
    pub step: f64,
}

impl Path {
    /// The work of a power over it \[J].
    fn work(&self, power: &dyn Fn(f64, &Self) -> f64) -> f64 {
        NODES.iter().map(|[part, weight]| weight * self.step * power(*part, self)).sum()
    }

    /// Place and motion after this part of it: Hermite's cubic.
    fn at(&self, part: f64) -> Shown {
        let mut at = Shown::zeros();
        let (rest, velocity) = (1.0 - part, self.velocity(part));
        for n in 0..LOADS {
            let bend = rest * self.from[LOADS + n] - part * self.to[LOADS + n];
            let ends = (1.0 + 2.0 * part) * rest * rest * self.from[n] + part * part * (3.0 - 2.0 * part) * self.to[n];
            at[n] = ends + part * rest * self.step * bend;
            at[LOADS + n] = velocity[n];
        }
        at
    }

    /// Its velocity there.
    fn velocity(&self, part: f64) -> Loads {
        Loads::from_fn(|n, _| {
            let [v0, v1] = [self.from[LOADS + n], self.to[LOADS + n]];
            let mean = (self.to[n] - self.from[n]) / self.step;
            6.0 * part * (1.0 - part) * mean + (1.0 - part) * (1.0 - 3.0 * part) * v0 + part * (3.0 * part - 2.0) * v1
        })
    }
}
