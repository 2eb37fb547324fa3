//! Arithmetic on N numbers two at a time, in the order that is written: the same bits as one at a time.

use wide::f64x2;

/// How many pairs hold `count` numbers.
#[inline(always)]
pub const fn pairs(count: usize) -> usize {
    count.div_ceil(2)
}

/// The numbers 2p and 2p + 1 of `v`; 0 for one beyond its end.
#[inline(always)]
pub fn pair<const N: usize>(v: &[f64; N], p: usize) -> f64x2 {
    // As chunks, for the compiler loads and stores them whole.
    let (whole, rest) = v.as_chunks();
    f64x2::new(if p < N / 2 { whole[p] } else { [rest[0], 0.0] })
}

/// Puts a pair where [`pair`] found it.
#[inline(always)]
pub fn put<const N: usize>(v: &mut [f64; N], p: usize, pair: f64x2) {
    let (whole, rest) = v.as_chunks_mut();
    if p < N / 2 {
        whole[p] = pair.to_array();
    } else {
        rest[0] = pair.to_array()[0];
    }
}

/// Both numbers are this one.
#[inline(always)]
pub fn both(a: f64) -> f64x2 {
    f64x2::splat(a)
}

/// Where a sum starts: −0 + x = x, so nothing is added. (+0 + −0 is +0, and the compiler would have to add it.)
#[inline(always)]
pub fn nothing() -> f64x2 {
    f64x2::splat(-0.0)
}

/// The larger ones of two pairs of numbers, each on its own: `max`, which passes over what is not a number, takes eight instructions.
#[inline(always)]
pub fn larger(a: f64x2, b: f64x2) -> f64x2 {
    a.fast_max(b)
}

/// The sum of both.
#[inline(always)]
pub fn sum(pair: f64x2) -> f64 {
    let [first, second] = pair.to_array();
    first + second
}

/// Whether all are finite: 0 times one that is not is not a number.
#[inline(always)]
pub fn are_finite<const N: usize>(v: &[f64; N]) -> bool {
    let zeros = (0..pairs(N)).fold(nothing(), |zeros, p| zeros + pair(v, p) * both(0.0));
    sum(zeros) == 0.0
}
