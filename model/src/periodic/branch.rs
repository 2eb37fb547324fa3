//! Motions that repeat with each revolution followed through the speeds, around folds.

use super::orbit::{Both, Near, Orbit, SPEED, UNHELD};
use super::revolution::{NUMBERS, Obstacle, Rotating, State};
use crate::decompositions::singular_values;
use nalgebra::SVD;

/// A step counts one where the speed changes by one of those asked for, or the state by this part of the motion's size \[1].
const BEND: f64 = 0.3;

/// Steps are halved to this one, and grow by this \[1].
const SHORTEST: f64 = 1e-2;
const GROWTH: f64 = 1.5;

/// Newton's method may move a motion from where it is expected by this part of a step \[1].
const OFF: f64 = 0.5;

/// The cosine between one step and the next is at least this, where steps are longer than that \[1]: a contact bends at once.
const STRAIGHT: f64 = 0.8;
const SHORT: f64 = 0.1;

/// A fold is found where the speed changes by less than this part of a step, or after so many orbits \[1].
const LEVEL: f64 = 1e-5;
const TURNS: u32 = 12;

/// A branch has at most so many motions for each speed that was asked for.
const MOST: usize = 20;

/// Why a branch ends.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// It leaves the range of speeds.
    Range,
    /// It is longer than is looked at.
    Long,
    /// It cannot be followed further.
    Lost(Obstacle),
}

/// Motions that go over into one another.
#[derive(Clone, Debug)]
pub struct Branch {
    /// In their order, at speeds that may turn back.
    pub orbits: Vec<Orbit>,
    /// Why there are no more.
    pub end: End,
}

impl Branch {
    /// The numbers of the orbits at which the speed turns back.
    pub fn folds(&self) -> impl Iterator<Item = usize> {
        let gain = |n: usize| self.orbits[n + 1].speed - self.orbits[n].speed;
        (1..self.orbits.len().saturating_sub(1)).filter(move |n| gain(*n) * gain(n - 1) < 0.0)
    }
}

impl Orbit {
    fn near(&self, unit: [f64; 2]) -> Near {
        Near { speed: self.speed, state: self.state, size: self.size, unit }
    }

    /// Which way a branch goes on from here, of length 1 in these units, `ahead` being about it.
    ///
    /// # Errors
    /// Where its equations are not solved.
    fn tangent(&self, unit: [f64; 2], ahead: &Both) -> Result<Both, Obstacle> {
        // eq. 119: (∂P/∂x − 1) x' + ∂P/∂ω ω' = 0
        let all = singular_values(&self.near(unit).matrix(&self.slopes, &self.by_speed, ahead));
        let solve = |all: SVD<_, _, _>| all.solve(&Both::ith(SPEED, 1.0), UNHELD * all.singular_values[0]).ok();
        let tangent = all.and_then(solve).ok_or(Obstacle::NotFound { speed: self.speed })?;
        Ok(tangent.normalize())
    }
}

