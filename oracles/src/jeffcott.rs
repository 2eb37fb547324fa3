//! Jeffcott's rotor (1919): a disk that does not tilt on a spring and a damper, its mass centre off the axis, turned at a given
//! speed or run up through its critical one. With z = y + iz of the axis:
//!
//! ```text
//! z̈ + 2ζω_n ż + ω_n² z = −ε d²/dt² e^(iφ),   φ = wt + ½at²,   z = ż = 0 at the start
//! ```
//!
//! By Duhamel's integral over the response to a kick. Checks: `tests/exact/motion.rs`.

use super::numerics::integral;
use nalgebra::Complex;

/// SI units.
#[derive(Clone, Copy, Debug)]
pub struct Jeffcott {
    /// ω_n [rad/s].
    pub natural: f64,
    /// ζ \[1].
    pub damping: f64,
    /// ε \[m].
    pub eccentricity: f64,
    /// ω at the start [rad/s].
    pub speed: f64,
    /// a [rad/s²].
    pub acceleration: f64,
}

impl Jeffcott {
    /// φ at time `t` \[s] \[rad].
    pub fn phi(&self, t: f64) -> f64 {
        (self.speed + 0.5 * self.acceleration * t) * t
    }

    /// Where the axis is at time `t` \[s] \[m].
    pub fn place(&self, t: f64) -> Complex<f64> {
        let damped = self.natural * (1.0 - self.damping * self.damping).sqrt();
        let kicked = |t: f64| libm::exp(-self.damping * self.natural * t) * libm::sin(damped * t) / damped;
        let part = |of: fn(Complex<f64>) -> f64| {
            let share = |s: f64| {
                let (speed, phi) = (self.speed + self.acceleration * s, self.phi(s));
                // −d²/ds² e^(iφ) = (φ̇² − iφ̈) e^(iφ)
                let pushed = Complex::new(speed * speed, -self.acceleration)
                    * Complex::new(libm::cos(phi), libm::sin(phi))
                    * self.eccentricity;
                kicked(t - s) * of(pushed)
            };
            // A panel for each quarter of a radian of the fastest.
            let fastest = self.natural + (self.speed + self.acceleration * t).abs();
            integral(share, 0.0, t, 1 + (4.0 * fastest * t) as usize)
        };
        Complex::new(part(|z| z.re), part(|z| z.im))
    }
}
