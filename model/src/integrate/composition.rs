//! Compositions: a motion that is the sum of two, each of which can be followed by itself, followed in turns.
//!
//! Steps are of one size; nothing chooses it. No allocation.

mod coefficients;

pub use coefficients::{KAHAN, SOFRONIOU, STRANG, SUZUKI};

use super::answer::Answer;
use super::{Cost, Fault, Refusal, System, end_of_step};
use crate::stored::{Damaged, Stored, Walk, choice, stored};

/// A motion that is the sum of two, on its way through a step.
pub trait Split<const N: usize> {
    /// Follows the one for a time `h` [s], backwards where it is negative.
    fn drift(&mut self, h: f64);

    /// Follows the other for a time `h` [s], backwards where it is negative; meanwhile the time stands at `t` [s].
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

    /// Sets out from y on a step of size `h` [s].
    fn flow<'s>(&'s self, y: &[f64; N], composition: &Composition, h: f64) -> Self::Flow<'s>;
}

/// The parts γ_i of a step, the same from both ends.
#[derive(Debug)]
pub struct Composition {
    /// Its order.
    pub order: u32,
    /// γ_1 to the one in the middle [1].
    half: &'static [f64],
}

impl Composition {
    /// The composition of this order: 2, 4, 6 or 8.
    pub fn of_order(order: u32) -> Option<&'static Self> {
        ALL.into_iter().find(|composition| composition.order == order)
    }

    /// All γ_i [1].
    pub fn parts(&self) -> impl Iterator<Item = f64> {
        self.half.iter().chain(self.half.iter().rev().skip(1)).copied()
    }

    /// One step of size `h` [s] from time `t` [s].
    #[inline(always)]
    pub fn follow<const N: usize>(&self, motion: &mut impl Split<N>, t: f64, h: f64) {
        // eq. 38: S(h) is drift(h/2), kick(h), drift(h/2); a step is S(γ₁h), S(γ₂h), …, and drifts that meet are one
        let (mut before, mut reached) = (0.0, 0.0);
        for part in self.parts() {
            let way = 0.5 * (before + part);
            motion.drift(way * h);
            reached += way;
            motion.kick(t + reached * h, part * h);
            before = part;
        }
        motion.drift(0.5 * before * h);
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
#[derive(Clone, Debug)]
pub struct Composed<const N: usize> {
    composition: &'static Composition,
    /// Size of a step [s].
    size: f64,
    /// Size of the next step [s], never more.
    h: f64,
    cost: Cost,
    /// The time reached [s], and the state there.
    t: f64,
    y: [f64; N],
    /// Where the last step began [s], the state there, and its size [s].
    start: f64,
    start_y: [f64; N],
    last: f64,
    answer: Answer<N>,
    /// Steps in a row that got nowhere.
    stall: u32,
}

stored!(Composed<const N: usize> { composition, size, h, cost, t, y, start, start_y, last, answer, stall });

/// So many steps in a row may be shorter than what gets anywhere.
const PATIENCE: u32 = 1000;

const TOO_SHORT: Refusal = Refusal(
    "in steps of the symplectic method that are so short the run would never end: lengthen solver.step_size, or where it is \
     0, soften what changes so fast",
);

impl<const N: usize> Composed<N> {
    /// Starts at time `t` [s] and state `y`, with steps of this size [s].
    pub fn start(composition: &'static Composition, size: f64, t: f64, y: [f64; N]) -> Self {
        let cost = Cost::default();
        Self {
            composition,
            size,
            h: size,
            cost,
            t,
            y,
            start: t,
            start_y: y,
            last: 0.0,
            answer: Answer::none(),
            stall: 0,
        }
    }

    /// Nothing yet: a place for what was stored.
    pub fn blank() -> Self {
        Self::start(&STRANG, 0.0, 0.0, [0.0; N])
    }

    /// The time reached [s].
    pub fn time(&self) -> f64 {
        self.t
    }

    /// The state at the time reached.
    pub fn state(&self) -> &[f64; N] {
        &self.y
    }

    /// Where the last step began [s].
    pub fn start_time(&self) -> f64 {
        self.start
    }

    /// The state where the last step began.
    pub fn start_state(&self) -> &[f64; N] {
        &self.start_y
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
    pub fn go_back(&mut self, t: f64, y: [f64; N]) {
        (self.t, self.y) = (t, y);
    }

    /// Goes on from another description `y` of the state reached.
    pub fn go_on_from(&mut self, y: [f64; N]) {
        self.y = y;
    }

    /// Replaces a component of the state.
    pub fn replace(&mut self, component: usize, value: f64) {
        self.y[component] = value;
    }

    /// What the run has cost so far. No error is estimated.
    pub fn cost(&self) -> Cost {
        Cost { next_step: self.h, ..self.cost }
    }

    /// One step forward, but not past time `until` [s]. One that cannot be done is tried again with half its size; where none
    /// is possible, the method stands as before.
    ///
    /// Steps below `least` [s] get nowhere: after [`PATIENCE`] of them in a row, none is possible.
    pub fn step(&mut self, system: &impl Splitting<N>, least: f64, until: f64) -> Result<(), Fault> {
        let (mut h, y) = (self.h, self.y);
        let mut fault = None;
        loop {
            // A step that is not a number does not advance the time either.
            let advances = self.t + 0.1 * h > self.t;
            if !advances || self.stall > PATIENCE {
                self.stall = 0;
                return Err(fault.unwrap_or(Fault::Refused { t: self.t, reason: TOO_SHORT }));
            }
            let end = end_of_step(self.t, h, until);
            // The step that the rounded times really span, or 10⁷ of them would drift from the time that they claim.
            let span = end - self.t;
            let followed = self.followed(system, self.t, &y, span);
            fault = Some(match followed.and_then(|y| system.admits(end, &y).map(|()| y)) {
                Ok(y) if y.iter().all(|y| y.is_finite()) => {
                    self.stall = if span < least { self.stall + 1 } else { 0 };
                    self.accept(end, y, span);
                    return Ok(());
                }
                Ok(_) => Fault::NotFinite { t: self.t },
                Err(reason) => Fault::Refused { t: self.t, reason },
            });
            self.cost.rejected += 1.0;
            h = 0.5 * span;
        }
    }

    /// One step of size `h` [s], wherever it ends.
    pub fn fixed_step(&mut self, system: &impl Splitting<N>, h: f64) {
        let y = self.y;
        let y = self.followed(system, self.t, &y, h).unwrap_or([f64::NAN; N]);
        self.accept(self.t + h, y, h);
    }

    /// The state at a time `t` [s] within the last step: a step of its own from where that began, as good as the method
    /// and without a gap at either end. `system` as it was in the last step.
    pub fn dense(&mut self, system: &impl Splitting<N>, t: f64) -> [f64; N] {
        if t == self.start || self.last == 0.0 {
            return self.start_y;
        }
        if let Some(answer) = self.answer.at(t) {
            return answer;
        }
        let y = self.start_y;
        let answer = self.followed(system, self.start, &y, t - self.start).unwrap_or([f64::NAN; N]);
        self.answer.keep(t, answer)
    }

    fn followed(&mut self, system: &impl Splitting<N>, t: f64, y: &[f64; N], h: f64) -> Result<[f64; N], Refusal> {
        let mut motion = system.flow(y, self.composition, h);
        self.composition.follow(&mut motion, t, h);
        let (y, evaluations) = motion.end();
        self.cost.evaluations += evaluations;
        y
    }

    fn accept(&mut self, end: f64, y: [f64; N], h: f64) {
        (self.start, self.start_y, self.last) = (self.t, self.y, h);
        (self.t, self.y, self.h) = (end, y, self.size);
        self.answer = Answer::none();
        self.cost.steps += 1.0;
    }
}
