//! A rotor on a motor whose torque falls with the speed: run-up in closed form, and what becomes of it at the critical speed.
//!
//! Upright, and with nothing but the motor, the rotor obeys
//!
//! ```text
//! J ω̇ = τ,   T τ̇ = τ_s (u − ω/Ω_s) − τ,   so   T d̈ + ḋ + d/T_m = 0   for d = ω − Ω_s u,   T_m = J Ω_s/τ_s
//! ```
//!
//! An unbalanced disk on an isotropic spring and damper takes the power d_1 |ṙ|² in its steady whirl, which the motor must give:
//!
//! ```text
//! τ_s (u − ω/Ω_s) = τ_vib(ω) = 2ζω_n m ω |r(ω)|²,   |r| = εω²/√((ω_n² − ω²)² + (2ζω_n ω)²)
//! ```
//!
//! A slow run-up hangs at the lowest speed that solves this, and passes where none near the critical speed does.
//!
//! Source: Sommerfeld (1902); Kononenko (1969), chapter 2; the closed forms are derived here. Checks:
//! `tests/exact/limited_power.rs`.

use super::numerics::root;

/// A motor and the upright rotor that it turns. SI units.
#[derive(Clone, Copy, Debug)]
pub struct Motor {
    /// J about the axis [kg·m²].
    pub inertia: f64,
    /// τ_s [N·m].
    pub stall: f64,
    /// Ω_s [rad/s].
    pub synchronous: f64,
    /// T \[s]; 0: the torque is that of the characteristic.
    pub lag: f64,
}

/// What an upright rotor does.
#[derive(Clone, Copy, Debug)]
pub struct Turning {
    /// φ \[rad].
    pub phi: f64,
    /// ω_φ [rad/s].
    pub speed: f64,
    /// τ [N·m].
    pub torque: f64,
}

impl Motor {
    /// T_m = J Ω_s/τ_s \[s].
    pub fn time(&self) -> f64 {
        self.inertia * self.synchronous / self.stall
    }

    /// τ∞ on the characteristic [N·m], at a command u \[1] and a speed [rad/s].
    pub fn steady(&self, command: f64, speed: f64) -> f64 {
        self.stall * (command - speed / self.synchronous)
    }

    /// Where the rotor is so long after `from` \[s] under a command u \[1] that is held. Without lag the torque of `from` does
    /// not count.
    pub fn run(&self, command: f64, from: &Turning, t: f64) -> Turning {
        let (time, lag, aim) = (self.time(), self.lag, self.synchronous * command);
        let d0 = from.speed - aim;
        let (d, rate, first) = if lag > 0.0 {
            let first = from.torque / self.inertia;
            let a = 0.5 / lag;
            // λ = −a ± s
            let square = a * a - 1.0 / (lag * time);
            let s = square.abs().sqrt();
            // e^(−at) cosh st and e^(−at) sinh(st)/s, without overflow and without cancelling; s² < 0: cos and sin.
            let (even, odd) = if square > 0.0 && s * t > 1.0 {
                let (slow, fast) = (libm::exp((s - a) * t), libm::exp((-s - a) * t));
                (0.5 * (slow + fast), 0.5 * (slow - fast) / s)
            } else {
                let (x, decay) = (s * t, libm::exp(-a * t));
                let [even, odd] =
                    if square < 0.0 { [libm::cos(x), libm::sin(x)] } else { [libm::cosh(x), libm::sinh(x)] };
                (decay * even, decay * t * if x > 0.0 { odd / x } else { 1.0 })
            };
            (d0 * even + (first + a * d0) * odd, first * even - (a * first + d0 / (lag * time)) * odd, first)
        } else {
            let d = d0 * libm::exp(-t / time);
            (d, -d / time, -d0 / time)
        };
        // ∫ of the equation: T ḋ + d + ∫d dt/T_m is constant.
        let way = time * (lag * (first - rate) + d0 - d);
        Turning { phi: from.phi + aim * t + way, speed: aim + d, torque: self.inertia * rate }
    }
}

/// An unbalanced disk that does not tilt, on an isotropic spring and damper. SI units.
#[derive(Clone, Copy, Debug)]
pub struct Disk {
    /// m of the whole \[kg].
    pub mass: f64,
    /// ω_n [rad/s].
    pub natural: f64,
    /// ζ \[1].
    pub damping: f64,
    /// ε of the mass centre \[m].
    pub eccentricity: f64,
}

impl Disk {
    /// |r| of the steady whirl \[m] at a speed [rad/s].
    pub fn radius(&self, speed: f64) -> f64 {
        let (below, lost) = (self.natural * self.natural - speed * speed, 2.0 * self.damping * self.natural * speed);
        self.eccentricity * speed * speed / libm::hypot(below, lost)
    }

    /// τ_vib, what the steady whirl takes of the motor's torque [N·m].
    pub fn torque(&self, speed: f64) -> f64 {
        let radius = self.radius(speed);
        2.0 * self.damping * self.natural * self.mass * speed * radius * radius
    }

    /// τ_s [N·m] below which the run-up hangs, at full command, for a motor of this Ω_s [rad/s]: the largest
    /// τ_vib/(1 − ω/Ω_s) near the critical speed; and the speed [rad/s] where it hangs then.
    ///
    /// Ω_s must be so far above that this has a peak of its own: it grows without bound towards Ω_s.
    pub fn threshold(&self, synchronous: f64) -> [f64; 2] {
        let needed = |speed: f64| self.torque(speed) / (1.0 - speed / synchronous);
        let width = 2.0 * self.damping * self.natural;
        // By thirds, in which the one peak stays.
        let (mut a, mut b) = (self.natural - width, self.natural + width);
        for _ in 0..100 {
            let third = (b - a) / 3.0;
            if needed(a + third) < needed(b - third) {
                a += third;
            } else {
                b -= third;
            }
        }
        [needed(0.5 * (a + b)), 0.5 * (a + b)]
    }

    /// The speed [rad/s] at which the run-up by this motor hangs, at full command; its τ_s is below the threshold.
    pub fn hangs_at(&self, motor: &Motor) -> f64 {
        let [_, critical] = self.threshold(motor.synchronous);
        root(|speed| motor.steady(1.0, speed) - self.torque(speed), 0.0, critical)
    }

    /// The speed [rad/s] to which this motor turns the disk once it has passed, at full command.
    pub fn runs_at(&self, motor: &Motor) -> f64 {
        let above = 0.5 * (self.natural + motor.synchronous);
        root(|speed| motor.steady(1.0, speed) - self.torque(speed), above, motor.synchronous)
    }
}
