//! A machine that runs from one communication point to the next.

use super::Machine;
use super::inputs::{Input, Inputs};
use super::laws::{Laws, SIZE, State, at};
use super::switches::Switch;
use crate::extrapolation::{MOST, change, cost};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// What is compared, and the velocities that go with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// Position of c \[m].
    pub r_c: Vector3<f64>,
    /// Velocity of c [m/s].
    pub v_c: Vector3<f64>,
    /// The axis t.
    pub axis: Vector3<f64>,
    /// Angular velocity [rad/s].
    pub omega: Vector3<f64>,
    /// φ \[rad].
    pub phi: f64,
}

/// The steps between two communication points: size \[s] and columns.
type Steps = Vec<(f64, usize)>;

/// How a run takes its steps.
#[derive(Clone, Debug)]
pub enum Pace {
    /// By its own estimate: a step may err by so much of how far the motion went \[1].
    Adaptive(f64),
    /// As another run took them, each cut into so many; not of a machine whose laws have branches.
    Like(Vec<Steps>, usize),
}

/// A run under way.
#[derive(Clone, Debug)]
pub struct Run {
    pub(super) laws: Laws,
    pub(super) inputs: Inputs,
    pace: Pace,
    pub(super) t: f64,
    pub(super) y: State,
    /// What rounding has left out of y.
    rest: State,
    start: State,
    /// How far each number went from the start, together with those that count with it.
    sizes: State,
    /// The step to try next \[s].
    next: f64,
    taken: Vec<Steps>,
    evaluations: usize,
    /// The nearest that the axis came to −e: 1 + e·t.
    nearest: f64,
    machine: Machine,
    /// The loads at the start, and the largest change of each from there [N, N·m].
    first: Vec<Vector3<f64>>,
    farthest: Vec<f64>,
}

/// What rounding leaves of the change in a step, and of a number itself \[1]: an estimate below is none.
const ROUNDING: [f64; 2] = [1e-14, 1e-15];

/// More evaluations than this are not affordable.
const AFFORDABLE: usize = 3_000_000;

/// Columns of a machine with rings: short steps, so that none of them holds both ends of a contact unseen.
const MOST_AT_RINGS: usize = 6;

/// 2π less its double.
const TAU_REST: f64 = 2.449_293_598_294_706_4e-16;

impl Run {
    /// From the machine's start at time 0.
    pub fn new(machine: &Machine, pace: Pace) -> Self {
        let (mut laws, inputs) = (Laws::new(machine), Inputs::new(machine));
        assert!(!laws.has_branches() || matches!(pace, Pace::Adaptive(_)), "branches end elsewhere in another run");
        let mut y = laws.start(&machine.start, &inputs);
        if machine.imposed_speed {
            y = laws.struck(&y, inputs.imposed().at(0.0)[0]);
        }
        laws.take_branches(&y);
        let taken = Vec::new();
        let first = laws.loads_shown(machine, &laws.motion(&y));
        let (machine, farthest) = (machine.clone(), vec![0.0; first.len()]);
        let (rest, sizes, nearest) = ([0.0; SIZE], [0.0; SIZE], 2.0);
        Self {
            laws,
            inputs,
            pace,
            t: 0.0,
            y,
            rest,
            start: y,
            sizes,
            next: 0.0,
            taken,
            evaluations: 0,
            nearest,
            machine,
            first,
            farthest,
        }
    }

    /// Sets an input at the communication point: its value and two derivatives.
    pub fn set(&mut self, input: Input, terms: [f64; 3]) {
        if self.inputs.set(self.t, input, terms) {
            self.y = self.laws.struck(&self.y, self.inputs.imposed().at(self.t)[0]);
            self.laws.take_branches(&self.y);
        }
    }

    /// Place and velocity of a port.
    pub fn port(&self, port: usize) -> [Vector3<f64>; 2] {
        self.laws.motion(&self.y).station(self.laws.port(port))
    }

