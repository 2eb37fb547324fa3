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
    /// γ_y and γ_z \[rad] in the chart.
    gamma: Vector2<S>,
    /// The rotor axis t \[1].
    pub axis: Vector3<S>,
    /// θ² [rad²], θ = |γ| in the chart
    theta_squared: S,
    /// s²/4 \[1]
    quarter: S,
    /// (jc + s²)/4 \[1]
    numerator: S,
    /// sin θ/θ and θ/sin θ \[1]
    sinc: S,
    per_sinc: S,
}

/// Below this θ² [rad²] the change of sin θ/θ is a short series: it errs by 3e-9 of it.
const SMALL: f64 = 0.01;

impl<S: Scalar> Tilt<S> {
    /// The tilt of γ = (0, γ_y, γ_z) \[rad] in a chart.
    #[inline(always)]
    pub fn new(chart: Chart, gamma: Vector2<S>) -> Self {
        let theta_squared = gamma.dot(&gamma);
        // eq. 9: s = sin(θ/2)/(θ/2) = c + x j
        let [c, j_quarter] = series::cosine_and_bessel(theta_squared);
        let s = c + theta_squared * j_quarter;
        // eq. 10: cos θ = c² − x s², sin θ/θ = s c, κ = (j c + s²)/4 · θ/sin θ
        let sinc = s * c;
        let quarter = s * s * S::constant(0.25);
        let cos_theta = c * c - theta_squared * quarter;
        let numerator = j_quarter * c + quarter;
        let per_sinc = S::one() / sinc;
        // eq. 2, eq. 29: t = ±(e cos θ + (sin θ/θ) γ×e)
        let sign = S::constant(chart.sign());
        let across = sign * sinc;
        let axis = Vector3::new(sign * cos_theta, across * gamma.y, -(across * gamma.x));
        Self { chart, gamma, axis, theta_squared, quarter, numerator, sinc, per_sinc }
    }

    /// The tilt of an axis t \[1] of which nothing else is known.
    #[inline(always)]
    pub(crate) fn of_axis(chart: Chart, axis: Vector3<S>) -> Self {
        let none = S::constant(f64::NAN);
        let gamma = Vector2::new(none, none);
        Self { chart, gamma, axis, theta_squared: none, quarter: none, numerator: none, sinc: none, per_sinc: none }
    }

    /// The tilt of an axis t \[1] that is not where the chart is singular. What nobody asks for is not computed.
    #[inline(always)]
    pub fn along(chart: Chart, axis: Vector3<f64>) -> Tilt<f64> {
        let (sign, across) = (chart.sign(), axis.yz());
        let per_sinc = series::per_sinc_of_both(sign * axis.x, across.norm_squared());
        // eq. 2, eq. 29: γ = ±(θ/sin θ) e×t
        let gamma = Vector2::new(-across.y, across.x) * (sign * per_sinc);
        Tilt { axis, ..Tilt::new(chart, gamma) }
    }

    /// τ = tan(θ/2)/θ \[1].
    #[inline(always)]
    fn tau(&self) -> S {
        // eq. 10: τ = s/(2c) = 2 s²/4 · θ/sin θ
        (self.quarter + self.quarter) * self.per_sinc
    }

    /// (1 − cos θ)/θ² \[1].
    #[inline(always)]
    pub(super) fn versine(&self) -> S {
        // eq. 10: ½ s² = 2 s²/4
        self.quarter + self.quarter
    }

    /// 1 − e·t \[1], to its last digits where t is near e.
    #[inline(always)]
    pub fn foreshortening(&self) -> S {
        let versine = self.versine() * self.theta_squared;
        match self.chart {
            Chart::FromE => versine,
            // eq. 29: e·t = −cos θ′
            Chart::FromMinusE => S::constant(2.0) - versine,
        }
    }

    /// g = γ×e in the chart, whose length is θ \[rad].
    #[inline(always)]
    fn g(&self) -> Vector2<S> {
        Vector2::new(self.gamma.y, -self.gamma.x)
    }

