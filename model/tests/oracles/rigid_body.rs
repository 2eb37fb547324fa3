//! A rigid body with its attitude as a quaternion and its inertia as a tensor, under the laws of EFFECTS.md. It knows no
//! chart; φ is a quadrature of ω·(e + t)/(1 + e·t). Vectors in O, SI units, radians. Checks: `exact_rigid_body.rs`.

use super::{extrapolation, rotation};
use nalgebra::{Matrix3, Vector2, Vector3};

/// The body, and what acts on it.
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "the paper's symbols")]
pub struct RigidBody {
    /// Mass [kg].
    pub m: f64,
    /// Moment of inertia about the axis [kg·m²].
    pub Ja: f64,
    /// Moment of inertia transverse to it [kg·m²].
    pub Jt: f64,
    /// From the support to the mass centre [m].
    pub l: f64,
    /// Acceleration of gravity [m/s²].
    pub g: Vector3<f64>,
    /// The support's stiffness [N/m], [N·m/rad].
    pub c: [f64; 2],
    /// The support's damping [N·s/m], [N·m·s/rad].
    pub d: [f64; 2],
    /// The drive's torque over time [N·m].
    pub tau: fn(f64) -> f64,
    /// A force at the support point, and a moment, from outside [N], [N·m].
    pub pushed: [Vector3<f64>; 2],
}

/// Where the body is, how it moves, and the work done since the start.
#[derive(Clone, Copy, Debug)]
pub struct Moving {
    /// Position of the mass centre [m].
    pub r: Vector3<f64>,
    /// Its velocity [m/s].
    pub v: Vector3<f64>,
    /// Attitude, a quaternion.
    pub q: (f64, Vector3<f64>),
    /// Angular momentum [kg·m²/s].
    pub k: Vector3<f64>,
    /// φ [rad].
    pub phi: f64,
    /// Work supplied from outside, work lost to the dampers [J].
    pub work: [f64; 2],
}

type Numbers = [f64; 16];

impl Moving {
    fn numbers(&self) -> Numbers {
        let [r, v, k, u] = [self.r, self.v, self.k, self.q.1];
        let [supplied, lost] = self.work;
        [r.x, r.y, r.z, v.x, v.y, v.z, k.x, k.y, k.z, self.q.0, u.x, u.y, u.z, self.phi, supplied, lost]
    }

    fn of(y: &Numbers) -> Self {
        let vector = |i: usize| Vector3::new(y[i], y[i + 1], y[i + 2]);
        Self { r: vector(0), v: vector(3), k: vector(6), q: (y[9], vector(10)), phi: y[13], work: [y[14], y[15]] }
    }

    /// The attitude as a matrix.
    pub fn attitude(&self) -> Matrix3<f64> {
        rotation::drifted(self.q)
    }

    /// The axis t.
    pub fn axis(&self) -> Vector3<f64> {
        self.attitude() * Vector3::x()
    }
}

impl RigidBody {
    /// A body at r [m] with v [m/s], φ [rad], γ [rad] and ω [rad/s].
    pub fn start(
        &self,
        r: Vector3<f64>,
        v: Vector3<f64>,
        phi: f64,
        gamma: &Vector2<f64>,
        omega: &Vector3<f64>,
    ) -> Moving {
        let q = rotation::split(phi, gamma);
        let attitude = rotation::matrix(q);
        let inertia = Matrix3::from_diagonal(&Vector3::new(self.Ja, self.Jt, self.Jt));
        Moving { r, v, q, k: attitude * inertia * attitude.transpose() * omega, phi, work: [0.0; 2] }
    }

    /// The motion from time `t` [s] to `end` [s], in so many steps.
    pub fn run(&self, t: f64, from: &Moving, end: f64, steps: u32) -> Moving {
        Moving::of(&extrapolation::steps(|t, y| self.rates(t, y), t, &from.numbers(), end - t, steps))
    }

    /// The motion while this torque of the drive [N·m] is held for `time` [s], in so many steps.
    pub fn held(&self, tau: f64, from: &Moving, time: f64, steps: u32) -> Moving {
        let rates = |_: f64, y: &Numbers| self.rates_under(tau, y);
        Moving::of(&extrapolation::steps(rates, 0.0, &from.numbers(), time, steps))
    }

    /// ω·(e + t)/(1 + e·t) [rad/s].
    pub fn axial_rate(&self, moving: &Moving) -> f64 {
        self.omega(moving).dot(&joint(&moving.axis()))
    }

    /// Kinetic and potential energy [J].
    pub fn energy(&self, moving: &Moving) -> f64 {
        let (t, v) = (moving.axis(), &moving.v);
        let (r_a, gamma) = (moving.r - t * self.l, rotation::gamma(&t));
        let kinetic = self.m * v.norm_squared() + self.omega(moving).dot(&moving.k);
        let springs = self.c[0] * r_a.norm_squared() + self.c[1] * gamma.norm_squared();
        0.5 * (kinetic + springs) - self.m * self.g.dot(&moving.r)
    }

    fn omega(&self, moving: &Moving) -> Vector3<f64> {
        let (attitude, inverse) = (moving.attitude(), Vector3::new(1.0 / self.Ja, 1.0 / self.Jt, 1.0 / self.Jt));
        attitude * inverse.component_mul(&(attitude.transpose() * moving.k))
    }

    fn rates(&self, time: f64, y: &Numbers) -> Numbers {
        self.rates_under((self.tau)(time), y)
    }

    fn rates_under(&self, tau: f64, y: &Numbers) -> Numbers {
        let moving = Moving::of(y);
        let (t, omega) = (moving.axis(), self.omega(&moving));
        let t_rate = omega.cross(&t);
        let (r_a, v_a) = (moving.r - t * self.l, moving.v - t_rate * self.l);
        let [push, twist] = self.pushed;
        let support = push - r_a * self.c[0] - v_a * self.d[0];
        let gamma = rotation::gamma(&t);
        let n = joint(&t);
        let moment = -t.cross(&support) * self.l
            - Vector3::new(0.0, gamma.x, gamma.y) * self.c[1]
            - t.cross(&t_rate) * self.d[1]
            + n * tau
            + twist;
        let (w, u) = rotation::product((0.0, omega * 0.5), moving.q);
        let lost = self.d[0] * v_a.norm_squared() + self.d[1] * t_rate.norm_squared();
        let rate = omega.dot(&n);
        let supplied = tau * rate + push.dot(&v_a) + twist.dot(&omega);
        let acceleration = self.g + support / self.m;
        Moving { r: moving.v, v: acceleration, q: (w, u), k: moment, phi: rate, work: [supplied, lost] }.numbers()
    }
}

/// n = (e + t)/(1 + e·t).
pub fn joint(t: &Vector3<f64>) -> Vector3<f64> {
    (Vector3::x() + t) / (1.0 + t.x)
}
