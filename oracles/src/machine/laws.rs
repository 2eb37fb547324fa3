//! The laws of docs/theory.md, written here once more as rates of the state.

use super::inputs::Inputs;
use super::tabled::Tabled;
use super::{Machine, Motor, Rub, Start, Unbalance};
use crate::{rigid_body::joint, rotation};
use nalgebra::{Matrix3, Vector3};

/// How many numbers a state has: r, v, K of G, the quaternion P, ψ, φ, the torque of a motor that lags.
pub const SIZE: usize = 16;

/// A state, or its rates.
pub type State = [f64; SIZE];

/// Where things stand in a state.
pub(super) mod at {
    pub const R: usize = 0;
    pub const V: usize = 3;
    pub const K: usize = 6;
    pub const P: usize = 9;
    pub const PSI: usize = 13;
    pub const PHI: usize = 14;
    pub const TORQUE: usize = 15;
}

/// A spring and damper at a station.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spring {
    pub p: f64,
    /// Where its axial spring is at rest \[m].
    pub x: f64,
    pub axial: [f64; 2],
    pub k: [[f64; 2]; 2],
    pub c: [[f64; 2]; 2],
}

/// The laws with all that is constant worked out.
#[derive(Clone, Debug)]
pub struct Laws {
    pub(super) mass: f64,
    pub(super) gravity: Vector3<f64>,
    /// From c to G, inertia about G and its inverse, in body axes; whether these turn with ψ.
    centre: Vector3<f64>,
    inertia: Matrix3<f64>,
    inverse: Matrix3<f64>,
    asymmetric: bool,
    pub(super) springs: Vec<Spring>,
    /// Against tilt: stiffness [N·m/rad], damping [N·m·s/rad].
    pub(super) tilt: [f64; 2],
    /// What rounding leaves of the rates of v [m/s²] and K [N·m]: a support knows how far it gives way to the last digit of l.
    pub(super) rounding: [f64; 2],
    rotating_damping: Option<[f64; 2]>,
    drag: Option<[f64; 2]>,
    ports: Vec<f64>,
    imposes: bool,
    motor: Option<Motor>,
    /// Rings, and which of them press.
    pub(super) rubs: Vec<(Rub, bool)>,
    /// Bearings with a table.
    pub(super) tables: Vec<Tabled>,
}

/// What follows from a state.
pub(super) struct Motion {
    /// The body's axes as columns, the first being t.
    pub attitude: Matrix3<f64>,
    pub omega: Vector3<f64>,
    pub t_rate: Vector3<f64>,
    /// From c to G.
    pub centre: Vector3<f64>,
    pub r_c: Vector3<f64>,
    pub v_c: Vector3<f64>,
}

impl Motion {
    pub fn axis(&self) -> Vector3<f64> {
        self.attitude.column(0).into_owned()
    }

    /// Place and velocity of the station at p \[m].
    /// ω_φ [rad/s].
    pub fn speed(&self) -> f64 {
        self.omega.dot(&joint(&self.axis()))
    }

    pub fn station(&self, p: f64) -> [Vector3<f64>; 2] {
        [self.r_c + self.axis() * p, self.v_c + self.t_rate * p]
    }
}

pub(super) fn vector(y: &[f64], n: usize) -> Vector3<f64> {
    Vector3::new(y[n], y[n + 1], y[n + 2])
}

fn put(y: &mut [f64], n: usize, v: &Vector3<f64>) {
    y[n..n + 3].copy_from_slice(v.as_slice());
}

/// |s|² − s sᵀ.
fn spread(s: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(s.norm_squared()) - s * s.transpose()
}

/// A·(y, z).
fn across(a: &[[f64; 2]; 2], v: &Vector3<f64>) -> [f64; 2] {
    [a[0][0] * v.y + a[0][1] * v.z, a[1][0] * v.y + a[1][1] * v.z]
}

