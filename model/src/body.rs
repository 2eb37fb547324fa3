//! The rigid body: a symmetric rotor on its rod, and what effects make of it.

pub mod frame;
mod poinsot;
mod principal;
mod shape;

pub use poinsot::Poinsot;
pub use shape::{Asymmetric, Shape};

use crate::scalar::Scalar;
use crate::stored::stored;
use nalgebra::{Matrix3, Vector3};

/// How many bodies move.
pub const BODIES: usize = 1;

/// The rotor among them.
pub const ROTOR: usize = 0;

/// Mass and inertia of a rotor that is symmetric about its axis t, and the length of its rod.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(non_snake_case, reason = "the paper's symbols")]
pub struct Body {
    /// Mass \[kg].
    pub m: f64,
    /// Moment of inertia about the axis t [kg·m²].
    pub Ja: f64,
    /// Moment of inertia about c, transverse to t [kg·m²].
    pub Jt: f64,
    /// Distance from the support point a to the mass centre c, along t \[m].
    pub l: f64,
}

/// What the motion needs of a body, with the divisions done once.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inertia {
    /// Mass of the whole \[kg].
    pub m: f64,
    /// Distance from the support point a to the mass centre c, along t \[m].
    pub l: f64,
    /// 1/m [1/kg].
    pub per_m: f64,
    /// 1/Jt [1/(kg·m²)]; of an asymmetric body 1/J about its third principal axis.
    pub per_jt: f64,
    /// 1/Ja − 1/Jt [1/(kg·m²)]; of an asymmetric body 1/J about its first principal axis less that about its third.
    pub spin: f64,
    /// What is asymmetric of it; None of a symmetric body with its mass centre on its axis.
    pub asymmetric: Option<Asymmetric>,
}

stored!(Inertia { m, l, per_m, per_jt, spin, asymmetric });

impl From<Body> for Inertia {
    #[allow(non_snake_case, reason = "the paper's symbols")]
    fn from(Body { m, Ja, Jt, l }: Body) -> Self {
        Self { m, l, per_m: 1.0 / m, per_jt: 1.0 / Jt, spin: 1.0 / Ja - 1.0 / Jt, asymmetric: None }
    }
}

impl Inertia {
    /// The same of a body of which it is known that it is not asymmetric.
    #[inline(always)]
    pub fn symmetric(self) -> Self {
        Self { asymmetric: None, ..self }
    }

    /// Radius of gyration across t, √(Jt/m) \[m].
    pub fn radius(&self) -> f64 {
        (self.per_m / self.per_jt).sqrt()
    }

    /// ω [rad/s] of angular momentum K [kg·m²/s] about c, the axis being t; of a symmetric body.
    #[inline(always)]
    pub fn angular_velocity<S: Scalar>(&self, momentum: &Vector3<S>, axis: &Vector3<S>) -> AngularVelocity<S> {
        // eq. 11: ω = K/Jt + (1/Ja − 1/Jt)(K·t) t
        AngularVelocity {
            swing: momentum * S::constant(self.per_jt),
            spin: S::constant(self.spin) * momentum.dot(axis),
        }
    }

    /// How an asymmetric body turns that nothing acts on, K being given along its principal axes [kg·m²/s]; None where it does so
    /// steadily.
    pub fn free(&self, asymmetric: &Asymmetric, momentum: &Vector3<f64>) -> Option<Poinsot> {
        Poinsot::new([self.spin, asymmetric.excess, 0.0], self.per_jt, momentum)
    }

    /// The largest 1/J of an asymmetric body [1/(kg·m²)]: |ω| is at most this times |K|.
    pub fn quickest(&self, asymmetric: &Asymmetric) -> f64 {
        [self.spin, asymmetric.excess, 0.0].into_iter().fold(f64::NEG_INFINITY, f64::max) + self.per_jt
    }

    /// ω [rad/s] of angular momentum K [kg·m²/s] about G, of an asymmetric body with this attitude.
    #[inline(always)]
    pub fn asymmetric_angular_velocity<S: Scalar>(
        &self,
        asymmetric: &Asymmetric,
        momentum: &Vector3<S>,
        attitude: &Matrix3<S>,
    ) -> AngularVelocity<S> {
        let [first, second] = asymmetric.axes.map(|axis| attitude * axis.map(S::constant));
        // eq. 72: ω = K/J₃ + (1/J₁ − 1/J₃)(K·p₁) p₁ + (1/J₂ − 1/J₃)(K·p₂) p₂
        let about_first = first * (S::constant(self.spin) * momentum.dot(&first));
        let about_second = second * (S::constant(asymmetric.excess) * momentum.dot(&second));
        AngularVelocity { swing: momentum * S::constant(self.per_jt) + about_first + about_second, spin: S::zero() }
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
        // eq. 11: K = Ja (ω·t) t + Jt t×(ω×t); of a needle, Jt ω + (Ja − Jt)(ω·t) t would lose Ja in the rounding of Jt
        axis * (S::constant(self.Ja) * omega.dot(axis)) + axis.cross(&omega.cross(axis)) * S::constant(self.Jt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_a_needle_keeps_its_spin() {
        /// Of ω·t, relative; measured 2.3e-16, allow 1e-15.
        const SPIN: f64 = 1e-15;
        for ratio in [1e-4, 1e-8, 1e-12] {
            let body = Body { m: 1.0, Ja: 0.07 * ratio, Jt: 0.07, l: 0.0 };
            // Along e, about which the axis also swings, and tilted, about which it does not.
            let tilted = Vector3::new(0.6, 0.64, 0.48);
            for (axis, omega) in [(Vector3::x(), Vector3::new(47.3, 3.0, -7.0)), (tilted, tilted * 47.3)] {
                let momentum = body.angular_momentum(&omega, &axis);
                let [spin, expected] = [momentum.dot(&axis) / body.Ja, omega.dot(&axis)];
                assert!((spin - expected).abs() <= SPIN * expected, "Ja/Jt = {ratio}: {spin:?}, not {expected:?}");
            }
        }
    }
}
