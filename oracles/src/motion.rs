//! Motions of rotors in closed form. Symbols of `docs/theory.md`; vectors in O, SI units, radians. Each is checked in
//! `tests/exact/motion.rs` against Newton's and Euler's equations.

use super::numerics::{integral, root};
use super::rotation;
use nalgebra::{Matrix3, Vector2, Vector3};
use std::f64::consts::PI;

/// A torque-free symmetric rotor.
///
/// Source: Poinsot (1834): L(t) = L(K t/Jt)·L(γ₀)·L((φ₀ + K_a t(1/Ja − 1/Jt))e), K_a = K·t.
#[derive(Clone, Debug)]
#[allow(non_snake_case, reason = "the paper's symbols")]
pub struct FreeRotor {
    /// Moment of inertia about the axis [kg·m²].
    pub Ja: f64,
    /// Moment of inertia transverse to it [kg·m²].
    pub Jt: f64,
    /// φ at the start \[rad].
    pub phi: f64,
    /// γ at the start \[rad].
    pub gamma: Vector2<f64>,
    /// ω at the start [rad/s].
    pub omega: Vector3<f64>,
}

impl FreeRotor {
    /// K = Jt ω + (Ja − Jt)(ω·t)t, which stays as it is [kg·m²/s].
    pub fn momentum(&self) -> Vector3<f64> {
        let t = rotation::axis(&self.gamma);
        self.omega * self.Jt + t * ((self.Ja - self.Jt) * self.omega.dot(&t))
    }

    /// ω·t, which stays as it is [rad/s].
    pub fn axial_spin(&self) -> f64 {
        self.omega.dot(&rotation::axis(&self.gamma))
    }

    /// The attitude at time `t` \[s] after the start.
    pub fn attitude(&self, t: f64) -> Matrix3<f64> {
        let spin = self.phi + self.Ja * self.axial_spin() * t * (1.0 / self.Ja - 1.0 / self.Jt);
        rotation::rodrigues(&(self.momentum() * (t / self.Jt))) * rotation::attitude(spin, &self.gamma)
    }

    /// The axis at time `t` \[s].
    pub fn axis(&self, t: f64) -> Vector3<f64> {
        rotation::rodrigues(&(self.momentum() * (t / self.Jt))) * rotation::axis(&self.gamma)
    }

    /// φ at time `t` \[s], whole turns included, in closed form. With a = |K|t/(2Jt) the quaternion of the axis' motion is
    /// (cos a, K/|K| sin a)·(cos θ/2, sin θ/2 γ/θ) = (w, x, …), and φ gains 2 arg(w + ix): the point (w, x) goes along an
    /// ellipse about 0, always in one sense, and is opposite to itself half a turn of a later.
    ///
    /// Source: derived here; checked against the quadrature of [`FreeRotor::phi`].
    pub fn phi_in_closed_form(&self, t: f64) -> f64 {
        let (momentum, theta) = (self.momentum(), self.gamma.norm());
        let (cosine, sine) = (libm::cos(0.5 * theta), if theta > 0.0 { libm::sin(0.5 * theta) / theta } else { 0.5 });
        let (n, tilt) = (momentum.normalize(), self.gamma * sine);
        let half = 0.5 * momentum.norm() * t / self.Jt;
        let (across, along) = (n.y * tilt.x + n.z * tilt.y, n.x * cosine + n.y * tilt.y - n.z * tilt.x);
        let halves = (half / PI).round();
        let rest = half - halves * PI;
        let (s, c) = (libm::sin(rest), libm::cos(rest));
        let turned = libm::atan2(along * s, cosine * c - across * s) + libm::copysign(halves * PI, halves * along);
        self.phi + self.Ja * self.axial_spin() * t * (1.0 / self.Ja - 1.0 / self.Jt) + 2.0 * turned
    }

    /// φ at time `t` \[s], whole turns included: spin plus swept solid angle (eq. 19), where
    /// (1 − cos θ)dψ = e·(t×dt)/(1 + cos θ) and dt/dt = K×t/Jt. `panels`: parts of the quadrature.
    pub fn phi(&self, t: f64, panels: usize) -> f64 {
        let momentum = self.momentum();
        let sweep = |time: f64| {
            let axis = self.axis(time);
            axis.cross(&(momentum.cross(&axis) / self.Jt)).x / (1.0 + axis.x)
        };
        self.phi + self.axial_spin() * t + integral(sweep, 0.0, t, panels)
    }
}

/// Steady whirl of the rotor on its elastic support (c2 too), with gravity g along −e.
///
/// It solves eq. 12 (derived here): ρ = c1 l sin θ/(c1 − mΩ²), r_c = (l cos θ − m g/c1, ρ cos Ωt, ρ sin Ωt),
/// γ = θ(0, −sin Ωt, cos Ωt), ω_a = [Jt Ω cos θ + l² c1 mΩ cos θ/(c1 − mΩ²) − c2 θ/(Ω sin θ) + m g l/Ω]/Ja.
#[derive(Clone, Debug)]
#[allow(non_snake_case, reason = "the paper's symbols")]
pub struct Whirl {
    /// Mass \[kg].
    pub m: f64,
    /// Moment of inertia about the axis [kg·m²].
    pub Ja: f64,
    /// Moment of inertia transverse to it [kg·m²].
    pub Jt: f64,
    /// From the support to the mass centre \[m].
    pub l: f64,
    /// Stiffness against displacement [N/m].
    pub c1: f64,
    /// Stiffness against tilt [N·m/rad].
    pub c2: f64,
    /// Gravity along −e [m/s²].
    pub g: f64,
    /// Tilt θ \[rad].
    pub theta: f64,
    /// Whirl rate Ω [rad/s].
    pub rate: f64,
}

