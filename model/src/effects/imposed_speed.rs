//! `imposed_speed`: a shaft that turns as it is told, whatever torque that takes.

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
    /// Its rate from there on [rad/s²].
    pub a: Signal,
}

impl ImposedSpeed {
    /// The torque of the shaft on the rotor, where the state has these rates [N·m].
    fn torque<S: Scalar>(&self, motion: &Kinematics<S>, rates: &Coordinates<S>) -> S {
        // eq. 76: M = dK/dt + λ dn/dt
        let moment = rates.k + motion.carried().unwrap_or_else(Vector3::zeros);
        motion.torque(self.a.at(motion.t), &moment)
    }
}

impl Effect for ImposedSpeed {
    const ROWS: &'static [Row<Self>] = &[
        input!(w, &RADIAN_PER_SECOND, 0.0, "axial rate that the shaft imposes"),
        input!(a, &RADIAN_PER_SECOND_SQUARED, 0.0, "rate of w, until either is set again"),
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
        let (since, a) = (self.w.since().max(self.a.since()), self.a.at::<S>(t));
        // eq. 75: ω_φ = w + a s
        Some([self.w.at::<S>(self.w.since()) + a * S::constant(t - since), a])
    }

    fn needs_gamma(&self) -> bool {
        true
    }
}
