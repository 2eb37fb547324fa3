//! The coefficients of t, and sums of their products.

use super::lean::{Lean, MOST_PAIRS};
use super::triple::{Triple, first, swapped, total};
use crate::integrate::taylor::{POWERS, Powers};
use wide::f64x2;

/// Coefficients of t, two and two as products need them, and of what is multiplied by t or by t×dt/dt. Those that run backwards
/// begin with the highest power.
///
/// They are stored as they are loaded, in pairs: a pair that is stored as two numbers makes its load wait.
pub struct Axis<'r> {
    xy: &'r mut Powers,
    zx: &'r mut Powers,
    yz: &'r mut Powers,
    back_xy: &'r mut Powers,
    back_zx: &'r mut Powers,
    back_yz: &'r mut Powers,
    back_yx: &'r mut Powers,
    /// λ twice; λ and the quotient q.
    pull: &'r mut Powers,
    both: &'r mut Powers,
    /// t×dt/dt, and S.
    turns: [&'r mut Powers; 2],
    spin: &'r mut Powers,
    /// Not 0 once S varies.
    changes: u64,
}

/// Sums of lower coefficients.
pub struct Lower {
    /// Σ λ_k t_(n−k).
    pub pulled: Triple,
    /// Beside another number, Σ q_k e·t_(n−k).
    pub divided: f64x2,
    /// Of θ/sin θ.
    pub lean: f64,
}

/// Of the pairs of powers a < b, a + b = m, 0 < a.
pub struct Pairs {
    /// Σ (b − a) t_a×t_b.
    pub crossed: Triple,
    /// ½ Σ t_a·t_b over all a from 1 to m − 1, and of e·t alone; twice.
    pub square: f64x2,
    pub along: f64x2,
}

/// The powers from `most` down to `least`.
#[inline(always)]
fn down(back: &Powers, most: usize, least: usize) -> &[f64x2] {
    &back[POWERS - 1 - most..POWERS - least]
}

impl<'r> Axis<'r> {
    /// Of a series that begins so.
    #[inline(always)]
    pub fn new(rows: &'r mut [Powers; 12], first: Triple, second: Triple, momentum: f64) -> Self {
        let [xy, zx, yz, back_xy, back_zx, back_yz, back_yx, pull, both, turn_xy, turn_zx, spin] = rows;
        let turns = [turn_xy, turn_zx];
        let mut axis = Self { xy, zx, yz, back_xy, back_zx, back_yz, back_yx, pull, both, turns, spin, changes: 0 };
        axis.put(0, first);
        axis.put(1, second);
        axis.spin[0] = f64x2::splat(momentum);
        axis
    }

    /// t of this power.
    #[inline(always)]
    pub fn put(&mut self, power: usize, t: Triple) {
        let back = POWERS - 1 - power;
        let (Triple { xy, zx }, yz, yx) = (t, t.yz(), swapped(t.xy));
        (self.xy[power], self.zx[power], self.yz[power]) = (xy, zx, yz);
        (self.back_xy[back], self.back_zx[back], self.back_yz[back], self.back_yx[back]) = (xy, zx, yz, yx);
    }

    /// λ, twice, and q, beside another number, of this power, and S of the next.
    #[inline(always)]
    pub fn push(&mut self, power: usize, pull: f64x2, quotient: f64x2, momentum: f64) {
        (self.pull[power], self.both[power]) = (pull, f64x2::new([pull.to_array()[0], quotient.to_array()[1]]));
        self.spin[power + 1] = f64x2::splat(momentum);
        // Without the sign of a zero.
        self.changes |= momentum.to_bits() << 1;
    }

    /// The sums over λ_k and q_k for the power n, of which λ_n and q_n are not known yet, and θ/sin θ.
    #[inline(always)]
    pub fn lower(&self, n: usize, lean: &mut Lean, along: f64) -> Lower {
        match lean.pairs {
            0 => self.lower_with::<0>(n, lean, along),
            1 => self.lower_with::<1>(n, lean, along),
            2 => self.lower_with::<2>(n, lean, along),
            _ => self.lower_with::<MOST_PAIRS>(n, lean, along),
        }
    }

