//! `drag`: what the medium around the rotor does to its spin, linear and quadratic in it.

use super::{Act, Effect, Facts, Motion, Row, Wrench};
use crate::scalar::Scalar;
use crate::variable::units::{
    NEWTON_METRE, NEWTON_METRE_SECOND_PER_RADIAN, NEWTON_METRE_SECOND_SQUARED_PER_RADIAN_SQUARED,
};
use crate::variable::{Bound, output, parameter};

/// Windage: a torque along t against the spin about it.
#[derive(Clone, Debug, Default)]
pub struct Drag {
    /// Of oil [N·m·s/rad].
    pub linear: f64,
    /// Of air [N·m·s²/rad²].
    pub quadratic: f64,
}

impl Drag {
    /// ω_a, the spin about t [rad/s], and the torque on the rotor [N·m].
    #[inline(always)]
    fn torque<S: Scalar>(&self, motion: &Motion<S>) -> [S; 2] {
        let speed = motion.spin();
        // eq. 65: τ = −(linear + quadratic |ω_a|) ω_a, ω_a = ω·t
        [speed, -motion.times(S::constant(self.linear) + S::constant(self.quadratic) * motion.size(speed), speed)]
    }
}

impl Effect for Drag {
    const LAW: &'static str = "M = −(linear + quadratic |ω_a|) ω_a t, ω_a = ω·t";

    const ROWS: &'static [Row<Self>] = &[
        parameter!(
            linear,
            &NEWTON_METRE_SECOND_PER_RADIAN,
            Some(0.0),
            Bound::NotNegative,
            "drag over the spin about the axis"
        ),
        parameter!(
            quadratic,
            &NEWTON_METRE_SECOND_SQUARED_PER_RADIAN_SQUARED,
            Some(0.0),
            Bound::NotNegative,
            "drag over the square of the spin about the axis"
        ),
        output!("tau", &NEWTON_METRE, "torque of the drag on the rotor, along its axis", |d, m| d.torque(m)[1]),
    ];

    // |ω_a| bends at zero.
    const FACTS: Facts = Facts { analytic: false, ..Facts::USUAL };

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let [speed, tau] = self.torque(motion);
        // eq. 65: M = τ t, P = −τ ω_a
        let loss = motion.power_along(-1.0, tau, speed);
        Act { damping: Wrench::along_axis(motion, tau), loss, ..Act::none() }
    }

    fn is_analytic(&self) -> bool {
        // Beside that place, and a step in series does not pass it.
        true
    }

    fn works(&self) -> bool {
        self.linear != 0.0 || self.quadratic != 0.0
    }
}