    /// What the communication point shows.
    pub fn show(&self) -> Shown {
        let motion = self.laws.motion(&self.y);
        let (axis, phi) = (motion.axis(), self.y[at::PHI] + self.rest[at::PHI]);
        Shown { r_c: motion.r_c, v_c: motion.v_c, axis, omega: motion.omega, phi }
    }

    /// The steps that it took.
    pub fn taken(&self) -> Vec<Steps> {
        self.taken.clone()
    }

    /// How many evaluations it took.
    pub fn evaluations(&self) -> usize {
        self.evaluations
    }

    /// The nearest that the axis came to −e at the end of a step: 1 + e·t.
    pub fn nearest(&self) -> f64 {
        self.nearest
    }

    /// How far each load of supports, bearings and rings went from the start so far, by the ends of all steps, in the order of
    /// [`Run::outputs`] [N, N·m].
    pub fn farthest(&self) -> &[f64] {
        &self.farthest
    }

    /// How fast the mass centre was across e at the ends of all steps so far, beside its start [m/s].
    pub fn fastest(&self) -> f64 {
        self.sizes[at::V + 1]
    }

    /// Moves the communication point to time `until` \[s]; false where the motion has no bounds or costs too much.
    pub fn advance(&mut self, until: f64) -> bool {
        self.inputs.step_from(self.t);
        self.taken.push(Vec::new());
        let steps = match &self.pace {
            Pace::Adaptive(tolerance) => return self.go_to(until, *tolerance),
            Pace::Like(steps, parts) => {
                let of_this = &steps[self.taken.len() - 1];
                of_this.iter().flat_map(|&(h, columns)| vec![(h / *parts as f64, columns); *parts]).collect::<Steps>()
            }
        };
        for (h, columns) in steps {
            self.step(h, columns);
        }
        self.t = until;
        self.y.iter().all(|number| number.is_finite())
    }

    /// A step of so many columns.
    fn step(&mut self, h: f64, columns: usize) {
        let Self { laws, inputs, t, y, .. } = self;
        let mut rates = |t: f64, y: &State| laws.rates(t, y, inputs);
        let first = rates(*t, y);
        let gained = change(&mut rates, *t, y, &first, h, |column, _, _| column >= columns);
        self.evaluations += 1 + cost(columns);
        self.accept(h, columns, &gained);
    }

    /// Steps of its own choice up to time `until` \[s].
    fn go_to(&mut self, until: f64, tolerance: f64) -> bool {
        let most = if self.laws.rubs.is_empty() { MOST } else { MOST_AT_RINGS };
        while self.t < until {
            let rest = until - self.t;
            let wanted = if self.next == 0.0 { rest } else { self.next };
            // It reaches the point, or leaves half of a short rest.
            let h = if wanted >= rest { rest } else { wanted.min(0.5 * rest) };
            let Self { laws, inputs, t, y, sizes, .. } = self;
            let mut rates = |t: f64, y: &State| laws.rates(t, y, inputs);
            let first = rates(*t, y);
            let h = laws.within_sliding(y, &first, h);
            let (mut accepted, mut best) = (None, (f64::INFINITY, 0.1 * h, 0));
            let gained = change(&mut rates, *t, y, &first, h, |column, gained, difference| {
                let rounding = laws.rounding.map(|rounding| h * rounding);
                let error = error(y, sizes, (&first.map(|rate| h * rate), rounding), gained, difference, tolerance);
                if column < 3 {
                    return false;
                }
                let factor = libm::pow(0.2 / error.max(1e-30), 1.0 / (2 * column - 1) as f64);
                let next = h * (0.9 * factor).min(4.0);
                let work = cost(column) as f64 / next;
                if work < best.0 {
                    best = (work, next, column);
                }
                if error <= 1.0 {
                    accepted = Some(column);
                }
                accepted.is_some() || column == most
            });
            self.evaluations += 1 + cost(accepted.unwrap_or(most));
            if self.evaluations > AFFORDABLE || h < 1e-14 * until {
                return false;
            }
            match accepted {
                Some(columns) => {
                    let (_, mut next, column) = best;
                    if column == columns && columns < most {
                        // One column more would do, and allow so much longer steps.
                        next *= cost(columns + 1) as f64 / cost(columns) as f64;
                    }
                    self.next = if h < wanted { wanted.max(next) } else { next };
                    let switch = self.first_switch(h, columns, &gained);
                    let (part, gained) = switch.as_ref().map_or((h, &gained), |switch| (switch.h, &switch.gained));
                    self.accept(part, columns, gained);
                    if let Some(switch) = switch {
                        self.laws.switch(switch.number);
                    } else if h == rest {
                        self.t = until;
                    }
                }
                None => self.next = best.1.clamp(0.1 * h, 0.7 * h),
            }
        }
        true
    }

