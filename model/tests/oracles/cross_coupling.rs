//! A rotor that does not tilt, in a bearing whose stiffness is cross-coupled by kyz = −kzy = s. With z = y + iz:
//!
//!     m z̈ + c ż + (k − is) z = 0,   z = a exp(λt),   m λ² + c λ + k − is = 0
//!
//! Forward whirl is unstable where s > c ω_n (Childs 1993; ORACLES.md 8).

use super::numerics::quadratic;
use nalgebra::Complex;

/// SI units.
#[derive(Clone, Copy, Debug)]
pub struct CrossCoupling {
    /// Mass [kg].
    pub m: f64,
    /// Stiffness [N/m].
    pub k: f64,
    /// Damping [N·s/m].
    pub c: f64,
}

impl CrossCoupling {
    /// λ of forward and of backward whirl [1/s] at a cross stiffness s [N/m].
    pub fn rates(&self, s: f64) -> [Complex<f64>; 2] {
        quadratic(self.m, Complex::new(self.c, 0.0), Complex::new(self.k, -s))
    }

    /// The cross stiffness above which forward whirl grows [N/m].
    pub fn threshold(&self) -> f64 {
        self.c * (self.k / self.m).sqrt()
    }
}
