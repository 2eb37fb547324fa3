//! The equations of motion of a body under its effects.

use crate::body::Body;
use crate::effects::Effects;
use crate::integrate::{Refusal, System};
use crate::rotation::Chart;
use crate::scalar::Scalar;
use crate::state::{COORDINATES, Coordinates, Kinematics};
use std::f64::consts::PI;

/// A rotor with what acts on it.
#[derive(Clone, Default)]
pub struct Rotor<E> {
    /// The body.
    pub body: Body,
    /// What acts on it.
    pub effects: E,
    /// The chart in which its state is written.
    pub chart: Chart,
}

/// |γ| [rad] beyond which laws that follow the direction of γ are refused: at π they have no limit.
pub const LIMIT: f64 = 3.1;

/// In the chart from −e: |γ′| [rad] within which they are refused.
pub const FORBIDDEN: f64 = PI - LIMIT;

const BEYOND_REACH: Refusal = Refusal("the axis turns too far for one chart, however short the step");

const BEYOND_LIMIT: Refusal =
    Refusal("the tilt |gamma| reaches 3.1 rad, and a spring or torque that follows gamma (c2) has no limit at pi");

/// The number of equations without the work integrals, and with them.
pub const WITHOUT_WORK: usize = COORDINATES;
/// Work supplied and work lost follow the coordinates.
pub const WITH_WORK: usize = COORDINATES + 2;
/// Where the work supplied [J] stands in a state with work.
pub const SUPPLIED: usize = COORDINATES;
/// Where the work lost [J] stands in a state with work.
pub const DISSIPATED: usize = COORDINATES + 1;

impl<E: Effects> Rotor<E> {
    /// The rates of the coordinates.
    #[inline(always)]
    pub fn rates<S: Scalar>(&self, motion: &Kinematics<S>) -> Coordinates<S> {
        let load = self.effects.load(motion);
        // eq. 12: dr_c/dt = v_c, m dv_c/dt = ΣF, dK_c/dt = ΣM_c
        Coordinates {
            r_c: motion.at.v_c,
            v_c: load.force * S::constant(1.0 / self.body.m),
            k_c: load.moment,
            gamma: motion.tilt.gamma_rate(&motion.omega),
            phi: motion.tilt.phi_rate(&motion.omega),
        }
    }
}

impl<E: Effects, const N: usize> System<N> for Rotor<E> {
    #[inline(always)]
    fn rates(&self, _t: f64, y: &[f64; N]) -> [f64; N] {
        let motion = Kinematics::new(self.body, self.chart, Coordinates::from_slice(y));
        let mut rates = [0.0; N];
        self.rates(&motion).write(&mut rates);
        if N == WITH_WORK {
            rates[SUPPLIED] = self.effects.supply(&motion);
            rates[DISSIPATED] = self.effects.loss(&motion);
        }
        rates
    }

    fn admits(&self, _t: f64, y: &[f64; N]) -> Result<(), Refusal> {
        let theta_squared = Coordinates::from_slice(y).gamma.norm_squared();
        if theta_squared > Chart::REACH * Chart::REACH {
            return Err(BEYOND_REACH);
        }
        if self.chart == Chart::FromMinusE && self.effects.needs_gamma() && theta_squared < FORBIDDEN * FORBIDDEN {
            return Err(BEYOND_LIMIT);
        }
        Ok(())
    }
}
