//! The state of the motion and its kinematics.

use crate::body::Body;
use crate::rotation::{Chart, Tilt};
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

/// How many coordinates a motion has.
pub const COORDINATES: usize = 12;

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
    pub body: Body,
    /// Its coordinates.
    pub at: Coordinates<S>,
    /// Its tilt: γ and the axis t.
    pub tilt: Tilt<S>,
    /// Angular velocity ω [rad/s].
    pub omega: Vector3<S>,
}

impl<S: Scalar> Kinematics<S> {
    /// The kinematics of `body` at these coordinates of a chart.
    #[inline(always)]
    pub fn new(body: Body, chart: Chart, at: Coordinates<S>) -> Self {
        let tilt = Tilt::new(chart, at.gamma);
        let omega = body.angular_velocity(&at.k_c, &tilt.axis);
        Self { body, at, tilt, omega }
    }

    /// The axis t [1].
    #[inline(always)]
    pub fn axis(&self) -> &Vector3<S> {
        &self.tilt.axis
    }

    /// dt/dt = ω×t, the rate of the axis [1/s].
    #[inline(always)]
    pub fn axis_rate(&self) -> Vector3<S> {
        self.omega.cross(self.axis())
    }

    /// ω_φ = dφ/dt [rad/s], φ from e.
    pub fn axial_rate(&self) -> S {
        self.tilt.axial_rate(&self.omega)
    }

    /// Position of the station at `p` [m] along t from c, in O [m].
    #[inline(always)]
    pub fn station(&self, p: f64) -> Vector3<S> {
        self.at.r_c + self.axis() * S::constant(p)
    }

    /// Velocity of the station at `p` [m] along t from c, in O [m/s].
    #[inline(always)]
    pub fn station_velocity(&self, p: f64) -> Vector3<S> {
        self.at.v_c + self.axis_rate() * S::constant(p)
    }
}
