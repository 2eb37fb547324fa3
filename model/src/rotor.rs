//! The equations of motion of a body under its effects.

use crate::body::Inertia;
use crate::dual::Dual;
use crate::effects::{Effects, Wrench};
use crate::integrate::stiff::Differentiable;
use crate::integrate::{Refusal, System};
use crate::rotation::Chart;
use crate::scalar::Scalar;
use crate::state::{Coordinates, DISSIPATED, Kinematics, PHI, SUPPLIED, WITH_WORK, Whole};
use crate::stored::stored;
use nalgebra::Vector2;
use std::f64::consts::PI;

/// A rotor with what acts on it.
#[derive(Clone, Default)]
pub struct Rotor<E> {
    /// The body.
    pub body: Inertia,
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

/// The rates of the coordinates under this load.
#[inline(always)]
fn rates<S: Scalar>(motion: &Kinematics<S>, load: Wrench<S>) -> Coordinates<S> {
    // eq. 12: dr_c/dt = v_c, m dv_c/dt = ΣF, dK_c/dt = ΣM_c
    Coordinates {
        r_c: motion.at.v_c,
        v_c: load.force * S::constant(motion.body.per_m),
        k_c: load.moment,
        gamma: motion.gamma_rate(),
        phi: motion.phi_rate(),
    }
}

/// The rates of the coordinates and of the work integrals.
#[inline(always)]
fn working_rates<S: Scalar, E: Effects>(effects: &E, motion: &Kinematics<S>) -> Whole<S> {
    let mut whole = [S::zero(); WITH_WORK];
    rates(motion, effects.load(motion) + effects.damping(motion)).write(&mut whole);
    whole[SUPPLIED] = effects.supply(motion);
    whole[DISSIPATED] = effects.loss(motion);
    whole
}

/// The rates of the coordinates and of the work integrals; not a number where a law that follows γ has no limit nearby.
pub fn whole_rates<S: Scalar, E: Effects>(effects: &E, motion: &Kinematics<S>) -> Whole<S> {
    if effects.needs_gamma() && motion.tilt.gamma().map(S::re).norm() > LIMIT {
        return [S::constant(f64::NAN); WITH_WORK];
    }
    if effects.works() {
        return working_rates(effects, motion);
    }
    let mut whole = [S::zero(); WITH_WORK];
    rates(motion, effects.load(motion)).write(&mut whole);
    whole
}

impl<E: Effects> Rotor<E> {
    /// The motion at time `t` [s], from a state.
    #[inline(always)]
    pub fn motion<S: Scalar>(&self, t: f64, y: &[S]) -> Kinematics<S> {
        Kinematics::new(self.body, self.chart, Coordinates::from_slice(y)).when(t, self.turns)
    }
}

impl<E: Effects> Rotor<E> {
    /// The rates of a state of N numbers in this chart.
    #[inline(always)]
    fn rates_in<S: Scalar, const N: usize>(&self, chart: Chart, t: f64, y: &[S; N]) -> [S; N] {
        let motion = Kinematics::new(self.body, chart, Coordinates::from_slice(y)).when(t, self.turns);
        let mut some = [S::zero(); N];
        debug_assert!(N == WITH_WORK || !self.effects.works(), "what works is solved with its work");
        if N == WITH_WORK {
            some.copy_from_slice(&working_rates(&self.effects, &motion));
        } else {
            rates(&motion, self.effects.load(&motion)).write(&mut some);
        }
        some
    }

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

impl<E: Effects, const N: usize> System<N> for Rotor<E> {
    /// φ and the work integrals are quadratures: no law depends on them.
    const DEPENDED_ON: usize = PHI;

    #[inline(always)]
    fn rates(&self, t: f64, y: &[f64; N]) -> [f64; N] {
        // Once for each chart, so that neither asks again which one it is.
        match self.chart {
            Chart::FromE => self.rates_in(Chart::FromE, t, y),
            Chart::FromMinusE => self.rates_in(Chart::FromMinusE, t, y),
        }
    }

    fn admits(&self, _t: f64, y: &[f64; N]) -> Result<(), Refusal> {
        self.reaches(Coordinates::from_slice(y).gamma, Chart::REACH)
    }
}

impl<E: Effects, const N: usize> Differentiable<N> for Rotor<E> {
    fn jacobian(&self, t: f64, y: &[f64; N]) -> [[f64; N]; N] {
        // Nothing depends on the quadratures, so there is no direction for them.
        let moving = |n: usize| if n < PHI { Dual::variable(y[n], n) } else { Dual::constant(y[n]) };
        let rates: [Dual<PHI>; N] = self.rates_in(self.chart, t, &std::array::from_fn(moving));
        rates.map(|rate| std::array::from_fn(|n| if n < PHI { rate.eps[n] } else { 0.0 }))
    }
}
