//! Looks whether contacts are chaotic: a small change of the motion then grows from contact to contact until it is as large as the motion.

use super::events::indicators;
use crate::body::{Inertia, ROTOR};
use crate::effects::Effects;
use crate::integrate::System;
use crate::log::shown;
use crate::rotor::Rotor;
use crate::state::{BODY, GAMMA};
use crate::stored::stored;
use std::fmt::{self, Display, Formatter};

/// Contacts that are chaotic, as they were when that was found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rattle {
    /// At which contact the look began \[s], and at which one a small change had grown ten thousandfold \[s].
    pub span: [f64; 2],
}

stored!(Rattle { span });

impl Display for Rattle {
    /// What to warn of.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let [from, to] = self.span.map(shown);
        write!(
            f,
            "the contacts with the ring are chaotic: from t = {from:?} s to t = {to:?} s a small change of the motion grows by a factor of \
             {GROWTH}, so from there on another tolerance, or a start that is a little different, gives another motion; trust what many \
             runs have in common, not a single run"
        )
    }
}

/// A small change that grows by this from contact to contact is chaos \[1].
const GROWTH: f64 = 1e4;

/// Beside what it is at most at the first contacts, at each of which a ring begins to press or lets go: there it has turned into the
/// directions that grow.
const FIRST: u32 = 10;

/// It must have grown so by the last of so many; what has fallen behind after the least is not looked at again until there were twice as
/// many as by then.
const LAST: u32 = 200;
const LEAST: u32 = 40;

/// The series of a step ends with a term of this part of its sum \[1], or after so many: a step of `stiff` may be too long for it.
const SMALL: f64 = 1e-4;
const MOST_TERMS: u32 = 24;

/// An indicator's slope is that to a place which is off by this part of the radius of gyration \[1].
const NEAR: f64 = 1e-9;

/// The effect that contacts are of.
const RING: &str = "rub";

/// The coordinates but φ, whose change grows with the time where the spin changes.
const CHANGED: usize = BODY;

/// Follows a small change of the motion, to first order: to see by what power of 10 it grows.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rattles {
    /// How often a ring began to press or let go.
    switches: u32,
    /// At which of these the look began, or will.
    first: u32,
    /// When it began \[s], while it lasts.
    since: Option<f64>,
    /// The small change \[m], [m/s], [kg·m²/s], \[rad], how far it went at the first contacts \[1], and so far.
    change: [f64; CHANGED],
    reached: f64,
    largest: f64,
    found: Option<Rattle>,
}

stored!(Rattles { switches, first, since, change, reached, largest, found });

/// Where a law switches: the motion beside comes there `later` \[s], to first order, and goes on until then as before, at this rate.
pub(super) struct Switch {
    later: f64,
    rate: [f64; CHANGED],
}

impl Rattles {
    /// The contacts that were found first to be chaotic.
    pub fn found(&self) -> Option<Rattle> {
        self.found
    }

    /// What is looked at begins anew at the next contact: the motion goes on otherwise.
    pub fn restart(&mut self) {
        if self.since.take().is_some() {
            self.first = self.switches;
        }
    }

    /// The motion has gone on by a step between these times \[s] and states.
    pub fn follow<E: Effects, const N: usize>(
        &mut self,
        rotor: &Rotor<'_, E>,
        [from, to]: [f64; 2],
        ends: [&[f64; N]; 2],
    ) {
        if self.since.is_none() {
            return;
        }
        let (h, middle) = (to - from, std::array::from_fn(|n| 0.5 * (ends[0][n] + ends[1][n])));
        let (mut power, mut sum, place) = ([0.0; N], self.change, E::layout::<N>().body(ROTOR));
        power[place.clone()].copy_from_slice(&self.change);
        let body = &rotor.frame.body;
        for n in 1..=MOST_TERMS {
            // eq. 122: xₙ = (h/n) A xₙ₋₁
            let next = rotor.slope_along(0.5 * (from + to), &middle, &power);
            let part = changed::<E, N>(&next).map(|rate| rate * (h / f64::from(n)));
            power[place.clone()].copy_from_slice(&part);
            sum = std::array::from_fn(|i| sum[i] + part[i]);
            if n > 1 && size(body, &part) < SMALL * size(body, &sum) {
                self.change = sum;
                return;
            }
        }
        self.restart();
    }

