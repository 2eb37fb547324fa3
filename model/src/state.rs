//! The state of the motion and its kinematics.

use crate::body::{AngularVelocity, Inertia};
use crate::dual::Dual;
use crate::rotation::{Angle, Chart, Tilt};
use crate::scalar::Scalar;
use nalgebra::{Vector2, Vector3};

/// The coordinates of the motion, or their rates (units per second). Vectors in the inertial frame O.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S: Scalar> {
    /// Position of the mass centre c [m].
    pub r_c: Vector3<S>,
    /// Velocity of c [m/s].
    pub v_c: Vector3<S>,
    /// Angular momentum K_c about c [kg·m²/s].
    pub k_c: Vector3<S>,
    /// γ_y and γ_z [rad] in the chart in force.
    pub gamma: Vector2<S>,
    /// φ [rad] in the chart in force, less the whole turns that are counted apart.
    pub phi: S,
}

/// How many coordinates a motion has; a state without the work integrals.
pub const COORDINATES: usize = 12;

/// A state with the work integrals, which follow the coordinates.
pub const WITH_WORK: usize = COORDINATES + 2;

/// Where the work supplied [J] stands in a state with work.
pub const SUPPLIED: usize = COORDINATES;

/// Where the work lost [J] stands in a state with work.
pub const DISSIPATED: usize = COORDINATES + 1;

/// A state with work, or its rates.
pub type Whole<S> = [S; WITH_WORK];

/// Where γ stands among them.
pub const GAMMA: std::ops::Range<usize> = 9..11;

/// Where φ stands among them.
pub const PHI: usize = 11;

impl<S: Scalar> Coordinates<S> {
    /// From the first [`COORDINATES`] numbers of `y`, in the order of the fields.
    #[inline(always)]
    pub fn from_slice(y: &[S]) -> Self {
        Self {
            r_c: Vector3::new(y[0], y[1], y[2]),
            v_c: Vector3::new(y[3], y[4], y[5]),
            k_c: Vector3::new(y[6], y[7], y[8]),
            gamma: Vector2::new(y[GAMMA.start], y[GAMMA.start + 1]),
            phi: y[PHI],
        }
    }

    /// Into the first [`COORDINATES`] numbers of `y`, in the order of the fields.
    #[inline(always)]
    pub fn write(&self, y: &mut [S]) {
        let [r, v, k, gamma] = [&self.r_c, &self.v_c, &self.k_c, &self.gamma.push(self.phi)];
        for (part, vector) in y.chunks_exact_mut(3).zip([r, v, k, gamma]) {
            part.copy_from_slice(vector.as_slice());
        }
    }
}

/// Everything kinematic that follows from the coordinates of a body.
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<S: Scalar> {
    /// The body that moves.
    pub body: Inertia,
    /// Time [s].
    pub t: f64,
    /// Whole turns of φ, counted apart.
    pub turns: f64,
    /// Its coordinates.
    pub at: Coordinates<S>,
    /// Its tilt: γ and the axis t.
    pub tilt: Tilt<S>,
    /// The part of ω that moves the axis [rad/s]: ω = swing + spin t.
    pub swing: Vector3<S>,
    /// The rest of ω, about t [rad/s].
    pub spin: S,
    /// Angular velocity ω [rad/s].
    pub omega: Vector3<S>,
}

impl<S: Scalar> Kinematics<S> {
    /// The kinematics of `body` at these coordinates of a chart, at time 0 and with no turns counted apart.
    #[inline(always)]
    pub fn new(body: Inertia, chart: Chart, at: Coordinates<S>) -> Self {
        let tilt = Tilt::new(chart, at.gamma);
        let velocity = body.angular_velocity(&at.k_c, &tilt.axis);
        let (omega, AngularVelocity { swing, spin }) = (velocity.omega(&tilt.axis), velocity);
        Self { body, t: 0.0, turns: 0.0, at, tilt, swing, spin, omega }
    }

    /// The same at time `t` [s], with whole turns counted apart.
    #[inline(always)]
    pub fn when(self, t: f64, turns: f64) -> Self {
        Self { t, turns, ..self }
    }

    /// φ from e, wrapped.
    pub fn angle(&self) -> Angle {
        let gamma = self.at.gamma.map(S::re);
        self.tilt.chart().axial_angle(self.turns, self.at.phi.re(), gamma)
    }

    /// φ from e [rad].
    pub fn phi(&self) -> S {
        self.tilt.chart().phi_from_e(self.at.phi, self.at.gamma).with_value(self.angle().radians())
    }

    /// The axis t [1].
    #[inline(always)]
    pub fn axis(&self) -> &Vector3<S> {
        &self.tilt.axis
    }

    /// dt/dt = ω×t = swing×t, the rate of the axis [1/s].
    #[inline(always)]
    pub fn axis_rate(&self) -> Vector3<S> {
        self.swing.cross(self.axis())
    }

    /// The rate of γ in the chart in force [rad/s].
    #[inline(always)]
    pub fn gamma_rate(&self) -> Vector2<S> {
        // eq. 8; it does not feel what turns about t
        self.tilt.gamma_rate(&self.swing)
    }

    /// The rate of φ in the chart in force [rad/s].
    #[inline(always)]
    pub fn phi_rate(&self) -> S {
        // eq. 6, eq. 29; n·t = 1
        self.tilt.phi_rate(&self.swing) + self.spin
    }

    /// ω_φ = dφ/dt [rad/s], φ from e.
    pub fn axial_rate(&self) -> S {
        self.tilt.axial_rate(&self.omega)
    }

    /// dω_φ/dt [rad/s²], φ from e, where the coordinates change at these rates.
    pub fn axial_acceleration(&self, rates: &Coordinates<S>) -> S {
        // dω_φ/dt = ∂ω_φ/∂y · dy/dt
        let along = |at: S, rate: S| Dual::along(at, rate);
        let moving = Coordinates {
            r_c: self.at.r_c.zip_map(&rates.r_c, along),
            v_c: self.at.v_c.zip_map(&rates.v_c, along),
            k_c: self.at.k_c.zip_map(&rates.k_c, along),
            gamma: self.at.gamma.zip_map(&rates.gamma, along),
            phi: along(self.at.phi, rates.phi),
        };
        let [rate] = Kinematics::new(self.body, self.tilt.chart(), moving).axial_rate().eps;
        rate
    }

    /// From c to the station at `p` [m] along t, in O [m].
    #[inline(always)]
    pub fn lever(&self, p: f64) -> Vector3<S> {
        self.axis() * S::constant(p)
    }

    /// Position of the station at `p` [m] along t from c, in O [m].
    #[inline(always)]
    pub fn station(&self, p: f64) -> Vector3<S> {
        self.at.r_c + self.lever(p)
    }

    /// Velocity of the station at `p` [m] along t from c, in O [m/s].
    #[inline(always)]
    pub fn station_velocity(&self, p: f64) -> Vector3<S> {
        self.at.v_c + self.axis_rate() * S::constant(p)
    }
}