    /// Where the first branch of a law ends in a step.
    fn first_switch(&mut self, h: f64, columns: usize, gained: &State) -> Option<Switch> {
        let Self { laws, inputs, t, y, evaluations, .. } = self;
        if !laws.has_branches() {
            return None;
        }
        let rates = |s: f64, y: &State| laws.rates(*t + s, y, inputs);
        let first = rates(0.0, y);
        let mut part = |h: f64| {
            *evaluations += cost(columns);
            change(&mut |t, y| laws.rates(t, y, inputs), *t, y, &first, h, |column, _, _| column >= columns)
        };
        laws.first_switch(y, h, gained, rates, &mut part)
    }

    fn accept(&mut self, h: f64, columns: usize, gained: &State) {
        for n in 0..SIZE {
            let gained = gained[n] + self.rest[n];
            let sum = self.y[n] + gained;
            self.rest[n] = gained - (sum - self.y[n]);
            self.y[n] = sum;
        }
        let turns = (self.y[at::PSI] / TAU).round();
        self.y[at::PSI] -= turns * TAU;
        self.rest[at::PSI] -= turns * TAU_REST;
        self.t += h;
        let way: State = std::array::from_fn(|n| self.y[n] - self.start[n]);
        let sizes = together(&way);
        self.sizes = std::array::from_fn(|n| self.sizes[n].max(sizes[n]));
        let motion = self.laws.motion(&self.y);
        self.nearest = self.nearest.min(1.0 + motion.axis().x);
        for (load, (first, farthest)) in
            self.laws.loads_shown(&self.machine, &motion).iter().zip(self.first.iter().zip(&mut self.farthest))
        {
            *farthest = farthest.max((load - first).norm());
        }
        self.taken.last_mut().expect("a step was begun").push((h, columns));
    }
}

/// How far numbers went: y and z together, x at least as far; of P, ψ and φ the tilt by itself and the turn by 1 rad.
fn together(way: &State) -> State {
    let mut sizes = [1.0; SIZE];
    for first in [at::R, at::V, at::K] {
        let across = libm::hypot(way[first + 1], way[first + 2]);
        sizes[first..first + 3].copy_from_slice(&[across.max(way[first].abs()), across, across]);
    }
    sizes[at::TORQUE] = way[at::TORQUE].abs();
    sizes[at::P + 2..at::P + 4].fill(libm::hypot(way[at::P + 2], way[at::P + 3]));
    sizes
}

/// The largest difference over what is tolerated: part of how far the motion went, with this step, and what rounding leaves.
fn error(
    y: &State,
    sizes: &State,
    (slope, [of_v, of_k]): (&State, [f64; 2]),
    gained: &State,
    difference: &State,
    tolerance: f64,
) -> f64 {
    let (with, at_first) = (together(gained), together(slope));
    let mut most = 0.0_f64;
    for n in 0..SIZE {
        let size = sizes[n].max(with[n]);
        let of_rates = match n {
            at::V..at::K => of_v,
            at::K..at::P => of_k,
            _ => 0.0,
        };
        let rounding = ROUNDING[0] * at_first[n].max(with[n]) + ROUNDING[1] * y[n].abs() + of_rates;
        let ratio = difference[n].abs() / (tolerance * size + rounding);
        // 0/0: nothing moves.
        if difference[n] != 0.0 {
            most = if ratio > most || ratio.is_nan() { ratio } else { most };
        }
    }
    most
}
