//! `imposed_speed`: a shaft that turns as it is told, whatever torque that takes.
//!
//! Both inputs tell one signal: ω_φ, and its rate. Where a host sends derivatives of w, they tell the rate themselves.

use super::{Effect, Row};
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::state::{Coordinates, Kinematics};
use crate::variable::units::{NEWTON_METRE, RADIAN_PER_SECOND, RADIAN_PER_SECOND_SQUARED};
use crate::variable::{input, output};
use nalgebra::Vector3;

/// The speed of a shaft that turns the rotor through a constant-velocity joint.
#[derive(Clone, Debug, Default)]
pub struct ImposedSpeed {
    /// ω_φ where either was last set [rad/s].
    pub w: Signal,
    /// Its rate from there on, where w has no derivatives of its own [rad/s²].
    pub a: Signal,
}

impl ImposedSpeed {
    /// The torque of the shaft on the rotor, where the state has these rates [N·m].
    fn torque<S: Scalar>(&self, motion: &Kinematics<S>, rates: &Coordinates<S>) -> S {
        // eq. 76: M = dK/dt + λ dn/dt
        let moment = rates.k + motion.carried().unwrap_or_else(Vector3::zeros);
        motion.torque(self.told(motion.t)[1], &moment)
    }

    /// ω_φ [rad/s] and its rate [rad/s²] at time `t` [s].
    #[inline(always)]
    fn told<S: Scalar>(&self, t: f64) -> [S; 2] {
        if !self.w.is_held() {
            return [self.w.at(t), S::constant(self.w.rate_at(t))];
        }
        let since = self.w.since().max(self.a.since());
        // eq. 75: ω_φ = w + ∫a dt
        [self.w.at::<S>(since) + self.a.sum::<S>(since, t), self.a.at(t)]
    }
}

impl Effect for ImposedSpeed {
    const ROWS: &'static [Row<Self>] = &[
        input!(w, &RADIAN_PER_SECOND, 0.0, "axial rate that the shaft imposes"),
        input!(
            a,
            &RADIAN_PER_SECOND_SQUARED,
            0.0,
            "rate of w, until either is set again; does not count where derivatives of w are sent"
        ),
        output!("tau", &NEWTON_METRE, "torque of the shaft on the rotor", |s, m, rates| {
            s.torque(m, &Coordinates::from_slice(rates))
        }),
    ];

    const FOLLOWS_PLACE: bool = false;

    const IMPOSES: bool = true;

    const TELLS_RATES: bool = true;

    const EXCLUDES: &'static [&'static str] = &["motor"];

    #[inline(always)]
    fn imposed<S: Scalar>(&self, t: f64) -> Option<[S; 2]> {
        Some(self.told(t))
    }

    fn needs_gamma(&self) -> bool {
        true
    }
}
