//! How fast forces move a rotor, from their derivatives. What damps is left out: it does not push.

use crate::body::Inertia;
use crate::dual::Dual;
use crate::effects::Effects;
use crate::rotor::Rotor;
use crate::scalar::Scalar;
use crate::state::{Coordinates, GAMMA, PHI};
use nalgebra::Vector3;
use std::ops::Range;

/// Where the axis turns about K faster than forces make the rotor swing by this, it does not give way to them but precesses
/// [1].
const GYROSCOPIC: f64 = 30.0;

/// Then the rate of the springs that hold the mass centre counts so many times [1]: measured in `high_spin`.
const OF_SPRINGS: f64 = 2.3;

/// What acts on a motion.
pub(super) struct Forces {
    body: Inertia,
    /// Norms of ∂F/∂r [N/m], ∂F/∂γ [N], ∂M/∂r [N], ∂M/∂γ [N·m].
    springs: [f64; 4],
    /// |F| [N].
    force: f64,
    /// Of M the part across the axis [N·m].
    moment: f64,
    /// |v| [m/s].
    speed: f64,
    /// |K| and its part across the axis [kg·m²/s].
    momentum: f64,
    across: f64,
}

impl Forces {
    /// At time `t` [s] and state `y`.
    pub fn new<E: Effects, const N: usize>(rotor: &Rotor<E>, t: f64, y: &[f64; N]) -> Self {
        let moving: [Dual<PHI>; N] =
            std::array::from_fn(|n| if n < PHI { Dual::variable(y[n], n) } else { Dual::constant(y[n]) });
        let motion = rotor.motion(t, &moving);
        let load = rotor.effects.load(&motion);
        let [force, moment] = [load.force, load.moment].map(|vector| vector.map(Scalar::re));
        let (axis, at) = (motion.axis().map(Scalar::re), Coordinates::from_slice(y));
        let [r, gamma] = [0..3, GAMMA];
        Self {
            body: rotor.body,
            springs: [
                slope(&load.force, r.clone()),
                slope(&load.force, gamma.clone()),
                slope(&load.moment, r),
                slope(&load.moment, gamma),
            ],
            force: force.norm(),
            moment: moment.cross(&axis).norm(),
            speed: at.v.norm(),
            momentum: at.k.norm(),
            across: at.k.cross(&axis).norm(),
        }
    }

    /// The rate at which the axis turns about K [rad/s].
    pub fn nutation(&self) -> f64 {
        self.momentum * self.body.per_jt
    }

    /// The rate at which a rotor swings that gives way to them [rad/s].
    pub fn swing(&self) -> f64 {
        let [fr, fg, mr, mg] = self.springs;
        let Inertia { per_m, per_jt, .. } = self.body;
        let mixed = (per_m * per_jt).sqrt();
        // eq. 45: the norm of ∂(F, M)/∂(r, γ), masses weighed out
        let parts = [fr * per_m, fg * mixed, mr * mixed, mg * per_jt];
        parts.map(|part| part * part).iter().sum::<f64>().sqrt().sqrt()
    }

    /// The rate at which one moves that spins so fast that it precesses [rad/s]; None of a slower one.
    pub fn precession(&self) -> Option<f64> {
        let [fr, _, _, mg] = self.springs;
        let of_springs = OF_SPRINGS * (fr * self.body.per_m).sqrt();
        let swing = self.swing();
        (swing > 0.0 && self.nutation() > GYROSCOPIC * swing).then(|| of_springs.max(mg / self.momentum))
    }

    /// How far the axis is off K [rad].
    pub fn wobble(&self) -> f64 {
        self.across / self.momentum
    }

    /// How far it nods where forces set in at once [rad].
    pub fn nods(&self) -> f64 {
        let [fr, _, mr, _] = self.springs;
        // The mass centre goes as far as springs let it.
        let way = if fr > 0.0 { self.speed / (fr * self.body.per_m).sqrt() + self.force / fr } else { 0.0 };
        // eq. 80: (|M| + |∂M/∂r| δ) Jt/|K|²
        (self.moment + mr * way) / (self.momentum * self.nutation())
    }
}

/// The norm of the derivatives in these directions.
fn slope(vector: &Vector3<Dual<PHI>>, directions: Range<usize>) -> f64 {
    vector.iter().flat_map(|v| v.eps[directions.clone()].iter()).map(|slope| slope * slope).sum::<f64>().sqrt()
}
