//! Where a law goes on in another branch: a ring is touched or lets go, a speed passes a node of a table.
//!
//! A step is made in one branch, so that it is smooth. Each branch has a margin that is positive as long as it holds; a step in
//! which one becomes negative is made again, shorter and shorter, until it ends there.

use super::laws::{Laws, SIZE, State};

/// What becomes of a state within a part of a step \[s].
pub(super) type Part<'a> = &'a mut dyn FnMut(f64) -> State;

/// A step up to where a branch ends.
pub(super) struct Switch {
    /// Its size \[s].
    pub h: f64,
    /// By how much the state changes.
    pub gained: State,
    /// Which branch ends.
    pub number: usize,
}

/// A rate of a margin is seen over this part of a step \[1].
const ASIDE: f64 = 1e-6;

/// A margin that is less than so many times what its rate makes of it in a step is looked at in so many places.
const NEAR: f64 = 1.0;
const LOOKS: u32 = 12;

/// A way is halved so often at most.
const HALVES: u32 = 60;

fn plus(y: &State, gained: &State, part: f64) -> State {
    std::array::from_fn(|n| y[n] + part * gained[n])
}

impl Laws {
    /// Whether any law has branches.
    pub fn has_branches(&self) -> bool {
        !self.rubs.is_empty() || !self.tables.is_empty()
    }

    /// The margins of all branches: of each ring, and of both ends of each table's piece.
    fn margins(&self, y: &State) -> Vec<f64> {
        let motion = self.motion(y);
        let of_ring = |(rub, presses): &(super::Rub, bool)| {
            let pressed = rub.pressed(&motion.station(rub.position));
            if *presses { pressed } else { -pressed }
        };
        let of_tables = self.tables.iter().flat_map(|table| table.within(motion.speed()));
        self.rubs.iter().map(of_ring).chain(of_tables).collect()
    }

    /// So much of a step of `h` \[s] from `y`, where the rates are these, that no shaft that slides on a ring turns back in it: friction would
    /// drive the points of the midpoint rule to and fro, the same in all columns, and stay out of sight.
    pub fn within_sliding(&self, y: &State, rates: &State, h: f64) -> f64 {
        let pressed = self.rubs.iter().filter(|(rub, presses)| *presses && rub.friction > 0.0);
        let longest = pressed.map(|(rub, _)| {
            let [now, next] = [0.0, ASIDE * h].map(|ahead| {
                let motion = self.motion(&plus(y, rates, ahead));
                rub.sliding(&motion.station(rub.position), motion.speed())
            });
            (0.5 * now.abs()).max(rub.v0) / ((next - now) / (ASIDE * h)).abs()
        });
        longest.fold(h, f64::min)
    }

    /// Takes the branches of a state.
    pub fn take_branches(&mut self, y: &State) {
        if !self.has_branches() {
            return;
        }
        let motion = self.motion(y);
        self.rubs.iter_mut().for_each(|(rub, presses)| *presses = rub.pressed(&motion.station(rub.position)) > 0.0);
        self.tables.iter_mut().for_each(|table| table.follow(motion.speed()));
    }

    /// Goes on beyond the branch of this number.
    pub fn switch(&mut self, number: usize) {
        if let Some((_, presses)) = self.rubs.get_mut(number) {
            *presses = !*presses;
            return;
        }
        let end = number - self.rubs.len();
        let below = &mut self.tables[end / 2].below;
        *below = if end.is_multiple_of(2) { *below - 1 } else { *below + 1 };
    }