    /// The rate of φ in the chart [rad/s] of a rotor that turns at ω [rad/s].
    #[inline(always)]
    pub fn phi_rate(&self, omega: &Vector3<S>) -> S {
        // eq. 6, eq. 29: dφ/dt = ±(e·ω + τ g·ω)
        S::constant(self.chart.sign()) * (omega.x + self.tau() * omega.yz().dot(&self.g()))
    }

    /// dγ/dt in the chart [rad/s], its y and z components, of a rotor that turns at ω [rad/s].
    #[inline(always)]
    pub fn gamma_rate(&self, omega: &Vector3<S>) -> Vector2<S> {
        let g = self.g();
        let across = self.numerator * omega.yz().dot(&g);
        // eq. 8: dγ/dt = ω_⊥ − (e·ω) g − κ (g·ω) g; the division in κ takes longest, so what it gives is waited for last
        (omega.yz() - g * omega.x) - g * across * self.per_sinc
    }

    /// By how much the axis t changes where γ in the chart changes by so much \[rad], to first order \[1].
    #[inline(always)]
    pub fn axis_change(&self, change: &Vector2<S>) -> Vector3<S> {
        let sign = S::constant(self.chart.sign());
        let along = self.gamma.dot(change);
        // (cos θ − sin θ/θ)/θ², whose terms nearly cancel where θ is small
        let direct = (sign * self.axis.x - self.sinc) / self.theta_squared;
        let x = self.theta_squared;
        let series = x * (x * S::constant(-1.0 / 840.0) + S::constant(1.0 / 30.0)) - S::constant(1.0 / 3.0);
        let slope = S::constant(SMALL).where_less(x, direct, series);
        // eq. 121: dt = ±(−e (sin θ/θ) γ·dγ + d((sin θ/θ) γ×e))
        let (g, g_change) = (self.g(), Vector2::new(change.y, -change.x));
        let across = g_change * self.sinc + g * (slope * along);
        Vector3::new(-(self.sinc * along), across.x, across.y) * sign
    }

    /// The axial rate ω_φ = dφ/dt [rad/s], φ from e, of a rotor that turns at ω [rad/s]. At t = −e, where it has no
    /// limit, that of the other chart.
    pub fn axial_rate(&self, omega: &Vector3<S>) -> S {
        let in_chart = self.phi_rate(omega);
        if self.chart == Chart::FromE {
            return in_chart;
        }
        // eq. 30: ω_φ = e·ω − cot(θ′/2)/θ′ g′·ω = e·ω − (g′·ω)/(θ′²τ)
        let rate = omega.x - omega.yz().dot(&self.g()) / (self.theta_squared * self.tau());
        if rate.re().is_finite() { rate } else { in_chart }
    }

    /// n = (e + t)/(1 + e·t) \[1], along which a constant-velocity joint passes a torque on: ω_φ = n·ω.
    #[inline(always)]
    pub fn joint_axis(&self) -> Vector3<S> {
        let g = self.g();
        let across = match self.chart {
            // eq. 6: n = e + τ g
            Chart::FromE => g * self.tau(),
            // eq. 30: n = e − g′/(θ′²τ)
            Chart::FromMinusE => -g / (self.theta_squared * self.tau()),
        };
        Vector3::new(S::one(), across.x, across.y)
    }

    /// tan(θ/2) γ/θ in the chart \[1].
    #[inline(always)]
    pub(super) fn half_tangent(&self) -> Vector2<S> {
        self.gamma * self.tau()
    }

    /// γ_y and γ_z \[rad] in the chart.
    #[inline(always)]
    pub fn gamma_in_chart(&self) -> Vector2<S> {
        self.gamma
    }

    /// The chart in which γ is written.
    pub fn chart(&self) -> Chart {
        self.chart
    }

    /// γ_y and γ_z from e \[rad], |γ| ≤ π.
    #[inline(always)]
    pub fn gamma(&self) -> Vector2<S> {
        match self.chart {
            Chart::FromE => self.gamma,
            Chart::FromMinusE => crossed(self.gamma),
        }
    }
}
