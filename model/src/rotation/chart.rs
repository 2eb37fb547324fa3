//! The two charts of the split rotation. Each is singular at one point of the sphere of axes, and regular at the other's.
//!
//! From e: L = L(γ)·L(φe), singular where t = −e. From −e: L = L(γ′)·Q·L(φ′e), Q a half turn about y, singular where
//! t = e. What is reported stays in the first, with |γ| ≤ π.

use super::series::per_sinc;
use super::{Angle, exact};
use crate::scalar::Scalar;
use crate::stored::{Damaged, Stored, Walk, choice};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The chart in which γ and φ are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Chart {
    /// γ turns e into t.
    #[default]
    FromE = 1,
    /// γ′ turns −e into t.
    FromMinusE = 2,
}

impl Stored for Chart {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        choice(self, &[Chart::FromE, Chart::FromMinusE], walk)
    }
}

/// π less its double \[rad].
const PI_LOW: f64 = 1.224_646_799_147_353_2e-16;

impl Chart {
    /// Beyond this |γ| \[rad] the motion goes on in the other chart. The other's |γ| is then 1.14, so that an axis that
    /// lingers about the equator (π/2) does not switch to and fro.
    const SWITCH: f64 = 2.0;

    /// A step that ends beyond this |γ| \[rad] was too long: the chart is singular at π.
    pub const REACH: f64 = 2.8;

    /// |γ| \[rad] from e beyond which laws that follow the direction of γ are refused: at π they are undefined.
    pub const LIMIT: f64 = 3.1;

    /// |γ′| \[rad] from −e within which they are refused.
    pub const FORBIDDEN: f64 = PI - Self::LIMIT;

    /// +1 where γ turns e into t, −1 where it turns −e into t \[1].
    #[inline(always)]
    pub const fn sign(self) -> f64 {
        match self {
            Chart::FromE => 1.0,
            Chart::FromMinusE => -1.0,
        }
    }

    /// The other one.
    pub const fn other(self) -> Self {
        match self {
            Chart::FromE => Chart::FromMinusE,
            Chart::FromMinusE => Chart::FromE,
        }
    }

    /// γ \[rad] in this chart of an axis t that is not where the chart is singular.
    #[inline(always)]
    pub fn gamma_of(self, axis: &Vector3<f64>) -> Vector2<f64> {
        let sign = self.sign();
        // eq. 2, eq. 29: γ = ±(θ/sin θ) e×t, cos θ = ±e·t
        Vector2::new(-axis.z, axis.y) * (sign * per_sinc(sign * axis.x))
    }

    /// How far a motion at this γ \[rad] is from where it should go on in the other chart \[rad²]; not positive there.
    pub fn before_border(self, gamma: Vector2<f64>) -> f64 {
        Self::SWITCH * Self::SWITCH - gamma.norm_squared()
    }

    /// Whether a motion at this γ \[rad] should go on in the other chart.
    pub fn is_left_at(self, gamma: Vector2<f64>) -> bool {
        self.before_border(gamma) <= 0.0
    }

    /// How far a motion at this γ \[rad] is from where a law that follows γ is refused \[rad²]; negative there.
    pub fn before_limit(self, gamma: Vector2<f64>) -> f64 {
        match self {
            Chart::FromE => Self::LIMIT * Self::LIMIT - gamma.norm_squared(),
            Chart::FromMinusE => gamma.norm_squared() - Self::FORBIDDEN * Self::FORBIDDEN,
        }
    }

    /// Whether the axis at this γ \[rad] is tilted from e by more than π/2.
    pub fn is_tilted_back(self, gamma: Vector2<f64>) -> bool {
        (gamma.norm_squared() > FRAC_PI_2 * FRAC_PI_2) == (self == Chart::FromE)
    }

    /// The chart and γ \[rad] in which a motion begins, given γ from e.
    pub fn best(gamma: Vector2<f64>) -> (Self, Vector2<f64>) {
        if gamma.norm_squared() <= FRAC_PI_2 * FRAC_PI_2 {
            (Chart::FromE, gamma)
        } else {
            (Chart::FromMinusE, crossed(gamma))
        }
    }

    /// φ from e \[rad], up to whole turns, of φ \[rad] and γ \[rad] in this chart.
    pub fn phi_from_e<S: Scalar>(self, phi: S, gamma: Vector2<S>) -> S {
        match self {
            Chart::FromE => phi,
            // eq. 27: φ = φ′ + 2β
            Chart::FromMinusE => phi + S::constant(2.0) * azimuth(gamma),
        }
    }

