//! `stiff`: Radau IIA of order 5 with adaptive steps and dense output. Its steps do not shrink with rates that are fast but
//! damped. Each step is an implicit equation, solved by Newton's method with the exact Jacobian. No allocation.

mod collocation;
pub mod lu;
pub mod radau;
pub mod spectrum;

use super::answer::Answer;
use super::control::Controller;
use super::power::power;
use super::sizes::{MOST_GROUPS, Sizes, Squares, larger_of, largest_square};
use super::{Cost, Fault, LEAST_FIRST, SHRUNK, System, Tolerance, end_of_step};
use crate::scalar::ulp;
use crate::stored::stored;
use collocation::Collocation;
use radau::{ERROR, STAGES, combined, weights};
use spectrum::spectral_radius;
use std::ops::Range;

/// A system that knows its derivatives.
pub trait Differentiable<const N: usize>: System<N> {
    /// ∂f/∂y at (t, y), by rows: row i is the gradient of f_i, 0 along the quadratures.
    fn jacobian(&self, t: f64, y: &[f64; N]) -> [[f64; N]; N];
}

/// The work of a factorisation, and of what is solved with it, is that of so many explicit evaluations: by callgrind `stiff_support` takes
/// 74 000 instructions for a step of some 21 evaluations, of 500 to 900 each.
const FACTORISATION: f64 = 100.0;

/// The method at work: where it stands, its last step, and what it spent.
#[derive(Clone, Copy, Debug)]
pub struct Stiff<const N: usize> {
    /// Of the error estimate, which is of order 3.
    tolerance: Tolerance,
    sizes: Sizes<N>,
    /// Of what Newton's method leaves.
    newton: Tolerance,
    /// Of a step's own error.
    local: Tolerance,
    controller: Controller,
    cost: Cost,
    /// The time reached \[s], the state there and its rate.
    t: f64,
    y: [f64; N],
    rate: [f64; N],
    /// Size of the next step \[s].
    h: f64,
    /// Iterations of Newton's method in the last attempt.
    iterations: u32,
    /// Whether the last step ended where the next one begins, so that its polynomial extrapolates it.
    smooth: bool,
    segment: Segment<N>,
}

stored!(Stiff<const N: usize> { tolerance, sizes, newton, local, controller, cost, t, y, rate, h, iterations, smooth, segment });

/// The last step.
#[derive(Clone, Copy, Debug)]
struct Segment<const N: usize> {
    /// Where it began \[s].
    t: f64,
    /// Its size \[s].
    h: f64,
    /// The state at its start, and the Jacobian that solved it.
    y: [f64; N],
    jacobian: [[f64; N]; N],
    /// How large the motion was there.
    sizes: Sizes<N>,
    /// z_i: what the state has gained at each stage.
    z: [[f64; N]; STAGES],
    answer: Answer<N>,
}

stored!(Segment<const N: usize> { t, h, y, jacobian, sizes, z, answer });

/// A refused step is tried again with this part of it, and so is one that Newton's method does not solve.
const REFUSED: f64 = 0.5;

/// The estimate's tolerance is this times the fourth fifth of the run's \[1]: measured, so that a tolerance means about what it does
/// with the other methods.
const LOOSER: f64 = 2.0;

/// A step may err by this times the sixth fifth of the run's tolerance in what goes on without damping \[1]: measured, so that 700 periods
/// of an undamped rotor in its springs err by less than 200 tolerances.
const ADDING_UP: f64 = 0.3;

/// What is left of an error after so many steps more goes on without damping, and so does, from half of them on, what one step leaves
/// this part of \[1]. Springs so fast that the method damps them (five radians a step) are no matter then.
const GO_ON: u32 = 8;
const LASTS: f64 = 0.97;

/// Newton's method stops where what is left is this part of the run's tolerance \[1].
const PRECISION: f64 = 0.1;

/// A first step is no longer than this \[s].
const LONGEST_FIRST: f64 = 1e-2;

/// Under a new law the first step spans no more than this of the fastest motion's phase \[rad].
const FRESH: f64 = 0.5;

/// Its equations round about so many sums one after another.
const SUMS: f64 = 10.0;

/// The last step extrapolates the next one as long as that is at most so many times longer \[1].
const EXTRAPOLATED: f64 = 10.0;

