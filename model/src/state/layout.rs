//! Where everything stands in a state.

use super::Coordinates;
use crate::body::BODIES;
use crate::scalar::Scalar;
use nalgebra::{Vector2, Vector3};
use std::ops::Range;

/// How many numbers a body has beside its angle φ: r, v, K and γ.
pub const BODY: usize = 11;

/// A state consists of the effects' own states, the bodies, their angles φ, and the work supplied and lost \[J], if there is room for it:
/// what nothing depends on stands last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    own: usize,
    has_work: bool,
}

impl Layout {
    /// With so many own states, and with the work or without it.
    pub const fn new(own: usize, has_work: bool) -> Self {
        Self { own, has_work }
    }

    /// Whether there is room for the work.
    #[inline(always)]
    pub const fn has_work(self) -> bool {
        self.has_work
    }

    /// Where the own states stand.
    #[inline(always)]
    pub const fn own(self) -> Range<usize> {
        0..self.own
    }

    /// Where r, v, K and γ of a body stand.
    #[inline(always)]
    pub const fn body(self, n: usize) -> Range<usize> {
        let start = self.own().end + n * BODY;
        start..start + BODY
    }

    /// Where γ of a body stands.
    #[inline(always)]
    pub const fn gamma(self, n: usize) -> Range<usize> {
        let end = self.body(n).end;
        end - 2..end
    }

    /// Where φ of all bodies stands.
    #[inline(always)]
    pub const fn angles(self) -> Range<usize> {
        let start = self.body(BODIES).start;
        start..start + BODIES
    }

    /// Where φ of a body stands.
    #[inline(always)]
    pub const fn phi(self, n: usize) -> usize {
        self.angles().start + n
    }

    /// Where the work supplied and lost stands.
    #[inline(always)]
    pub const fn work(self) -> Range<usize> {
        let start = self.angles().end;
        start..start + if self.has_work { 2 } else { 0 }
    }

    /// How many numbers the state has.
    #[inline(always)]
    pub const fn count(self) -> usize {
        self.work().end
    }

    /// How many of them a host sees: all, or all but the work.
    pub const fn count_of_host(self, sees_work: bool) -> usize {
        if sees_work { self.count() } else { self.angles().end }
    }

    /// Where the number stands that is the n-th for a host: own states follow what else it sees, and what it does not see is last.
    pub const fn of_host(self, n: usize, sees_work: bool) -> usize {
        let seen = self.count_of_host(sees_work);
        match n + self.own {
            place if place < seen => place,
            _ if n < seen => n + self.own - seen,
            _ => n,
        }
    }

    /// The coordinates of a body.
    #[inline(always)]
    pub fn read<S: Scalar>(self, y: &[S], n: usize) -> Coordinates<S> {
        let (at, gamma) = (self.body(n).start, self.gamma(n).start);
        Coordinates {
            r: Vector3::new(y[at], y[at + 1], y[at + 2]),
            v: Vector3::new(y[at + 3], y[at + 4], y[at + 5]),
            k: Vector3::new(y[at + 6], y[at + 7], y[at + 8]),
            gamma: Vector2::new(y[gamma], y[gamma + 1]),
            phi: y[self.phi(n)],
        }
    }

    /// Writes the coordinates of a body.
    #[inline(always)]
    pub fn write<S: Scalar>(self, y: &mut [S], n: usize, at: &Coordinates<S>) {
        let start = self.body(n).start;
        for (part, vector) in [(0, &at.r), (3, &at.v), (6, &at.k)] {
            y[start + part..][..3].copy_from_slice(vector.as_slice());
        }
        y[self.gamma(n)].copy_from_slice(at.gamma.as_slice());
        y[self.phi(n)] = at.phi;
    }

    /// The work supplied and lost \[J]; 0 where there is no room for it.
    #[inline(always)]
    pub fn read_work<S: Scalar>(self, y: &[S]) -> [S; 2] {
        if self.has_work { [y[self.work().start], y[self.work().start + 1]] } else { [S::zero(); 2] }
    }

    /// Writes the work supplied and lost \[J], if there is room for it.
    #[inline(always)]
    pub fn write_work<S: Scalar>(self, y: &mut [S], work: [S; 2]) {
        if self.has_work {
            y[self.work()].copy_from_slice(&work);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With and without own states and work.
    fn layouts() -> [Layout; 4] {
        [(0, false), (0, true), (3, false), (3, true)].map(|(own, has_work)| Layout::new(own, has_work))
    }

    #[test]
    fn exact_the_parts_cover_a_state_once_and_in_order() {
        for layout in layouts() {
            let bodies = (0..BODIES).flat_map(|n| layout.body(n));
            let parts = layout.own().chain(bodies).chain(layout.angles()).chain(layout.work());
            assert!(parts.eq(0..layout.count()), "{layout:?}");
            for n in 0..BODIES {
                assert!(layout.angles().contains(&layout.phi(n)) && layout.body(n).end == layout.gamma(n).end);
            }
        }
    }

    #[test]
    fn exact_a_host_sees_each_number_once_and_own_states_behind_what_moves() {
        for layout in layouts() {
            for sees_work in [false, layout.has_work()] {
                let places: Vec<_> = (0..layout.count()).map(|n| layout.of_host(n, sees_work)).collect();
                let seen = layout.count_of_host(sees_work);
                assert!((0..layout.count()).all(|place| places.contains(&place)), "{layout:?}: {places:?}");
                assert!(places[..seen - layout.own].iter().all(|place| *place >= layout.own));
                assert!(layout.own().eq(places[seen - layout.own..seen].iter().copied()));
            }
        }
    }

    #[test]
    fn exact_what_is_written_is_read_again() {
        for layout in layouts() {
            let mut y = vec![0.0; layout.count()];
            let numbered: Vec<f64> = (0..).map(f64::from).take(layout.count()).collect();
            (0..BODIES).for_each(|n| layout.write(&mut y, n, &layout.read(&numbered, n)));
            layout.write_work(&mut y, layout.read_work(&numbered));
            assert!(
                y[layout.own()].iter().all(|own| *own == 0.0) && y[layout.own().end..] == numbered[layout.own().end..]
            );
        }
    }
}
