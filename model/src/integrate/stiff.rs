//! `stiff`: Radau IIA of order 5 with adaptive steps and dense output. Its steps do not shrink with rates that are fast but
//! damped. Each step is an implicit equation, solved by Newton's method with the exact Jacobian. No allocation.

mod collocation;
pub mod lu;
pub mod radau;

use super::answer::Answer;
use super::control::Controller;
use super::{Cost, Fault, System, Tolerance, end_of_step, mean_square};
use crate::scalar::ulp;
use crate::stored::stored;
use collocation::Collocation;
use radau::{ERROR, STAGES, combined, weights};

/// A system that knows its derivatives.
pub trait Differentiable<const N: usize>: System<N> {
    /// ∂f/∂y at (t, y), by rows: row i is the gradient of f_i, 0 along the quadratures.
    fn jacobian(&self, t: f64, y: &[f64; N]) -> [[f64; N]; N];
}

/// The method at work: where it stands, its last step, and what it spent.
#[derive(Clone, Debug)]
pub struct Stiff<const N: usize> {
    /// Of the error estimate, which is of order 3.
    tolerance: Tolerance<N>,
    /// Newton's method stops at this part of the tolerance [1]: ten times sooner than radau5, whose κ leaves errors of the
    /// slow motion beyond the tolerance where a support is stiff.
    precision: f64,
    controller: Controller,
    cost: Cost,
    /// The time reached [s], the state there and its rate.
    t: f64,
    y: [f64; N],
    rate: [f64; N],
    /// Size of the next step [s].
    h: f64,
    /// Attempts in a row that got nowhere.
    stall: u32,
    /// Iterations of Newton's method in the last attempt.
    iterations: u32,
    /// Whether the last step ended where the next one begins, so that its polynomial foretells it.
    smooth: bool,
    segment: Segment<N>,
}

stored!(Stiff<const N: usize> { tolerance, precision, controller, cost, t, y, rate, h, stall, iterations, smooth, segment });

/// The last step.
#[derive(Clone, Copy, Debug)]
struct Segment<const N: usize> {
    /// Where it began [s].
    t: f64,
    /// Its size [s].
    h: f64,
    /// The state at its start, and the Jacobian that solved it.
    y: [f64; N],
    jacobian: [[f64; N]; N],
    /// z_i: what the state has gained at each stage.
    z: [[f64; N]; STAGES],
    answer: Answer<N>,
}

stored!(Segment<const N: usize> { t, h, y, jacobian, z, answer });

/// A refused step is tried again with this part of it, and so is one that Newton's method does not solve.
const REFUSED: f64 = 0.5;

/// A first step spans at least so many units in the last place of the time.
const LEAST_FIRST: f64 = 100.0;

/// So many attempts in a row may be shorter than what gets anywhere.
const PATIENCE: u32 = 1000;

/// Newton's method gives up after so many iterations.
const MOST_ITERATIONS: u32 = 10;

/// After a step that took more, the next one does not grow: its equations would not be solved.
const FEW_ITERATIONS: u32 = 4;

impl<const N: usize> Stiff<N> {
    /// Starts at time `t` [s] and state `y`. Some component of the tolerance is relative.
    pub fn start(tolerance: Tolerance<N>, system: &impl System<N>, t: f64, y: [f64; N]) -> Self {
        let relative = tolerance.relative.into_iter().fold(0.0, f64::max);
        // The estimate is of order 3, the step of order 5: what the one calls 0.1 tol^(2/3) the other keeps to tol
        // (radau5).
        let looser = 0.1 / libm::cbrt(relative);
        let [absolute, relative_each] = [tolerance.absolute, tolerance.relative].map(|size| size.map(|x| x * looser));
        let mut method = Self {
            tolerance: Tolerance { absolute, relative: relative_each },
            precision: 0.1 * (looser * relative).sqrt().min(0.03),
            t,
            y,
            segment: Segment { t, y, ..Segment::blank() },
            ..Self::blank()
        };
        method.go_on_from(system, y);
        // A hundredth of the time in which the state changes; what is too long is rejected.
        let sizes = y.map(f64::abs);
        let [size, speed] = [&y, &method.rate].map(|v| method.tolerance.norm(v, &sizes));
        let first = if size < 1e-5 || speed < 1e-5 { 1e-6 } else { 0.01 * size / speed };
        method.h = first.max(LEAST_FIRST * ulp(t));
        method
    }

