//! A rotor that does not tilt, on a spring and a damper, with damping that turns with it (Kimball 1924). With z = y + iz:
//!
//!     m z̈ + c ż + d (ż − iωz) + k z = 0,   z = a exp(λt),   m λ² + (c + d) λ + k − iωd = 0
//!
//! Forward whirl is unstable above ω_n (1 + c/d), where it is of the frequency ω_n (ORACLES.md 7).

use super::numerics::quadratic;
use nalgebra::Complex;

/// SI units.
#[derive(Clone, Copy, Debug)]
pub struct RotatingDamping {
    /// Mass [kg].
    pub m: f64,
    /// Stiffness [N/m].
    pub k: f64,
    /// Damping at rest [N·s/m].
    pub c: f64,
    /// Damping that turns [N·s/m].
    pub d: f64,
}

impl RotatingDamping {
    /// λ of forward and of backward whirl [1/s] at a spin [rad/s].
    pub fn rates(&self, spin: f64) -> [Complex<f64>; 2] {
        quadratic(self.m, Complex::new(self.c + self.d, 0.0), Complex::new(self.k, -spin * self.d))
    }

    /// The spin above which forward whirl grows [rad/s].
    pub fn threshold(&self) -> f64 {
        (self.k / self.m).sqrt() * (1.0 + self.c / self.d)
    }
}
