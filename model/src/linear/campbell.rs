//! Modes followed through a range of speeds, and where they cross the lines of the speed's multiples, or begin to grow.

use super::modes::GROWS;
use super::{Machine, Mode, Obstacle, Steady};
use nalgebra::ComplexField;

/// A mode at a speed.
#[derive(Clone, Debug)]
pub struct Point {
    /// [rad/s].
    pub speed: f64,
    /// The mode.
    pub mode: Mode,
}

/// A mode through the speeds, as long as it can be followed.
#[derive(Clone, Debug)]
pub struct Branch {
    /// By speed.
    pub points: Vec<Point>,
}

/// Where something happens to a branch.
#[derive(Clone, Debug)]
pub struct Crossing {
    /// The branch's number, from 0.
    pub branch: usize,
    /// [rad/s].
    pub speed: f64,
    /// The mode there.
    pub mode: Mode,
}

/// The modes of a machine from one speed to another.
pub struct Campbell<'m> {
    machine: &'m Machine,
    /// Where it runs steadily, by speed.
    pub steady: Vec<Steady>,
    /// Its modes.
    pub branches: Vec<Branch>,
}

/// Two modes are one where they are more alike than this \[1], or there is no speed left between them.
const ALIKE: f64 = 0.9;

/// An interval is halved so often to follow a mode.
const HALVINGS: u32 = 10;

/// A crossing is found to this part of its speed \[1], or after so many trials.
const FOUND: f64 = 1e-13;
const TRIALS: u32 = 100;

/// Of the distance of two speeds, a crossing this near to one of them is between them too \[1].
const BESIDE_END: f64 = 1e-6;

impl<'m> Campbell<'m> {
    /// Of these speeds [rad/s], which ascend.
    ///
    /// # Errors
    /// Where there is no steady state at one of them, and where its eigenvalues are not found.
    pub fn of(machine: &'m Machine, speeds: &[f64]) -> Result<Self, Obstacle> {
        let mut all = Self { machine, steady: Vec::new(), branches: Vec::new() };
        let mut open: Vec<usize> = Vec::new();
        for speed in speeds {
            let (steady, modes) = machine.modes(*speed, all.steady.last())?;
            let last: Vec<_> = open.iter().map(|branch| all.last(*branch).clone()).collect();
            let follows = match all.steady.last() {
                Some(before) => machine.follow((before, &last), (&steady, &modes), HALVINGS)?,
                None => Vec::new(),
            };
            let mut next = Vec::new();
            for (n, mode) in modes.into_iter().enumerate() {
                let branch = follows.iter().position(|to| *to == Some(n)).map_or(all.branches.len(), |from| open[from]);
                if branch == all.branches.len() {
                    all.branches.push(Branch { points: Vec::new() });
                }
                all.branches[branch].points.push(Point { speed: *speed, mode });
                next.push(branch);
            }
            open = next;
            all.steady.push(steady);
        }
        Ok(all)
    }

    fn last(&self, branch: usize) -> &Mode {
        &self.branches[branch].points.last().expect("a branch begins with a mode").mode
    }

    /// Where the frequencies are `order` times the speed.
    ///
    /// # Errors
    /// Where there is no steady state on the way, and where a mode cannot be followed to its crossing.
    pub fn critical_speeds(&self, order: f64) -> Result<Vec<Crossing>, Obstacle> {
        self.crossings(|mode, speed| (mode.eigenvalue.im > 0.0).then(|| mode.eigenvalue.im - order * speed.abs()))
    }

    /// Where modes begin or cease to grow.
    ///
    /// # Errors
    /// Where there is no steady state on the way, and where a mode cannot be followed to its threshold.
    pub fn thresholds(&self) -> Result<Vec<Crossing>, Obstacle> {
        let mut found = self.crossings(|mode, _| Some(mode.eigenvalue.re))?;
        // A mode that ends, or begins, between two speeds has no value on one side.
        for pair in self.steady.windows(2) {
            let ends = [pair[0].speed, pair[1].speed];
            // One at an end may be found a rounding beyond it.
            let slack = BESIDE_END * (ends[1] - ends[0]);
            let is_told = found.iter().any(|one| (ends[0] - slack..=ends[1] + slack).contains(&one.speed));
            let [before, after] = ends.map(|speed| self.fastest_growth(speed));
            if before.is_some() != after.is_some() && !is_told {
                found.push(self.onset(&pair[0], [before, after].map(|growth| growth.is_some()), ends)?);
            }
        }
        found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        Ok(found)
    }