impl Rotating {
    /// The motions that go over into that at the first of these speeds [rad/s], neither of which is 0, on to the second, in so many steps
    /// or more.
    ///
    /// # Errors
    /// Where there is none at the first.
    pub fn branch(&self, [from, to]: [f64; 2], steps: u32) -> Result<Branch, Obstacle> {
        let first = self.orbit(from, None)?;
        let pace = (to - from) / f64::from(steps);
        let (mut branch, mut ahead, mut step) =
            (Branch { orbits: vec![first], end: End::Long }, Both::ith(SPEED, 1.0), 1.0);
        while branch.orbits.len() < MOST * steps as usize {
            let last = branch.orbits.last().expect("it begins with one");
            let unit = [BEND * last.size, pace];
            let tangent = match last.tangent(unit, &ahead) {
                Ok(tangent) => tangent,
                Err(obstacle) => {
                    branch.end = End::Lost(obstacle);
                    return Ok(branch);
                }
            };
            let near = last.near(unit);
            // The end of the range is met.
            let rest = (to - last.speed) / pace;
            let is_last = tangent[SPEED] * step >= rest;
            let by = if is_last { rest / tangent[SPEED] } else { step };
            let held = if is_last { Both::ith(SPEED, 1.0) } else { tangent };
            let step_on = self.step(last, &near, &(tangent * by), &held).and_then(|orbit| {
                let on = orbit.tangent(unit, &tangent)?;
                Ok((orbit, on))
            });
            match step_on {
                Ok((orbit, _)) if is_last => {
                    branch.orbits.push(orbit);
                    branch.end = End::Range;
                    return Ok(branch);
                }
                Ok((orbit, on)) => {
                    if on.dot(&tangent) < STRAIGHT && step > SHORT {
                        step *= 0.5;
                        continue;
                    }
                    // Past an end of the range a branch is over.
                    if (to - orbit.speed) / pace < 0.0 {
                        branch.end = match self.orbit(to, Some(&orbit)) {
                            Ok(last) => {
                                branch.orbits.push(last);
                                End::Range
                            }
                            Err(obstacle) => End::Lost(obstacle),
                        };
                        return Ok(branch);
                    }
                    if (orbit.speed - from) / pace < 0.0 {
                        branch.end = End::Range;
                        return Ok(branch);
                    }
                    if on[SPEED] * tangent[SPEED] < 0.0 {
                        let fold = self.fold(last, &near, [&(tangent * by), &tangent], [tangent[SPEED], on[SPEED]]);
                        branch.orbits.extend(fold);
                    }
                    ahead = tangent;
                    branch.orbits.push(orbit);
                    step = (step * GROWTH).min(1.0);
                }
                Err(obstacle) => {
                    step *= 0.5;
                    if step < SHORTEST {
                        branch.end = End::Lost(obstacle);
                        return Ok(branch);
                    }
                }
            }
        }
        Ok(branch)
    }

    /// The orbit on this way from `near` at which the speed turns back: by Illinois' rule, from the rates of the speed at both ends; where that
    /// leads to no orbit, by halves. None where neither does: the fold is then as coarse as the steps beside it.
    fn fold(
        &self,
        last: &Orbit,
        near: &Near,
        [way, held]: [&Both; 2],
        [mut at_a, mut at_b]: [f64; 2],
    ) -> Option<Orbit> {
        let [mut a, mut b] = [0.0, 1.0];
        let mut found = None;
        for _ in 0..TURNS {
            let seen = |part: f64| {
                let orbit = self.step(last, near, &(way * part), held)?;
                let value = orbit.tangent(near.unit, held)?[SPEED];
                Ok::<_, Obstacle>((part, orbit, value))
            };
            let Ok((part, orbit, value)) = seen(b - at_b * (b - a) / (at_b - at_a)).or_else(|_| seen(0.5 * (a + b)))
            else {
                break;
            };
            if value * at_b < 0.0 {
                (a, at_a) = (b, at_b);
            } else {
                at_a *= 0.5;
            }
            (b, at_b) = (part, value);
            found = Some(orbit);
            if value.abs() < LEVEL {
                break;
            }
        }
        found
    }

    /// The orbit that is met by this way from `near`, or beside it.
    fn step(&self, last: &Orbit, near: &Near, way: &Both, held: &Both) -> Result<Orbit, Obstacle> {
        let expected: State = near.state + way.fixed_rows::<NUMBERS>(0) * near.unit[0];
        let at = Near { speed: near.speed + way[SPEED] * near.unit[1], state: expected, ..*near };
        let lost = Obstacle::NotFound { speed: at.speed };
        let (speed, state) = self.corrected(&at, held, Some(&last.slopes))?.ok_or(lost.clone())?;
        let [by_state, by_speed] = [(state - expected).norm() / near.unit[0], (speed - at.speed) / near.unit[1]];
        let off = (by_state * by_state + by_speed * by_speed).sqrt();
        if off > OFF * (way.norm() + SHORT) { Err(lost) } else { self.at(speed, &state) }
    }
}
