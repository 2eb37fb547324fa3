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

/// The rotation ρ as a quaternion (w, σρ), its half angle less n half turns.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    rho: Vector3<f64>,
    w: f64,
    sigma: f64,
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
            return Self { rho, w: c, sigma: 0.5 * (c + square * j_quarter), half_turns: 0.0 };
        }
        let angle = square.sqrt();
        let half = Reduced::new(0.5 * angle);
        Self { rho, w: half.cosine, sigma: half.beta * half.sinc / angle, half_turns: half.half_turns }
    }

    /// That of a quaternion of any length and sign, half a turn or less.
    pub fn of(w: f64, p: Vector3<f64>) -> Self {
        let per = (1.0 / (w * w + p.norm_squared()).sqrt()).copysign(w);
        Self { rho: p * per, w: w * per, sigma: 1.0, half_turns: 0.0 }
    }

    /// This one after another, half a turn or less.
    pub fn after(&self, other: &Self) -> Self {
        let ((w, p), (v, q)) = (self.quaternion(), other.quaternion());
        Self::of(w * v - p.dot(&q), q * w + p * v + p.cross(&q))
    }

    /// The same backwards.
    pub fn back(&self) -> Self {
        Self { rho: -self.rho, ..*self }
    }

    /// The same seen from other axes, those of a rotation matrix.
    pub fn seen_from(&self, axes: &Matrix3<f64>) -> Self {
        Self { rho: axes * self.rho, ..*self }
    }

    /// Where it takes a vector.
    #[inline(always)]
    pub fn carried(&self, v: &Vector3<f64>) -> Vector3<f64> {
        let across = self.rho.cross(v);
        let twice = 2.0 * self.sigma;
        // The products with ρ need not wait for w and σ.
        v + across * (twice * self.w) + self.rho.cross(&across) * (twice * self.sigma)
    }

    /// Real and imaginary part \[1].
    #[inline(always)]
    pub fn quaternion(&self) -> (f64, Vector3<f64>) {
        (self.w, self.rho * self.sigma)
    }

    /// Real part and part along e of its product with (a, 0, b).
    #[inline(always)]
    fn along(&self, a: f64, b: Vector2<f64>) -> (f64, f64) {
        let (w, p) = self.quaternion();
        (w * a - p.yz().dot(&b), p.x * a + p.yz().perp(&b))
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

/// How far an axis that is turned again and again turns the rotor about it beside a chart, whole turns among it: a product of
/// complex numbers, so that many turns take one arc tangent.
#[derive(Clone, Copy, Debug)]
pub struct Winding {
    real: f64,
    imaginary: f64,
    half_turns: f64,
}

impl Winding {
    /// Not turned yet.
    pub fn none() -> Self {
        Self { real: 1.0, imaginary: 0.0, half_turns: 0.0 }
    }

    /// Goes on with a turn of an axis that is here \[1]: t in the chart from e, −t in the other.
    #[inline(always)]
    pub fn turn(&mut self, q: &Turn, axis: &Vector3<f64>) {
        let (sum, (real, p)) = (Vector3::new(1.0 + axis.x, axis.y, axis.z), q.quaternion());
        // eq. 108: q = p_w (1 + t_x) + p_y t_z − p_z t_y + i p·(e + t), whose angle is δ/2
        let (w, x) = (real * sum.x + p.y * sum.z - p.z * sum.y, p.dot(&sum));
        let (real, imaginary) = (self.real * w - self.imaginary * x, self.real * x + self.imaginary * w);
        // An angle within ±π that is gone on from by less than π the same way has passed ±π where the side changes.
        if (self.imaginary < 0.0) == (x < 0.0) && (imaginary < 0.0) != (x < 0.0) {
            self.half_turns += if x < 0.0 { -2.0 } else { 2.0 };
        }
        if q.half_turns != 0.0 {
            // eq. 36
            self.half_turns += if q.rho.dot(&sum) < 0.0 { -q.half_turns } else { q.half_turns };
        }
        (self.real, self.imaginary) = (real, imaginary);
    }

    /// The half angle \[rad] in [−π, π], and the half turns that it does besides.
    #[inline(always)]
    fn half_angle(&self) -> (f64, f64) {
        (atan2(self.imaginary, self.real), self.half_turns)
    }

    /// How φ in a chart advances \[rad] and φ from e besides it by whole turns, while γ \[rad] goes `from` there `to` here; beside
    /// the other chart the axis winds by `other`, which the chart from e does not ask for.
    #[inline(always)]
    pub fn advances(&self, other: &Self, chart: Chart, [from, to]: [Vector2<f64>; 2]) -> (f64, f64) {
        let (half, turns) = self.half_angle();
        match chart {
            Chart::FromE => (2.0 * half, turns),
            Chart::FromMinusE => (-2.0 * half, gained([(half, turns), other.half_angle()], from, to) - turns),
        }
    }
}

/// The turns that φ from e gains from an azimuth that goes on by half the sum of these angles, each with half turns besides.
#[inline(always)]
fn gained([(half, turns), (other_half, other_turns)]: [(f64, f64); 2], from: Vector2<f64>, to: Vector2<f64>) -> f64 {
    // eq. 37: 2Δβ = δ + δ′
    let beta = (half + other_half) + PI * (turns + other_turns);
    2.0 * ((azimuth(from) + beta - azimuth(to)) / TAU).round()
}

impl Tilt<f64> {
    /// The tilt after a turn about its direction all the way.
    #[inline(always)]
    pub fn turned(&self, q: &Turn) -> Turned {
        let b = self.half_tangent();
        // eq. 35: (w, x, y, z) is the product of the quaternions of ρ and (1, 0, b), b = tan(θ/2) γ/θ
        let (w, x) = q.along(1.0, b);
        let (real, p) = q.quaternion();
        let y = real * b.x + p.y - p.x * b.y;
        let z = real * b.y + p.z + p.x * b.x;
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
                // In the chart from e γ has the quaternion (|b|², 0, −b).
                let other = q.half_angle(b.norm_squared(), -b);
                let gained = gained([(half, turns), other], self.gamma_in_chart(), gamma);
                Turned { gamma, phi: -2.0 * half, turns: gained - turns }
            }
        }
    }
}
