//! The energy ledger.

use crate::effects::{Effects, Motion};
use crate::scalar::Scalar;
use crate::state::Kinematics;

/// Kinetic energy \[J].
pub fn kinetic<S: Scalar>(motion: &Kinematics<S>) -> S {
    let (v, omega) = (&motion.at.v, &motion.omega);
    // eq. 17: T = ½ m |v|² + ½ ω·K, of the mass centre of the whole
    (v.dot(v) * S::constant(motion.body.m) + omega.dot(&motion.momentum())) * S::constant(0.5)
}

/// Kinetic energy without that of the spin, of a balanced and symmetric body \[J].
pub fn moving(motion: &Kinematics<f64>) -> f64 {
    // ½ m |v|² + ½ Jt |dt/dt|²
    (motion.at.v.norm_squared() * motion.body.m + motion.axis_rate().norm_squared() / motion.body.per_jt) * 0.5
}

/// What there is, what came in and what went out \[J].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ledger<S: Scalar> {
    /// Kinetic energy \[J].
    pub kinetic: S,
    /// Potential energy of all effects \[J].
    pub potential: S,
    /// Total energy at the start \[J].
    pub total_at_start: f64,
    /// Work supplied from outside since the start \[J].
    pub supplied: S,
    /// Work lost since the start \[J].
    pub dissipated: S,
}

impl<S: Scalar> Ledger<S> {
    /// The ledger of an instant, the effects having these `own` states; work supplied and lost \[J] since the start, `total_at_start` \[J].
    pub fn new<E: Effects>(motion: &Kinematics<S>, own: &[S], effects: &E, work: [S; 2], total_at_start: f64) -> Self {
        let [supplied, dissipated] = work;
        Self {
            kinetic: kinetic(motion),
            potential: effects.stored(&Motion::new(motion, own)),
            total_at_start,
            supplied,
            dissipated,
        }
    }

    /// Kinetic plus potential energy \[J].
    pub fn total(&self) -> S {
        self.kinetic + self.potential
    }

    /// Zero for an exact solution \[J].
    pub fn residual(&self) -> S {
        // eq. 18: total − total(start) − supplied + dissipated
        self.total() - S::constant(self.total_at_start) - self.supplied + self.dissipated
    }
}