    /// The first branch that ends in a step of size `h` \[s] from `y`: `rates` there and at its end, and what changes in its parts.
    pub fn first_switch(
        &self,
        y: &State,
        h: f64,
        gained: &State,
        mut rates: impl FnMut(f64, &State) -> State,
        part: Part,
    ) -> Option<Switch> {
        let after = plus(y, gained, 1.0);
        let [at_first, at_last] = [rates(0.0, y), rates(h, &after)];
        // The rate of a margin, by the state's rates.
        let slopes = |y: &State, rates: &State| {
            let [ahead, behind] = [1.0, -1.0].map(|side| self.margins(&plus(y, rates, side * ASIDE * h)));
            ahead.iter().zip(&behind).map(|(a, b)| (a - b) / (2.0 * ASIDE * h)).collect::<Vec<_>>()
        };
        let [margins, margins_after] = [y, &after].map(|y| self.margins(y));
        let [slopes_first, slopes_last] = [slopes(y, &at_first), slopes(&after, &at_last)];
        let mut found: Option<Switch> = None;
        for number in 0..margins.len() {
            let [before, after] = [margins[number], margins_after[number]];
            let [falls, rises] = [slopes_first[number], slopes_last[number]];
            let mut margin = |h: f64| self.margins(&plus(y, &part(h), 1.0))[number];
            // What is near its end may turn more than once in a step.
            let near = before.min(after) < NEAR * h * falls.abs().max(rises.abs());
            let looks = if near { LOOKS } else { 0 };
            let negative = (1..looks).map(|n| h * f64::from(n) / f64::from(LOOKS)).find(|t| margin(*t) < 0.0);
            let beyond = if let Some(t) = negative {
                t
            } else if after < 0.0 {
                h
            } else if falls < 0.0 && rises > 0.0 && {
                // Where the tangents at both ends meet.
                let meet = (after - before - rises * h) / (falls - rises);
                before + falls * meet < 0.0
            } {
                match lowest(h, &mut margin) {
                    Some(beyond) => beyond,
                    None => continue,
                }
            } else {
                continue;
            };
            let end = last_within(beyond, falls > 0.0, &mut margin);
            if found.as_ref().is_none_or(|earliest| end < earliest.h) {
                found = Some(Switch { h: end, gained: [0.0; SIZE], number });
            }
        }
        found.map(|switch| Switch { gained: part(switch.h), ..switch })
    }
}

/// A time \[s] in a step of size `h` \[s] at which a margin that falls and rises is negative, if there is one, by thirds.
fn lowest(h: f64, margin: &mut impl FnMut(f64) -> f64) -> Option<f64> {
    let (mut a, mut b) = (0.0, h);
    for _ in 0..HALVES {
        let [near, far] = [a + (b - a) / 3.0, b - (b - a) / 3.0];
        let [at_near, at_far] = [margin(near), margin(far)];
        if at_near < 0.0 {
            return Some(near);
        }
        if at_far < 0.0 {
            return Some(far);
        }
        if at_near < at_far { b = far } else { a = near }
    }
    None
}

/// The time \[s] at which a margin becomes negative before `beyond` \[s], where it is; it is 0 or more at the start, and `rises`
/// there or not.
fn last_within(beyond: f64, rises: bool, margin: &mut impl FnMut(f64) -> f64) -> f64 {
    let (mut good, mut bad) = (0.0, beyond);
    let (mut above, mut below) = (margin(good).max(0.0), margin(bad));
    // What has only just switched has hardly a margin: it is looked for where it has one.
    for _ in 0..HALVES {
        if !rises || good > 0.0 {
            break;
        }
        let t = 0.5 * bad;
        match margin(t) {
            z if z > 0.0 => (good, above) = (t, z),
            z => (bad, below) = (t, z),
        }
    }
    // By chords, the end that stays counting half (Illinois's variant), and by halves in between.
    for n in 0..2 * HALVES {
        let chord = above / (above - below);
        let part = if n % 4 == 3 || !(chord > 0.0 && chord < 1.0) { 0.5 } else { chord };
        let t = good + part * (bad - good);
        if t <= good || t >= bad {
            break;
        }
        match margin(t) {
            z if z < 0.0 => (bad, below, above) = (t, z, 0.5 * above),
            z => (good, above, below) = (t, z, 0.5 * below),
        }
    }
    bad
}
