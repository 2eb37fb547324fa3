//! A rotor on its support with its attitude as a quaternion, and with point masses on it, as Newton and Euler have them one by
//! one: forces between rotor and masses are eliminated with the accelerations of c and of the attitude. It knows neither the
//! mass centre of the whole nor its inertia tensor nor a chart; φ is a quadrature of ω·(e + t)/(1 + e·t). Vectors in O, SI
//! units, radians. Checks: `tests/exact/rigid_body.rs`.

use super::{extrapolation, rotation};
use nalgebra::{Matrix3, SMatrix, SVector, Vector2, Vector3};

/// The rotor, its masses, and what acts on it.
#[derive(Clone, Debug)]
pub struct RigidBody {
    /// Mass of the balanced rotor \[kg].
    pub m: f64,
    /// Its moments of inertia about c and the body's axes [kg·m²].
    pub moments: Vector3<f64>,
    /// Masses \[kg] and where they are from c, in the body's axes \[m].
    pub masses: Vec<(f64, Vector3<f64>)>,
    /// From the support to c \[m].
    pub l: f64,
    /// Acceleration of gravity [m/s²].
    pub g: Vector3<f64>,
    /// The support's stiffness [N/m], [N·m/rad].
    pub c: [f64; 2],
    /// The support's damping [N·s/m], [N·m·s/rad].
    pub d: [f64; 2],
    /// The drive's torque [N·m], its rate [N·m/s] and the rate of that [N·m/s²] at time 0.
    pub tau: [f64; 3],
    /// A force at the support point \[N], and a moment [N·m], from outside.
    pub pushed: [Vector3<f64>; 2],
    /// The rate of ω_φ over time [rad/s²], where it is imposed.
    pub imposed: Option<fn(f64) -> f64>,
}

/// Where it is, how it moves, and the work done since the start.
#[derive(Clone, Copy, Debug)]
pub struct Moving {
    /// Position of c \[m].
    pub r: Vector3<f64>,
    /// Its velocity [m/s].
    pub v: Vector3<f64>,
    /// Attitude, a quaternion.
    pub q: (f64, Vector3<f64>),
    /// Angular velocity [rad/s].
    pub omega: Vector3<f64>,
    /// φ \[rad].
    pub phi: f64,
    /// Work supplied from outside, work lost to the dampers \[J].
    pub work: [f64; 2],
}

type Numbers = [f64; 16];

impl Moving {
    fn numbers(&self) -> Numbers {
        let [r, v, w, u] = [self.r, self.v, self.omega, self.q.1];
        let [supplied, lost] = self.work;
        [r.x, r.y, r.z, v.x, v.y, v.z, w.x, w.y, w.z, self.q.0, u.x, u.y, u.z, self.phi, supplied, lost]
    }

