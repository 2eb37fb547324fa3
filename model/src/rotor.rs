//! The equations of motion of a body under its effects.

use crate::body::Body;
use crate::dual::Dual;
use crate::effects::Effects;
use crate::integrate::stiff::Differentiable;
use crate::integrate::{Refusal, System};
use crate::rotation::Chart;
use crate::scalar::Scalar;
use crate::state::{Coordinates, DISSIPATED, Kinematics, SUPPLIED, WITH_WORK, Whole};
use crate::stored::stored;
use nalgebra::Vector2;
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
    /// Whole turns of φ, counted apart.
    pub turns: f64,
}

/// |γ| [rad] beyond which laws that follow the direction of γ are refused: at π they have no limit.
pub const LIMIT: f64 = 3.1;

/// In the chart from −e: |γ′| [rad] within which they are refused.
pub const FORBIDDEN: f64 = PI - LIMIT;

const BEYOND_REACH: Refusal = Refusal("the axis turns too far for one chart, however short the step");

const BEYOND_CHART: Refusal = Refusal(
    "|gamma| of the continuous states exceeds 3.1 rad, too far for their chart: complete a step earlier, so that an event \
     can change it",
);

const BEYOND_LIMIT: Refusal =
    Refusal("the tilt |gamma| reaches 3.1 rad, and a spring or torque that follows gamma (c2, tau) has no limit at pi");

/// The rates of the coordinates.
#[inline(always)]
fn rates<S: Scalar, E: Effects>(effects: &E, motion: &Kinematics<S>) -> Coordinates<S> {
    let load = effects.load(motion);
    // eq. 12: dr_c/dt = v_c, m dv_c/dt = ΣF, dK_c/dt = ΣM_c
    Coordinates {
        r_c: motion.at.v_c,
        v_c: load.force * S::constant(1.0 / motion.body.m),
        k_c: load.moment,
        gamma: motion.tilt.gamma_rate(&motion.omega),
        phi: motion.tilt.phi_rate(&motion.omega),
    }
}

/// The rates of the coordinates and of the work integrals; not a number where a law that follows γ has no limit nearby.
pub fn whole_rates<S: Scalar, E: Effects>(effects: &E, motion: &Kinematics<S>) -> Whole<S> {
    if effects.needs_gamma() && motion.tilt.gamma().map(S::re).norm() > LIMIT {
        return [S::constant(f64::NAN); WITH_WORK];
    }
    let mut whole = [S::zero(); WITH_WORK];
    rates(effects, motion).write(&mut whole);
    if effects.works() {
        whole[SUPPLIED] = effects.supply(motion);
        whole[DISSIPATED] = effects.loss(motion);
    }
    whole
}

impl<E: Effects> Rotor<E> {
    /// The rates of the coordinates.
    #[inline(always)]
    pub fn rates<S: Scalar>(&self, motion: &Kinematics<S>) -> Coordinates<S> {
        rates(&self.effects, motion)
    }

    /// The motion at time `t` [s], from a state.
    #[inline(always)]
    pub fn motion<S: Scalar>(&self, t: f64, y: &[S]) -> Kinematics<S> {
        Kinematics::new(self.body, self.chart, Coordinates::from_slice(y)).when(t, self.turns)
    }
}

impl<E: Effects> Rotor<E> {
    /// Whether a state may have this γ [rad] in the chart, whose own reach is told, under these effects.
    pub fn reaches(&self, gamma: Vector2<f64>, reach: f64) -> Result<(), Refusal> {
        let theta_squared = gamma.norm_squared();
        if theta_squared > reach * reach {
            return Err(if reach < LIMIT { BEYOND_REACH } else { BEYOND_CHART });
        }
        if self.chart == Chart::FromMinusE && self.effects.needs_gamma() && theta_squared < FORBIDDEN * FORBIDDEN {
            return Err(BEYOND_LIMIT);
        }
        Ok(())
    }
}

stored!(Rotor<E: Effects> { body, effects, chart, turns });

impl<E: Effects> Rotor<E> {
    /// The rates of N equations.
    #[inline(always)]
    fn equations<S: Scalar, const N: usize>(&self, motion: &Kinematics<S>) -> [S; N] {
        let mut rates = [S::zero(); N];
        self.rates(motion).write(&mut rates);
        if N == WITH_WORK {
            rates[SUPPLIED] = self.effects.supply(motion);
            rates[DISSIPATED] = self.effects.loss(motion);
        }
        rates
    }
}

impl<E: Effects, const N: usize> System<N> for Rotor<E> {
    #[inline(always)]
    fn rates(&self, t: f64, y: &[f64; N]) -> [f64; N] {
        self.equations(&self.motion(t, y))
    }

    fn admits(&self, _t: f64, y: &[f64; N]) -> Result<(), Refusal> {
        self.reaches(Coordinates::from_slice(y).gamma, Chart::REACH)
    }
}

impl<E: Effects, const N: usize> Differentiable<N> for Rotor<E> {
    fn jacobian(&self, t: f64, y: &[f64; N]) -> [[f64; N]; N] {
        let y: [Dual<N>; N] = std::array::from_fn(|n| Dual::variable(y[n], n));
        self.equations(&self.motion(t, &y)).map(|rate| rate.eps)
    }
}
