//! What follows from γ alone: the axis t, the axial rate ω_φ, the rate of γ. Closed forms of the paper's equations.

use super::chart::{Chart, crossed};
use super::series;
use crate::scalar::Scalar;
use nalgebra::{Vector2, Vector3};

/// The tilt of the rotor axis: a transverse Euler vector γ, |γ| < π, and the functions of it that the motion needs.
#[derive(Clone, Copy, Debug)]
pub struct Tilt<S: Scalar> {
    /// The chart of `gamma`.
    chart: Chart,
    /// γ_y and γ_z [rad] in the chart.
    gamma: Vector2<S>,
    /// The rotor axis t [1].
    pub axis: Vector3<S>,
    /// θ²/4 [rad²], θ = |γ| in the chart
    x: S,
    /// τ = tan(θ/2)/θ [1]
    tau: S,
    /// κ = (1 − θ cot θ)/θ² [1]
    kappa: S,
}

impl<S: Scalar> Tilt<S> {
    /// The tilt of γ = (0, γ_y, γ_z) [rad] in a chart.
    #[inline(always)]
    pub fn new(chart: Chart, gamma: Vector2<S>) -> Self {
        let x = gamma.dot(&gamma) * S::constant(0.25);
        // eq. 9: s = sin(θ/2)/(θ/2) = c + x j
        let (c, j) = (series::cosine(x), series::bessel(x));
        let s = c + x * j;
        // eq. 10: cos θ = c² − x s², sin θ/θ = s c, τ = s/(2c), κ = (j c + s²)/(4 s c)
        let s_squared = s * s;
        let sinc = s * c;
        let quarter = S::constant(0.25) / sinc;
        let cos_theta = c * c - x * s_squared;
        let tau = (s_squared + s_squared) * quarter;
        let kappa = (j * c + s_squared) * quarter;
        // eq. 2, eq. 29: t = ±(e cos θ + (sin θ/θ) γ×e)
        let sign = S::constant(chart.sign());
        let across = sign * sinc;
        let axis = Vector3::new(sign * cos_theta, across * gamma.y, -(across * gamma.x));
        Self { chart, gamma, axis, x, tau, kappa }
    }

    /// g = γ×e in the chart, whose length is θ [rad].
    #[inline(always)]
    fn g(&self) -> Vector2<S> {
        Vector2::new(self.gamma.y, -self.gamma.x)
    }

    /// The rate of φ in the chart [rad/s] of a rotor that turns at ω [rad/s].
    #[inline(always)]
    pub fn phi_rate(&self, omega: &Vector3<S>) -> S {
        // eq. 6, eq. 29: dφ/dt = ±(e·ω + τ g·ω)
        S::constant(self.chart.sign()) * (omega.x + self.tau * omega.yz().dot(&self.g()))
    }

    /// dγ/dt in the chart [rad/s], its y and z components, of a rotor that turns at ω [rad/s].
    #[inline(always)]
    pub fn gamma_rate(&self, omega: &Vector3<S>) -> Vector2<S> {
        // eq. 8: dγ/dt = ω_⊥ − (e·ω + κ g·ω) g
        let g = self.g();
        omega.yz() - g * (omega.x + self.kappa * omega.yz().dot(&g))
    }

    /// The axial rate ω_φ = dφ/dt [rad/s], φ from e, of a rotor that turns at ω [rad/s]. At t = −e, where it has no
    /// limit, that of the other chart.
    pub fn axial_rate(&self, omega: &Vector3<S>) -> S {
        let in_chart = self.phi_rate(omega);
        if self.chart == Chart::FromE {
            return in_chart;
        }
        // eq. 30: ω_φ = e·ω − cot(θ′/2)/θ′ g′·ω = e·ω − (g′·ω)/(4xτ)
        let rate = omega.x - omega.yz().dot(&self.g()) / (self.x * self.tau * S::constant(4.0));
        if rate.re().is_finite() { rate } else { in_chart }
    }

    /// n = (e + t)/(1 + e·t) [1], along which a constant-velocity joint passes a torque on: ω_φ = n·ω.
    #[inline(always)]
    pub fn joint_axis(&self) -> Vector3<S> {
        let g = self.g();
        let across = match self.chart {
            // eq. 6: n = e + τ g
            Chart::FromE => g * self.tau,
            // eq. 30: n = e − g′/(4xτ)
            Chart::FromMinusE => -g / (self.x * self.tau * S::constant(4.0)),
        };
        Vector3::new(S::one(), across.x, across.y)
    }

    /// tan(θ/2) γ/θ in the chart [1].
    #[inline(always)]
    pub(super) fn half_tangent(&self) -> Vector2<S> {
        self.gamma * self.tau
    }

    /// γ_y and γ_z [rad] in the chart.
    #[inline(always)]
    pub fn gamma_in_chart(&self) -> Vector2<S> {
        self.gamma
    }

    /// The chart in which γ is written.
    pub fn chart(&self) -> Chart {
        self.chart
    }

    /// γ from e [rad], |γ| ≤ π.
    #[inline(always)]
    pub fn gamma(&self) -> Vector3<S> {
        let gamma = match self.chart {
            Chart::FromE => self.gamma,
            Chart::FromMinusE => crossed(self.gamma),
        };
        Vector3::new(S::zero(), gamma.x, gamma.y)
    }
}
