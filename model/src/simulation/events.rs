//! Events of effects: where an indicator changes its sign, a law goes on as another one.
//!
//! A law keeps its branch through a step, so that the step is smooth; where an indicator has changed its sign on the way, the step
//! ends there, and the law switches before the next one begins.

use crate::effects::{Effects, MOST_INDICATORS};
use crate::scalar::ulp;
use crate::state::Kinematics;
use crate::stored::stored;

/// The values of all indicators of a list.
pub(super) type Indicators = [f64; MOST_INDICATORS];

/// On which side each indicator is.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Events {
    /// Whether it is positive, as the laws have it.
    positive: [bool; MOST_INDICATORS],
    /// The number of the one that changes its sign where the last step ended.
    due: Option<u32>,
}

stored!(Events { positive, due });

/// A contact shorter than the way between two places of a step is looked for where a parabola through three of them is lowest by less than
/// this part of what they differ by: it is as good as that, as long as what swings is seen in ten places \[1].
const NEAR: f64 = 0.1;

/// A jump changes the sides of indicators at most so often until all laws hold where it ends.
const MOST_JUMPED: u32 = 8;

impl Events {
    /// Of a motion that begins, of whose sides the effects hear.
    pub(super) fn begin<E: Effects, const N: usize>(
        effects: &mut E,
        motion: &Kinematics<f64>,
        state: &[f64; N],
    ) -> Self {
        let mut events = Self::default();
        events.take_sides(effects, motion, state);
        events
    }

    /// Takes the sides that the indicators have now, of which the effects hear; whether any is another one.
    pub(super) fn take_sides<E: Effects, const N: usize>(
        &mut self,
        effects: &mut E,
        motion: &Kinematics<f64>,
        state: &[f64; N],
    ) -> bool {
        if E::FACTS.indicators == 0 {
            return false;
        }
        let before = std::mem::replace(&mut self.positive, indicators(effects, motion, state).map(|z| z > 0.0));
        self.tell(effects, motion, state);
        before != self.positive
    }

    /// The motion has jumped, and with it the indicators, some of them past more than one switch.
    pub(super) fn jump<E: Effects, const N: usize>(
        &mut self,
        effects: &mut E,
        motion: &Kinematics<f64>,
        state: &[f64; N],
    ) {
        for _ in 0..MOST_JUMPED {
            if !self.take_sides(effects, motion, state) {
                return;
            }
            self.forget();
        }
    }

    /// Whether an indicator is now on another side.
    pub(super) fn would_change<E: Effects, const N: usize>(
        &self,
        effects: &E,
        motion: &Kinematics<f64>,
        state: &[f64; N],
    ) -> bool {
        E::FACTS.indicators > 0 && indicators(effects, motion, state).map(|z| z > 0.0) != self.positive
    }

    /// Indicators as a host is to see them: what is zero is still on the side that its law has. A host that starts from zero would not
    /// see the sign change that follows: CVode drops such a root, and a shaft that begins to press on its ring would fall on.
    pub(super) fn sided(&self, values: Indicators) -> Indicators {
        let least = |positive| if positive { f64::MIN_POSITIVE } else { -f64::MIN_POSITIVE };
        std::array::from_fn(|n| if values[n] == 0.0 { least(self.positive[n]) } else { values[n] })
    }

    /// The number of the indicator whose law must switch before the motion goes on.
    pub(super) fn due(&self) -> Option<u32> {
        self.due
    }

    /// The next step begins elsewhere.
    pub(super) fn forget(&mut self) {
        self.due = None;
    }

    /// A law must switch where the motion is now.
    pub(super) fn expect(&mut self, number: u32) {
        self.due = Some(number);
    }

    /// The law switches that must.
    pub(super) fn switch<E: Effects, const N: usize>(
        &mut self,
        effects: &mut E,
        motion: &Kinematics<f64>,
        state: &[f64; N],
    ) {
        let due = self.due.take().and_then(|number| self.positive.get_mut(number as usize));
        if let Some(positive) = due {
            *positive = !*positive;
            self.tell(effects, motion, state);
        }
    }

    /// The effects take the sides that are known.
    pub(super) fn tell<E: Effects, const N: usize>(&self, effects: &mut E, motion: &Kinematics<f64>, state: &[f64; N]) {
        if E::FACTS.indicators > 0 {
            effects.switch(&self.positive, motion, &state[E::layout::<N>().own()]);
        }
    }

