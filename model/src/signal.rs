//! What comes in from outside, over time.

use crate::scalar::Scalar;
use crate::stored::{Damaged, Stored, Walk, choice, stored};

/// An input as a polynomial of degree 3 in time, about the communication point where it was last set.
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
    /// Half its second derivative [unit/s²].
    square: f64,
    /// A sixth of its third one [unit/s³].
    cube: f64,
    /// The direction in which derivatives are asked for [unit].
    seed: f64,
    /// What was said of it last, and when \[s].
    source: Source,
    told: f64,
}

stored!(Signal { origin, value, slope, square, cube, seed, source, told });

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

/// A cubic goes through so many values.
pub const NODES: usize = 4;

/// The polynomial of degree 0 to 3 through these values at these times \[s], the latest first: by how much it is at `t` \[s] more than the latest
/// value, and its coefficients of powers 1 to 3 of the time from there on.
pub fn goes_on(t: f64, times: [f64; NODES], values: [f64; NODES], degree: usize) -> [f64; NODES] {
    let [t0, t1, t2, t3] = times;
    let ahead = t - t0;
    // Before the first point nothing is known of an input but its value.
    let over = |rise: f64, run: f64| if run > 0.0 { rise / run } else { 0.0 };
    let slope = |n: usize| over(values[n] - values[n + 1], times[n] - times[n + 1]);
    // eq. 67: P(t) = u₀ + [u₀u₁](t − t₀) + [u₀u₁u₂](t − t₀)(t − t₁) + [u₀u₁u₂u₃](t − t₀)(t − t₁)(t − t₂)
    let first = if degree > 0 { slope(0) } else { 0.0 };
    let second = if degree > 1 { over(first - slope(1), t0 - t2) } else { 0.0 };
    let last_step = if degree > 1 { t0 - t1 } else { 0.0 };
    let parabola = [ahead * (first + second * (ahead + last_step)), first + second * (2.0 * ahead + last_step), second];
    let [change, rate, bend] = parabola;
    if degree < 3 {
        return [change, rate, bend, 0.0];
    }
    let third = over(second - over(slope(1) - slope(2), t1 - t3), t0 - t3);
    let (since, before) = (t - t1, t - t2);
    [
        change + third * ahead * since * before,
        rate + third * (ahead * since + (ahead + since) * before),
        bend + third * (ahead + since + before),
        third,
    ]
}

/// The highest derivative of an input that a host may send.
pub const HIGHEST_DERIVATIVE: u32 = 3;

impl Signal {
    /// A signal that holds this value.
    pub fn held(value: f64) -> Self {
        Self { value, ..Self::default() }
    }

    /// Its value at time `t` \[s].
    #[inline(always)]
    pub fn at<S: Scalar>(&self, t: S) -> S {
        let s = t - S::constant(self.origin);
        let bend = S::constant(self.square) + s * S::constant(self.cube);
        // eq. 31: u(t₀ + s) = u₀ + u₁ s + ½ u₂ s² + ⅙ u₃ s³
        S::moving(self.value, self.seed) + s * (S::constant(self.slope) + s * bend)
    }

    /// Its coefficient of this power of the time from `t` \[s] on.
    pub fn coefficient(&self, t: f64, power: usize) -> f64 {
        match power {
            0 => self.at(t),
            1 => self.rate_at(t),
            2 => 0.5 * self.curvature_at(t),
            3 => self.cube,
            _ => 0.0,
        }
    }

    /// What it sums up to from time `from` to `t` [unit·s]: what is set now, it does not change.
    #[inline(always)]
    pub fn sum<S: Scalar>(&self, from: f64, t: S) -> S {
        let s = t - S::constant(from);
        let bend = S::constant(self.curvature_at(from) / 6.0) + s * S::constant(0.25 * self.cube);
        let further = s * (S::constant(0.5 * self.rate_at(from)) + s * bend);
        // eq. 31: ∫u dt = u s + ½ u₁ s² + ⅙ u₂ s³ + u₃ s⁴/24
        (S::constant(self.at(from)) + further) * s
    }

    /// What it gains from time `from` to `t` [unit].
    #[inline(always)]
    pub fn gain<S: Scalar>(&self, from: f64, t: S) -> S {
        let s = t - S::constant(from);
        let bend = S::constant(0.5 * self.curvature_at(from)) + s * S::constant(self.cube);
        // eq. 31: u₁ s + ½ u₂ s² + ⅙ u₃ s³
        s * (S::constant(self.rate_at(from)) + s * bend)
    }

    /// Its rate at time `t` [unit/s].
    #[inline(always)]
    pub fn rate_at<S: Scalar>(&self, t: S) -> S {
        let s = t - S::constant(self.origin);
        S::constant(self.slope) + s * (S::constant(2.0 * self.square) + s * S::constant(3.0 * self.cube))
    }

    /// Its second derivative at time `t` \[s] [unit/s²].
    fn curvature_at(&self, t: f64) -> f64 {
        2.0 * self.square + (t - self.origin) * (6.0 * self.cube)
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
        self.slope == 0.0 && self.square == 0.0 && self.cube == 0.0
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

    /// Sets its derivative of order 1 to [`HIGHEST_DERIVATIVE`] at the communication point `t` \[s].
    pub fn set_derivative(&mut self, t: f64, order: u32, value: f64) {
        self.set_out_from(t);
        self.source = Source::Derivatives;
        match order {
            1 => self.slope = value,
            2 => self.square = 0.5 * value,
            _ => self.cube = value * (1.0 / 6.0),
        }
    }

    /// Goes on from the communication point `t` \[s] at the rate that another signal says, unless it has derivatives that were sent no earlier.
    pub fn follow(&mut self, t: f64, rate: &Self) {
        let (value, slope, bend, curvature) = (self.at(t), rate.at(t), rate.rate_at::<f64>(t), rate.curvature_at(t));
        let (square, cube) = (0.5 * bend, curvature * (1.0 / 6.0));
        let goes_on = [self.rate_at(t), 0.5 * self.curvature_at(t), self.cube] == [slope, square, cube];
        let has_own = self.source == Source::Derivatives && !self.is_held() && self.told >= rate.told;
        if !goes_on && !has_own {
            *self = Self { origin: t, value, slope, square, cube, ..*self };
        }
    }

    /// Whether derivatives were sent of it after anything was said of the other, or the other is zero.
    pub fn has_later_derivatives_than(&self, other: &Self) -> bool {
        self.source == Source::Derivatives && (other.told < self.told || other.is_zero())
    }

    /// Its rate as a signal.
    pub fn rate(&self) -> Self {
        Self { value: self.slope, slope: 2.0 * self.square, square: 3.0 * self.cube, cube: 0.0, seed: 0.0, ..*self }
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

    /// Extrapolates it from the communication point `t` \[s] on, by its coefficients of powers 0 to 3 of the time since.
    pub fn extrapolate(&mut self, t: f64, [value, slope, square, cube]: [f64; NODES]) {
        let (source, told) = (Source::Extrapolated, t);
        *self = Self { origin: t, value, slope, square, cube, source, told, ..*self };
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