    #[inline(always)]
    fn lower_with<const PAIRS: usize>(&self, n: usize, lean: &mut Lean, along: f64) -> Lower {
        let none = f64x2::ZERO;
        let (mut xys, mut zxs, mut sums) = (none, none, [none; PAIRS]);
        let (pull, both, xy, zx) =
            (&self.pull[..n], &self.both[..n], &down(self.back_xy, n, 1)[..n], &down(self.back_zx, n, 1)[..n]);
        if PAIRS == 0 {
            for k in 0..n {
                xys += pull[k] * xy[k];
                zxs += both[k] * zx[k];
            }
        } else {
            let (inner, squares) = (&lean.inner.as_chunks::<PAIRS>().0[..n], &down(lean.back_squares, n, 1)[..n]);
            for k in 0..n {
                xys += pull[k] * xy[k];
                zxs += both[k] * zx[k];
                for (sum, inner) in sums.iter_mut().zip(&inner[k]) {
                    *sum += *inner * squares[k];
                }
            }
        }
        let pulled = Triple { xy: xys, zx: f64x2::new([zxs.to_array()[0], xys.to_array()[0]]) };
        Lower { pulled, divided: zxs, lean: lean.go_on(n, along, sums) }
    }

    /// The coefficient of S t×dt/dt of which that of t×dt/dt is `turn`.
    #[inline(always)]
    pub fn gyroscopic(&mut self, n: usize, turn: Triple) -> Triple {
        let back = POWERS - 1 - n;
        (self.turns[0][back], self.turns[1][back]) = (turn.xy, turn.zx);
        if self.changes == 0 {
            let spin = self.spin[0];
            return turn * spin;
        }
        let (mut xys, mut zxs) = (f64x2::ZERO, f64x2::ZERO);
        let (spin, [xy, zx]) = (&self.spin[..=n], self.turns.each_ref().map(|turns| &down(turns, n, 0)[..=n]));
        for k in 0..=n {
            xys += spin[k] * xy[k];
            zxs += spin[k] * zx[k];
        }
        Triple { xy: xys, zx: zxs }
    }

    /// The sums for the power m, of which t_m is not known yet.
    #[inline(always)]
    pub fn pairs_of(&self, m: usize) -> Pairs {
        let none = f64x2::ZERO;
        let (mut crossed_xy, mut crossed_z, mut square_xy, mut square_zx) = (none, none, none, none);
        let count = (m - 1) / 2;
        let (mut difference, two) = (f64x2::splat((m - 2 * count) as f64), f64x2::splat(2.0));
        let [xy, zx, yz] = [&*self.xy, &*self.zx, &*self.yz].map(|of| &of[1..=count]);
        let [back_xy, back_zx, back_yz, back_yx] = [&*self.back_xy, &*self.back_zx, &*self.back_yz, &*self.back_yx]
            .map(|of| &down(of, m - 1, m - count)[..count]);
        // The newest last: the others need not wait for it.
        for i in (0..count).rev() {
            crossed_xy += (yz[i] * back_zx[i] - zx[i] * back_yz[i]) * difference;
            crossed_z += xy[i] * back_yx[i] * difference;
            square_xy += xy[i] * back_xy[i];
            square_zx += zx[i] * back_zx[i];
            difference += two;
        }
        if m.is_multiple_of(2) {
            let [xy, zx] = [self.xy[m / 2], self.zx[m / 2]];
            square_xy += xy * xy * f64x2::HALF;
            square_zx += zx * zx * f64x2::HALF;
        }
        let z = crossed_z - swapped(crossed_z);
        let zx = f64x2::new([z.to_array()[0], crossed_xy.to_array()[0]]);
        let crossed = Triple { xy: crossed_xy, zx };
        Pairs { crossed, square: total(square_xy, square_zx), along: first(square_xy) }
    }
}
