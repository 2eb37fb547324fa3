//! `drive`: a torque from outside, and the angle that goes with it.

use super::{Act, Effect, Motion, Row, Terminal, Wrench};
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::variable::units::{NEWTON_METRE, RADIAN, RADIAN_PER_SECOND, RADIAN_PER_SECOND_SQUARED};
use crate::variable::{input, output};

/// A constant-velocity joint between the rotor and a drive along e.
#[derive(Clone, Debug, Default)]
pub struct Drive {
    /// Torque τ of the drive on the rotor [N·m].
    pub tau: Signal,
}

impl Effect for Drive {
    const LAW: &'static str =
        "M = τ n, n = (e + t)/(1 + e·t): a torque that a constant-velocity joint passes on, of power τ ω_φ";

    const ROWS: &'static [Row<Self>] = &[
        input!(tau, &NEWTON_METRE, 0.0, "torque of the drive on the rotor, passed on by a constant-velocity joint"),
        output!("phi", &RADIAN, "angle of the drive, the axial angle of the rotor", |_, m| m.phi()),
        output!("w", &RADIAN_PER_SECOND, "speed of the drive, the rate of its angle", |_, m| m.omega_phi()),
        output!("a", &RADIAN_PER_SECOND_SQUARED, "acceleration of the drive", |_, m, rates| {
            m.axial_acceleration(rates)
        }),
    ];

    const EXCLUDES: &'static [&'static str] = &["imposed_speed"];

    // The members have the names of Modelica's adaptors between flanges and signals.
    const TERMINAL: Option<Terminal> =
        Some(Terminal { kind: "Modelica.Mechanics.Rotational.Interfaces.Flange_a", flows: &["tau"] });

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let tau = motion.input(&self.tau);
        // eq. 32: M = τ n, P = τ ω_φ
        let supply = motion.power_along(1.0, tau, motion.omega_phi());
        Act { load: Wrench::along_joint(motion, tau), supply, ..Act::none() }
    }

    fn follows_speed(&self) -> bool {
        false
    }

    fn no_limit(&self) -> Option<&'static str> {
        (!self.tau.is_zero()).then_some(no_limit!("drive.tau, which a joint passes on,"))
    }
}