    /// Of the modes at one of the speeds, the branch of that which grows fastest, where one does.
    fn fastest_growth(&self, speed: f64) -> Option<(usize, &Mode)> {
        let points = |branch: &'_ Branch| branch.points.iter().position(|point| point.speed == speed);
        let modes =
            self.branches.iter().enumerate().filter_map(|(n, branch)| Some((n, &branch.points[points(branch)?].mode)));
        modes.filter(|(_, mode)| mode.grows()).max_by(|(_, a), (_, b)| a.eigenvalue.re.total_cmp(&b.eigenvalue.re))
    }

    /// Where between these two speeds the first mode begins to grow, or the last one ceases to, by halves; it grows at one of them only.
    fn onset(&self, near: &Steady, grows: [bool; 2], [mut from, mut to]: [f64; 2]) -> Result<Crossing, Obstacle> {
        let (branch, mode) = [from, to].into_iter().find_map(|speed| self.fastest_growth(speed)).expect("one grows");
        let mut mode = mode.clone();
        for _ in 0..TRIALS {
            if to - from <= FOUND * to.abs() {
                break;
            }
            let speed = 0.5 * (from + to);
            let (_, modes) = self.machine.modes(speed, Some(near))?;
            let growing = modes.into_iter().filter(Mode::grows);
            let growing = growing.max_by(|a, b| a.eigenvalue.re.total_cmp(&b.eigenvalue.re));
            *(if growing.is_some() == grows[0] { &mut from } else { &mut to }) = speed;
            mode = growing.unwrap_or(mode);
        }
        Ok(Crossing { branch, speed: 0.5 * (from + to), mode })
    }

    /// Whether any mode grows at one of the speeds.
    pub fn grows(&self) -> bool {
        self.branches.iter().flat_map(|branch| &branch.points).any(|point| point.mode.grows())
    }

    /// Where this changes its sign along the branches.
    fn crossings(&self, of: impl Fn(&Mode, f64) -> Option<f64>) -> Result<Vec<Crossing>, Obstacle> {
        let mut found = Vec::new();
        for (branch, Branch { points }) in self.branches.iter().enumerate() {
            for pair in points.windows(2) {
                let [from, to] = [&pair[0], &pair[1]];
                if let (Some(a), Some(b)) = (of(&from.mode, from.speed), of(&to.mode, to.speed))
                    && is_above(a, &from.mode) != is_above(b, &to.mode)
                {
                    let point = self.root([(from, a), (to, b)], &of)?;
                    found.push(Crossing { branch, speed: point.speed, mode: point.mode });
                }
            }
        }
        found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        Ok(found)
    }

    /// Along the mode, from either end; where that cannot be followed, along the nearest eigenvalues.
    fn root(&self, ends: [(&Point, f64); 2], of: &impl Fn(&Mode, f64) -> Option<f64>) -> Result<Point, Obstacle> {
        let [from, to] = ends;
        let by_shape = |near: &Point, speed: f64| self.machine.followed(near, speed);
        let by_value = |near: &Point, speed: f64| self.machine.nearest(near, speed);
        for ends in [[from, to], [to, from]] {
            if let Some(point) = Self::root_by(ends, of, by_shape)? {
                return Ok(point);
            }
        }
        let lost = Obstacle::NotFollowed { from: from.0.speed, to: to.0.speed };
        Self::root_by(ends, of, by_value)?.ok_or(lost)
    }