/// A state within a step for which Newton's method does not converge is sought in so many shorter steps.
const PARTS: [u32; 3] = [2, 4, 8];

/// Newton's method gives up after so many iterations.
const MOST_ITERATIONS: u32 = 10;

/// After a step that took more, the next one does not grow: its equations would not be solved.
const FEW_ITERATIONS: u32 = 4;

impl<const N: usize> Stiff<N> {
    /// Starts at time `t` \[s] and state `y`.
    pub fn start(tolerance: Tolerance, system: &impl System<N>, t: f64, y: [f64; N]) -> Self {
        // The estimate falls with h⁴, the error of a step with h⁶ and that of a run with h⁵: what the first two call c tol^(4/5) and
        // c tol^(6/5), the last one keeps to tol.
        let fifth = power(tolerance.relative, 0.2);
        let within = tolerance.times(LOOSER / fifth);
        let mut method = Self {
            tolerance: within,
            newton: tolerance.times(PRECISION),
            local: tolerance.times(ADDING_UP * fifth),
            t,
            y,
            segment: Segment { t, y, ..Segment::blank() },
            ..Self::blank()
        };
        method.go_on_from(system, y);
        method.sizes = Sizes::at_start(&within, system, &y, &method.rate);
        method.segment.sizes = method.sizes;
        // In which some size changes by a hundredth; what is too long is rejected.
        let weights = method.weights(system, f64::INFINITY, &method.sizes.seen(system, &y, &method.rate));
        let speed = largest_square(system, &system.parts(t, &y, &method.rate), &weights).sqrt();
        method.h = (0.01 / (within.relative * speed)).min(LONGEST_FIRST).max(LEAST_FIRST * ulp(t));
        method
    }

