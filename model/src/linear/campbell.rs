//! Modes followed through a range of speeds.

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

impl Branch {
    /// Its point at one of the speeds [rad/s], if it has one there.
    pub fn at(&self, speed: f64) -> Option<&Point> {
        self.points.iter().find(|point| point.speed == speed)
    }
}

/// The modes of a machine from one speed to another.
pub struct Campbell<'m> {
    pub(super) machine: &'m Machine,
    /// Where it runs steadily, by speed.
    pub steady: Vec<Steady>,
    /// Its modes.
    pub branches: Vec<Branch>,
}

/// Two modes are one where they are more alike than this \[1], or there is no speed left between them.
const ALIKE: f64 = 0.9;

/// An interval is halved so often to follow a mode.
const HALVINGS: u32 = 10;

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

    /// The modes at one of the speeds [rad/s], each with its branch.
    pub fn at(&self, speed: f64) -> impl Iterator<Item = (usize, &Mode)> {
        let points = self.branches.iter().map(move |branch| branch.at(speed));
        points.enumerate().filter_map(|(branch, point)| Some((branch, &point?.mode)))
    }

    /// Whether any mode grows at one of the speeds.
    pub fn grows(&self) -> bool {
        self.branches.iter().flat_map(|branch| &branch.points).any(|point| point.mode.grows())
    }
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
    pub(super) fn followed(&self, from: &Point, speed: f64) -> Result<Option<Mode>, Obstacle> {
        let (start, ours) = self.modes(from.speed, None)?;
        let (end, mut theirs) = self.modes(speed, Some(&start))?;
        let is_it = |n: &usize| from.mode.likeness(&ours[*n]);
        let nearest = (0..ours.len()).max_by(|a, b| is_it(a).total_cmp(&is_it(b)));
        let follows = self.follow((&start, &ours), (&end, &theirs), HALVINGS)?;
        Ok(nearest.and_then(|nearest| follows[nearest]).map(|to| theirs.swap_remove(to)))
    }

    /// The mode at `speed` [rad/s] whose eigenvalue is nearest to this one's.
    pub(super) fn nearest(&self, from: &Point, speed: f64) -> Result<Option<Mode>, Obstacle> {
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
