//! Numbers of 320 binary places (96 decimal ones), and the entire functions of the tilt as Taylor series in them.
//!
//! A double is a rational with a power of two below the line, so each enters exactly (to 2⁻³²⁰ where it is smaller).
//! Each product and quotient is cut at 2⁻³²⁰; the series need some 60 of them, so what comes out is good to 90 digits.
//! Source of the series: Taylor's. Checks: `tests/exact/fixed.rs`, against digits in print and unrounded rationals.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use std::ops::{Add, Div, Mul, Sub};

/// Binary places.
pub const PLACES: u32 = 320;

/// A number of [`PLACES`] binary places.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fixed(BigInt);

/// Mantissa and exponent: |x| = mantissa·2^exponent.
pub fn decoded(x: f64) -> (u64, i32) {
    assert!(x.is_finite());
    let bits = x.to_bits();
    let (field, fraction) = (((bits >> 52) & 0x7ff) as i32, bits & ((1 << 52) - 1));
    if field == 0 { (fraction, -1074) } else { (fraction | (1 << 52), field - 1075) }
}

impl Fixed {
    /// A whole number.
    pub fn whole(n: i64) -> Self {
        Self(BigInt::from(n) << PLACES)
    }

    /// A double, exactly where it has no places beyond the last.
    pub fn of(x: f64) -> Self {
        let (mantissa, exponent) = decoded(x);
        let shift = PLACES as i32 + exponent;
        let magnitude = BigInt::from(mantissa);
        let magnitude = if shift >= 0 { magnitude << shift } else { magnitude >> -shift };
        Self(if x < 0.0 { -magnitude } else { magnitude })
    }

    /// A rational number, cut at the last place.
    pub fn rational(x: &BigRational) -> Self {
        Self((x.numer() << PLACES) / x.denom())
    }

    /// A decimal number with a point.
    pub fn decimal(digits: &str) -> Self {
        let (whole, fraction) = digits.split_once('.').expect("a point");
        let n: BigInt = format!("{whole}{fraction}").parse().expect("digits");
        Self((n << PLACES) / BigInt::from(10).pow(fraction.len() as u32))
    }

    /// a/b of two doubles, which may be as small as they like.
    pub fn ratio(a: f64, b: f64) -> Self {
        let ((p, i), (q, j)) = (decoded(a), decoded(b));
        let (shift, q) = (PLACES as i32 + i - j, BigInt::from(q));
        let magnitude = if shift >= 0 { (BigInt::from(p) << shift) / q } else { BigInt::from(p) / (q << -shift) };
        Self(if (a < 0.0) == (b < 0.0) { magnitude } else { -magnitude })
    }

    /// The nearest double, or one beside it.
    pub fn to_f64(&self) -> f64 {
        let dropped = self.0.bits().saturating_sub(64).min(u64::from(PLACES)) as u32;
        let high = (&self.0 >> dropped).to_f64().expect("in range");
        let mut value = high;
        for _ in 0..PLACES - dropped {
            value *= 0.5;
        }
        value
    }

    /// |self|
    pub fn abs(&self) -> Self {
        Self(self.0.abs())
    }

    /// √self, cut at the last place.
    pub fn sqrt(&self) -> Self {
        Self((&self.0 << PLACES).sqrt())
    }

    /// Σ coefficient(k)·(−x)^k/(2k + n)!, summed until nothing is left.
    fn alternating(&self, n: i64, coefficient: impl Fn(i64) -> i64) -> Self {
        let mut term = Self::whole(1);
        for i in 2..=n {
            term = Self(term.0 / i);
        }
        let (mut sum, mut k) = (Self::whole(0), 0);
        while !term.0.is_zero() {
            sum = Self(sum.0 + &term.0 * coefficient(k));
            k += 1;
            term = Self(-(&term * self).0 / ((2 * k + n - 1) * (2 * k + n)));
        }
        sum
    }

    /// cos √x
    pub fn cosine(&self) -> Self {
        self.alternating(0, |_| 1)
    }

    /// sin √x/√x
    pub fn sinc(&self) -> Self {
        self.alternating(1, |_| 1)
    }

    /// (1 − cos √x)/x
    pub fn versine(&self) -> Self {
        self.alternating(2, |_| 1)
    }

    /// (sin √x/√x − cos √x)/x, with 1/(2k+3)! − 1/(2k+2)! joined to 2(k+1)/(2k+3)!
    pub fn bessel(&self) -> Self {
        self.alternating(3, |k| 2 * (k + 1))
    }

    /// tan(θ/2)/θ = (1 − cos θ)/(θ sin θ), of θ².
    pub fn tau(&self) -> Self {
        &self.versine() / &self.sinc()
    }

    /// (1 − θ cot θ)/θ² = (sin θ/θ − cos θ)/θ² : sin θ/θ, of θ².
    pub fn kappa(&self) -> Self {
        &self.bessel() / &self.sinc()
    }

    /// 2π to 100 places (OEIS A019692).
    pub fn tau_circle() -> Self {
        Self::decimal(
            "6.2831853071795864769252867665590057683943387987502116419498891846156328125724179972560696506842341359",
        )
    }
}

impl Add for &Fixed {
    type Output = Fixed;
    fn add(self, b: Self) -> Fixed {
        Fixed(&self.0 + &b.0)
    }
}

impl Sub for &Fixed {
    type Output = Fixed;
    fn sub(self, b: Self) -> Fixed {
        Fixed(&self.0 - &b.0)
    }
}

impl Mul for &Fixed {
    type Output = Fixed;
    fn mul(self, b: Self) -> Fixed {
        Fixed((&self.0 * &b.0) >> PLACES)
    }
}

impl Div for &Fixed {
    type Output = Fixed;
    fn div(self, b: Self) -> Fixed {
        Fixed((&self.0 << PLACES) / &b.0)
    }
}