impl Laws {
    /// Of a machine.
    pub fn new(machine: &Machine) -> Self {
        let mass = machine.m + machine.unbalances.iter().map(|one| one.mass).sum::<f64>();
        let place = |one: &Unbalance| {
            Vector3::new(one.position, one.radius * libm::cos(one.angle), one.radius * libm::sin(one.angle))
        };
        let centre = machine.unbalances.iter().map(|one| place(one) * (one.mass / mass)).sum::<Vector3<f64>>();
        // Each part about G (Huygens and Steiner), the rotor being c of its own.
        let balanced = Vector3::new(machine.Ja, machine.Jt, machine.Jt2.unwrap_or(machine.Jt));
        let of_masses = machine.unbalances.iter().map(|one| spread(&(place(one) - centre)) * one.mass);
        let inertia = Matrix3::from_diagonal(&balanced) + spread(&centre) * machine.m + of_masses.sum::<Matrix3<f64>>();
        let mut laws = Self {
            mass,
            gravity: machine.gravity.unwrap_or_default(),
            centre,
            inertia,
            inverse: inertia.try_inverse().expect("a body with mass"),
            asymmetric: !machine.unbalances.is_empty() || machine.Jt2.is_some(),
            springs: Vec::new(),
            tilt: [0.0; 2],
            rounding: [0.0; 2],
            rotating_damping: machine.rotating_damping,
            drag: machine.drag,
            ports: machine.ports.clone(),
            imposes: machine.imposed_speed,
            motor: machine.motor,
            rubs: machine.rubs.iter().map(|rub| (*rub, false)).collect(),
            tables: machine.bearings.iter().filter_map(Tabled::of).collect(),
        };
        let Start { r_c, gamma, .. } = machine.start;
        let axis = rotation::axis(&gamma);
        for bearing in &machine.bearings {
            let super::Bearing { position: p, k, c, axial, tilt, .. } = *bearing;
            laws.springs.push(Spring { p, x: r_c.x + p * axis.x, axial, k, c });
            laws.tilt = [laws.tilt[0] + tilt[0], laws.tilt[1] + tilt[1]];
        }
        if let Some(super::Support { c, d }) = machine.support {
            let round = |s: f64| [[s, 0.0], [0.0, s]];
            laws.springs.push(Spring { p: -machine.l, x: 0.0, axial: [c[0], d[0]], k: round(c[0]), c: round(d[0]) });
            laws.tilt = [laws.tilt[0] + c[1], laws.tilt[1] + d[1]];
            let force = 16.0 * f64::EPSILON * c[0] * machine.l;
            laws.rounding = [force / mass, force * machine.l];
        }
        laws
    }

    /// The same machine, whose speed nothing imposes.
    pub(super) fn unimposed(&self) -> Self {
        Self { imposes: false, ..self.clone() }
    }

    /// Where ports are along t \[m].
    pub(super) fn port(&self, port: usize) -> f64 {
        self.ports[port]
    }

    /// The state at this start; the speed is not imposed yet.
    pub fn start(&self, start: &Start, inputs: &Inputs) -> State {
        let (w, v) = rotation::quaternion(&Vector3::new(0.0, start.gamma.x, start.gamma.y));
        let mut y = [0.0; SIZE];
        (y[at::P], y[at::PSI], y[at::PHI]) = (w, start.phi, start.phi);
        put(&mut y, at::P + 1, &v);
        let attitude = self.attitude(&y);
        let centre = attitude * self.centre;
        put(&mut y, at::R, &(start.r_c + centre));
        put(&mut y, at::V, &(start.v_c + start.omega.cross(&centre)));
        put(&mut y, at::K, &(attitude * (self.inertia * attitude.tr_mul(&start.omega))));
        y[at::TORQUE] = self.characteristic(0.0, &self.motion(&y), inputs);
        y
    }

    /// The body's axes, as far as they matter.
    fn attitude(&self, y: &State) -> Matrix3<f64> {
        let (w, v) = (y[at::P], vector(y, at::P + 1));
        let frame = rotation::drifted((w, v));
        if !self.asymmetric {
            return frame;
        }
        let (sine, cosine) = libm::sincos(y[at::PSI]);
        let (y, z) = (frame.column(1), frame.column(2));
        Matrix3::from_columns(&[frame.column(0).into_owned(), y * cosine + z * sine, z * cosine - y * sine])
    }

    pub(super) fn motion(&self, y: &State) -> Motion {
        let attitude = self.attitude(y);
        let omega = self.turning(&attitude, &vector(y, at::K));
        let t_rate = omega.cross(&attitude.column(0));
        let centre = if self.asymmetric { attitude * self.centre } else { Vector3::zeros() };
        let (r_c, v_c) = (vector(y, at::R) - centre, vector(y, at::V) - omega.cross(&centre));
        Motion { attitude, omega, t_rate, centre, r_c, v_c }
    }

    /// I⁻¹K.
    fn turning(&self, attitude: &Matrix3<f64>, k: &Vector3<f64>) -> Vector3<f64> {
        attitude * (self.inverse * attitude.tr_mul(k))
    }

    /// What a motor gives where it does not lag [N·m].
    fn characteristic(&self, t: f64, motion: &Motion, inputs: &Inputs) -> f64 {
        let steady = |motor: Motor| motor.stall_torque * (inputs.command(t) - motion.speed() / motor.synchronous_speed);
        self.motor.map_or(0.0, steady)
    }

    /// The torque of a motor [N·m] and its rate [N·m/s], where so much is in the state.
    pub(super) fn motor(&self, t: f64, motion: &Motion, inputs: &Inputs, torque: f64) -> [f64; 2] {
        let steady = self.characteristic(t, motion, inputs);
        match self.motor {
            Some(Motor { time_constant, .. }) if time_constant > 0.0 => [torque, (steady - torque) / time_constant],
            _ => [steady, 0.0],
        }
    }

