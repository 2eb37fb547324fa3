//! The drift of an asymmetric body: its attitude in closed form, and how many turns φ has made on the way.

use super::Flow;
use crate::body::{Asymmetric, Inertia, Poinsot};
use crate::effects::Effects;
use crate::integrate::Refusal;
use crate::rotation::{Tilt, Turn, Turned};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

/// Of a path that ends at −e if it goes straight there, so much is gone at once \[1].
const SHARE: f64 = 0.9;

/// So close to −e \[rad] nothing tells on which side the axis passes.
const LEAST: f64 = 1e-12;

/// By less than half a turn \[rad] the shortest turn has the turns of φ of the true one.
const FARTHEST: f64 = 3.0;

impl<E: Effects, const N: usize> Flow<'_, E, N> {
    /// Has followed an asymmetric body that nothing acts on for a time `h` \[s].
    pub(super) fn tumbled(mut self, body: &Inertia, asymmetric: &Asymmetric, h: f64) -> Self {
        let tilt = self.tilt();
        let axes = tilt.attitude(self.at.phi) * asymmetric.principal();
        let along = axes.tr_mul(&self.at.k);
        let Some(tumbling) = Tumbling::new(body, asymmetric, axes, along) else {
            // eq. 72: ω stays
            let about = Vector3::new(body.spin * along.x, asymmetric.excess * along.y, 0.0);
            self.take(tilt.turned(&Turn::about((self.at.k * body.per_jt + axes * about) * h)));
            return self;
        };
        let turned = tilt.turned(&tumbling.free.turn(h).seen_from(&axes));
        let beside = tumbling.beside(tilt, h, turned.phi + TAU * turned.turns);
        // Each part costs about what an evaluation does.
        self.evaluations += f64::from(beside.parts);
        if beside.parts > MOST_PARTS {
            self.refusal = Some(TOO_MANY_PARTS);
            return self;
        }
        self.turns += beside.turns;
        self.take(turned);
        self
    }

    /// Goes on from a tilt that has turned.
    fn take(&mut self, turned: Turned) {
        self.at.phi += turned.phi;
        self.turns += turned.turns;
        self.at.gamma = turned.gamma;
        self.axis = Tilt::new(self.rotor.frame.chart, turned.gamma).axis;
    }
}

/// A drift is cut into at most so many parts: a longer one must be made of several.
const MOST_PARTS: u32 = 30_000;

const TOO_MANY_PARTS: Refusal =
    Refusal("the axis lingers at -e, and the turns that phi makes there cannot be counted over so long a step");

/// A body that tumbles.
pub struct Tumbling {
    free: Poinsot,
    /// Its principal axes at the start, in O \[1].
    axes: Matrix3<f64>,
    /// K along them [kg·m²/s].
    along: Vector3<f64>,
    /// 1/J about them [1/(kg·m²)].
    slowness: Vector3<f64>,
    /// The axis t along them \[1].
    t: Vector3<f64>,
}

/// What a walk past −e has found.
pub struct Beside {
    /// Whole turns by which φ advances more than was thought.
    pub turns: f64,
    /// Parts in which it went.
    pub parts: u32,
}

impl Tumbling {
    /// With its principal axes in O \[1], and K `along` them [kg·m²/s]; None where it turns steadily.
    pub fn new(body: &Inertia, asymmetric: &Asymmetric, axes: Matrix3<f64>, along: Vector3<f64>) -> Option<Self> {
        let slowness = Vector3::new(body.spin + body.per_jt, asymmetric.excess + body.per_jt, body.per_jt);
        let free = body.free(asymmetric, &along)?;
        Some(Self { free, axes, along, slowness, t: asymmetric.principal().row(0).transpose() })
    }

    /// For how long the axis, `tilt` now, surely does not reach −e when K is `along` the principal axes now \[s]; nearer than
    /// `least` \[rad] it does not count.
    fn clear(&self, tilt: &Tilt<f64>, along: &Vector3<f64>, least: f64) -> f64 {
        let (bound, way) = (self.free.bound(), (SHARE * (tilt.axis + Vector3::x()).norm()).max(least));
        let omega = along.component_mul(&self.slowness);
        let (speed, growth) = (omega.cross(&self.t).norm(), along.cross(&omega).component_mul(&self.slowness).norm());
        // eq. 95: |ω×t| τ + ½ |dω/dt| τ² = s, s = 0.9 |t + e|
        let time = 2.0 * way / (speed + (speed * speed + 2.0 * growth * way).sqrt());
        // eq. 95: the larger of s/Ω and (2/λ) ln(1 + ½λτ), λ = 2Ω/√3, this 3/Ω at most
        let half = bound / 3.0_f64.sqrt();
        (way / bound).max((libm::log1p(half * time) / half).min(FARTHEST / bound))
    }

    /// How φ advances in a time `h` \[s], by `phi` \[rad] and so many whole turns, where the start is `tilt`.
    ///
    /// In parts too short to reach −e. Any two ways of the axis that do not reach it advance φ alike, so the shortest may
    /// stand for the true one.
    pub fn beside(&self, mut tilt: Tilt<f64>, h: f64, phi: f64) -> Beside {
        // After many turns the attitude is known as well as their angle: no part is then lost in the time's rounding.
        let least = LEAST.max(4.0 * f64::EPSILON * self.free.bound() * h.abs());
        let mut clear = self.clear(&tilt, &self.along, least);
        if h.abs() <= clear {
            return Beside { turns: 0.0, parts: 0 };
        }
        let (mut at, mut behind, mut advanced, mut parts) = (0.0, Turn::of(1.0, Vector3::zeros()), 0.0, 0);
        loop {
            let is_last = (h - at).abs() <= clear;
            at = if is_last { h } else { at + clear.copysign(h) };
            let turn = self.free.turn(at);
            let here = turn.seen_from(&self.axes);
            let turned = tilt.turned(&here.after(&behind.back()));
            advanced += turned.phi + TAU * turned.turns;
            parts += 1;
            if is_last || parts > MOST_PARTS {
                return Beside { turns: ((advanced - phi) / TAU).round(), parts };
            }
            (tilt, behind) = (Tilt::new(tilt.chart(), turned.gamma), here);
            clear = self.clear(&tilt, &turn.back().carried(&self.along), least);
        }
    }
}
