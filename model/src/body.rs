//! The rigid body: a symmetric rotor on its rod.

use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::stored::stored;
use nalgebra::Vector3;

/// Mass and inertia of a rotor that is symmetric about its axis t, and the length of its rod.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(non_snake_case, reason = "the paper's symbols")]
pub struct Body {
    /// Mass [kg].
    pub m: f64,
    /// Moment of inertia about the axis t [kg·m²].
    pub Ja: f64,
    /// Moment of inertia about c, transverse to t [kg·m²].
    pub Jt: f64,
    /// Distance from the support point a to the mass centre c, along t [m].
    pub l: f64,
}

/// What the motion needs of a body, with the divisions done once.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inertia {
    /// Mass [kg].
    pub m: f64,
    /// Distance from the support point a to the mass centre c, along t [m].
    pub l: f64,
    /// 1/m [1/kg].
    pub per_m: f64,
    /// 1/Jt [1/(kg·m²)].
    pub per_jt: f64,
    /// 1/Ja − 1/Jt [1/(kg·m²)].
    pub spin: f64,
}

stored!(Inertia { m, l, per_m, per_jt, spin });

impl From<Body> for Inertia {
    #[allow(non_snake_case, reason = "the paper's symbols")]
    fn from(Body { m, Ja, Jt, l }: Body) -> Self {
        Self { m, l, per_m: 1.0 / m, per_jt: 1.0 / Jt, spin: 1.0 / Ja - 1.0 / Jt }
    }
}

impl Inertia {
    /// ω [rad/s] of angular momentum K [kg·m²/s] about c, the axis being t.
    #[inline(always)]
    pub fn angular_velocity<S: Scalar>(&self, momentum: &Vector3<S>, axis: &Vector3<S>) -> AngularVelocity<S> {
        // eq. 11: ω = K/Jt + (1/Ja − 1/Jt)(K·t) t
        AngularVelocity {
            swing: momentum * S::constant(self.per_jt),
            spin: S::constant(self.spin) * momentum.dot(axis),
        }
    }
}

/// An angular velocity ω = swing + spin t.
#[derive(Clone, Copy, Debug)]
pub struct AngularVelocity<S: Scalar> {
    /// What moves the axis [rad/s]; of a symmetric body along K, so not across the axis alone.
    pub swing: Vector3<S>,
    /// What turns the body about its axis besides [rad/s].
    pub spin: S,
}

impl<S: Scalar> AngularVelocity<S> {
    /// ω [rad/s], the axis being t.
    #[inline(always)]
    pub fn omega(&self, axis: &Vector3<S>) -> Vector3<S> {
        self.swing + axis * self.spin
    }
}

impl Body {
    /// K [kg·m²/s] about c of angular velocity ω [rad/s], the axis being t.
    pub fn angular_momentum<S: Scalar>(&self, omega: &Vector3<S>, axis: &Vector3<S>) -> Vector3<S> {
        // eq. 11: K = Jt ω + (Ja − Jt)(ω·t) t
        omega * S::constant(self.Jt) + axis * (S::constant(self.Ja - self.Jt) * omega.dot(axis))
    }

    /// Whether a body of this shape can exist: Ja ≤ 2 Jt (equal for the thin disk).
    ///
    /// Ja is the integral of y² + z², and 2 Jt that of y² + z² + 2x². An excess within rounding (1e-12) is a thin disk.
    pub fn check(&self) -> Result<(), Invalid> {
        if self.Ja <= 2.0 * self.Jt * (1.0 + 1e-12) {
            return Ok(());
        }
        let bound = format!("at most 2 rotor.Jt = {:?} (a thin disk has Ja = 2 Jt)", 2.0 * self.Jt);
        Err(Invalid::new("rotor.Ja", self.Ja, bound))
    }
}