    /// φ from e, wrapped, of whole turns, and φ \[rad] and γ \[rad] in this chart.
    pub fn axial_angle(self, turns: f64, phi: f64, gamma: Vector2<f64>) -> Angle {
        Angle { turns, remainder: self.phi_from_e(phi, gamma) }.wrapped()
    }

    /// φ in this chart, wrapped, of φ from e and γ \[rad] in this chart.
    pub fn own_angle(self, phi: Angle, gamma: Vector2<f64>) -> Angle {
        match self {
            Chart::FromE => phi,
            // eq. 27: φ′ = φ − 2β
            Chart::FromMinusE => Angle { remainder: phi.remainder - 2.0 * azimuth(gamma), ..phi }.wrapped(),
        }
    }

    /// The turns that φ from e gains beside φ in this chart, while γ \[rad] goes a way from one place to the next by less than
    /// half a turn about the origin: those of 2β where its azimuth β passes its cut at ±π. 0 if the path is not finite.
    pub fn turns_gained(self, mut from: Vector2<f64>, way: impl IntoIterator<Item = Vector2<f64>>) -> f64 {
        if self == Chart::FromE {
            return 0.0;
        }
        let gained = way.into_iter().map(|to| {
            let from = std::mem::replace(&mut from, to);
            2.0 * ((azimuth(from) + azimuth_change(from, to) - azimuth(to)) / TAU).round()
        });
        let gained = gained.sum::<f64>();
        if gained.is_finite() { gained } else { 0.0 }
    }
}

/// The same tilt from the other chart: γ′ of γ, or γ of γ′ \[rad]. Where γ = 0: a half turn about y backwards.
pub fn crossed<S: Scalar>(gamma: Vector2<S>) -> Vector2<S> {
    let theta_squared = gamma.dot(&gamma);
    if theta_squared.re() == 0.0 {
        return Vector2::new(S::constant(-PI), S::zero());
    }
    let theta = theta_squared.sqrt();
    // eq. 26: γ′ = −(π − θ) γ/θ, π with its low part
    let rest = (S::constant(PI) - theta) + S::constant(PI_LOW);
    gamma * -(rest / theta)
}

/// [`crossed`] for a switch of chart: to the last bit, so that a switch leaves the motion where it is.
pub fn crossed_exactly(gamma: Vector2<f64>) -> Vector2<f64> {
    let ((yy, yy_low), (zz, zz_low)) = (exact::product(gamma.x, gamma.x), exact::product(gamma.y, gamma.y));
    let (sum, sum_low) = exact::sum(yy, zz);
    let theta_squared_low = sum_low + yy_low + zz_low;
    let theta = sum.sqrt();
    if theta == 0.0 {
        return crossed(gamma);
    }
    // θ + θ_low: one step of Newton's method on the exact θ².
    let (product, product_low) = exact::product(theta, theta);
    let theta_low = ((sum - product) - product_low + theta_squared_low) / (2.0 * theta);
    // eq. 26: γ′ = −(π − θ) γ/θ
    let (rest, rest_low) = exact::sum(PI, -theta);
    let rest_low = rest_low + PI_LOW - theta_low;
    let ratio = (rest + rest_low) / theta;
    let (back, back_low) = exact::product(ratio, theta);
    let ratio_low = ((rest - back) - back_low + rest_low - ratio * theta_low) / theta;
    gamma.map(|component| {
        let (high, low) = exact::product(component, ratio);
        -(high + (low + component * ratio_low))
    })
}

/// Azimuth β of γ about e, from y towards z \[rad], in [−π, π].
pub(super) fn azimuth<S: Scalar>(gamma: Vector2<S>) -> S {
    let (y, z) = (gamma.x.re(), gamma.y.re());
    // dβ = e·(γ×dγ)/|γ|²
    let turned = (gamma.y * S::constant(y) - gamma.x * S::constant(z)) / S::constant(y * y + z * z);
    // + 0 makes −0 a +0, and so −π a +π: who counts turns from one γ to an equal one must count none.
    turned.with_value(libm::atan2(z + 0.0, y))
}

/// Δβ \[rad] from one γ to another, by the shorter way; +π where it is straight through the origin.
pub fn azimuth_change(from: Vector2<f64>, to: Vector2<f64>) -> f64 {
    // eq. 28: Δβ = atan2(e·(γ₀×γ₁), γ₀·γ₁)
    azimuth(Vector2::new(from.dot(&to), from.perp(&to)))
}
