//! What comes in from outside, over time.

use crate::scalar::Scalar;
use crate::stored::{Damaged, Stored, Walk, choice, stored};

/// An input as a polynomial of degree 2 in time, about the communication point where it was last set.
///
/// What is sent at one communication point belongs together: a value and derivatives, in any order. A value alone is
/// held. The polynomial stays in force until the input is set again.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Signal {
    /// The communication point where it was last set \[s].
    origin: f64,
    /// In the input's unit.
    value: f64,
    /// Its rate [unit/s].
    slope: f64,
    /// Its second derivative [unit/s²].
    curvature: f64,
    /// The direction in which derivatives are asked for [unit].
    seed: f64,
    /// What was said of it last, and when \[s].
    source: Source,
    told: f64,
}

stored!(Signal { origin, value, slope, curvature, seed, source, told });

/// What was said of a signal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Source {
    /// A value was set.
    #[default]
    Value,
    /// Derivatives were sent.
    Derivatives,
    /// It was extrapolated.
    Extrapolated,
}

impl Stored for Source {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        choice(self, &[Source::Value, Source::Derivatives, Source::Extrapolated], walk)
    }
}

/// A parabola goes through so many values.
pub const NODES: usize = 3;

/// The polynomial of degree 0, 1 or 2 through these values at these times \[s], the latest first: by how much it is at `t` \[s] more than the latest
/// value, and its coefficients of powers 1 and 2 of the time from there on.
pub fn goes_on(t: f64, [t0, t1, t2]: [f64; NODES], values: [f64; NODES], degree: usize) -> [f64; NODES] {
    let ahead = t - t0;
    // Before the first point nothing is known of an input but its value.
    let over = |rise: f64, run: f64| if run > 0.0 { rise / run } else { 0.0 };
    let slope = |n: usize, from: f64, to: f64| over(values[n] - values[n + 1], to - from);
    // eq. 67: P(t) = u₀ + [u₀u₁](t − t₀) + [u₀u₁u₂](t − t₀)(t − t₁)
    let first = if degree > 0 { slope(0, t1, t0) } else { 0.0 };
    let second = if degree > 1 { over(first - slope(1, t2, t1), t0 - t2) } else { 0.0 };
    let last_step = if degree > 1 { t0 - t1 } else { 0.0 };
    [ahead * (first + second * (ahead + last_step)), first + second * (2.0 * ahead + last_step), second]
}

/// The highest derivative of an input that a host may send.
pub const HIGHEST_DERIVATIVE: u32 = 2;

impl Signal {
    /// A signal that holds this value.
    pub fn held(value: f64) -> Self {
        Self { value, ..Self::default() }
    }

    /// Its value at time `t` \[s].
    #[inline(always)]
    pub fn at<S: Scalar>(&self, t: S) -> S {
        let s = t - S::constant(self.origin);
        // eq. 31: u(t₀ + s) = u₀ + u₁ s + ½ u₂ s²
        S::moving(self.value, self.seed) + s * (S::constant(self.slope) + s * S::constant(0.5 * self.curvature))
    }

    /// Its coefficient of this power of the time from `t` \[s] on.
    pub fn coefficient(&self, t: f64, power: usize) -> f64 {
        match power {
            0 => self.at(t),
            1 => self.rate_at(t),
            2 => 0.5 * self.curvature,
            _ => 0.0,
        }
    }

    /// What it sums up to from time `from` to `t` [unit·s]: what is set now, it does not change.
    #[inline(always)]
    pub fn sum<S: Scalar>(&self, from: f64, t: S) -> S {
        let s = t - S::constant(from);
        let further = s * (S::constant(0.5 * self.rate_at(from)) + s * S::constant(self.curvature / 6.0));
        // eq. 31: ∫u dt = u s + ½ u₁ s² + ⅙ u₂ s³
        (S::constant(self.at(from)) + further) * s
    }

    /// What it gains from time `from` to `t` [unit].
    #[inline(always)]
    pub fn gain<S: Scalar>(&self, from: f64, t: S) -> S {
        let s = t - S::constant(from);
        // eq. 31: u₁ s + ½ u₂ s²
        s * (S::constant(self.rate_at(from)) + s * S::constant(0.5 * self.curvature))
    }

