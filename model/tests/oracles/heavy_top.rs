//! A heavy symmetric top about a fixed point (Lagrange 1788), gravity along −x: A is its inertia across the axis about the
//! point, ω_a = ω·t and p, the angular momentum about x, are constant. SI units.

use super::extrapolation::steps;

/// The top.
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "the paper's symbols")]
pub struct HeavyTop {
    /// Inertia across the axis about the fixed point [kg·m²].
    pub A: f64,
    /// Inertia about the axis [kg·m²].
    pub Ja: f64,
    /// Weight times the distance of the mass centre [N·m].
    pub weight: f64,
    /// ω·t [rad/s].
    pub spin: f64,
}

impl HeavyTop {
    /// θ [rad] a time `t` [s] after it was let go at θ₀ [rad] without precession and nutation.
    pub fn let_go(&self, theta: f64, t: f64) -> f64 {
        let axial = self.Ja * self.spin;
        let p = axial * libm::cos(theta);
        let rates = |_: f64, [theta, rate]: &[f64; 2]| {
            let (sine, cosine) = (libm::sin(*theta), libm::cos(*theta));
            // p = A ψ̇ sin²θ + Ja ω_a cosθ;  A θ̈ = A ψ̇² sinθ cosθ − Ja ω_a ψ̇ sinθ + m g l sinθ
            let precession = (p - axial * cosine) / (self.A * sine * sine);
            let moment = (self.A * precession * cosine - axial) * precession * sine + self.weight * sine;
            [*rate, moment / self.A]
        };
        steps(rates, 0.0, &[theta, 0.0], t, 200)[0]
    }
}
