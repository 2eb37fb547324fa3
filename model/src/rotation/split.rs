//! What follows from γ alone: the axis t, the axial rate ω_φ, the rate of γ. Closed forms of the paper's equations.

use super::series;
use crate::scalar::Scalar;
use nalgebra::{Vector2, Vector3};

/// The tilt of the rotor axis: a transverse Euler vector γ, |γ| < π, and the functions of it that the motion needs.
#[derive(Clone, Copy, Debug)]
pub struct Tilt<S: Scalar> {
    /// γ [rad], with γ·e = 0.
    pub gamma: Vector3<S>,
    /// The rotor axis t = L(γ)·e [1].
    pub axis: Vector3<S>,
    /// τ = tan(θ/2)/θ [1]
    tau: S,
    /// κ = (1 − θ cot θ)/θ² [1]
    kappa: S,
}

impl<S: Scalar> Tilt<S> {
    /// The tilt of γ = (0, γ_y, γ_z) [rad].
    #[inline(always)]
    pub fn new(gamma: Vector2<S>) -> Self {
        let x = gamma.dot(&gamma) * S::constant(0.25);
        // eq. 9: s = sin(θ/2)/(θ/2) = c + x j
        let (c, j) = (series::cosine(x), series::bessel(x));
        let s = c + x * j;
        // eq. 10: cos θ = 1 − 2x s², sin θ/θ = s c, τ = s/(2c), κ = (j c + s²)/(4 s c)
        let s_squared = s * s;
        let sinc = s * c;
        let quarter = S::constant(0.25) / sinc;
        let cos_theta = S::one() - (x + x) * s_squared;
        let tau = (s_squared + s_squared) * quarter;
        let kappa = (j * c + s_squared) * quarter;
        // eq. 2: t = e cos θ + (sin θ/θ) γ×e
        let axis = Vector3::new(cos_theta, sinc * gamma.y, -(sinc * gamma.x));
        Self { gamma: Vector3::new(S::zero(), gamma.x, gamma.y), axis, tau, kappa }
    }

    /// g = γ×e, whose length is θ [rad].
    #[inline(always)]
    fn g(&self) -> Vector2<S> {
        Vector2::new(self.gamma.z, -self.gamma.y)
    }

    /// The axial rate ω_φ = dφ/dt [rad/s] of a rotor that turns at ω [rad/s].
    #[inline(always)]
    pub fn axial_rate(&self, omega: &Vector3<S>) -> S {
        // eq. 6: ω_φ = e·ω + τ g·ω
        omega.x + self.tau * omega.yz().dot(&self.g())
    }

    /// dγ/dt [rad/s], its y and z components, of a rotor that turns at ω [rad/s].
    #[inline(always)]
    pub fn gamma_rate(&self, omega: &Vector3<S>) -> Vector2<S> {
        // eq. 8: dγ/dt = ω_⊥ − (e·ω + κ g·ω) g
        let g = self.g();
        omega.yz() - g * (omega.x + self.kappa * omega.yz().dot(&g))
    }

    /// θ² = |γ|² [rad²].
    #[inline(always)]
    pub fn theta_squared(&self) -> S {
        self.gamma.dot(&self.gamma)
    }
}
