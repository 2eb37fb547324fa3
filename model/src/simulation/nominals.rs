//! How large a motion will be, as far as its start tells: for hosts that integrate themselves, and for a method until it has
//! seen the motion.

use super::start::Motion;
use crate::body::ROTOR;
use crate::effects::Effects;
use crate::integrate::System;
use crate::integrate::sizes::{MOST_GROUPS, Squares};
use crate::integrate::stiff::Differentiable;
use crate::rotor::groups::squares;
use crate::state::GAMMA;

/// One length \[m] and one rate [rad/s], and what goes with them.
#[derive(Clone, Copy, Debug)]
pub struct Nominals<const N: usize> {
    /// Of r \[m].
    pub place: f64,
    /// Of v [m/s].
    pub velocity: f64,
    /// Of K [kg·m²/s].
    pub momentum: f64,
    /// Of γ \[rad].
    pub tilt: f64,
    /// Of work \[J].
    pub work: f64,
    /// Of the own states, which come first.
    pub own: [f64; N],
    /// Of the loads, squared, where they stand among the groups.
    loads: Squares,
}

/// Of its radius of gyration a rotor moves so much where nothing else is known \[1].
const UNKNOWN: f64 = 1e-6;

impl<const N: usize> Nominals<N> {
    /// Of a motion that starts at time `t` \[s] and lasts for `span` \[s], infinite where nobody knows.
    pub(super) fn of<E: Effects>(
        effects: &E,
        Motion { bodies, state, own_nominal, .. }: &Motion<N>,
        t: f64,
        span: f64,
    ) -> Self {
        let rotor = bodies.under(effects);
        let (rates, jacobian, first) =
            (rotor.rates_of_all(t, state), rotor.jacobian(t, state), E::layout::<N>().body(ROTOR).start);
        let slope = |rate: usize, at: usize| jacobian[first + rate][first + at];
        let body = &rotor.frame.body;
        let (jt, omega) = (1.0 / body.per_jt, rotor.motion(t, state).omega.norm());
        let radius = (jt * body.per_m).sqrt();
        // Across e, by number: the rate of v or K, and the place or tilt that a spring answers; in metres.
        let springs =
            [(4, 1, 1.0, 1.0), (5, 2, 1.0, 1.0), (7, GAMMA.start, jt, radius), (8, GAMMA.start + 1, jt, radius)];
        let swings = springs.iter().map(|&(rate, at, inertia, _)| (slope(rate, at) / inertia).abs().sqrt());
        let rate = swings.filter(|rate| rate.is_finite()).fold(omega, larger);
        let rate = if rate > 0.0 && rate.is_finite() { rate } else { 1.0 };
        // How far springs give way to what pushes at the start: by (ωT)²/2 of that, where the run ends before they swing.
        let gives = springs.map(|(rate, at, inertia, length)| {
            let share = 0.5 * (slope(rate, at) / inertia).abs() * span * span;
            (rates[first + rate] / slope(rate, at)).abs() * length * if share < 1.0 { share } else { 1.0 }
        });
        let eccentricity = body.asymmetric.map_or(0.0, |asymmetric| asymmetric.centre.yz().norm());
        let at = rotor.at(state);
        let (offset, tilt, speed) = (at.r.yz().norm(), at.gamma.norm(), at.v.yz().norm() / rate);
        let known = gives.into_iter().chain([eccentricity, offset, tilt * radius, speed]);
        // What is smallest must still be seen.
        let least = known.filter(|length| length.is_finite() && *length > 0.0).fold(f64::INFINITY, f64::min);
        let unknown = UNKNOWN * radius;
        let place = if least.is_finite() { larger(least, unknown) } else { unknown };
        let tilt = place / radius;
        let velocity = rate * place;
        let mut loads = [0.0; MOST_GROUPS];
        rotor.round_loads::<N>(&at, [place, velocity, tilt, rate * tilt], &mut loads);
        Self {
            place,
            velocity,
            momentum: jt * rate * tilt,
            tilt,
            work: body.m * velocity * velocity,
            own: *own_nominal,
            loads,
        }
    }

    /// In the groups of [`crate::rotor::groups`], squared.
    pub(super) fn squares<E: Effects>(&self) -> Squares {
        let Self { place, velocity, momentum, tilt, work, .. } = *self;
        let groups = [place, place, velocity, velocity, momentum, momentum, tilt, 1.0, work];
        let rigid = squares(&self.own[E::layout::<N>().own()], groups.map(|size| size * size));
        // Neither has any where the other has.
        std::array::from_fn(|group| rigid[group] + self.loads[group])
    }

    /// Of each number of the state.
    pub(super) fn each<E: Effects>(&self) -> [f64; N] {
        let Self { place, velocity, momentum, tilt, own: mut nominals, .. } = *self;
        let layout = E::layout::<N>();
        nominals[layout.own().end..].fill(1.0);
        for (n, nominal) in nominals[layout.body(ROTOR)].iter_mut().enumerate() {
            let size = [place, velocity, momentum, tilt][n / 3];
            // Of absurd parameters no size may come of it that a host cannot take.
            *nominal = if size > 0.0 && size.is_finite() { size } else { 1.0 };
        }
        nominals
    }
}

fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
