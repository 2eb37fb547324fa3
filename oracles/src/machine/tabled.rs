//! What a bearing has against the speed: a curve over ω_φ of both signs, of which one piece at a time is followed. Cross terms change
//! their sign with it.

use super::Bearing;
use crate::monotone::piece;
use nalgebra::Vector3;

/// The eight coefficients as curves through points (ω_φ, coefficient).
#[derive(Clone, Debug)]
pub(super) struct Tabled {
    /// Along t from c \[m].
    pub p: f64,
    /// kyy, kyz, kzy, kzz, cyy, cyz, czy, czz.
    curves: [Vec<(f64, f64)>; 8],
    /// So many nodes are below what is followed.
    pub below: usize,
}

/// A piece is left where the speed is beyond its end by this part of the largest speed \[1]: rounding is no way.
const EDGE: f64 = 1e-12;

impl Tabled {
    /// Of a bearing with a table.
    pub fn of(bearing: &Bearing) -> Option<Self> {
        let backward = bearing.table.iter().rev().filter(|node| node.speed > 0.0).map(|node| (-node.speed, node));
        let nodes: Vec<_> = backward.chain(bearing.table.iter().map(|node| (node.speed, node))).collect();
        let curve = |n: usize| nodes.iter().map(|(speed, node)| (*speed, node.values()[n])).collect();
        (!nodes.is_empty()).then(|| Self { p: bearing.position, curves: std::array::from_fn(curve), below: 0 })
    }

    fn speed(&self, n: usize) -> f64 {
        self.curves[0][n].0
    }

    /// Follows the piece at this ω_φ [rad/s].
    pub fn follow(&mut self, speed: f64) {
        self.below = self.curves[0].partition_point(|node| node.0 <= speed);
    }

    /// How far ω_φ is above the lower end of the piece and below its upper one [rad/s].
    pub fn within(&self, speed: f64) -> [f64; 2] {
        let count = self.curves[0].len();
        let edge = EDGE * self.speed(count - 1);
        let low = if self.below == 0 { f64::INFINITY } else { speed - self.speed(self.below - 1) };
        let high = if self.below == count { f64::INFINITY } else { self.speed(self.below) - speed };
        [low + edge, high + edge]
    }

    /// What the cross terms have of those of the size of the speed \[1]: the sign of the piece, and of one about rest a line through 0.
    fn sign(&self, speed: f64) -> f64 {
        let count = self.curves[0].len();
        if self.below == 0 || (self.below < count && self.speed(self.below) <= 0.0) {
            -1.0
        } else if self.speed(self.below - 1) >= 0.0 {
            1.0
        } else {
            speed / self.speed(self.below)
        }
    }

    /// Force on the rotor at its station, of this place and velocity \[N].
    pub fn force(&self, [r, v]: &[Vector3<f64>; 2], speed: f64) -> Vector3<f64> {
        let [kyy, kyz, kzy, kzz, cyy, cyz, czy, czz] =
            std::array::from_fn(|n| piece(&self.curves[n], self.below, speed));
        let sign = self.sign(speed);
        let [kyz, kzy, cyz, czy] = [kyz, kzy, cyz, czy].map(|cross| cross * sign);
        let y = kyy * r.y + kyz * r.z + cyy * v.y + cyz * v.z;
        let z = kzy * r.y + kzz * r.z + czy * v.y + czz * v.z;
        Vector3::new(0.0, -y, -z)
    }
}
