//! What a scene's motion is, how far it goes, and how it grows what is off at the start.

use super::play::{Seen, play};
use super::trial::Trial;
use crate::harness::largest;
use nalgebra::Vector3;
use oracles::machine::{Beside, Machine, Pace, Run, Shown};
use oracles::rotation;
use std::f64::consts::TAU;

/// Place across e [m], axis [rad], φ [rad].
pub type Measures = [f64; 3];

/// The reference motion and what follows from it.
#[derive(Clone, Debug)]
pub struct Truth {
    /// At the start and at each point.
    pub shown: Vec<Seen>,
    /// All other outputs.
    pub outputs: Vec<Output>,
    /// How far the motion goes.
    pub sizes: Measures,
    /// By how much it differs from that in steps twice as long, over the sizes.
    pub own_error: Measures,
    /// A: by how many tolerances it shifts where the start is off by one.
    pub growth: f64,
    /// Evaluations that it took in all.
    pub evaluations: usize,
}

/// An output beside the motion.
#[derive(Clone, Debug)]
pub struct Output {
    /// Its name, of a vector without its axes.
    pub name: String,
    /// What its errors are compared with, in its unit.
    pub size: f64,
    /// The reference's own error over that [1].
    pub own_error: f64,
    /// For a ring, by how many tolerances its force shifts where the start is off by one, else 0: what is hard and hit for moments comes
    /// late by as much as the motion does.
    pub growth: f64,
}

/// Of what hardly changes, errors count beside this part of its value [1]: rounding is no error.
const LEAST: f64 = 1e-6;

/// A motion that has decayed to this part of what it was is followed no further (eq. 80), so velocities count beside this part of the fastest ever,
/// which may lie between two points \[1].
const FOLLOWED: f64 = 1e-3;

/// A bearing's force counts beside that of an axial way of this part of its position [1]: along t that is a number with the rounding of
/// the position, and the whole motion may be less than that.
const OF_LEVER: f64 = 1e-8;

/// Why a scene is drawn anew.
#[derive(Clone, Debug, PartialEq)]
pub enum Unfit {
    /// The axis comes too near to −e, 1 + e·t.
    TiltsOver(f64),
    /// It grows what is off at the start by more than is judged.
    Grows(f64),
    /// It turns more often than is judged.
    Spins(f64),
    /// The reference errs by too much to judge by it, over the sizes.
    Unsure(f64),
    /// The reference does not get on.
    Runaway,
}

/// A step of the reference errs by so much of the motion's size [1].
const STEP: f64 = 1e-13;

/// Where halved steps are not possible, one errs by so much less [1].
const FINER: f64 = 10.0;

/// By how much of the sizes the start is off, to see what becomes of it [1].
const OFF: f64 = 1e-6;

/// A beyond this is not judged.
const MOST_GROWTH: f64 = 1e4;

/// The reference may err by so much of the sizes and of A [1]: a tenth of what is allowed at the smallest tolerance.
const SURE: f64 = 3e-9;

/// Revolutions beyond this are not judged.
const MOST_TURNS: f64 = 1e4;

/// The nearest that an axis may come to −e, 1 + e·t: there φ has no limit, and with a joint the motion has none; a joint's laws
/// end at 3.1 rad.
const NEAREST: [f64; 2] = [1e-3, 0.06];

impl Truth {
    /// Of a scene; why it is not fit.
    pub fn of(trial: &Trial) -> Result<Self, Unfit> {
        Self::with(trial, OFF)
    }

