//! A rotor that does not tilt, on a spring and a damper, with what drives its whirl: damping that turns with it (Kimball 1924),
//! and a bearing whose stiffness is cross-coupled by kyz = −kzy = s (Childs 1993). With z = y + iz:
//!
//! ```text
//! m z̈ + c ż + d (ż − iωz) + (k − is) z = 0,   z = a exp(λt),   m λ² + (c + d) λ + k − i(ωd + s) = 0
//! ```
//!
//! Forward whirl is of the frequency ω_n where it begins to grow: at ωd + s = (c + d) ω_n.

use super::numerics::quadratic;
use nalgebra::Complex;

/// SI units.
#[derive(Clone, Copy, Debug)]
pub struct ForwardWhirl {
    /// Mass \[kg].
    pub m: f64,
    /// Stiffness [N/m].
    pub k: f64,
    /// Damping at rest [N·s/m].
    pub c: f64,
    /// Damping that turns [N·s/m].
    pub d: f64,
    /// Cross stiffness [N/m].
    pub s: f64,
}

impl ForwardWhirl {
    /// λ of forward and of backward whirl [1/s] at a spin [rad/s].
    pub fn rates(&self, spin: f64) -> [Complex<f64>; 2] {
        quadratic(self.m, Complex::new(self.c + self.d, 0.0), Complex::new(self.k, -spin * self.d - self.s))
    }

    /// ω d + s [N/m], above which forward whirl grows.
    pub fn threshold(&self) -> f64 {
        (self.c + self.d) * (self.k / self.m).sqrt()
    }
}
