//! A split rotation that is turned by any Euler vector ρ: L(ρ)·L(γ) = L(γ₁)·L(δe), with all turns of δ.

use super::arc::{Reduced, atan2};
use super::chart::azimuth;
use super::{Chart, Tilt, series};
use nalgebra::{Matrix3, Vector2, Vector3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// What becomes of a tilt.
#[derive(Clone, Copy, Debug)]
pub struct Turned {
    /// γ₁ in the chart of γ \[rad].
    pub gamma: Vector2<f64>,
    /// By how much φ in the chart advances \[rad], less `turns`.
    pub phi: f64,
    /// Whole turns, so that φ from e advances by what its rate adds up to.
    pub turns: f64,
}

/// The rotation ρ as a quaternion (w, p), its half angle less n half turns.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    rho: Vector3<f64>,
    w: f64,
    p: Vector3<f64>,
    half_turns: f64,
}

impl Turn {
    /// By an Euler vector ρ \[rad] of any length.
    #[inline(always)]
    pub fn about(rho: Vector3<f64>) -> Self {
        let square = rho.norm_squared();
        if square <= PI * PI {
            // eq. 9
            let [c, j_quarter] = series::cosine_and_bessel(square);
            return Self { rho, w: c, p: rho * (0.5 * (c + square * j_quarter)), half_turns: 0.0 };
        }
        let angle = square.sqrt();
        let half = Reduced::new(0.5 * angle);
        Self { rho, w: half.cosine, p: rho * (half.beta * half.sinc / angle), half_turns: half.half_turns }
    }

    /// That of a quaternion of any length and sign, half a turn or less.
    pub fn of(w: f64, p: Vector3<f64>) -> Self {
        let per = (1.0 / (w * w + p.norm_squared()).sqrt()).copysign(w);
        Self { rho: p * per, w: w * per, p: p * per, half_turns: 0.0 }
    }

    /// This one after another, half a turn or less.
    pub fn after(&self, other: &Self) -> Self {
        Self::of(self.w * other.w - self.p.dot(&other.p), other.p * self.w + self.p * other.w + self.p.cross(&other.p))
    }

    /// The same backwards.
    pub fn back(&self) -> Self {
        Self { rho: -self.rho, p: -self.p, ..*self }
    }

    /// The same seen from other axes, those of a rotation matrix.
    pub fn seen_from(&self, axes: &Matrix3<f64>) -> Self {
        Self { rho: axes * self.rho, p: axes * self.p, ..*self }
    }

    /// Where it takes a vector.
    pub fn carried(&self, v: &Vector3<f64>) -> Vector3<f64> {
        let across = self.p.cross(v);
        v + (across * self.w + self.p.cross(&across)) * 2.0
    }

    /// Real and imaginary part \[1].
    pub fn quaternion(&self) -> (f64, Vector3<f64>) {
        (self.w, self.p)
    }

    /// Real part and part along e of its product with (a, 0, b).
    #[inline(always)]
    fn along(&self, a: f64, b: Vector2<f64>) -> (f64, f64) {
        (self.w * a - self.p.yz().dot(&b), self.p.x * a + self.p.yz().perp(&b))
    }

    /// The half angle δ/2 of that part \[rad] in [−π, π], and the half turns that it does besides.
    #[inline(always)]
    fn half_angle(&self, a: f64, b: Vector2<f64>) -> (f64, f64) {
        let (w, x) = self.along(a, b);
        // eq. 36: from (a, 0) the point (w, x) goes round the origin in one sense all the way
        let sense = if self.rho.x * a + self.rho.yz().perp(&b) < 0.0 { -1.0 } else { 1.0 };
        (atan2(x, w), sense * self.half_turns)
    }
}

impl Tilt<f64> {
    /// The tilt after a turn about its direction all the way.
    #[inline(always)]
    pub fn turned(&self, q: &Turn) -> Turned {
        let b = self.half_tangent();
        // eq. 35: (w, x, y, z) is the product of the quaternions of ρ and (1, 0, b), b = tan(θ/2) γ/θ
        let (w, x) = q.along(1.0, b);
        let y = q.w * b.x + q.p.y - q.p.x * b.y;
        let z = q.w * b.y + q.p.z + q.p.x * b.x;
        // eq. 36: γ₁ = 2 arctan(|y + iz|/|w + ix|), along (y + iz)(w + ix)
        let (along, across) = (w * w + x * x, y * y + z * z);
        let direction = Vector2::new(y * w - z * x, y * x + z * w);
        let gamma = if across <= along {
            let inverse = 1.0 / along;
            direction * (2.0 * inverse * series::arctangent(across * inverse))
        } else {
            let ratio = along / across;
            let half = FRAC_PI_2 - ratio.sqrt() * series::arctangent(ratio);
            direction * (2.0 * half / (along * across).sqrt())
        };
        let (half, turns) = q.half_angle(1.0, b);
        match self.chart() {
            Chart::FromE => Turned { gamma, phi: 2.0 * half, turns },
            Chart::FromMinusE => {
                // eq. 37: 2Δβ = δ + δ′; in the chart from e γ has the quaternion (|b|², 0, −b)
                let (other_half, other_turns) = q.half_angle(b.norm_squared(), -b);
                let beta = (half + other_half) + PI * (turns + other_turns);
                let gained = 2.0 * ((azimuth(self.gamma_in_chart()) + beta - azimuth(gamma)) / TAU).round();
                Turned { gamma, phi: -2.0 * half, turns: gained - turns }
            }
        }
    }
}
