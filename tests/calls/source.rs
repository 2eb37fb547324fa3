//! Bytes as a row of choices.

use std::f64::consts::PI;

/// Bytes still to be read; after the last, zeros.
#[derive(Clone)]
pub struct Source<'b>(&'b [u8]);

/// Numbers on which arithmetic stumbles.
const NASTY: [f64; 18] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    5e-324,
    -5e-324,
    f64::MIN_POSITIVE,
    1e-300,
    -1e-300,
    1e300,
    -1e300,
    f64::MAX,
    f64::MIN,
    1.0,
    -1.0,
    PI,
    -PI,
];

impl<'b> Source<'b> {
    pub fn new(bytes: &'b [u8]) -> Self {
        Self(bytes)
    }

    pub fn has_ended(&self) -> bool {
        self.0.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        *first
    }

    /// A number below `n`, which is at most 256.
    pub fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }

    /// One of these.
    pub fn of<T: Copy>(&mut self, these: &[T]) -> T {
        these[self.below(these.len())]
    }

    /// True in about `of_256` cases of 256.
    pub fn chance(&mut self, of_256: u32) -> bool {
        // The high end: what is missing at the end of the bytes is no luck.
        u32::from(self.byte()) >= 256 - of_256
    }

    /// A number on which arithmetic stumbles.
    pub fn nasty(&mut self) -> f64 {
        self.of(&NASTY)
    }

    /// A number of ordinary size, or a nasty one.
    pub fn number(&mut self) -> f64 {
        if self.chance(64) { self.nasty() } else { (f64::from(self.byte()) - 128.0) / 8.0 }
    }

    /// About this number, or a nasty one.
    pub fn about(&mut self, number: f64) -> f64 {
        if self.chance(24) {
            self.nasty()
        } else if number == 0.0 {
            f64::from(self.byte()) / 128.0
        } else {
            number * self.of(&[0.5, 0.75, 1.0, 1.25, 2.0])
        }
    }
}