    /// Force on the rotor of the spring and damper of this number.
    pub(super) fn spring_force(&self, n: usize, motion: &Motion) -> Vector3<f64> {
        let Spring { p, x, axial, k, c } = &self.springs[n];
        let [r, v] = motion.station(*p);
        let ([ky, kz], [cy, cz]) = (across(k, &r), across(c, &v));
        -Vector3::new(axial[0] * (r.x - x) + axial[1] * v.x, ky + cy, kz + cz)
    }

    /// Force on the rotor and moment about c, all but gravity, a motor and what imposes a speed.
    fn loads(&self, t: f64, motion: &Motion, inputs: &Inputs) -> [Vector3<f64>; 2] {
        let (axis, omega) = (motion.axis(), &motion.omega);
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        let mut push = |p: f64, f: Vector3<f64>| {
            force += f;
            moment += axis.cross(&f) * p;
        };
        for n in 0..self.springs.len() {
            push(self.springs[n].p, self.spring_force(n, motion));
        }
        for (n, p) in self.ports.iter().enumerate() {
            push(*p, inputs.port(n, t)[0]);
        }
        for table in &self.tables {
            push(table.p, table.force(&motion.station(table.p), motion.speed()));
        }
        let mut braking = 0.0;
        for (rub, _) in self.rubs.iter().filter(|(_, presses)| *presses) {
            let (force, torque) = rub.load(&motion.station(rub.position), motion.speed());
            push(rub.position, force);
            braking += torque;
        }
        if let Some([d, p]) = self.rotating_damping {
            let [r, v] = motion.station(p);
            // F = −d(q̇ − Ω e×q), Ω = e·ω, and the couple −e·(q×F) along e.
            let f = Vector3::new(0.0, v.y + omega.x * r.z, v.z - omega.x * r.y) * -d;
            push(p, f);
            moment.x -= r.y * f.z - r.z * f.y;
        }
        if braking != 0.0 {
            moment += joint(&axis) * braking;
        }
        for n in 0..self.ports.len() {
            moment += inputs.port(n, t)[1];
        }
        if self.tilt[0] != 0.0 {
            let gamma = rotation::gamma(&axis);
            moment -= Vector3::new(0.0, gamma.x, gamma.y) * self.tilt[0];
        }
        moment -= axis.cross(&motion.t_rate) * self.tilt[1];
        if let Some([linear, quadratic]) = self.drag {
            let speed = omega.dot(&axis);
            moment -= axis * ((linear + quadratic * speed.abs()) * speed);
        }
        let torque = inputs.torque(t);
        if torque != 0.0 {
            moment += joint(&axis) * torque;
        }
        [force, moment]
    }

    /// The rates of a state.
    pub fn rates(&self, t: f64, y: &State, inputs: &Inputs) -> State {
        let motion = self.motion(y);
        let (axis, omega) = (motion.axis(), motion.omega);
        let [force, moment] = self.loads(t, &motion, inputs);
        let mut moment = moment - motion.centre.cross(&force);
        let n = joint(&axis);
        let [torque, torque_rate] = self.motor(t, &motion, inputs, y[at::TORQUE]);
        if torque != 0.0 {
            moment += n * torque;
        }
        if self.imposes {
            // n·dω/dt = a − ω·dn/dt, with I dω/dt = M + τ n − ω×K.
            let sum = 1.0 + axis.x;
            let n_rate = motion.t_rate / sum - (Vector3::x() + axis) * (motion.t_rate.x / (sum * sum));
            let others = self.turning(&motion.attitude, &(moment - omega.cross(&vector(y, at::K))));
            let answer = n.dot(&self.turning(&motion.attitude, &n));
            let wanted = inputs.imposed().at(t)[1];
            moment += n * ((wanted - n_rate.dot(&omega) - n.dot(&others)) / answer);
        }
        let spin = omega.dot(&axis);
        // P turns as the axis does, at t×dt/dt.
        let (w, v) = rotation::product((0.0, axis.cross(&motion.t_rate) * 0.5), (y[at::P], vector(y, at::P + 1)));
        let mut rates = [0.0; SIZE];
        put(&mut rates, at::R, &vector(y, at::V));
        put(&mut rates, at::V, &(self.gravity + force / self.mass));
        put(&mut rates, at::K, &moment);
        rates[at::P] = w;
        put(&mut rates, at::P + 1, &v);
        (rates[at::PSI], rates[at::PHI], rates[at::TORQUE]) = (spin, omega.dot(&n), torque_rate);
        rates
    }

    /// The state after a blow along n that gives ω_φ this value [rad/s].
    pub(super) fn struck(&self, y: &State, speed: f64) -> State {
        let motion = self.motion(y);
        let n = joint(&motion.axis());
        let answer = n.dot(&self.turning(&motion.attitude, &n));
        let blow = n * ((speed - n.dot(&motion.omega)) / answer);
        let mut struck = *y;
        put(&mut struck, at::K, &(vector(y, at::K) + blow));
        struck
    }
}
