//! Products of what varies, one power of time after another, for laws over [coefficients](crate::coefficient).
//!
//! A law asks for the same products in the same order at each power: what it asks for n-th finds its lower coefficients in the
//! n-th row.

use crate::integrate::power::power;
use nalgebra::Vector3;
use std::cell::{Cell, RefCell};
use wide::f64x2;

/// Coefficients of the powers from 0 to this one are asked for, at most.
pub const MOST_POWER: usize = crate::integrate::taylor::MOST_ORDER;

/// The coefficients of a series, with zeros behind them: sums go by fours.
pub type Row = [f64; ROW];

const ROW: usize = MOST_POWER + 4;

/// A series without coefficients yet.
pub const EMPTY: Row = [0.0; ROW];

/// What every law can ask of the motion: coefficients of the power at hand.
#[derive(Clone, Copy, Debug, Default)]
pub struct Now {
    /// The power.
    pub power: usize,
    /// Where the series starts \[s].
    pub t: f64,
    /// Of dt/dt [1/s].
    pub axis_rate: Vector3<f64>,
    /// Of t×dt/dt [1/s].
    pub turn: Vector3<f64>,
    /// Of ω_a [rad/s].
    pub spin: f64,
    /// Of θ/sin θ \[1], where a law has asked for it before.
    pub lean: f64,
}

/// A motion as a series, and the rows of what laws have asked for.
pub struct Series<R: ?Sized = [Row]> {
    /// At the power at hand.
    pub now: Now,
    /// 1 + e·t, but for the power at hand, which stands alone.
    one_and_along: Row,
    along: f64,
    /// Whether anyone asks for powers \[W].
    works: bool,
    leans: Cell<bool>,
    /// The row of what has a size.
    sized: Cell<Option<usize>>,
    next: Cell<usize>,
    rows: RefCell<R>,
}

impl<const ROWS: usize> Series<[Row; ROWS]> {
    /// With so many rows.
    pub fn new(works: bool) -> Self {
        Self {
            now: Now::default(),
            one_and_along: EMPTY,
            along: 0.0,
            works,
            leans: Cell::new(false),
            sized: Cell::new(None),
            next: Cell::new(0),
            rows: RefCell::new([EMPTY; ROWS]),
        }
    }
}

impl Series {
    /// Goes on to another power, where the coefficient of e·t is `along`.
    #[inline(always)]
    pub fn go_on(&mut self, now: Now, along: f64) {
        self.one_and_along[self.now.power] = self.along;
        self.along = if now.power == 0 { 1.0 + along } else { along };
        self.now = now;
        self.next.set(0);
    }

    /// Whether anyone asks for powers \[W].
    #[inline(always)]
    pub fn works(&self) -> bool {
        self.works
    }

    /// How many rows were asked for at this power.
    pub fn count(&self) -> usize {
        self.next.get()
    }

    /// The next rows; None where there are no more.
    #[inline(always)]
    fn take<T>(&self, count: usize, work: impl FnOnce(&mut [Row]) -> T) -> Option<T> {
        let first = self.next.replace(self.next.get() + count);
        self.rows.borrow_mut().get_mut(first..first + count).map(work)
    }

    /// Of a product; not a number where there are no more rows.
    #[inline(always)]
    pub fn product(&self, a: f64, b: f64) -> f64 {
        let power = self.now.power;
        let product = self.take(2, |rows| {
            let product = outer(a, b, rows, power) + folded(inner(&rows[0], &rows[1], power));
            (rows[0][power], rows[1][MOST_POWER - power]) = (a, b);
            product
        });
        product.unwrap_or(f64::NAN)
    }

    /// Of a sum of three products.
    #[inline(always)]
    pub fn dot(&self, a: [f64; 3], b: [f64; 3]) -> f64 {
        let power = self.now.power;
        let dot = self.take(6, |rows| {
            let (mut ends, mut between) = (0.0, f64x2::ZERO);
            for (pair, (a, b)) in rows.as_chunks_mut::<2>().0.iter_mut().zip(a.into_iter().zip(b)) {
                ends += outer(a, b, pair, power);
                between += inner(&pair[0], &pair[1], power);
                (pair[0][power], pair[1][MOST_POWER - power]) = (a, b);
            }
            ends + folded(between)
        });
        dot.unwrap_or(f64::NAN)
    }

    /// Of the size of what does not pass zero: the sign that it starts with stays.
    #[inline(always)]
    pub fn size(&self, a: f64) -> f64 {
        let power = self.now.power;
        self.sized.set(Some(self.next.get()));
        let sign = self.take(1, |rows| {
            rows[0][power] = a;
            if rows[0][0] < 0.0 { -1.0 } else { 1.0 }
        });
        sign.map_or(f64::NAN, |sign| sign * a)
    }

    /// So long \[s] what has a size keeps its sign for certain, of all powers up to this one.
    pub fn horizon(&self, order: usize) -> f64 {
        let rows = self.rows.borrow();
        let Some(row) = self.sized.get().and_then(|number| rows.get(number)) else { return f64::INFINITY };
        // Where |a_n| hⁿ ≤ |a₀|/2ⁿ for all n, their sum is less than |a₀|.
        let until = |n: usize| power(row[0].abs() / row[n].abs(), 1.0 / n as f64);
        0.5 * (1..=order).map(until).fold(f64::INFINITY, |least, one| if one < least { one } else { least })
    }

    /// Of a quotient by 1 + e·t.
    #[inline(always)]
    pub fn quotient(&self, a: f64) -> f64 {
        let power = self.now.power;
        let quotient = self.take(1, |rows| {
            // q_n d₀ = a_n − d_n q₀ − Σ d_k q_(n−k), 0 < k < n
            let lower = folded(inner(&self.one_and_along, &rows[0], power));
            let coefficient = if power == 0 {
                a / self.along
            } else {
                (a - self.along * rows[0][MOST_POWER] - lower) / self.one_and_along[0]
            };
            rows[0][MOST_POWER - power] = coefficient;
            coefficient
        });
        quotient.unwrap_or(f64::NAN)
    }

    /// Of θ/sin θ.
    #[inline(always)]
    pub fn lean(&self) -> f64 {
        self.leans.set(true);
        self.now.lean
    }

    /// Whether any law has asked for it.
    pub fn leans(&self) -> bool {
        self.leans.get()
    }
}

/// a_n b₀ + a₀ b_n, of which a_n and b_n are not in their rows yet: what was just written makes a pair that is loaded wait.
#[inline(always)]
fn outer(a: f64, b: f64, rows: &[Row], n: usize) -> f64 {
    if n == 0 { a * b } else { a * rows[1][MOST_POWER] + rows[0][0] * b }
}

/// Σ a_k b_(n−k), 0 < k < n, those of even and odd k apart: b is written backwards, and a ends before n.
#[inline(always)]
fn inner(a: &Row, b: &Row, n: usize) -> f64x2 {
    let count = n / 2;
    let [a, b] = [&a[1..], &b[MOST_POWER + 1 - n..]].map(|row| &row.as_chunks::<2>().0[..count]);
    let mut sum = f64x2::ZERO;
    for i in 0..count {
        sum += f64x2::new(a[i]) * f64x2::new(b[i]);
    }
    sum
}

#[inline(always)]
fn folded(sum: f64x2) -> f64 {
    let [odd, even] = sum.to_array();
    odd + even
}
