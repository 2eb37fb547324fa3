//! Three numbers, two and two.

use nalgebra::Vector3;
use std::ops::{Add, Mul, Sub};
use wide::f64x2;

/// x and y, z and x.
#[derive(Clone, Copy)]
pub struct Triple {
    pub xy: f64x2,
    pub zx: f64x2,
}

impl Triple {
    #[inline(always)]
    pub fn of(v: Vector3<f64>) -> Self {
        Self { xy: f64x2::new([v.x, v.y]), zx: f64x2::new([v.z, v.x]) }
    }

    #[inline(always)]
    pub fn vector(self) -> Vector3<f64> {
        let ([x, y], [z, _]) = (self.xy.to_array(), self.zx.to_array());
        Vector3::new(x, y, z)
    }

    /// y and z.
    #[inline(always)]
    pub fn yz(self) -> f64x2 {
        between(self.xy, self.zx)
    }

    /// a·b, twice.
    #[inline(always)]
    pub fn dot(self, other: Self) -> f64x2 {
        total(self.xy * other.xy, self.zx * other.zx)
    }

    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        let (yz, other_yz) = (self.yz(), other.yz());
        Self { xy: yz * other.zx - self.zx * other_yz, zx: self.xy * other_yz - yz * other.xy }
    }
}

/// x + y + z of x and y, z and anything: twice, as packed numbers that are stored whole and so can be loaded whole at once.
#[inline(always)]
pub fn total(xy: f64x2, z: f64x2) -> f64x2 {
    xy + swapped(xy) + first(z)
}

/// The first number, twice.
#[inline(always)]
pub fn first(of: f64x2) -> f64x2 {
    let [one, _] = of.to_array();
    f64x2::new([one, one])
}

/// The second number, then the first.
#[inline(always)]
pub fn swapped(of: f64x2) -> f64x2 {
    let [one, other] = of.to_array();
    f64x2::new([other, one])
}

/// The second number of one, then the first of another.
#[inline(always)]
pub fn between(of: f64x2, next: f64x2) -> f64x2 {
    f64x2::new([of.to_array()[1], next.to_array()[0]])
}

impl Add for Triple {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { xy: self.xy + other.xy, zx: self.zx + other.zx }
    }
}

impl Sub for Triple {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { xy: self.xy - other.xy, zx: self.zx - other.zx }
    }
}

impl Mul<f64x2> for Triple {
    type Output = Self;
    /// By a number that stands there twice.
    #[inline(always)]
    fn mul(self, by: f64x2) -> Self {
        Self { xy: self.xy * by, zx: self.zx * by }
    }
}
