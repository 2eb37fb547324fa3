//! Where modes cross a line: their frequency that of a multiple of the speed, or their growth 0.

use super::campbell::{Campbell, Point};
use super::{Mode, Obstacle, Steady};
use nalgebra::ComplexField;

/// Where a mode crosses a line.
#[derive(Clone, Debug)]
pub struct Crossing {
    /// The number of its branch, from 0.
    pub branch: usize,
    /// [rad/s].
    pub speed: f64,
    /// The mode there.
    pub mode: Mode,
}

/// A crossing is found to this part of its speed \[1], or after so many trials.
const FOUND: f64 = 1e-13;
const TRIALS: u32 = 100;

/// What is left of the distance to the line there, of that at both ends \[1]: more is a jump from one mode to another.
const CLOSED: f64 = 1e-6;

/// So near to a crossing, of the distance of two speeds, it is sought on which side of the line the mode is \[1].
const BESIDE: [f64; 6] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];

/// A mode is near a line where it is nearer than this part of its size \[1].
const NEAR: f64 = 1e-4;

/// A speed, and the modes that are above the line there.
struct Seen {
    speed: f64,
    above: Vec<Mode>,
}

impl Seen {
    /// How many eigenvalues these modes have: a mode that swings has two, and may become two that do not.
    fn eigenvalues(&self) -> usize {
        self.above.iter().map(|mode| if mode.eigenvalue.im > 0.0 { 2 } else { 1 }).sum()
    }
}

/// A line, by how far a mode is above it at a speed [rad/s].
struct Line<F: Fn(&Mode, f64) -> f64>(F);

impl<F: Fn(&Mode, f64) -> f64> Line<F> {
    fn height(&self, mode: &Mode, speed: f64) -> f64 {
        (self.0)(mode, speed)
    }

    fn is_above(&self, mode: &Mode, speed: f64) -> bool {
        self.height(mode, speed) > mode.rounding
    }

    fn is_on(&self, mode: &Mode, speed: f64) -> bool {
        self.height(mode, speed).abs() <= mode.rounding
    }
}

