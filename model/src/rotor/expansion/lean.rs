//! The series of θ/sin θ in that of e·t.

use super::triple::between;
use crate::integrate::taylor::{POWERS, Powers};
use crate::rotation::series::lean_over_sine;
use wide::f64x2;

/// θ/sin θ = f_0 + f_1 w + w² (f_2 + f_3 w + w² (f_4 + …)), w being the change of e·t.
pub struct Lean<'r> {
    /// w², at each power twice.
    pub back_squares: &'r mut Powers,
    /// What stands in brackets, the outer ones first, two by two.
    pub inner: &'r mut [f64x2],
    pub pairs: usize,
    /// The terms f_k.
    terms: [f64; 4 * MOST_PAIRS + 3],
}

/// Pairs of brackets, at most.
pub const MOST_PAIRS: usize = 6;

/// So many pairs there are for so many powers of w: few numbers, for each is compiled by itself.
fn pairs(powers: u32) -> usize {
    match powers {
        0 => 0,
        1..=6 => 1,
        7..=10 => 2,
        _ => MOST_PAIRS,
    }
}

/// So many powers of w there are where so many are needed.
pub fn room(powers: u32) -> u32 {
    4 * pairs(powers) as u32 + 2
}

impl<'r> Lean<'r> {
    /// By so many powers of w.
    #[inline(always)]
    pub fn new(rows: &'r mut [Powers; 1 + MOST_PAIRS], powers: u32) -> Self {
        let ([back_squares, brackets @ ..], pairs) = (rows, pairs(powers));
        let inner = &mut brackets.as_flattened_mut()[..pairs * POWERS];
        Self { back_squares, inner, pairs, terms: [0.0; 4 * MOST_PAIRS + 3] }
    }

    #[inline(always)]
    pub fn put_square(&mut self, power: usize, square: f64x2) {
        self.back_squares[POWERS - 1 - power] = square;
    }

    /// The first coefficient, where e·t is `along`.
    pub fn begin(&mut self, along: f64) -> f64 {
        if self.pairs == 0 {
            return 0.0;
        }
        let levels = 4 * self.pairs + 2;
        lean_over_sine(along, &mut self.terms[..=levels]);
        for (pair, terms) in self.inner.iter_mut().zip(self.terms[2..levels].as_chunks::<4>().0) {
            *pair = f64x2::new([terms[0], terms[2]]);
        }
        self.terms[0]
    }

    /// The coefficient of the power n > 0, where that of e·t is `along` and these are those of w² times brackets.
    #[inline(always)]
    pub fn go_on<const PAIRS: usize>(&mut self, n: usize, along: f64, sums: [f64x2; PAIRS]) -> f64 {
        if PAIRS == 0 || n == 0 {
            return 0.0;
        }
        // eq. 103: the brackets from within
        let mut within = self.back_squares[POWERS - 1 - n] * f64x2::splat(self.terms[4 * PAIRS + 2]);
        let brackets = &mut self.inner.as_chunks_mut::<PAIRS>().0[n];
        for p in (0..PAIRS).rev() {
            let terms = f64x2::new([3, 5].map(|k| self.terms[4 * p + k]));
            brackets[p] = terms * f64x2::splat(along) + between(sums[p], within);
            within = sums[p];
        }
        let [outer, _] = within.to_array();
        self.terms[1] * along + outer
    }
}
