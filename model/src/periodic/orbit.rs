//! A motion that repeats with each revolution: where its stations go, and whether it lasts.

use super::revolution::{NUMBERS, Obstacle, Rotating, Slopes, State};
use crate::decompositions::{eigenvalues, singular_values};
use crate::linear;
use nalgebra::{Complex, ComplexField, SMatrix, SVector, Vector2, Vector3};
use std::f64::consts::TAU;

/// A revolution is shown at so many points.
const POINTS: u32 = 128;

/// A motion has at least this size, over √(Jt/m) \[1]: differences are taken of one that does not move at all, too.
const LEAST: f64 = 1e-7;

/// A multiplier beyond 1 by more than this tells that the motion does not last \[1]: less may be what differences err.
const GROWS: f64 = 1e-5;

/// A multiplier is real where its angle is less than this \[1].
const REAL: f64 = 1e-3;

/// So many revolutions are followed to come near a motion that Newton's method does not find from afar.
const SETTLING: u32 = 300;

/// So many steps Newton's method takes at most, and new slopes.
const MOST_STEPS: u32 = 20;
const MOST_SLOPES: u32 = 4;

/// A step is the last where it is less than this part of the motion's size; or than that, where it hardly shrinks any more \[1].
const FOUND: f64 = 1e-9;
const ROUNDED: f64 = 1e-6;

/// A motion comes back that misses its start by less than this part of its size before the last step \[1].
const RETURNS: f64 = 1e-4;

/// New slopes where a step is more than this part of the one before \[1].
const SLOW: f64 = 0.1;

/// Sizes by which a motion was sought and found are alike within this \[1].
const LIKE: f64 = 10.0;

/// Singular values below this part of the largest are those of directions in which nothing holds the rotor \[1].
pub(super) const UNHELD: f64 = 1e-10;

/// Numbers that continuation solves for: the state, and the speed.
pub(super) type Both = SVector<f64, { NUMBERS + 1 }>;
pub(super) type Square = SMatrix<f64, { NUMBERS + 1 }, { NUMBERS + 1 }>;

/// Where the speed stands among them.
pub(super) const SPEED: usize = NUMBERS;

/// c \[m] and the axis t \[1], point by point.
type Seen = Vec<[Vector3<f64>; 2]>;

/// A motion that repeats with each revolution.
#[derive(Clone, Debug)]
pub struct Orbit {
    /// ω_φ [rad/s].
    pub speed: f64,
    /// Where φ = 0.
    pub state: State,
    /// By what small motions beside it are multiplied in a revolution (Floquet) \[1].
    pub multipliers: Vec<Complex<f64>>,
    /// How the end of a revolution changes with its start, and with the speed, per rad/s.
    pub(super) slopes: Slopes,
    pub(super) by_speed: State,
    /// How far it moves, over the sizes of the state \[1].
    pub(super) size: f64,
    /// At equal parts of the revolution, the last where it begins anew.
    seen: Seen,
}

/// How a motion that does not last leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// A multiplier beyond 1: it goes elsewhere, as beyond a fold.
    Away,
    /// One beyond −1: it goes on with twice the period.
    Twice,
    /// A pair beyond the unit circle: it begins to beat.
    Beat,
}

impl Loss {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Away => "leaves for another motion",
            Self::Twice => "goes on with twice the period",
            Self::Beat => "begins to beat",
        }
    }
}

/// What a station does in a revolution, across the x axis.
#[derive(Clone, Copy, Debug)]
pub struct Path {
    /// Its part that goes round once with the spin.
    pub once: linear::Orbit,
    /// Where it is in the mean \[m].
    pub mean: Vector2<f64>,
    /// How far it comes from the mean \[m].
    pub reach: f64,
    /// How far it comes from the stator line \[m].
    pub farthest: f64,
}

impl Orbit {
    /// The size of the largest multiplier \[1].
    pub fn largest_multiplier(&self) -> f64 {
        self.multipliers.iter().map(|multiplier| multiplier.modulus()).fold(0.0, f64::max)
    }

