//! The equations of motion of a body under its effects.

use crate::body::Body;
use crate::effects::Effects;
use crate::integrate::{Refusal, System};
use crate::scalar::Scalar;
use crate::state::{COORDINATES, Chart, Coordinates, Kinematics};

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
            phi: motion.axial_rate(),
        }
    }
}

impl<E: Effects, const N: usize> System<N> for Rotor<E> {
    #[inline(always)]
    fn rates(&self, _t: f64, y: &[f64; N]) -> [f64; N] {
        let motion = Kinematics::new(self.body, Coordinates::from_slice(y));
        let mut rates = [0.0; N];
        self.rates(&motion).write(&mut rates);
        if N == WITH_WORK {
            rates[SUPPLIED] = self.effects.supply(&motion);
            rates[DISSIPATED] = self.effects.loss(&motion);
        }
        rates
    }

    fn admits(&self, _t: f64, y: &[f64; N]) -> Result<(), Refusal> {
        let gamma = Coordinates::from_slice(y).gamma;
        let limit = self.chart.limit();
        if gamma.dot(&gamma) <= limit * limit {
            return Ok(());
        }
        Err(Refusal("the tilt |gamma| reaches 3.1 rad, and at pi the split rotation is singular"))
    }
}
