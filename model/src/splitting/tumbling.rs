//! The drift of an uneven body: its attitude in closed form, and how many turns φ has made on the way.

use super::Flow;
use crate::body::{Inertia, Uneven};
use crate::effects::Effects;
use crate::rotation::{Tilt, Turn};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// Of a path that ends at −e if it goes straight there, so much is gone at once [1].
const SHARE: f64 = 0.9;

/// So close to −e [rad] nothing tells on which side the axis passes.
const LEAST: f64 = 1e-12;

impl<E: Effects, const N: usize> Flow<'_, E, N> {
    /// Follows an uneven body that nothing acts on for a time `h` [s].
    pub(super) fn tumble(&mut self, body: &Inertia, uneven: &Uneven, h: f64) {
        let axes = self.tilt.attitude(self.at.phi) * uneven.principal();
        let along = axes.tr_mul(&self.at.k);
        let Some(free) = body.free(uneven, &along) else {
            // eq. 72: ω stays
            let about = Vector3::new(body.spin * along.x, uneven.excess * along.y, 0.0);
            return self.turn((self.at.k * body.per_jt + axes * about) * h);
        };
        let turn = |h: f64| free.turn(h).seen_from(&axes);
        let turned = self.tilt.turned(&turn(h));
        let slowness = Vector3::new(body.spin + body.per_jt, uneven.excess + body.per_jt, body.per_jt);
        let omega = along.component_mul(&slowness);
        let gyration = along.cross(&omega).component_mul(&slowness);
        let speeds = [(axes * omega).cross(&self.tilt.axis).norm(), gyration.norm(), free.bound()];
        if farthest(speeds, h) > SHARE * to_minus_e(&self.tilt) {
            self.turns += turns_beside(self.tilt, turn, free.bound(), h, turned.phi + TAU * turned.turns);
        }
        self.take(turned);
    }
}

/// How far the axis gets in a time `h` [s] at most [rad]: with its speed |ω×t| [rad/s], |dω/dt| [rad/s²], and an angular velocity
/// that is not exceeded [rad/s].
fn farthest([speed, acceleration, bound]: [f64; 3], h: f64) -> f64 {
    let way = bound * h.abs();
    if way > 1.0 {
        return way;
    }
    // eq. 95: |ω×t| h + |dω/dt| h² (e^x − 1 − x)/x² at x = 2Ωh ≤ 2, where the last factor is at most 1.1
    way.min((speed + 1.1 * acceleration * h.abs()) * h.abs())
}

/// The distance of the axis to −e [1].
fn to_minus_e(tilt: &Tilt<f64>) -> f64 {
    (tilt.axis + Vector3::x()).norm()
}

/// Whole turns by which φ advances more than by `phi` [rad] when its tilt turns so for `h` [s], never faster than `bound` [rad/s].
///
/// In parts too short to reach −e. Any two ways of the axis that do not reach it advance φ alike, so the shortest may stand for
/// the true one.
fn turns_beside(mut tilt: Tilt<f64>, turn: impl Fn(f64) -> Turn, bound: f64, h: f64, phi: f64) -> f64 {
    let (mut at, mut behind, mut advanced) = (0.0, None::<Turn>, 0.0);
    loop {
        let clear = (to_minus_e(&tilt) * SHARE).max(LEAST) / bound;
        let is_last = (h - at).abs() <= clear;
        if is_last && behind.is_none() {
            return 0.0;
        }
        at = if is_last { h } else { at + clear.copysign(h) };
        let here = turn(at);
        // eq. 95
        let turned = tilt.turned(&behind.map_or(here, |behind| here.after(&behind.back())));
        advanced += turned.phi + TAU * turned.turns;
        if is_last {
            return ((advanced - phi) / TAU).round();
        }
        (tilt, behind) = (Tilt::new(tilt.chart(), turned.gamma), Some(here));
    }
}