    /// By which rates small motions beside it grow, and their frequencies but for whole multiples of the speed [rad/s].
    pub fn exponents(&self) -> Vec<Complex<f64>> {
        // μ = e^(λT)
        let per_time = self.speed.abs() / TAU;
        let exponent = |multiplier: &Complex<f64>| {
            Complex::new(libm::log(multiplier.modulus()), libm::atan2(multiplier.im, multiplier.re)) * per_time
        };
        self.multipliers.iter().map(exponent).collect()
    }

    /// How small motions beside it leave it, if they do.
    pub fn loss(&self) -> Option<Loss> {
        let largest = self.multipliers.iter().max_by(|a, b| a.modulus().total_cmp(&b.modulus()))?;
        let is_real = largest.im.abs() < REAL * largest.modulus();
        // What is no number does not last either.
        let lasts = largest.modulus() <= 1.0 + GROWS;
        (!lasts).then_some(match (is_real, largest.re > 0.0) {
            (true, true) => Loss::Away,
            (true, false) => Loss::Twice,
            (false, _) => Loss::Beat,
        })
    }

    /// What the station at `position` from c along t \[m] does.
    pub fn path(&self, position: f64) -> Path {
        let all = || self.seen.iter().map(|[c, axis]| (c + axis * position).yz());
        let count = self.seen.len() as f64;
        let mean = all().sum::<Vector2<f64>>() / count;
        let mut once = [Complex::from(0.0); 2];
        for (n, at) in (1..).zip(all()) {
            let (sine, cosine) = libm::sincos(TAU.copysign(self.speed) * f64::from(n) / count);
            // eq. 120: Y = (2/N) Σ y_n e^(−iφ_n)
            let back = Complex::new(cosine, -sine) * (2.0 / count);
            once[0] += back * at.x;
            once[1] += back * at.y;
        }
        let [y, z] = once;
        let largest = |distance: &dyn Fn(Vector2<f64>) -> f64| all().map(distance).fold(0.0, f64::max);
        Path {
            once: linear::Orbit { y, z },
            mean,
            reach: largest(&|at| (at - mean).norm()),
            farthest: largest(&|at| at.norm()),
        }
    }
}

impl Rotating {
    /// The motion that repeats with each revolution at `speed` [rad/s], which is not 0, sought from `near`, else from where it
    /// would stand without its unbalance, and from what it does when it has settled.
    ///
    /// # Errors
    /// Where it is not found.
    pub fn orbit(&self, speed: f64, near: Option<&Orbit>) -> Result<Orbit, Obstacle> {
        let from = near.map_or_else(|| self.at_rest(speed), |near| near.state);
        if let Ok(orbit) = self.found(speed, from) {
            return Ok(orbit);
        }
        self.found(speed, self.follow(speed, &from, [SETTLING, 1], |_| {})?)
    }

    fn found(&self, speed: f64, mut state: State) -> Result<Orbit, Obstacle> {
        let (_, mut size) = self.watched(speed, &state)?;
        let held = Both::ith(SPEED, 1.0);
        // What is far from it at first has another size.
        for _ in 0..3 {
            let near = Near { speed, state, size, unit: [1.0, speed.abs()] };
            let Some(found) = self.corrected(&near, &held, None)? else { break };
            state = found.1;
            let watched @ (_, now) = self.watched(speed, &state)?;
            if now <= LIKE * size && size <= LIKE * now {
                return self.repeating(speed, &state, watched);
            }
            size = now;
        }
        Err(Obstacle::NotFound { speed })
    }

    /// What a motion shows in a revolution, and its size.
    fn watched(&self, speed: f64, state: &State) -> Result<(Seen, f64), Obstacle> {
        let mut seen = Vec::new();
        let end = self.follow(speed, state, [1, POINTS], |motion| seen.push([motion.r_c(), *motion.axis()]))?;
        let mean = seen.iter().fold([Vector3::zeros(); 2], |[r, t], [c, axis]| [r + c, t + axis]);
        let [place, axis] = mean.map(|sum: Vector3<f64>| sum / f64::from(POINTS));
        let moved = |[c, t]: &[Vector3<f64>; 2]| ((c - place) / self.length).norm() + (t - axis).norm();
        let size = seen.iter().map(moved).fold(0.0, f64::max);
        Ok((seen, size.max(LEAST).max((end - state).amax())))
    }

