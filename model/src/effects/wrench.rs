//! A force and a moment.

use super::Motion;
use crate::scalar::Scalar;
use crate::state::Kinematics;
use nalgebra::Vector3;
use std::ops::Add;

/// A force on the rotor and its moment M about c, in O.
///
/// Where the motion is a [series](Scalar::SERIES), `moment` is M×t, to which any multiple of t may be added, and `along` is M·t:
/// the motion of the axis needs no more, and of most laws these are linear in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<S: Scalar> {
    /// Force \[N].
    pub force: Vector3<S>,
    /// Moment about c [N·m].
    pub moment: Vector3<S>,
    /// Moment along t of a series [N·m].
    pub along: S,
}

impl<S: Scalar> Wrench<S> {
    /// No load: zeros that leave every sum as it is, −0 + x = x. (+0 does not: +0 + −0 = +0. The compiler would have to add
    /// it.)
    #[inline(always)]
    pub fn zero() -> Self {
        let none = Vector3::repeat(-S::zero());
        Self { force: none, moment: none, along: -S::zero() }
    }

    /// A force \[N] at the mass centre G of the whole.
    #[inline(always)]
    pub fn at_centre(motion: &Motion<S>, force: Vector3<S>) -> Self {
        match motion.to_centre() {
            None => Self { force, ..Self::zero() },
            // eq. 73: M_c = L b×F
            Some(to_centre) => Self { force, moment: to_centre.cross(&force), ..Self::zero() },
        }
    }

    /// Its moment about the mass centre G of the whole [N·m].
    #[inline(always)]
    pub fn about_centre(&self, motion: &Kinematics<S>) -> Vector3<S> {
        // eq. 73: M_G = M_c − L b×F
        motion.to_centre.map_or(self.moment, |to_centre| self.moment - to_centre.cross(&self.force))
    }

    /// A force \[N] at the station at `p` \[m] along t from c.
    #[inline(always)]
    pub fn at_station(motion: &Motion<S>, p: f64, force: Vector3<S>) -> Self {
        // eq. 60: M_c = p t×F; M×t = p F − p (t·F) t
        let moment = if S::SERIES { force * S::constant(p) } else { motion.lever(p).cross(&force) };
        Self { force, moment, ..Self::zero() }
    }

    /// A moment [N·m].
    #[inline(always)]
    pub fn couple(motion: &Motion<S>, moment: Vector3<S>) -> Self {
        if !S::SERIES {
            return Self { moment, ..Self::zero() };
        }
        let (m, t, times) = (moment, motion.axis(), |a, b| motion.times(a, b));
        let across = Vector3::new(
            times(m.y, t.z) - times(m.z, t.y),
            times(m.z, t.x) - times(m.x, t.z),
            times(m.x, t.y) - times(m.y, t.x),
        );
        let along = times(m.x, t.x) + times(m.y, t.y) + times(m.z, t.z);
        Self { moment: across, along, ..Self::zero() }
    }

    /// A spring against the lean γ [N·m/rad]: M = −k γ.
    #[inline(always)]
    pub fn against_lean(motion: &Motion<S>, k: f64) -> Self {
        let Some(series) = motion.series() else {
            let lean = motion.lean() * S::constant(-k);
            return Self { moment: Vector3::new(-S::zero(), lean.x, lean.y), ..Self::zero() };
        };
        // M×t = k f e − k f (e·t) t, f = θ/sin θ
        let pull = if k == 0.0 { S::zero() } else { S::of_power(series.lean()) * S::constant(k) };
        Self { moment: Vector3::x() * pull, ..Self::zero() }
    }

    /// A damper against how fast the axis turns [N·m·s/rad]: M = −d t×dt/dt.
    #[inline(always)]
    pub fn against_turn(motion: &Motion<S>, d: f64) -> Self {
        // M×t = −d dt/dt
        let moment = if S::SERIES { motion.axis_rate() } else { motion.turn() };
        Self { moment: moment * S::constant(-d), ..Self::zero() }
    }

    /// A torque τ [N·m] that a constant-velocity joint passes on: M = τ n.
    #[inline(always)]
    pub fn along_joint(motion: &Motion<S>, tau: S) -> Self {
        let Some(series) = motion.series() else {
            return Self { moment: motion.joint_axis() * tau, ..Self::zero() };
        };
        let over = |a: S| a.in_power().map_or(S::zero(), |a| S::of_power(series.quotient(a)));
        // M×t = τ e×t/(1 + e·t), M·t = τ
        let across = [-over(motion.axis().z), over(motion.axis().y)].map(|w| motion.times(tau, w));
        Self { moment: Vector3::new(S::zero(), across[0], across[1]), along: tau, ..Self::zero() }
    }

    /// A torque τ [N·m] along t.
    #[inline(always)]
    pub fn along_axis(motion: &Motion<S>, tau: S) -> Self {
        if S::SERIES {
            return Self { along: tau, ..Self::zero() };
        }
        Self { moment: motion.axis() * tau, ..Self::zero() }
    }
}

impl<S: Scalar> Add for Wrench<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { force: self.force + other.force, moment: self.moment + other.moment, along: self.along + other.along }
    }
}