    /// At time `t` \[s] and state `y` the law will switch whose indicator has this number. None where nothing is followed, or the motion
    /// only grazes the switch.
    pub fn switches<E: Effects, const N: usize>(
        &self,
        rotor: &Rotor<'_, E>,
        t: f64,
        y: &[f64; N],
        number: u32,
    ) -> Option<Switch> {
        self.since?;
        let rate = changed::<E, N>(&rotor.rates::<true, false>(t, y));
        let all = |y: &[f64; N]| indicators(rotor.effects, &rotor.motion(t, y), y);
        let indicator = |y: &[f64; N]| all(y).get(number as usize).copied().unwrap_or(f64::NAN);
        let slope = |along: &[f64; CHANGED]| {
            let (mut beside, part) = (*y, NEAR / size(&rotor.frame.body, along));
            beside[E::layout::<N>().body(ROTOR)].iter_mut().zip(along).for_each(|(y, along)| *y += part * along);
            (indicator(&beside) - indicator(y)) / part
        };
        let later = -slope(&self.change) / slope(&rate);
        later.is_finite().then_some(Switch { later, rate })
    }

    /// The law has switched at time `t` \[s] and state `y`: the motion goes on as that of this rotor.
    pub fn switched<E: Effects, const N: usize>(
        &mut self,
        rotor: &Rotor<'_, E>,
        t: f64,
        y: &[f64; N],
        switch: Option<Switch>,
    ) {
        if self.found.is_some() || !rotor.effects.active().any(|block| block.kind().name == RING) {
            return;
        }
        if let Some(Switch { later, rate }) = switch {
            let after = changed::<E, N>(&rotor.rates::<true, false>(t, y));
            // eq. 123: x₊ = x₋ + (f₋ − f₊) τ
            self.change = std::array::from_fn(|n| self.change[n] + (rate[n] - after[n]) * later);
        }
        self.switches = self.switches.saturating_add(1);
        let body = &rotor.frame.body;
        let Some(since) = self.since else {
            if self.switches >= self.first {
                (self.since, self.first, self.largest) = (Some(t), self.switches, 0.0);
                self.change = start(body);
            }
            return;
        };
        let seen = self.switches.saturating_sub(self.first);
        self.largest = self.largest.max(size(body, &self.change));
        if seen <= FIRST {
            self.reached = self.largest;
            return;
        }
        let behind = || libm::pow(GROWTH, f64::from(seen) / f64::from(LAST)) * self.reached > self.largest;
        if self.largest > GROWTH * self.reached {
            self.found = Some(Rattle { span: [since, t] });
            self.since = None;
        } else if seen >= LEAST && behind() {
            (self.since, self.first) = (None, self.switches.saturating_mul(2));
        }
    }
}

/// What of a rate is one of a small change.
fn changed<E: Effects, const N: usize>(rate: &[f64; N]) -> [f64; CHANGED] {
    let first = E::layout::<N>().body(ROTOR).start;
    std::array::from_fn(|n| rate[first + n])
}

/// A change of place and tilt that favours no direction.
fn start(body: &Inertia) -> [f64; CHANGED] {
    let mut change = [0.0; CHANGED];
    change[..3].copy_from_slice(&[0.3, 0.8, -0.5].map(|part| part * body.radius()));
    change[GAMMA].copy_from_slice(&[0.7, 0.4]);
    change
}

/// How far place and axis go with a change \[1].
fn size(body: &Inertia, change: &[f64; CHANGED]) -> f64 {
    let norm = |part: &[f64]| part.iter().map(|x| x * x).sum::<f64>().sqrt();
    norm(&change[..3]) / body.radius() + norm(&change[GAMMA])
}
