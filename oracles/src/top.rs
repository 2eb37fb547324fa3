//! The heavy symmetric top: Lagrange's, on a fixed pivot, by elliptic functions, and the upright one on an elastic pivot
//! by its linear equations. SI units, radians; gravity g along −e. Checks: `tests/exact/top.rs`.

use super::elliptic::{jacobi, quarter_period};
use nalgebra::{Complex, Matrix4};

/// A top on a fixed pivot, let go at the tilt θ₀ while only its axis spins.
///
/// Source: Lagrange (1788); Whittaker, Analytical Dynamics, §71. With u = cos θ and λ = (Ja ω_a)²/(4 A m g l),
/// A = Jt + m l²: u̇² = (2 m g l/A)(u₀ − u)(1 − u² − 2λ(u₀ − u)), so u = u₁ + (u₀ − u₁) sn², between u₀ and u₁.
#[derive(Clone, Copy, Debug)]
pub struct Lagrange {
    /// u at its least, at the start, and the third root, beyond 1.
    roots: [f64; 3],
    /// du/dt of sn's argument [1/s].
    p: f64,
}

impl Lagrange {
    /// Of a top of transverse inertia `a` about the pivot and axial momentum `momentum` [kg·m²/s], with m g l `weight`
    /// [N·m], let go at `theta` \[rad].
    pub fn new(a: f64, momentum: f64, weight: f64, theta: f64) -> Self {
        let (start, lambda) = (libm::cos(theta), momentum * momentum / (4.0 * a * weight));
        let root = (lambda * lambda - 2.0 * lambda * start + 1.0).sqrt();
        let roots = [lambda - root, start, lambda + root];
        Self { roots, p: (weight * (roots[2] - roots[0]) / (2.0 * a)).sqrt() }
    }

    /// cos θ at time `t` \[s].
    pub fn cosine(&self, t: f64) -> f64 {
        let [low, high, third] = self.roots;
        let m1 = (third - high) / (third - low);
        let [sn, ..] = jacobi(self.p * t + quarter_period(m1), m1);
        low + (high - low) * sn * sn
    }
}

/// The rates Ω [rad/s] of small motions e^(iΩt) of an upright top on an elastic pivot; with Im Ω < 0 they grow.
///
/// Eq. 12, linear in the tilt, gravity in place of the tilt spring:
/// (c1 − mΩ²)(l²c1 − m g l + Ja ω Ω − Jt Ω²) = (c1 l)².
#[allow(non_snake_case, reason = "the paper's symbols")]
#[derive(Clone, Copy, Debug)]
pub struct Upright {
    /// Mass \[kg].
    pub m: f64,
    /// Moments of inertia [kg·m²].
    pub Ja: f64,
    /// See `Ja`.
    pub Jt: f64,
    /// From the pivot to the mass centre \[m].
    pub l: f64,
    /// Stiffness of the pivot [N/m].
    pub c1: f64,
    /// Gravity along −e [m/s²].
    pub g: f64,
    /// ω·t [rad/s].
    pub spin: f64,
}

impl Upright {
    /// The four rates Ω [rad/s].
    pub fn rates(&self) -> [Complex<f64>; 4] {
        let Self { m, Ja, Jt, l, c1, g, spin } = *self;
        // Coefficients of Ω⁰ … Ω⁴; those of Ω⁰ without the two (c1 l)² that cancel.
        let tilt = l * l * c1 - m * g * l;
        let c = [-c1 * m * g * l, c1 * Ja * spin, -c1 * Jt - m * tilt, -m * Ja * spin, m * Jt];
        let mut companion = Matrix4::zeros();
        for n in 0..4 {
            companion[(n, 3)] = -c[n] / c[4];
            if n < 3 {
                companion[(n + 1, n)] = 1.0;
            }
        }
        let mut rates: [Complex<f64>; 4] = companion.complex_eigenvalues().into();
        // Newton's method to the last digits, which the companion's largest root leaves out for the others.
        for rate in &mut rates {
            for _ in 0..4 {
                // Horner's rule, for the slope too.
                let (mut value, mut slope) = (Complex::from(0.0), Complex::from(0.0));
                for c in c.iter().rev() {
                    slope = slope * *rate + value;
                    value = value * *rate + c;
                }
                *rate -= value / slope;
            }
        }
        rates
    }

    /// The rate that grows fastest.
    pub fn fastest_growing(&self) -> Complex<f64> {
        self.rates().into_iter().min_by(|a, b| a.im.total_cmp(&b.im)).expect("four")
    }

    /// How far the mass centre is out for a tilt of 1 rad in the motion of rate Ω: c1 l/(c1 − mΩ²) \[m].
    pub fn shape(&self, rate: Complex<f64>) -> Complex<f64> {
        Complex::from(self.c1 * self.l) / (-rate * rate * self.m + self.c1)
    }

    /// The spin above which a top on a rigid pivot sleeps [rad/s]: (Ja ω)² = 4 A m g l.
    pub fn sleeps_from(&self) -> f64 {
        2.0 * ((self.Jt + self.m * self.l * self.l) * self.m * self.g * self.l).sqrt() / self.Ja
    }
}
