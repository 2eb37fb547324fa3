//! The groups of a motion whose errors count together, and how large each is: r \[m] and v [m/s] along e and across it, K
//! [kg·m²/s] along K and across it, γ \[rad], φ \[rad], the work supplied and lost \[J]; then the loads \[N], [N·m].

use super::Rotor;
use crate::body::ROTOR;
use crate::effects::Effects;
use crate::integrate::System;
use crate::integrate::sizes::{MOST_GROUPS, Squares};
use crate::rotation::Tilt;
use nalgebra::Vector3;

/// How many there are, beside the own states, which come first, each a group of its own.
pub const RIGID: usize = 9;
/// The number of K across K among them.
pub const ACROSS: usize = 5;
/// The number of γ among them.
pub const GAMMA: usize = 6;
/// The number of φ.
pub const PHI: usize = 7;

/// The own states' squares and those of the rigid motion.
#[inline(always)]
pub(crate) fn squares(own: &[f64], rigid: [f64; RIGID]) -> Squares {
    let mut squares = [0.0; MOST_GROUPS];
    for n in 0..own.len() {
        squares[n] = own[n] * own[n];
    }
    squares[own.len()..][..RIGID].copy_from_slice(&rigid);
    squares
}

/// |v|² along e and across it.
#[inline(always)]
fn split(v: &Vector3<f64>) -> [f64; 2] {
    [v.x * v.x, v.y * v.y + v.z * v.z]
}

impl<E: Effects> Rotor<'_, E> {
    /// [`System::sizes`]: how far c and γ are from where they are counted from, how fast the axis turns, 1 rad for φ, and for work
    /// the kinetic energy, or up to twice as much.
    ///
    /// What happens along e is second order in what happens across it, and counts beside that. Where the mass centre is off the axis,
    /// r and v go round with it; what c does beside that may be far less, and then φ must be known as well.
    #[inline(always)]
    pub(super) fn sizes_of<const N: usize>(&self, y: &[f64; N], rate: &[f64; N], origin: &[f64; N]) -> Squares {
        let [at, rate, origin] = [y, rate, origin].map(|y| self.at(y));
        let (mut way, mut speed, mut phi) = (at.r - origin.r, at.v, 1.0);
        let centre = self.frame.body.asymmetric.map_or_else(Vector3::zeros, |asymmetric| asymmetric.centre);
        let eccentricity = split(&centre)[1];
        if eccentricity > 0.0 {
            let [now, then] = [at, origin].map(|at| Tilt::new(self.frame.chart, at.gamma).attitude(at.phi));
            // eq. 79: r_c − r_c0 = r − r0 − (R − R0) b, v_c = v − dφ/dt t×R b
            way -= (now - then) * centre;
            speed -= now.column(0).cross(&(now * centre)) * rate.phi;
            phi = (split(&way)[1] / eccentricity).min(1.0);
        }
        let ([x, r], [vx, v]) = (split(&way), split(&speed));
        let jt = 1.0 / self.frame.body.per_jt;
        // eq. 84: |K| along K, Jt |dγ/dt| across it
        let across = rate.gamma.norm_squared() * (jt * jt);
        let (k, tilt) = (at.k.norm_squared(), (at.gamma - origin.gamma).norm_squared());
        let per_j = self.frame.body.per_jt + larger(self.frame.body.spin, 0.0);
        // Where a speed is imposed, K lacks what the imposing torque gave: ω_φ has it.
        let driven = if E::FACTS.imposes && self.effects.imposed(0.0).is_some() {
            rate.phi * rate.phi / (self.frame.body.per_jt + self.frame.body.spin)
        } else {
            0.0
        };
        let kinetic = 0.5 * (self.frame.body.m * at.v.norm_squared() + k * per_j + driven);
        let mut squares = squares(
            &y[E::layout::<N>().own()],
            [larger(x, r), r, larger(vx, v), v, k, across, tilt, phi, kinetic * kinetic],
        );
        self.size_loads::<N>([&at, &rate, &origin], [way, speed], &mut squares);
        squares
    }

    /// [`System::parts`].
    #[inline(always)]
    pub(super) fn parts_of<const N: usize>(&self, t: f64, y: &[f64; N], change: &[f64; N]) -> Squares {
        let mut squares = self.parts_of_motion(y, change);
        self.part_loads(t, y, &self.at(change), &mut squares);
        squares
    }

    /// The same, without the loads.
    #[inline(always)]
    pub(crate) fn parts_of_motion<const N: usize>(&self, y: &[f64; N], change: &[f64; N]) -> Squares {
        let (k, by) = (self.at(y).k, self.at(change));
        let ([x, r], [vx, v]) = (split(&by.r), split(&by.v));
        let square = k.norm_squared();
        let (dot, cross) = (k.dot(&by.k), k.cross(&by.k).norm_squared());
        // eq. 84: |K·δK|/|K| and |K×δK|/|K|
        let [along, across] =
            if square > 0.0 { [dot * dot / square, cross / square] } else { [0.0, by.k.norm_squared()] };
        let gamma = by.gamma.norm_squared();
        // eq. 121: Jt d(dt/dt) = dK×t + K×dt
        let across =
            if E::FACTS.shows_velocity && self.effects.shows_velocity() { across + square * gamma } else { across };
        let layout = E::layout::<N>();
        // As a quadrature it has no part in the error.
        let phi = if System::<N>::depended_on(self) > layout.phi(ROTOR) { by.phi * by.phi } else { 0.0 };
        let [supplied, dissipated] = layout.read_work(change);
        let work = supplied * supplied + dissipated * dissipated;
        squares(&change[layout.own()], [x, r, vx, v, along, across, gamma, phi, work])
    }

    /// [`System::roundings`]: a velocity is known no better than the place over the step allows,
    /// a tilt no better than the way of the step.
    #[inline(always)]
    pub(super) fn roundings_of<const N: usize>(&self, y: &[f64; N], h: f64) -> Squares {
        let (at, layout) = (self.at(y), E::layout::<N>());
        let ([x, r], [vx, v], k) = (split(&at.r), split(&at.v), at.k.norm_squared());
        let (per_h, jt, gamma) = (1.0 / (h * h), 1.0 / self.frame.body.per_jt, at.gamma.norm_squared());
        // eq. 85: q² = |r|² + |γ|² Jt/m
        let q = r + gamma * (jt * self.frame.body.per_m);
        let turning = k + q * per_h * (jt * self.frame.body.m);
        // eq. 85: |γ|² + (4 h |v⊥|)² m/Jt, what moments that cancel leave in all stages of a step
        let tilt = gamma + 16.0 * v * (h * h * self.frame.body.m * self.frame.body.per_jt);
        let [supplied, dissipated] = layout.read_work(y);
        let work = supplied * supplied + dissipated * dissipated;
        let velocity = v + q * per_h;
        let mut squares =
            squares(&y[layout.own()], [x, r, vx + x * per_h, velocity, turning, turning, tilt, at.phi * at.phi, work]);
        let loaded = [x + r, vx + velocity, tilt, turning * self.frame.body.per_jt * self.frame.body.per_jt];
        self.round_loads::<N>(&at, loaded.map(f64::sqrt), &mut squares);
        squares
    }
}

/// Not `max`, which asks for what is not a number.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