    /// When \[s] the first of these indicators changes its sign between the times `from` and `to` \[s], looked at in so many `places`, and
    /// its number; `at` tells the values of all.
    pub(super) fn first(
        &self,
        watched: impl Iterator<Item = usize> + Clone,
        [from, to]: [f64; 2],
        places: u32,
        mut at: impl FnMut(f64) -> Indicators,
    ) -> Option<(f64, u32)> {
        let place = |n: u32| if n == places { to } else { from + (to - from) * f64::from(n) / f64::from(places) };
        // What is positive is on its side.
        let side_of = |z: &Indicators, n: usize| if self.positive[n] { z[n] } else { -z[n] };
        let start = at(from);
        // What has just switched may still be on the other side by as much as the tolerance allows: it counts from there.
        let sided = |z: Indicators, n: usize| {
            let at_start = side_of(&start, n);
            if at_start < 0.0 { side_of(&z, n) - at_start } else { side_of(&z, n) }
        };
        let (mut before, mut found) = ([(from, start); 2], None::<(f64, u32)>);
        for n in 1..=places {
            let now = (place(n), at(place(n)));
            // One place beyond, for what may dip before the first that was found.
            let is_beyond = found.is_some();
            for number in watched.clone() {
                let [first, middle, last] = [before[0], before[1], now].map(|(t, z)| (t, sided(z, number)));
                let mut side = |t: f64| sided(at(t), number);
                let crossed = if last.1 < 0.0 {
                    (!is_beyond).then_some((middle.0, last.0))
                } else if first.0 < middle.0 && may_dip([first.1, middle.1, last.1]) {
                    lowest(first.0, last.0, &mut side).map(|low| (first.0, low))
                } else {
                    None
                };
                if let Some((good, bad)) = crossed {
                    let t = zero(good, bad, side);
                    if found.is_none_or(|(earliest, _)| t < earliest) {
                        found = Some((t, number as u32));
                    }
                }
            }
            if is_beyond {
                break;
            }
            before = [before[1], now];
        }
        found
    }
}

/// Whether what is positive in these three places, equally far apart, may be negative between them.
fn may_dip([first, middle, last]: [f64; 3]) -> bool {
    // The parabola m + s x + c x², x from −1 to 1, is lowest at x = −s/2c.
    let (slope, bend) = (0.5 * (last - first), 0.5 * (first + last) - middle);
    let is_within = bend > 0.0 && slope.abs() <= 2.0 * bend;
    let apart = first.max(middle).max(last) - first.min(middle).min(last);
    is_within && middle - slope * slope / (4.0 * bend) < NEAR * apart
}

/// The values of all indicators, 1 of those that are switched off.
pub(super) fn indicators<E: Effects, const N: usize>(
    effects: &E,
    motion: &Kinematics<f64>,
    state: &[f64; N],
) -> Indicators {
    let mut all = [1.0; MOST_INDICATORS];
    effects.indicators(motion, &state[E::layout::<N>().own()], &mut all);
    all
}

/// Where a function that is positive at both ends is negative between them, if it is, by golden sections.
fn lowest(mut low: f64, mut high: f64, at: &mut impl FnMut(f64) -> f64) -> Option<f64> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    const SECTIONS: u32 = 40;
    for _ in 0..SECTIONS {
        let [a, b] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        let [at_a, at_b] = [at(a), at(b)];
        if at_a < 0.0 || at_b < 0.0 {
            return Some(if at_a < 0.0 { a } else { b });
        }
        if at_a < at_b {
            high = b;
        } else {
            low = a;
        }
    }
    None
}

/// Where a function changes its sign between a time where it is on its side and one where it is not: the first time at which it is
/// not, to rounding (regula falsi, Illinois's variant: Dowell and Jarratt 1971).
fn zero(mut good: f64, mut bad: f64, mut at: impl FnMut(f64) -> f64) -> f64 {
    const TRIES: u32 = 200;
    /// The least part of the way that a chord goes: 12 of them reach rounding \[1].
    const NEAREST: f64 = 1.0 / 16.0;
    let positive = |z: f64| if z > 0.0 { z } else { 0.0 };
    let (mut above, mut below) = (positive(at(good)), -positive(-at(bad)));
    for n in 0..TRIES {
        if (bad - good).abs() <= 2.0 * ulp(bad) {
            break;
        }
        // What has just switched is hardly on its side: the chord would end in what rounding leaves of that.
        let chord = above / (above - below);
        let part = if chord < NEAREST { NEAREST } else { chord };
        // Where the chord does not help, halves do.
        let part = if n % 4 == 3 || !(part > 0.0 && part < 1.0) { 0.5 } else { part };
        let t = good + part * (bad - good);
        let t = if t <= good || t >= bad { 0.5 * (good + bad) } else { t };
        let z = at(t);
        if z < 0.0 {
            (bad, below, above) = (t, z, 0.5 * above);
        } else {
            (good, above, below) = (t, z, 0.5 * below);
        }
    }
    bad
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_dip_at_either_end_of_a_step_is_seen() {
        let mut all = Events::default();
        all.positive[0] = true;
        for middle in [0.004, 0.03, 0.4, 0.5, 0.97, 0.996] {
            for depth in [1e-3, 1e-6, 1e-9] {
                let at = |t: f64| {
                    let mut indicators = [1.0; MOST_INDICATORS];
                    indicators[0] = (t - middle) * (t - middle) - depth * depth;
                    indicators
                };
                let (t, _) = all.first(0..1, [0.0, 1.0], 16, at).expect("it is below zero");
                assert!((t - (middle - depth)).abs() < 1e-6 * depth, "{t} is not {middle} less {depth}");
            }
        }
    }

    #[test]
    fn exact_the_lowest_place_is_found_on_either_side() {
        for place in [0.1, 0.45, 0.9] {
            // Below zero only nearby, and never.
            let found = lowest(0.0, 1.0, &mut |t| (t - place).abs() - 1e-6).expect("it is below zero");
            assert!((found - place).abs() < 1e-6, "{found} is not {place}");
            assert_eq!(lowest(0.0, 1.0, &mut |t| (t - place).abs() + 1e-6), None);
        }
    }
}