impl Whirl {
    /// That of the paper's rotor without gravity: tilt θ \[rad], whirl rate Ω [rad/s].
    pub fn paper(theta: f64, rate: f64) -> Self {
        Self { m: 5.0, Ja: 0.15625, Jt: 0.078125, l: 0.75, c1: 2000.0, c2: 500.0, g: 0.0, theta, rate }
    }

    /// Radius of the circle of the mass centre \[m].
    pub fn radius(&self) -> f64 {
        self.c1 * self.l * libm::sin(self.theta) / (self.c1 - self.m * self.rate * self.rate)
    }

    /// ω·t [rad/s].
    pub fn axial_spin(&self) -> f64 {
        let (sine, cosine, w) = (libm::sin(self.theta), libm::cos(self.theta), self.rate);
        let force = self.l * self.l * self.c1 * self.m * w * cosine / (self.c1 - self.m * w * w);
        (self.Jt * w * cosine + force - self.c2 * self.theta / (w * sine) + self.m * self.g * self.l / w) / self.Ja
    }

    /// Position of the mass centre at time `t` \[s], in m.
    pub fn r_c(&self, t: f64) -> Vector3<f64> {
        let (radius, angle) = (self.radius(), self.rate * t);
        let along = self.l * libm::cos(self.theta) - self.m * self.g / self.c1;
        Vector3::new(along, radius * libm::cos(angle), radius * libm::sin(angle))
    }

    /// Velocity of the mass centre at time `t` \[s], in m/s.
    pub fn v_c(&self, t: f64) -> Vector3<f64> {
        let (speed, angle) = (self.radius() * self.rate, self.rate * t);
        Vector3::new(0.0, -speed * libm::sin(angle), speed * libm::cos(angle))
    }

    /// γ at time `t` \[s], in rad.
    pub fn gamma(&self, t: f64) -> Vector2<f64> {
        Vector2::new(-libm::sin(self.rate * t), libm::cos(self.rate * t)) * self.theta
    }

    /// ω = ω_a t + t×dt/dt at time `t` \[s], dt/dt = Ω e×t, in rad/s.
    pub fn omega(&self, t: f64) -> Vector3<f64> {
        let axis = rotation::axis(&self.gamma(t));
        axis * self.axial_spin() + axis.cross(&Vector3::x().cross(&axis)) * self.rate
    }

    /// φ at time `t` \[s] if 0 at the start, in rad.
    pub fn phi(&self, t: f64) -> f64 {
        let half = libm::sin(0.5 * self.theta);
        (self.axial_spin() + 2.0 * half * half * self.rate) * t
    }
}

/// The whirl rates of small motions about the straight rotor without gravity, in order [rad/s].
///
/// Eq. 12, linear in the displacement and the tilt: (c1 − mΩ²)(c2 + l²c1 + Ja ω Ω − Jt Ω²) = (c1 l)²; the roots lie between the poles and beyond.
pub fn small_whirl(paper: &Whirl, spin: f64) -> [f64; 4] {
    let defect = |w: f64| {
        let tilt = paper.c2 + paper.l * paper.l * paper.c1 + paper.Ja * spin * w - paper.Jt * w * w;
        (paper.c1 - paper.m * w * w) * tilt - (paper.c1 * paper.l) * (paper.c1 * paper.l)
    };
    // Two roots on each side of 0, where the defect is c1 c2 > 0: once below 0 at the translational rate √(c1/m).
    let (middle, far) = ((paper.c1 / paper.m).sqrt(), 1e4);
    [root(defect, -far, -middle), root(defect, -middle, 0.0), root(defect, 0.0, middle), root(defect, middle, far)]
}

/// m ẍ + d ẋ + c x = 0.
///
/// Source: any textbook. Under-, over- and critically damped.
#[derive(Clone, Copy, Debug)]
pub struct Oscillator {
    /// Inertia: m \[kg], or Jt [kg·m²] where x is an angle.
    pub m: f64,
    /// Damping [N·s/m] or [N·m·s/rad].
    pub d: f64,
    /// Stiffness [N/m] or [N·m/rad].
    pub c: f64,
    /// x at the start \[m] or \[rad].
    pub x: f64,
    /// Its rate at the start.
    pub v: f64,
}

impl Oscillator {
    /// x and its rate at time `t` \[s].
    pub fn at(&self, t: f64) -> (f64, f64) {
        let (decay, square) = (0.5 * self.d / self.m, self.c / self.m - 0.25 * (self.d / self.m) * (self.d / self.m));
        // The even and odd solutions of ü + square·u = 0, which for square → 0 are 1 and t.
        let (even, odd, fall) = if square > 0.0 {
            let w = square.sqrt();
            (libm::cos(w * t), libm::sin(w * t) / w, libm::exp(-decay * t))
        } else if square < 0.0 {
            let w = (-square).sqrt();
            (libm::cosh(w * t), libm::sinh(w * t) / w, libm::exp(-decay * t))
        } else {
            (1.0, t, libm::exp(-decay * t))
        };
        let slope = self.v + decay * self.x;
        let u = self.x * even + slope * odd;
        let u_rate = -square * self.x * odd + slope * even;
        (fall * u, fall * (u_rate - decay * u))
    }
}