    /// Nothing yet: a place for what was stored.
    pub fn blank() -> Self {
        Self {
            tolerance: Tolerance { absolute: [0.0; N], relative: [0.0; N] },
            precision: 0.0,
            controller: Controller::new(4.0),
            cost: Cost::default(),
            t: 0.0,
            y: [0.0; N],
            rate: [0.0; N],
            h: 0.0,
            stall: 0,
            iterations: 0,
            smooth: false,
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
        &self.rate
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

    /// Goes on from another description `y` of the state reached.
    pub fn go_on_from(&mut self, system: &impl System<N>, y: [f64; N]) {
        self.y = y;
        self.rate = self.evaluate(system, self.t, &y);
        self.smooth = false;
    }

    /// Replaces a component of the state on which the rates do not depend.
    pub fn replace(&mut self, component: usize, value: f64) {
        self.y[component] = value;
    }

    /// What the run has cost so far. A matrix of derivatives counts as one evaluation for each of its columns.
    pub fn cost(&self) -> Cost {
        Cost { next_step: self.h, ..self.cost }
    }

    /// One step forward of the method's own choice, but not past time `until` [s]. Where none is possible, the method
    /// stands as before.
    ///
    /// Steps below `least` [s] get nowhere: after [`PATIENCE`] of them in a row, none is possible.
    pub fn step(&mut self, system: &impl Differentiable<N>, least: f64, until: f64) -> Result<(), Fault> {
        if !self.rate.iter().all(|rate| rate.is_finite()) {
            return Err(Fault::NotFinite { t: self.t });
        }
        let before = self.h;
        let jacobian = self.differentiate(system);
        let mut fault = Fault::Underflow { t: self.t };
        loop {
            self.stall = if self.h < least { self.stall + 1 } else { 0 };
            // A step that is not a number does not advance the time either.
            let advances = self.t + 0.1 * self.h > self.t;
            if !advances || self.stall > PATIENCE {
                (self.h, self.stall) = (before, 0);
                return Err(fault);
            }
            let wish = self.h;
            let end = end_of_step(self.t, self.h, until);
            // The step that the rounded times really span, or 10⁷ of them would drift from the time that they claim.
            self.h = end - self.t;
            let (z, error) = self.attempt(system, &jacobian);
            let y = self.ended(&z);
            let mut least_factor = REFUSED;
            fault = if !error.is_finite() {
                Fault::NotFinite { t: self.t }
            } else if error > 1.0 {
                least_factor = 0.0;
                Fault::Underflow { t: self.t }
            } else if let Err(reason) = system.admits(end, &y) {
                Fault::Refused { t: self.t, reason }
            } else {
                let cut = self.h < 0.999 * wish;
                self.accept(system, end, jacobian, z, error);
                if cut {
                    // What was cut short says little about the step that may follow.
                    self.h = self.h.max(wish);
                }
                return Ok(());
            };
            self.cost.rejected += 1.0;
            let measured = matches!(fault, Fault::Underflow { .. });
            let factor = self.controller.rejected(if measured { error } else { f64::INFINITY });
            self.h *= factor.max(least_factor);
        }
    }

    /// One step of size `h` [s], whatever its error.
    pub fn fixed_step(&mut self, system: &impl Differentiable<N>, h: f64) {
        self.h = h;
        let jacobian = self.differentiate(system);
        let (z, _) = self.attempt(system, &jacobian);
        self.accept(system, self.t + h, jacobian, z, 0.0);
        self.h = h;
    }

    /// The state at a time `t` [s] within the last step: that of a shorter step from the same start, which the polynomial of
    /// collocation, of order 3 only, foretells.
    pub fn dense(&mut self, system: &impl System<N>, t: f64) -> [f64; N] {
        let Segment { t: start, h, y, jacobian, z, answer } = self.segment;
        if let Some(answer) = answer.at(t) {
            return answer;
        }
        if t == start || h == 0.0 {
            return y;
        }
        let sigma = (t - start) / h;
        let guess = radau::C.map(|c| combined(&weights(c * sigma), &z));
        let z = self
            .solve(system, start, y, &Collocation::new(&jacobian, t - start, system.depended_on()), guess)
            .unwrap_or(guess);
        self.segment.answer.keep(t, std::array::from_fn(|n| y[n] + z[STAGES - 1][n]))
    }

    fn evaluate(&mut self, system: &impl System<N>, t: f64, y: &[f64; N]) -> [f64; N] {
        self.cost.evaluations += 1.0;
        system.rates(t, y)
    }

    /// The Jacobian for a step of size h.
    fn differentiate(&mut self, system: &impl Differentiable<N>) -> [[f64; N]; N] {
        self.cost.evaluations += system.depended_on() as f64;
        // In the middle of the step, where the method is going: there it serves all stages.
        let ahead = self.foretold_at(0.5);
        system.jacobian(self.t + 0.5 * self.h, &std::array::from_fn(|n| self.y[n] + ahead[n]))
    }

    /// A step of size h from where the method stands: its stages and the norm of its error in units of the tolerance [1].
    fn attempt(&mut self, system: &impl System<N>, jacobian: &[[f64; N]; N]) -> ([[f64; N]; STAGES], f64) {
        let collocation = Collocation::new(jacobian, self.h, system.depended_on());
        let guess = self.foretold();
        match self.solve(system, self.t, self.y, &collocation, guess) {
            Some(z) => (z, self.error_norm(system, &collocation, &z)),
            None => (guess, f64::NAN),
        }
    }

    /// The stages that the polynomial of the last step leads to.
    fn foretold(&self) -> [[f64; N]; STAGES] {
        radau::C.map(|c| self.foretold_at(c))
    }

    /// What the state gains on the first part `sigma` of a step, by the polynomial of the last one.
    fn foretold_at(&self, sigma: f64) -> [f64; N] {
        let Segment { h, z, .. } = &self.segment;
        if !self.smooth {
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
        let (weights, share) = (self.tolerance.weights(&y.map(f64::abs)), self.tolerance.share());
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
            let change = collocation.newton(&rates, &w);
            for i in 0..STAGES {
                for n in 0..N {
                    w[i][n] += change[i][n];
                }
            }
            z = radau::T.map(|row| combined(&row, &w));
            let squares = change.iter().map(|change| mean_square(change, &weights, share));
            let now = (squares.sum::<f64>() / STAGES as f64).sqrt();
            // What is left, by the rate at which the changes shrink.
            let rate = if iteration == 0 { 0.5 } else { now / before };
            if now == 0.0 || (rate < 1.0 && rate / (1.0 - rate) * now <= self.precision) {
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

    /// The norm of the error of a step, in units of the tolerance [1].
    fn error_norm(&mut self, system: &impl System<N>, collocation: &Collocation<N>, z: &[[f64; N]; STAGES]) -> f64 {
        let end = self.ended(z);
        let size: [f64; N] = std::array::from_fn(|n| self.y[n].abs().max(end[n].abs()));
        let estimate = combined(&ERROR, z).map(|sum| sum / self.h);
        // eq. 44: (γ/h I − J) err = f(t, y) + Σ e_i z_i/h
        let error = collocation.filtered(&std::array::from_fn(|n| self.rate[n] + estimate[n]));
        let norm = self.tolerance.norm(&error, &size);
        if norm <= 1.0 {
            return norm;
        }
        // A stiff part that has not died out yet shows at every size of the step: it is filtered once more.
        let rate = self.evaluate(system, self.t, &std::array::from_fn(|n| self.y[n] + error[n]));
        let error = collocation.filtered(&std::array::from_fn(|n| rate[n] + estimate[n]));
        self.tolerance.norm(&error, &size)
    }

    fn ended(&self, z: &[[f64; N]; STAGES]) -> [f64; N] {
        std::array::from_fn(|n| self.y[n] + z[STAGES - 1][n])
    }

    fn accept(
        &mut self,
        system: &impl System<N>,
        end: f64,
        jacobian: [[f64; N]; N],
        z: [[f64; N]; STAGES],
        error: f64,
    ) {
        let y = self.ended(&z);
        self.segment = Segment { t: self.t, h: self.h, y: self.y, jacobian, z, ..Segment::blank() };
        self.t = end;
        self.go_on_from(system, y);
        self.smooth = true;
        self.cost.steps += 1.0;
        self.cost.error_estimate += error;
        let factor = self.controller.accepted(error);
        self.h *= if self.iterations > FEW_ITERATIONS { factor.min(1.0) } else { factor };
    }
}

impl<const N: usize> Segment<N> {
    fn blank() -> Self {
        Self { t: 0.0, h: 0.0, y: [0.0; N], jacobian: [[0.0; N]; N], z: [[0.0; N]; STAGES], answer: Answer::none() }
    }
}
