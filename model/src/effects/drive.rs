//! `drive`: a torque from outside, and the angle that goes with it.

use super::{Effect, Row, Terminal, Wrench};
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::state::{Coordinates, Kinematics};
use crate::variable::units::{NEWTON_METRE, RADIAN, RADIAN_PER_SECOND, RADIAN_PER_SECOND_SQUARED};
use crate::variable::{input, output};

/// A constant-velocity joint between the rotor and a drive along e.
#[derive(Clone, Debug, Default)]
pub struct Drive {
    /// Torque τ of the drive on the rotor [N·m].
    pub tau: Signal,
}

impl Effect for Drive {
    const ROWS: &'static [Row<Self>] = &[
        input!(tau, &NEWTON_METRE, 0.0, "torque of the drive on the rotor, passed on by a constant-velocity joint"),
        output!("phi", &RADIAN, "angle of the drive, the axial angle of the rotor", |_, m| m.phi()),
        output!("w", &RADIAN_PER_SECOND, "speed of the drive, the rate of its angle", |_, m| m.axial_rate()),
        output!("a", &RADIAN_PER_SECOND_SQUARED, "acceleration of the drive", |_, m, rates| {
            m.axial_acceleration(&Coordinates::from_slice(rates))
        }),
    ];

    const FOLLOWS_PLACE: bool = false;

    const EXCLUDES: &'static [&'static str] = &["imposed_speed"];

    // The members have the names of Modelica's adaptors between flanges and signals.
    const TERMINAL: Option<Terminal> =
        Some(Terminal { kind: "Modelica.Mechanics.Rotational.Interfaces.Flange_a", flows: &["tau"] });

    #[inline(always)]
    fn load<S: Scalar>(&self, motion: &Kinematics<S>) -> Wrench<S> {
        // eq. 32: M = τ n
        Wrench { moment: motion.tilt.joint_axis() * self.tau.at::<S>(motion.t), ..Wrench::zero() }
    }

    #[inline(always)]
    fn supply<S: Scalar>(&self, motion: &Kinematics<S>) -> S {
        // eq. 32: P = τ ω_φ
        self.tau.at::<S>(motion.t) * motion.axial_rate()
    }

    fn needs_gamma(&self) -> bool {
        !self.tau.is_zero()
    }
}