    /// By Illinois' rule; None where the mode cannot be followed, or no root is met.
    fn root_by(
        ends: [(&Point, f64); 2],
        of: &impl Fn(&Mode, f64) -> Option<f64>,
        at: impl Fn(&Point, f64) -> Result<Option<Mode>, Obstacle>,
    ) -> Result<Option<Point>, Obstacle> {
        let [(from, mut at_a), (to, mut at_b)] = ends;
        let (mut a, mut b) = (from.speed, to.clone());
        for _ in 0..TRIALS {
            if (b.speed - a).abs() <= FOUND * b.speed.abs() || at_b == 0.0 {
                return Ok(Some(b));
            }
            let speed = b.speed - at_b * (b.speed - a) / (at_b - at_a);
            let Some(mode) = at(&b, speed)? else { return Ok(None) };
            let Some(value) = of(&mode, speed) else { return Ok(None) };
            let is_still = speed == b.speed;
            let (last, at_last) =
                (std::mem::replace(&mut b, Point { speed, mode }), std::mem::replace(&mut at_b, value));
            if (value > 0.0) != (at_last > 0.0) {
                (a, at_a) = (last.speed, at_last);
            } else {
                at_a *= 0.5;
            }
            if is_still {
                return Ok(Some(b));
            }
        }
        Ok(None)
    }
}

/// What is 0 but for rounding is not above.
fn is_above(value: f64, mode: &Mode) -> bool {
    value > GROWS * mode.eigenvalue.modulus()
}

impl Machine {
    /// Which mode at the second place each of the first ones becomes.
    fn follow(
        &self,
        (from, ours): (&Steady, &[Mode]),
        (to, theirs): (&Steady, &[Mode]),
        halvings: u32,
    ) -> Result<Vec<Option<usize>>, Obstacle> {
        let pairs = matched(ours, theirs);
        let is_sure = pairs.iter().all(|pair| pair.is_some_and(|(_, likeness)| likeness > ALIKE));
        if is_sure || halvings == 0 {
            return Ok(pairs.into_iter().map(|pair| pair.map(|(to, _)| to)).collect());
        }
        let (between, modes) = self.modes(0.5 * (from.speed + to.speed), Some(from))?;
        let there = self.follow((from, ours), (&between, &modes), halvings - 1)?;
        let on = self.follow((&between, &modes), (to, theirs), halvings - 1)?;
        Ok(there.into_iter().map(|between| between.and_then(|between| on[between])).collect())
    }

    /// The mode at `speed` [rad/s] that this one becomes.
    fn followed(&self, from: &Point, speed: f64) -> Result<Option<Mode>, Obstacle> {
        let (start, ours) = self.modes(from.speed, None)?;
        let (end, mut theirs) = self.modes(speed, Some(&start))?;
        let is_it = |n: &usize| from.mode.likeness(&ours[*n]);
        let nearest = (0..ours.len()).max_by(|a, b| is_it(a).total_cmp(&is_it(b)));
        let follows = self.follow((&start, &ours), (&end, &theirs), HALVINGS)?;
        Ok(nearest.and_then(|nearest| follows[nearest]).map(|to| theirs.swap_remove(to)))
    }

    /// The mode at `speed` [rad/s] whose eigenvalue is nearest to this one's.
    fn nearest(&self, from: &Point, speed: f64) -> Result<Option<Mode>, Obstacle> {
        let (_, modes) = self.modes(speed, None)?;
        let apart = |mode: &Mode| (mode.eigenvalue - from.mode.eigenvalue).modulus();
        Ok(modes.into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b))))
    }
}

/// Each of ours with the one of theirs that is most like it, and how like; each of theirs once.
fn matched(ours: &[Mode], theirs: &[Mode]) -> Vec<Option<(usize, f64)>> {
    let mut all: Vec<_> = (0..ours.len())
        .flat_map(|a| (0..theirs.len()).map(move |b| (a, b)))
        .map(|(a, b)| (a, b, ours[a].likeness(&theirs[b])))
        .collect();
    all.sort_by(|a, b| b.2.total_cmp(&a.2));
    let (mut pairs, mut taken) = (vec![None; ours.len()], vec![false; theirs.len()]);
    for (a, b, likeness) in all {
        if pairs[a].is_none() && !taken[b] {
            (pairs[a], taken[b]) = (Some((b, likeness)), true);
        }
    }
    pairs
}
