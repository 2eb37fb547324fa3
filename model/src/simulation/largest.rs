//! The largest deflections of a run. A run is read at few points, and what it does between them is in the solver's dense output: that
//! is searched step by step.

use super::integration::Integration;
use crate::effects::Effects;
use crate::scalar::ulp;
use crate::state::Kinematics;

/// The largest deflection of a station so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deflection {
    /// The station, along t from c \[m].
    pub position: f64,
    /// How far it was from the x axis at most \[m]: a static deflection is part of that.
    pub largest: f64,
    /// When that was \[s].
    pub at: f64,
}

/// The largest deflections of some stations, up to the communication point.
#[derive(Clone, Debug, Default)]
pub struct Largest {
    stations: Vec<Station>,
    /// Up to when \[s] the motion was looked at; None before the start.
    seen: Option<f64>,
}

/// A station, and where it was when it was looked at last.
#[derive(Clone, Copy, Debug)]
struct Station {
    found: Deflection,
    /// The square of its distance from the x axis \[m²].
    largest: f64,
    last: Look,
}

/// A look at a station.
#[derive(Clone, Copy, Debug, Default)]
struct Look {
    t: f64,
    /// The square of the distance from the x axis \[m²].
    square: f64,
    /// The rate of that [m²/s].
    rate: f64,
}

impl Look {
    /// At the station at `p` \[m] along t from c.
    fn at(motion: &Kinematics<f64>, p: f64) -> Self {
        let (r, v) = (motion.station(p), motion.station_velocity(p));
        Self { t: motion.t, square: r.y * r.y + r.z * r.z, rate: 2.0 * (r.y * v.y + r.z * v.z) }
    }

    /// Whether the square may exceed `largest` between here and there: it rises and falls, and the tangents at both ends cross above that.
    fn may_exceed(&self, there: &Self, largest: f64) -> bool {
        if self.rate <= 0.0 || there.rate >= 0.0 {
            return false;
        }
        let h = there.t - self.t;
        let x = (there.square - self.square - there.rate * h) / (self.rate - there.rate);
        self.square + self.rate * x.clamp(0.0, h) > largest * (1.0 + f64::EPSILON)
    }
}

/// The place where a distance is largest is sought to this part of an interval: the distance itself is then right to the square of it \[1].
const CLOSE: f64 = 1e-8;

impl Largest {
    /// Of the stations at these positions \[m] along t from c.
    pub fn at(positions: impl IntoIterator<Item = f64>) -> Self {
        let station = |position| Station {
            found: Deflection { position, largest: 0.0, at: f64::NAN },
            largest: -1.0,
            last: Look::default(),
        };
        Self { stations: positions.into_iter().map(station).collect(), seen: None }
    }

    /// What was found, in the order of the positions.
    pub fn found(&self) -> impl Iterator<Item = Deflection> {
        self.stations.iter().map(|station| station.found)
    }

    /// Looks at a motion up to time `to` \[s], which lies in its last step.
    pub(super) fn follow<E: Effects, const N: usize>(&mut self, run: &Integration<N>, effects: &E, to: f64) {
        if self.stations.is_empty() || self.seen.is_some_and(|seen| seen >= to) {
            return;
        }
        // What is read costs evaluations, which are not the run's.
        let mut read = *run;
        let [start, end] = run.last_step();
        let from = self.seen.map_or(to, |seen| seen.max(start).min(to));
        let parts = (f64::from(run.places_to_look::<E>()) * (to - from) / (end - start)).ceil().max(1.0);
        self.seen = Some(to);
        let mut motion = |t: f64| read.motion_at(effects, t);
        let first = motion(from);
        for station in &mut self.stations {
            station.take(Look::at(&first, station.found.position));
        }
        if from == to {
            return;
        }
        let mut part = 1.0;
        while part <= parts {
            let t = if part == parts { to } else { from + (to - from) * (part / parts) };
            let here = motion(t);
            for station in &mut self.stations {
                let (before, now) = (station.last, Look::at(&here, station.found.position));
                station.take(now);
                if before.may_exceed(&now, station.largest) {
                    station.search(before, now, &mut motion);
                }
            }
            part += 1.0;
        }
    }
}

impl Station {
    fn take(&mut self, look: Look) {
        self.last = look;
        self.compare(look);
    }

    fn compare(&mut self, look: Look) {
        if look.square > self.largest {
            self.largest = look.square;
            (self.found.largest, self.found.at) = (look.square.sqrt(), look.t);
        }
    }

    /// Looks where the distance is largest between a time when it rises and one when it falls: where its rate is zero (regula falsi,
    /// Illinois's variant: Dowell and Jarratt 1971).
    fn search(&mut self, mut rises: Look, mut falls: Look, motion: &mut impl FnMut(f64) -> Kinematics<f64>) {
        const TRIES: u32 = 100;
        let close = (CLOSE * (falls.t - rises.t)).max(2.0 * ulp(falls.t));
        let [mut above, mut below] = [rises.rate, falls.rate];
        for n in 0..TRIES {
            let width = falls.t - rises.t;
            if width <= close {
                break;
            }
            let part = above / (above - below);
            // Where the chord does not help, halves do.
            let part = if n % 4 == 3 || !(part > 0.0 && part < 1.0) { 0.5 } else { part };
            let look = Look::at(&motion(rises.t + part * width), self.found.position);
            self.compare(look);
            if look.rate.abs() * width <= f64::EPSILON * look.square {
                break;
            }
            if look.rate > 0.0 {
                (rises, above, below) = (look, look.rate, 0.5 * below);
            } else {
                (falls, below, above) = (look, look.rate, 0.5 * above);
            }
        }
    }
}

/// What looks at each step of a run.
pub(super) trait Looks: Clone {
    /// Whether it does: then a run ends where it diverges.
    fn looks(&self) -> bool;

    /// Looks at the last step up to time `to` \[s].
    fn look<E: Effects, const N: usize>(&mut self, run: &Integration<N>, effects: &E, to: f64);
}

/// Nothing does.
impl Looks for () {
    #[inline(always)]
    fn looks(&self) -> bool {
        false
    }

    #[inline(always)]
    fn look<E: Effects, const N: usize>(&mut self, _: &Integration<N>, _: &E, _: f64) {}
}

impl Looks for Option<Largest> {
    fn looks(&self) -> bool {
        self.is_some()
    }

    fn look<E: Effects, const N: usize>(&mut self, run: &Integration<N>, effects: &E, to: f64) {
        if let Some(largest) = self {
            largest.follow(run, effects, to);
        }
    }
}