    /// The motion of a state that repeats.
    pub(super) fn at(&self, speed: f64, state: &State) -> Result<Orbit, Obstacle> {
        self.repeating(speed, state, self.watched(speed, state)?)
    }

    /// The same where a revolution of it was watched.
    fn repeating(&self, speed: f64, state: &State, (seen, size): (Seen, f64)) -> Result<Orbit, Obstacle> {
        let (slopes, by_speed) = (self.slopes(speed, state, size)?, self.slope_by_speed(speed, state)?);
        let multipliers = eigenvalues(&slopes).ok_or(Obstacle::NoMultipliers { speed })?;
        let multipliers = multipliers.iter().copied().collect();
        Ok(Orbit { speed, state: *state, multipliers, slopes, by_speed, size, seen })
    }

    /// Newton's method from near a motion to one that repeats, and does not move along `held`, with these slopes as long as they do; None
    /// where it leads nowhere.
    pub(super) fn corrected(
        &self,
        near: &Near,
        held: &Both,
        slopes: Option<&Slopes>,
    ) -> Result<Option<(f64, State)>, Obstacle> {
        let Near { mut speed, mut state, size, unit } = *near;
        let mut matrix = None;
        if let Some(slopes) = slopes {
            matrix = Some(near.matrix(slopes, &self.slope_by_speed(speed, &state)?, held));
        }
        let (mut before, mut made) = (f64::INFINITY, 0);
        for _ in 0..MOST_STEPS {
            let all = match matrix {
                Some(matrix) => matrix,
                None if made == MOST_SLOPES => return Ok(None),
                None => {
                    made += 1;
                    let slopes = self.slopes(speed, &state, size)?;
                    near.matrix(&slopes, &self.slope_by_speed(speed, &state)?, held)
                }
            };
            matrix = Some(all);
            let Some(all) = singular_values(&all) else { return Ok(None) };
            // eq. 119: P(x, ω) − x = 0
            let mut left = Both::zeros();
            left.fixed_rows_mut::<NUMBERS>(0).copy_from(&((state - self.turn(speed, &state)?) / unit[0]));
            let Ok(step) = all.solve(&left, UNHELD * all.singular_values[0]) else { return Ok(None) };
            state += step.fixed_rows::<NUMBERS>(0) * unit[0];
            speed += step[SPEED] * unit[1];
            let length = step.norm() * unit[0] / size;
            if length < FOUND || (length < ROUNDED && length > SLOW * before) {
                // Where nothing holds the rotor a step is none, and the motion does not come back for all that.
                let returns = left.norm() * unit[0] < RETURNS * size;
                return Ok(returns.then_some((speed, state)));
            }
            if !length.is_finite() || speed * near.speed <= 0.0 {
                return Ok(None);
            }
            matrix = matrix.filter(|_| length <= SLOW * before);
            before = length;
        }
        Ok(None)
    }
}

/// Where a motion is sought.
#[derive(Clone, Copy)]
pub(super) struct Near {
    pub speed: f64,
    pub state: State,
    /// Of the motion \[1].
    pub size: f64,
    /// What states \[1] and speeds [rad/s] count in.
    pub unit: [f64; 2],
}

impl Near {
    /// The equations of a motion that repeats, and what is held.
    pub fn matrix(&self, slopes: &Slopes, by_speed: &State, held: &Both) -> Square {
        let mut matrix = Square::zeros();
        matrix.fixed_view_mut::<NUMBERS, NUMBERS>(0, 0).copy_from(&(slopes - Slopes::identity()));
        matrix.fixed_view_mut::<NUMBERS, 1>(0, SPEED).copy_from(&(by_speed * (self.unit[1] / self.unit[0])));
        matrix.set_row(SPEED, &held.transpose());
        matrix
    }
}