    /// Its rate at time `t` [unit/s].
    #[inline(always)]
    pub fn rate_at<S: Scalar>(&self, t: S) -> S {
        S::constant(self.slope) + (t - S::constant(self.origin)) * S::constant(self.curvature)
    }

    /// When it was last set \[s].
    pub fn since(&self) -> f64 {
        self.origin
    }

    /// Whether it is zero at all times.
    pub fn is_zero(&self) -> bool {
        self.value == 0.0 && self.is_held()
    }

    /// Whether it has no derivatives: none were sent, or zeros.
    #[inline(always)]
    pub fn is_held(&self) -> bool {
        self.slope == 0.0 && self.curvature == 0.0
    }

    /// Whether it is the same as another: both hold one value.
    pub fn goes_on_like(&self, other: &Self) -> bool {
        self.is_held() && other.is_held() && self.value.to_bits() == other.value.to_bits()
    }

    /// What was said last, of a signal that goes on as it was.
    pub fn going_on(self, before: Self) -> Self {
        Self { source: self.source, told: self.told, ..before }
    }

    /// Sets its value from the communication point `t` \[s] on. Derivatives sent there stay.
    pub fn set(&mut self, t: f64, value: f64) {
        self.set_out_from(t);
        self.value = value;
    }

    /// Sets its derivative of order 1 or 2 at the communication point `t` \[s].
    pub fn set_derivative(&mut self, t: f64, order: u32, value: f64) {
        self.set_out_from(t);
        self.source = Source::Derivatives;
        if order == 1 {
            self.slope = value;
        } else {
            self.curvature = value;
        }
    }

    /// Goes on from the communication point `t` \[s] at the rate that another signal says, unless it has derivatives that were sent no earlier.
    pub fn follow(&mut self, t: f64, rate: &Self) {
        let (value, slope, curvature) = (self.at(t), rate.at(t), rate.rate_at(t));
        let goes_on = self.rate_at::<f64>(t) == slope && self.curvature == curvature;
        let has_own = self.source == Source::Derivatives && !self.is_held() && self.told >= rate.told;
        if !goes_on && !has_own {
            *self = Self { origin: t, value, slope, curvature, ..*self };
        }
    }

    /// Whether derivatives were sent of it after anything was said of the other, or the other is zero.
    pub fn has_later_derivatives_than(&self, other: &Self) -> bool {
        self.source == Source::Derivatives && (other.told < self.told || other.is_zero())
    }

    /// Its rate as a signal.
    pub fn rate(&self) -> Self {
        Self { value: self.slope, slope: self.curvature, curvature: 0.0, seed: 0.0, ..*self }
    }

    /// What was set before the run counts from its start at `t` \[s].
    pub fn begin(&mut self, t: f64) {
        (self.origin, self.told) = (t, t);
    }

    /// The value that was set at the communication point `t` \[s], if one was.
    pub fn set_at(&self, t: f64) -> Option<f64> {
        (self.told == t && self.source != Source::Extrapolated).then_some(self.value)
    }

    /// Whether derivatives were sent at the communication point `t` \[s].
    pub fn was_sent_derivatives_at(&self, t: f64) -> bool {
        self.told == t && self.source == Source::Derivatives
    }

    /// Extrapolates it from the communication point `t` \[s] on: value, rate and second derivative there.
    pub fn extrapolate(&mut self, t: f64, [value, slope, curvature]: [f64; 3]) {
        *self = Self { origin: t, value, slope, curvature, source: Source::Extrapolated, told: t, ..*self };
    }

    /// Derivatives are asked for in a direction that has this much more of this input.
    pub fn ask(&mut self, seed: f64) {
        self.seed += seed;
    }

    /// The value goes on from `t` \[s]; derivatives sent elsewhere are forgotten.
    fn set_out_from(&mut self, t: f64) {
        if self.origin != t || self.source == Source::Extrapolated {
            *self = Self { origin: t, value: self.at(t), ..Self::default() };
        } else if self.told != t {
            self.source = Source::Value;
        }
        self.told = t;
    }
}