impl Campbell<'_> {
    /// Where the frequencies are `order` times the speed, by speed.
    ///
    /// # Errors
    /// Where there is no steady state on the way, and where its eigenvalues are not found.
    pub fn critical_speeds(&self, order: f64) -> Result<Vec<Crossing>, Obstacle> {
        let line = Line(|mode: &Mode, speed: f64| mode.eigenvalue.im - order * speed.abs());
        let mut found = self.crossings(&line)?;
        // A mode that comes up beside the line, as the spin begins to hold the axis, has not crossed it; nor has one that does not swing.
        let is_near = |speed: f64, mode: &Mode| line.height(mode, speed).abs() <= NEAR * mode.eigenvalue.modulus();
        found.retain(|Crossing { speed, mode, .. }| mode.eigenvalue.im > 0.0 && is_near(*speed, mode));
        Ok(found)
    }

    /// Where modes begin or cease to grow, by speed.
    ///
    /// # Errors
    /// Where there is no steady state on the way, and where its eigenvalues are not found.
    pub fn thresholds(&self) -> Result<Vec<Crossing>, Obstacle> {
        self.crossings(&Line(|mode: &Mode, _| mode.eigenvalue.re))
    }

    fn crossings<F: Fn(&Mode, f64) -> f64>(&self, line: &Line<F>) -> Result<Vec<Crossing>, Obstacle> {
        let mut found = Vec::new();
        for pair in self.steady.windows(2) {
            let ends = [&pair[0], &pair[1]];
            found.extend(match self.along_branches(ends, line)? {
                Some(crossings) => crossings,
                None => self.by_numbers(ends, line)?,
            });
        }
        found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        Ok(found)
    }

    /// Between two neighbouring speeds, along the branches that are above the line at one of them: to the last digits. None where such a
    /// branch begins, ends or is lost between them, and where it is on the line at one of them, as undamped modes are until they meet.
    fn along_branches<F: Fn(&Mode, f64) -> f64>(
        &self,
        ends: [&Steady; 2],
        line: &Line<F>,
    ) -> Result<Option<Vec<Crossing>>, Obstacle> {
        let mut found = Vec::new();
        for (branch, of) in self.branches.iter().enumerate() {
            let ends = ends.map(|end| of.at(end.speed));
            let above = ends.map(|end| end.is_some_and(|end| line.is_above(&end.mode, end.speed)));
            if above[0] == above[1] {
                continue;
            }
            let [Some(from), Some(to)] = ends else { return Ok(None) };
            if [from, to].into_iter().any(|end| line.is_on(&end.mode, end.speed)) {
                return Ok(None);
            }
            let Some(Point { speed, mode }) = self.root([from, to], line)? else { return Ok(None) };
            found.push(Crossing { branch, speed, mode });
        }
        Ok(Some(found))
    }

    /// Along the mode, from either end; where that cannot be followed, along the nearest eigenvalues; None where those lead nowhere either.
    fn root<F: Fn(&Mode, f64) -> f64>(&self, ends: [&Point; 2], line: &Line<F>) -> Result<Option<Point>, Obstacle> {
        let [from, to] = ends;
        let by_shape = |near: &Point, speed: f64| self.machine.followed(near, speed);
        let by_value = |near: &Point, speed: f64| self.machine.nearest(near, speed);
        for ends in [[from, to], [to, from]] {
            if let Some(point) = root_by(ends, line, by_shape)? {
                return Ok(Some(point));
            }
        }
        root_by(ends, line, by_value)
    }

    /// Between two neighbouring speeds, where the number of eigenvalues above the line changes, by halves.
    fn by_numbers<F: Fn(&Mode, f64) -> f64>(
        &self,
        ends: [&Steady; 2],
        line: &Line<F>,
    ) -> Result<Vec<Crossing>, Obstacle> {
        let seen = ends.map(|Steady { speed, .. }| {
            let above = self.at(*speed).filter(|(_, mode)| line.is_above(mode, *speed));
            Seen { speed: *speed, above: above.map(|(_, mode)| mode.clone()).collect() }
        });
        let mut found = Vec::new();
        self.halve(ends[0], seen.each_ref(), line, TRIALS, &mut found)?;
        let mut crossings: Vec<Crossing> = Vec::new();
        for (at, rises) in found {
            let [there, elsewhere] = if rises { [1, 0] } else { [0, 1] }.map(|n: usize| ends[n].speed);
            let alike =
                |a: &(usize, &Mode), b: &(usize, &Mode)| at.mode.likeness(a.1).total_cmp(&at.mode.likeness(b.1));
            let is_new = |(n, _): &(usize, &Mode)| crossings.iter().all(|other| other.branch != *n);
            let above = self.at(there).filter(|(_, mode)| line.is_above(mode, there)).filter(is_new).max_by(alike);
            // It may have crossed the line again until there.
            let (branch, _) = above.or_else(|| self.at(elsewhere).max_by(alike)).expect("modes at one of the ends");
            let Point { speed, mode } = self.polished(&at, ends[1].speed - ends[0].speed, line)?.unwrap_or(at);
            crossings.push(Crossing { branch, speed, mode });
        }
        Ok(crossings)
    }

    /// A crossing from one side of the line to the other, to the last digits, between the nearest speeds at which more than rounding parts
    /// the mode from the line. None where it is on the same side at both, or cannot be followed to them.
    fn polished<F: Fn(&Mode, f64) -> f64>(
        &self,
        at: &Point,
        distance: f64,
        line: &Line<F>,
    ) -> Result<Option<Point>, Obstacle> {
        for part in BESIDE {
            let ends = [-part, part].map(|part| at.speed + part * distance);
            if ends[0] * ends[1] <= 0.0 {
                break;
            }
            let [Some(from), Some(to)] = ends.map(|speed| self.machine.followed(at, speed).transpose()) else { break };
            let [from, to] = [Point { speed: ends[0], mode: from? }, Point { speed: ends[1], mode: to? }];
            if [&from, &to].into_iter().all(|end| !line.is_on(&end.mode, end.speed)) {
                let [before, after] = [&from, &to].map(|end| line.is_above(&end.mode, end.speed));
                return if before == after { Ok(None) } else { self.root([&from, &to], line) };
            }
        }
        Ok(None)
    }

    /// Adds each crossing between these speeds, and whether the mode is above the line from there on.
    fn halve<F: Fn(&Mode, f64) -> f64>(
        &self,
        near: &Steady,
        [from, to]: [&Seen; 2],
        line: &Line<F>,
        trials: u32,
        found: &mut Vec<(Point, bool)>,
    ) -> Result<(), Obstacle> {
        if from.eigenvalues() == to.eigenvalues() {
            return Ok(());
        }
        let speed = 0.5 * (from.speed + to.speed);
        if trials == 0 || to.speed - from.speed <= FOUND * speed.abs() {
            let rises = to.eigenvalues() > from.eigenvalues();
            let (more, less) = if rises { (to, from) } else { (from, to) };
            let height = |mode: &Mode| line.height(mode, more.speed);
            let mut above = more.above.clone();
            above.sort_by(|a, b| height(a).total_cmp(&height(b)));
            // The lowest ones have just crossed it.
            let count = above.len().saturating_sub(less.above.len()).max(1);
            found.extend(above.into_iter().take(count).map(|mode| (Point { speed, mode }, rises)));
            return Ok(());
        }
        let (_, modes) = self.machine.modes(speed, Some(near))?;
        let above = modes.into_iter().filter(|mode| line.is_above(mode, speed)).collect();
        let between = Seen { speed, above };
        self.halve(near, [from, &between], line, trials - 1, found)?;
        self.halve(near, [&between, to], line, trials - 1, found)
    }
}

/// By Illinois' rule; None where the mode cannot be followed, or no root is met.
fn root_by<F: Fn(&Mode, f64) -> f64>(
    [from, to]: [&Point; 2],
    line: &Line<F>,
    at: impl Fn(&Point, f64) -> Result<Option<Mode>, Obstacle>,
) -> Result<Option<Point>, Obstacle> {
    let [mut at_a, mut at_b] = [from, to].map(|end| line.height(&end.mode, end.speed));
    let close = CLOSED * at_a.abs().max(at_b.abs());
    let closed = |at_b: f64, b: Point| (at_b.abs() <= close || line.is_on(&b.mode, b.speed)).then_some(b);
    let (mut a, mut b) = (from.speed, to.clone());
    for _ in 0..TRIALS {
        if (b.speed - a).abs() <= FOUND * b.speed.abs() || at_b == 0.0 {
            return Ok(closed(at_b, b));
        }
        let speed = b.speed - at_b * (b.speed - a) / (at_b - at_a);
        let Some(mode) = at(&b, speed)? else { return Ok(None) };
        let value = line.height(&mode, speed);
        let is_still = speed == b.speed;
        let (last, at_last) = (std::mem::replace(&mut b, Point { speed, mode }), std::mem::replace(&mut at_b, value));
        if (value > 0.0) != (at_last > 0.0) {
            (a, at_a) = (last.speed, at_last);
        } else {
            at_a *= 0.5;
        }
        if is_still {
            return Ok(closed(at_b, b));
        }
    }
    Ok(None)
}