    /// The same, A seen with a start that is off by this part of the sizes [1].
    pub fn with(trial: &Trial, off_by: f64) -> Result<Self, Unfit> {
        let mut coarse = Run::new(&trial.machine, Pace::Adaptive(STEP));
        let in_long_steps = play(trial, &mut coarse).map_err(|_| Unfit::Runaway)?;
        let nearest = NEAREST[usize::from(has_joint(&trial.machine))];
        if coarse.nearest() < nearest {
            return Err(Unfit::TiltsOver(coarse.nearest()));
        }
        let steps = coarse.taken();
        // What switches does so at other times where steps differ, so each run takes its own.
        let pace = |parts: usize| {
            if switches(&trial.machine) {
                Pace::Adaptive(STEP / if parts == 1 { 1.0 } else { FINER })
            } else {
                Pace::Like(steps.clone(), parts)
            }
        };
        let mut fine = Run::new(&trial.machine, pace(2));
        let shown = play(trial, &mut fine).map_err(|_| Unfit::Runaway)?;
        let judged = trial.judged();
        let sizes = sizes(&shown, judged);
        if sizes[2] > TAU * MOST_TURNS {
            return Err(Unfit::Spins(sizes[2] / TAU));
        }
        let mut off = Run::new(&moved(&trial.machine, &shown, off_by), pace(1));
        let shifted = play(trial, &mut off).map_err(|_| Unfit::Runaway)?;
        let shifts = differences(&shifted, &in_long_steps, judged);
        let growth = largest(over(shifts, sizes)) / off_by;
        if growth.is_nan() || growth > MOST_GROWTH {
            return Err(Unfit::Grows(growth));
        }
        let own_error = over(differences(&in_long_steps, &shown, judged), sizes);
        let outputs = outputs(trial, [&in_long_steps, &shown, &shifted], off_by, &fine);
        let own = largest(own_error);
        if own.is_nan() || own > SURE * growth.max(1.0) {
            return Err(Unfit::Unsure(own));
        }
        Ok(Self {
            sizes,
            outputs,
            own_error,
            growth,
            evaluations: coarse.evaluations() + fine.evaluations() + off.evaluations(),
            shown,
        })
    }
}

/// Whether a law goes on as another one where it is touched or a speed is passed.
fn switches(machine: &Machine) -> bool {
    !machine.rubs.is_empty() || machine.bearings.iter().any(|bearing| !bearing.table.is_empty())
}

/// Whether a law acts along n or follows γ or ω_φ, which have no limit at −e.
fn has_joint(machine: &Machine) -> bool {
    let bearings = machine.bearings.iter().any(|bearing| bearing.tilt[0] != 0.0 || !bearing.table.is_empty());
    let rubs = machine.rubs.iter().any(|rub| rub.friction != 0.0);
    let driven = machine.drive || machine.motor.is_some() || machine.imposed_speed;
    driven || bearings || rubs || machine.support.is_some_and(|support| support.c[1] != 0.0)
}

impl Trial {
    /// The first point that is judged.
    fn judged(&self) -> usize {
        1 + self.points.iter().position(|t| *t >= self.judged_from).expect("a point that is judged")
    }
}

fn across(v: &Vector3<f64>) -> f64 {
    libm::hypot(v.y, v.z)
}

/// All outputs, their sizes and the reference's own errors.
fn outputs(trial: &Trial, [in_long_steps, shown, shifted]: [&[Seen]; 3], off_by: f64, fine: &Run) -> Vec<Output> {
    let farthest = fine.farthest();
    let (judged, names) = (trial.judged(), trial.machine.outputs(&trial.probes));
    let from = if judged == 1 { &shown[0] } else { &shown[judged] };
    let value = |n: usize| largest(shown[judged..].iter().map(|now| now.outputs[n].norm()));
    let excursion = |n: usize| largest(shown[judged..].iter().map(|now| (now.outputs[n] - from.outputs[n]).norm()));
    let potential = names.len() - 1;
    let turning = largest(shown.iter().map(|now| now.motion.omega.norm()));
    let own = output_differences(in_long_steps, shown, judged);
    let shifts = output_differences(in_long_steps, shifted, judged);
    let bearings = trial.machine.bearings.iter().enumerate();
    let levers: Vec<_> = bearings
        .map(|(n, bearing)| (format!("bearing[{}].F", n + 1), OF_LEVER * bearing.axial[0] * bearing.position.abs()))
        .collect();
    let output = |(n, (name, beside)): (usize, (String, Beside))| {
        let lever = levers.iter().find(|(of, _)| *of == name).map_or(0.0, |(_, force)| *force);
        let size = match beside {
            // A hard ring is hit for moments, mostly between two points.
            Beside::Excursion if n < farthest.len() && judged == 1 => {
                excursion(n).max(farthest[n]).max(LEAST * value(n)).max(lever)
            }
            // A velocity of the axis is known to the last digits of that of the mass centre.
            Beside::Excursion => {
                let decayed = if name == "v_c" || name.ends_with(".v") { FOLLOWED * fine.fastest() } else { 0.0 };
                let least = LEAST * value(n).max(trial.machine.eccentricity() * turning);
                excursion(n).max(least).max(decayed)
            }
            Beside::Size => value(n),
            Beside::Energy => value(potential - 1) + excursion(potential),
        };
        let growth = if name.starts_with("rub") { part(shifts[n], size) / off_by } else { 0.0 };
        Output { name, size, own_error: part(own[n], size), growth }
    };
    names.into_iter().enumerate().map(output).collect()
}