    /// Nothing yet: a place for what was stored.
    pub fn blank() -> Self {
        Self {
            tolerance: Tolerance::default(),
            sizes: Sizes::blank(),
            newton: Tolerance::default(),
            local: Tolerance::default(),
            controller: Controller::new(4.0),
            cost: Cost::default(),
            t: 0.0,
            y: [0.0; N],
            rate: [0.0; N],
            h: 0.0,
            iterations: 0,
            smooth: false,
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

    /// Its rate there.
    pub fn rate(&self) -> &[f64; N] {
        &self.rate
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
            self.sizes.take(system, &sizes.seen(system, &y, &self.rate), (t - start) / h);
        }
    }

    /// Goes on from another description `y` of the state reached.
    pub fn go_on_from(&mut self, system: &impl System<N>, y: [f64; N]) {
        self.y = y;
        self.rate = self.evaluate(system, self.t, &y);
        self.smooth = false;
    }

    /// Goes on under another law, whose fastest motion may be one that the last step knew nothing of: a long step would take it for what
    /// has died out, and a hard ring would catch what it must throw back.
    pub fn go_on_under(&mut self, system: &impl Differentiable<N>, y: [f64; N]) {
        self.go_on_from(system, y);
        let rate = spectral_radius(&system.jacobian(self.t, &y), system.depended_on());
        self.cost.evaluations += system.differentiated() as f64;
        if rate > 0.0 {
            self.limit_step(FRESH / rate);
        }
    }

    /// Replaces a component of the state on which the rates do not depend.
    pub fn replace(&mut self, component: usize, value: f64) {
        self.y[component] = value;
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

    /// What the run has cost so far. A matrix of derivatives counts as one evaluation for each of its columns.
    pub fn cost(&self) -> Cost {
        Cost { next_step: self.h, ..self.cost }
    }

    /// So much was spent until now.
    pub fn charge(&mut self, spent: Cost) {
        self.cost.charge(spent);
    }

    /// One step forward of the method's own choice, but not past time `until` \[s], while the run has taken at most `most`
    /// evaluations, other work counted as such. Where none is possible, the method stands as before.
    pub fn step(&mut self, system: &impl Differentiable<N>, most: f64, until: f64) -> Result<(), Fault> {
        if !self.rate.iter().all(|rate| rate.is_finite()) {
            return Err(Fault::NotFinite { t: self.t });
        }
        let before = self.h;
        let mut obstacle = None;
        loop {
            // A step that is not a number does not advance the time either.
            let advances = self.t + 0.1 * self.h > self.t && self.h > SHRUNK * before;
            if !advances || self.cost.work() > most {
                self.h = before;
                return Err(Fault::of_no_step(self.t, advances, obstacle));
            }
            let wish = self.h;
            let end = end_of_step(self.t, self.h, until);
            // The step that the rounded times really span, or 10⁷ of them would drift from the time that they claim.
            self.h = end - self.t;
            // Anew for each try: where a step that was far too long seemed to go, it does not.
            let jacobian = self.differentiate(system);
            let Attempt { z, error, rate, seen } = self.attempt(system, end, &jacobian);
            let y = self.ended(&z);
            let mut least_factor = REFUSED;
            obstacle = if !error.is_finite() {
                Some(Fault::NotFinite { t: self.t })
            } else if error > 1.0 {
                least_factor = 0.0;
                None
            } else if let Err(reason) = system.admits(end, &y) {
                Some(Fault::Refused { t: self.t, reason })
            } else {
                let share = if self.h < 0.999 * wish { self.h / wish } else { 1.0 };
                self.accept(system, end, jacobian, Attempt { z, error, rate, seen }, share);
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
    pub fn fixed_step(&mut self, system: &impl Differentiable<N>, h: f64) {
        self.h = h;
        let jacobian = self.differentiate(system);
        let attempt = self.attempt(system, self.t + h, &jacobian);
        self.accept(system, self.t + h, jacobian, Attempt { error: 0.0, ..attempt }, 1.0);
        self.h = h;
    }

    /// The state at a time `t` \[s] within the last step: that of a shorter step from the same start, which the polynomial of
    /// collocation, of order 3 only, extrapolates.
    pub fn dense(&mut self, system: &impl System<N>, t: f64) -> [f64; N] {
        let Segment { t: start, h, y, jacobian, z, answer, .. } = self.segment;
        if let Some(answer) = answer.at(t) {
            return answer;
        }
        if t == start || h == 0.0 {
            return y;
        }
        let sigma = (t - start) / h;
        let guess = radau::C.map(|c| combined(&weights(c * sigma), &z));
        let last = |y: &[f64; N], z: &[[f64; N]; STAGES]| std::array::from_fn(|n| y[n] + z[STAGES - 1][n]);
        let collocation = self.factorised(system, &jacobian, t - start);
        let whole = self.solve(system, start, y, &collocation, guess).map(|z| last(&y, &z));
        // Where Newton's method does not get there in one step, shorter ones do; the polynomial of the step is the last resort.
        let answer = whole.or_else(|| {
            PARTS.into_iter().find_map(|parts| {
                let size = (t - start) / f64::from(parts);
                let collocation = self.factorised(system, &jacobian, size);
                (0..parts).try_fold(y, |y, n| {
                    let z = self.solve(system, start + f64::from(n) * size, y, &collocation, [[0.0; N]; STAGES])?;
                    Some(last(&y, &z))
                })
            })
        });
        self.segment.answer.keep(t, answer.unwrap_or_else(|| last(&y, &guess)))
    }

    fn evaluate(&mut self, system: &impl System<N>, t: f64, y: &[f64; N]) -> [f64; N] {
        self.cost.evaluations += 1.0;
        system.rates_of_all(t, y)
    }

    /// The equations of a step of size `h` \[s], factorised.
    fn factorised<'j>(&mut self, system: &impl System<N>, jacobian: &'j [[f64; N]; N], h: f64) -> Collocation<'j, N> {
        self.cost.besides += FACTORISATION;
        Collocation::new(jacobian, h, system.depended_on())
    }

    /// The Jacobian for a step of size h.
    fn differentiate(&mut self, system: &impl Differentiable<N>) -> [[f64; N]; N] {
        self.cost.evaluations += system.differentiated() as f64;
        // In the middle of the step, where the method is going: there it serves all stages.
        let ahead = self.extrapolated_at(0.5);
        system.jacobian(self.t + 0.5 * self.h, &std::array::from_fn(|n| self.y[n] + ahead[n]))
    }

    /// A step of size h from where the method stands to time `end` \[s].
    fn attempt(&mut self, system: &impl Differentiable<N>, end: f64, jacobian: &[[f64; N]; N]) -> Attempt<N> {
        let collocation = self.factorised(system, jacobian, self.h);
        let guess = self.extrapolated();
        let Some(z) = self.solve(system, self.t, self.y, &collocation, guess) else {
            return Attempt { z: guess, error: f64::NAN, rate: self.rate, seen: [0.0; MOST_GROUPS] };
        };
        let y = self.ended(&z);
        let rate = self.evaluate(system, end, &y);
        let seen = self.sizes.seen(system, &y, &rate);
        let mut error = self.error_norm(system, &collocation, &z, &seen);
        if !self.smooth && error <= 1.0 {
            // What has jumped may leave what is stiff where the step begins, as a shaft that begins to slide on its ring does: a step that
            // holds it there must not seem right by the derivatives there.
            let jacobian = system.jacobian(end, &y);
            self.cost.evaluations += system.differentiated() as f64;
            let there = self.factorised(system, &jacobian, self.h);
            let seen_there = self.error_norm(system, &there, &z, &seen);
            // Not `max`, which passes over what is not a number.
            error = if seen_there <= error { error } else { seen_there };
        }
        Attempt { z, error, rate, seen }
    }

    /// What each group's error counts in a step of size `h` \[s] that ends where the sizes are `seen`.
    fn weights(&self, system: &impl System<N>, h: f64, seen: &Squares) -> Squares {
        self.sizes.weights(system, &self.tolerance, &system.roundings(&self.y, h), seen)
    }

    /// The stages that the polynomial of the last step leads to.
    fn extrapolated(&self) -> [[f64; N]; STAGES] {
        radau::C.map(|c| self.extrapolated_at(c))
    }

    /// What the state gains on the first part `sigma` of a step, by the polynomial of the last one.
    fn extrapolated_at(&self, sigma: f64) -> [f64; N] {
        let Segment { h, z, .. } = &self.segment;
        if !self.smooth || self.h > EXTRAPOLATED * h {
            return [0.0; N];
        }
        let ahead = combined(&weights(1.0 + sigma * self.h / h), z);
        std::array::from_fn(|n| ahead[n] - z[STAGES - 1][n])
    }

    /// Newton's method for the stages of a step from (t, y); None where it does not converge.
    fn solve(
        &mut self,
        system: &impl System<N>,
        t: f64,
        y: [f64; N],
        collocation: &Collocation<N>,
        guess: [[f64; N]; STAGES],
    ) -> Option<[[f64; N]; STAGES]> {
        let (mut z, mut before) = (guess, f64::INFINITY);
        let mut w = collocation.transformed(&z);
        for iteration in 0..MOST_ITERATIONS {
            self.iterations = iteration + 1;
            let mut rates = [[0.0; N]; STAGES];
            // eq. 42: z_i = h Σ a_ij f(t + c_j h, y + z_j)
            for i in 0..STAGES {
                let at = std::array::from_fn(|n| y[n] + z[i][n]);
                rates[i] = self.evaluate(system, t + radau::C[i] * collocation.h, &at);
            }
            // What rounds is as large as the larger end.
            let end = std::array::from_fn(|n| y[n] + z[STAGES - 1][n]);
            let [from, to] = [y, end].map(|y| system.roundings(&y, collocation.h));
            let rounded = larger_of(&from, &to).map(|square| square * SUMS * SUMS);
            // As large as the motion was of late: a stage that is still wrong may be of any size.
            let weights = self.sizes.weights(system, &self.newton, &rounded, &[0.0; MOST_GROUPS]);
            let change = collocation.newton(&rates, &w);
            for i in 0..STAGES {
                for n in 0..N {
                    w[i][n] += change[i][n];
                }
            }
            z = radau::T.map(|row| combined(&row, &w));
            let squares = change.map(|change| largest_square(system, &system.parts(t, &y, &change), &weights));
            let now = (squares.iter().sum::<f64>() / STAGES as f64).sqrt();
            // What is left, by the rate at which the changes shrink. That may be the rate of a large part which the Jacobian fits, and
            // hide a small one which it does not: what changed last must be small itself.
            let rate = if iteration == 0 { 0.5 } else { now / before };
            if now <= 1.0 && rate < 1.0 && rate / (1.0 - rate) * now <= 1.0 {
                return Some(z);
            }
            // A stiff support takes two changes of one size, along its springs and back, before they shrink.
            if !now.is_finite() || (rate >= 1.0 && iteration > 1) {
                return None;
            }
            before = now;
        }
        None
    }

    /// The norm of the error of a step that ends where the sizes are `seen`, in units of the tolerance \[1].
    fn error_norm(
        &mut self,
        system: &impl System<N>,
        collocation: &Collocation<N>,
        z: &[[f64; N]; STAGES],
        seen: &Squares,
    ) -> f64 {
        let (y, weights) = (self.y, self.weights(system, self.h, seen));
        let t = self.t;
        let norm =
            |error: &[f64; N], weights: &Squares| largest_square(system, &system.parts(t, &y, error), weights).sqrt();
        let estimate = combined(&ERROR, z).map(|sum| sum / self.h);
        // eq. 44: (γ/h I − J) err = f(t, y) + Σ e_i z_i/h
        let mut error = collocation.filtered(&std::array::from_fn(|n| self.rate[n] + estimate[n]));
        let mut size = norm(&error, &weights);
        if size > 1.0 {
            // A stiff part that has not died out yet shows at every size of the step: it is filtered once more.
            let rate = self.evaluate(system, self.t, &std::array::from_fn(|n| self.y[n] + error[n]));
            error = collocation.filtered(&std::array::from_fn(|n| rate[n] + estimate[n]));
            size = norm(&error, &weights);
        }
        if size > 1.0 || size.is_nan() {
            return size;
        }
        // eq. 114: local = K R(hJ)⁴ (hJ (γ I − hJ)⁻¹)² err
        let mut local = collocation.unresolved(&collocation.unresolved(&error)).map(|error| radau::LOCAL * error);
        let weights = self.sizes.weights(system, &self.local, &system.roundings(&y, self.h), seen);
        // It falls with the sixth power of the step, and the other one with the fourth.
        let goes_on = |local: &[f64; N]| power(norm(local, &weights), 2.0 / 3.0);
        let (mut larger, mut before) = (goes_on(&local), f64::INFINITY);
        for step in 0..GO_ON {
            // It only gets less.
            if larger <= size {
                return size;
            }
            // The first steps also take away what dies out at once.
            if step >= GO_ON / 2 && larger > LASTS * before {
                break;
            }
            local = collocation.advanced(&local);
            before = std::mem::replace(&mut larger, goes_on(&local));
        }
        // Not `max`, which passes over what is not a number.
        if larger <= size { size } else { larger }
    }

    fn ended(&self, z: &[[f64; N]; STAGES]) -> [f64; N] {
        std::array::from_fn(|n| self.y[n] + z[STAGES - 1][n])
    }

    /// Goes on to time `end` \[s], over this `share` of a whole step \[1].
    fn accept(&mut self, system: &impl System<N>, end: f64, jacobian: [[f64; N]; N], attempt: Attempt<N>, share: f64) {
        let Attempt { z, error, rate, seen } = attempt;
        let y = self.ended(&z);
        self.segment = Segment { t: self.t, h: self.h, y: self.y, jacobian, sizes: self.sizes, z, ..Segment::blank() };
        (self.t, self.y, self.rate) = (end, y, rate);
        self.sizes.take(system, &seen, share);
        self.smooth = true;
        self.cost.steps += 1.0;
        self.cost.error_estimate += error;
        let factor = self.controller.accepted(error);
        self.h *= if self.iterations > FEW_ITERATIONS { factor.min(1.0) } else { factor };
    }
}

/// What came of a step that was tried.
struct Attempt<const N: usize> {
    /// What the state gains at each stage.
    z: [[f64; N]; STAGES],
    /// The norm of the error in units of the tolerance \[1]; not a number where the equations were not solved.
    error: f64,
    /// The rate of the state at its end, and the sizes of the motion there.
    rate: [f64; N],
    seen: Squares,
}

impl<const N: usize> Segment<N> {
    fn blank() -> Self {
        let (jacobian, sizes, z) = ([[0.0; N]; N], Sizes::blank(), [[0.0; N]; STAGES]);
        Self { t: 0.0, h: 0.0, y: [0.0; N], jacobian, sizes, z, answer: Answer::none() }
    }
}