    fn of(y: &Numbers) -> Self {
        let vector = |i: usize| Vector3::new(y[i], y[i + 1], y[i + 2]);
        Self { r: vector(0), v: vector(3), omega: vector(6), q: (y[9], vector(10)), phi: y[13], work: [y[14], y[15]] }
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
    /// A balanced rotor with nothing acting on it: mass \[kg], moments of inertia [kg·m²], from the support to c \[m].
    pub fn free(m: f64, moments: impl Into<Vector3<f64>>, l: f64) -> Self {
        Self {
            m,
            moments: moments.into(),
            masses: Vec::new(),
            l,
            g: Vector3::zeros(),
            c: [0.0; 2],
            d: [0.0; 2],
            tau: [0.0; 3],
            pushed: [Vector3::zeros(); 2],
            imposed: None,
        }
    }

    /// At c in r \[m] with v [m/s], φ \[rad], γ \[rad] and ω [rad/s].
    pub fn start(
        &self,
        r: Vector3<f64>,
        v: Vector3<f64>,
        phi: f64,
        gamma: Vector2<f64>,
        omega: Vector3<f64>,
    ) -> Moving {
        Moving { r, v, q: rotation::split(phi, &gamma), omega, phi, work: [0.0; 2] }
    }

    /// The motion from time `t` \[s] to `end` \[s], in so many steps.
    pub fn run(&self, t: f64, from: &Moving, end: f64, steps: u32) -> Moving {
        Moving::of(&extrapolation::steps(|t, y| self.rates(t, y), t, &from.numbers(), end - t, steps))
    }

    /// Kinetic and potential energy \[J].
    pub fn energy(&self, moving: &Moving) -> f64 {
        let (attitude, t) = (moving.attitude(), moving.axis());
        let turning = attitude.tr_mul(&moving.omega);
        let of_rotor = self.m * moving.v.norm_squared() + turning.dot(&self.moments.component_mul(&turning));
        let of_masses = self.masses.iter().map(|(mass, place)| {
            let place = attitude * place;
            let kinetic = 0.5 * (moving.v + moving.omega.cross(&place)).norm_squared();
            mass * (kinetic - self.g.dot(&(moving.r + place)))
        });
        let (r_a, gamma) = (moving.r - t * self.l, rotation::gamma(&t));
        let springs = self.c[0] * r_a.norm_squared() + self.c[1] * gamma.norm_squared();
        0.5 * (of_rotor + springs) - self.m * self.g.dot(&moving.r) + of_masses.sum::<f64>()
    }

    /// Accelerations of c [m/s²] and of the attitude [rad/s²], and the torque that imposes the speed [N·m].
    fn accelerations(&self, time: f64, moving: &Moving) -> (Vector3<f64>, Vector3<f64>, f64) {
        let (attitude, t, omega) = (moving.attitude(), moving.axis(), moving.omega);
        let inertia = attitude * Matrix3::from_diagonal(&self.moments) * attitude.transpose();
        let t_rate = omega.cross(&t);
        let (r_a, v_a) = (moving.r - t * self.l, moving.v - t_rate * self.l);
        let ([push, twist], n, gamma) = (self.pushed, joint(&t), rotation::gamma(&t));
        let support = push - r_a * self.c[0] - v_a * self.d[0];
        let tilting = twist + n * self.drive(time)
            - Vector3::new(0.0, gamma.x, gamma.y) * self.c[1]
            - t.cross(&t_rate) * self.d[1];
        // m a = F and J α = M − ω×Jω of the rotor; then m_i (a + α×ρ − |ω×|²…) = m_i g + f_i, −f_i on the rotor at ρ.
        let mut force = support + self.g * self.m;
        let mut moment = -t.cross(&support) * self.l + tilting - omega.cross(&(inertia * omega));
        let mut matrix = SMatrix::<f64, 7, 7>::zeros();
        let mut put = |row: usize, column: usize, block: &Matrix3<f64>| {
            let mut view = matrix.fixed_view_mut::<3, 3>(row, column);
            view += block;
        };
        put(0, 0, &(Matrix3::identity() * self.m));
        put(3, 3, &inertia);
        for (mass, place) in &self.masses {
            let place = attitude * place;
            let across = rotation::cross(&place) * *mass;
            let pull = (self.g - omega.cross(&omega.cross(&place))) * *mass;
            force += pull;
            moment += place.cross(&pull);
            put(0, 0, &(Matrix3::identity() * *mass));
            put(0, 3, &-across);
            put(3, 0, &across);
            put(3, 3, &-(rotation::cross(&place) * across));
        }
        let mut right = SVector::<f64, 7>::zeros();
        right.fixed_rows_mut::<3>(0).copy_from(&force);
        right.fixed_rows_mut::<3>(3).copy_from(&moment);
        match self.imposed {
            // n·α = dω_φ/dt − ω·dn/dt, by a torque τ n.
            Some(rate) => {
                let sum = 1.0 + t.x;
                let n_rate = t_rate / sum - (Vector3::x() + t) * (t_rate.x / (sum * sum));
                for i in 0..3 {
                    (matrix[(3 + i, 6)], matrix[(6, 3 + i)]) = (-n[i], n[i]);
                }
                right[6] = rate(time) - omega.dot(&n_rate);
            }
            None => matrix[(6, 6)] = 1.0,
        }
        let solved = matrix.lu().solve(&right).expect("a body with mass");
        let vector = |i: usize| Vector3::new(solved[i], solved[i + 1], solved[i + 2]);
        (vector(0), vector(3), solved[6])
    }

    /// The drive's torque at a time \[s], [N·m].
    fn drive(&self, t: f64) -> f64 {
        let [torque, slope, curvature] = self.tau;
        torque + t * (slope + t * (0.5 * curvature))
    }

    /// ω·(e + t)/(1 + e·t) [rad/s].
    pub fn axial_rate(&self, moving: &Moving) -> f64 {
        moving.omega.dot(&joint(&moving.axis()))
    }

    /// The torque that imposes the speed at a time \[s], [N·m].
    pub fn torque(&self, time: f64, moving: &Moving) -> f64 {
        self.accelerations(time, moving).2
    }

    /// After a blow along n that makes ω_φ this [rad/s]: impulse and its moment are passed on to each mass.
    pub fn jumped(&self, moving: &Moving, speed: f64) -> Moving {
        let attitude = moving.attitude();
        let inertia = attitude * Matrix3::from_diagonal(&self.moments) * attitude.transpose();
        let (mut total, mut moment, mut about) = (self.m, Vector3::zeros(), inertia);
        for (mass, place) in &self.masses {
            let place = attitude * place;
            let across = rotation::cross(&place);
            total += mass;
            moment += place * *mass;
            about -= across * across * *mass;
        }
        // Total momentum stays: M Δv + Δω×Σmρ = 0; about c: Σmρ×Δv + I_c Δω = λ n.
        let first = rotation::cross(&moment);
        let whole = about + first * first / total;
        let n = joint(&moving.axis());
        let gain = whole.lu().solve(&n).expect("a body with mass");
        let gain = gain * ((speed - n.dot(&moving.omega)) / n.dot(&gain));
        Moving { omega: moving.omega + gain, v: moving.v - gain.cross(&moment) / total, ..*moving }
    }

    fn rates(&self, time: f64, y: &Numbers) -> Numbers {
        let moving = Moving::of(y);
        let (t, omega) = (moving.axis(), moving.omega);
        let (acceleration, turning, torque) = self.accelerations(time, &moving);
        let (w, u) = rotation::product((0.0, omega * 0.5), moving.q);
        let t_rate = omega.cross(&t);
        let v_a = moving.v - t_rate * self.l;
        let lost = self.d[0] * v_a.norm_squared() + self.d[1] * t_rate.norm_squared();
        let (phi, [push, twist]) = (omega.dot(&joint(&t)), self.pushed);
        let supplied = (torque + self.drive(time)) * phi + push.dot(&v_a) + twist.dot(&omega);
        Moving { r: moving.v, v: acceleration, q: (w, u), omega: turning, phi, work: [supplied, lost] }.numbers()
    }
}

/// n = (e + t)/(1 + e·t).
pub fn joint(t: &Vector3<f64>) -> Vector3<f64> {
    (Vector3::x() + t) / (1.0 + t.x)
}