/// The largest differences of the outputs of two motions.
fn output_differences(a: &[Seen], b: &[Seen], judged: usize) -> Vec<f64> {
    let count = a[0].outputs.len();
    let of = |n: usize| largest(a.iter().zip(b).skip(judged).map(|(a, b)| (a.outputs[n] - b.outputs[n]).norm()));
    (0..count).map(of).collect()
}

/// How far place and axis go from the first point that counts, and φ from the start, but 1 rad at least.
fn sizes(shown: &[Seen], judged: usize) -> Measures {
    let shown: Vec<_> = shown.iter().map(|seen| seen.motion).collect();
    let from = if judged == 1 { &shown[0] } else { &shown[judged] };
    [
        largest(shown[judged..].iter().map(|now| across(&(now.r_c - from.r_c)))),
        largest(shown[judged..].iter().map(|now| angle(&now.axis, &from.axis))),
        largest(shown[judged..].iter().map(|now| (now.phi - shown[0].phi).abs())).max(1.0),
    ]
}

fn angle(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    libm::atan2(a.cross(b).norm(), a.dot(b))
}

/// The largest differences between two motions.
fn differences(a: &[Seen], b: &[Seen], judged: usize) -> Measures {
    let pairs = || a.iter().zip(b).skip(judged).map(|(a, b)| (&a.motion, &b.motion));
    [
        largest(pairs().map(|(a, b)| across(&(a.r_c - b.r_c)))),
        largest(pairs().map(|(a, b)| angle(&a.axis, &b.axis))),
        largest(pairs().map(|(a, b)| (a.phi - b.phi).abs())),
    ]
}

impl Truth {
    /// The largest differences from another motion.
    pub fn differences(&self, trial: &Trial, other: &[Seen]) -> Measures {
        differences(&self.shown, other, trial.judged())
    }

    /// The output that another motion has worst, and its error over its size and its own growth, where the motion grows by less; ten
    /// times of what the reference itself errs must be within `allowed` \[1].
    pub fn worst_output(&self, trial: &Trial, other: &[Seen], allowed: f64) -> (String, f64) {
        let apart = output_differences(&self.shown, other, trial.judged());
        let sure = self.outputs.iter().zip(apart).filter(|(output, _)| 10.0 * output.own_error <= allowed);
        let grown = |output: &Output| (output.growth / self.growth.max(1.0)).max(1.0);
        let errors = sure.map(|(output, apart)| (output.name.clone(), part(apart, output.size) / grown(output)));
        errors
            .fold(("nothing".into(), 0.0), |worst, next| if next.1 > worst.1 || next.1.is_nan() { next } else { worst })
    }
}

/// An error over a size; nothing over nothing is nothing.
fn part(error: f64, size: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / size }
}

/// Each over its size; nothing over nothing is nothing.
pub fn over(measures: Measures, sizes: Measures) -> Measures {
    std::array::from_fn(|n| part(measures[n], sizes[n]))
}

/// The machine with a start that is off by a part of how far each went, in directions that favour none.
fn moved(machine: &Machine, shown: &[Seen], by: f64) -> Machine {
    let shown: Vec<_> = shown.iter().map(|seen| seen.motion).collect();
    let first = &shown[0];
    let went = |of: fn(&Shown) -> Vector3<f64>| {
        let ways = shown.iter().map(|now| of(now) - of(first));
        ways.fold([0.0_f64; 2], |[along, over], way| [along.max(way.x.abs()), over.max(across(&way))])
    };
    let off = |[along, over]: [f64; 2], azimuth: f64| {
        Vector3::new(along, over * libm::cos(azimuth), over * libm::sin(azimuth)) * by
    };
    let [place, speed, turning] = [went(|now| now.r_c), went(|now| now.v_c), went(|now| now.omega.cross(&now.axis))];

    let tilt = largest(shown.iter().map(|now| angle(&now.axis, &first.axis)));
    let mut moved = machine.clone();
    let start = &mut moved.start;
    start.r_c += off(place, 0.7);
    start.v_c += off(speed, 2.9);
    // The rate of the axis, ω = ω_a t + t×dt/dt. Not its spin: that would be off for ever, while a method keeps what nothing
    // brakes or drives.
    start.omega += first.axis.cross(&off(turning, 4.4));
    // About an axis across t, so that it tilts by so much.
    let side = first.axis.cross(&Vector3::new(0.3, 0.8, -0.5)).normalize();
    let axis = rotation::rodrigues(&(side * (tilt * by))) * first.axis;
    start.gamma = rotation::gamma(&axis);
    moved
}
