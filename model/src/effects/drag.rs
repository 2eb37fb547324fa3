//! `drag`: a torque against the spin, linear and quadratic in it.

use super::{Effect, Row, Wrench};
use crate::scalar::Scalar;
use crate::state::Kinematics;
use crate::variable::units::{
    NEWTON_METRE, NEWTON_METRE_SECOND_PER_RADIAN, NEWTON_METRE_SECOND_SQUARED_PER_RADIAN_SQUARED,
};
use crate::variable::{Bound, output, parameter};

/// Drag on the shaft that a constant-velocity joint connects with the rotor.
#[derive(Clone, Debug, Default)]
pub struct Drag {
    /// Of oil [N·m·s/rad].
    pub linear: f64,
    /// Of air [N·m·s²/rad²].
    pub quadratic: f64,
}

impl Drag {
    /// The torque over the spin [N·m·s/rad].
    #[inline(always)]
    fn per_speed<S: Scalar>(&self, speed: S) -> S {
        let size = if speed.re() < 0.0 { -speed } else { speed };
        S::constant(self.linear) + S::constant(self.quadratic) * size
    }

    /// The torque on the rotor [N·m].
    #[inline(always)]
    fn tau<S: Scalar>(&self, motion: &Kinematics<S>) -> S {
        let speed = motion.axial_rate();
        // eq. 65: τ = −(linear + quadratic |ω_φ|) ω_φ
        -(self.per_speed(speed) * speed)
    }
}

impl Effect for Drag {
    const ROWS: &'static [Row<Self>] = &[
        parameter!(linear, &NEWTON_METRE_SECOND_PER_RADIAN, Some(0.0), Bound::NotNegative, "drag over the axial rate"),
        parameter!(
            quadratic,
            &NEWTON_METRE_SECOND_SQUARED_PER_RADIAN_SQUARED,
            Some(0.0),
            Bound::NotNegative,
            "drag over the square of the axial rate"
        ),
        output!(
            "tau",
            &NEWTON_METRE,
            "torque of the drag on the rotor, passed on by a constant-velocity joint",
            |d, m| { d.tau(m) }
        ),
    ];

    const FOLLOWS_PLACE: bool = false;

    #[inline(always)]
    fn damping<S: Scalar>(&self, motion: &Kinematics<S>) -> Wrench<S> {
        // eq. 32: M = τ n
        Wrench::couple(motion.tilt.joint_axis() * self.tau(motion))
    }

    #[inline(always)]
    fn loss<S: Scalar>(&self, motion: &Kinematics<S>) -> S {
        // eq. 65: P = −τ ω_φ
        -(self.tau(motion) * motion.axial_rate())
    }

    fn needs_gamma(&self) -> bool {
        self.works()
    }

    fn works(&self) -> bool {
        self.linear != 0.0 || self.quadratic != 0.0
    }
}
