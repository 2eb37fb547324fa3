//! What an error of the motion means for a load that is an output: how much it changes with a small change of the motion.

use crate::rotation::Tilt;
use nalgebra::Vector3;

/// An effect has at most so many loads among its outputs.
pub const MOST_LOADS: usize = 2;

/// How a rotor lies, for laws whose loads follow that.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// Position of the mass centre G of the whole \[m].
    pub centre: Vector3<f64>,
    /// From c to G in body axes \[m]; None where both are one.
    pub to_centre: Option<Vector3<f64>>,
    /// The tilt of the axis, and φ \[rad] in its chart.
    pub tilt: Tilt<f64>,
    /// See there.
    pub phi: f64,
    /// Velocity of G [m/s].
    pub velocity: Vector3<f64>,
    /// dt/dt [1/s].
    pub axis_rate: Vector3<f64>,
    /// Distance from the support point a to c, along t \[m].
    pub l: f64,
    /// ω_φ [rad/s].
    pub speed: f64,
}

/// A change of the motion to first order.
#[derive(Clone, Copy, Debug)]
pub struct Change {
    /// Of the position of c \[m].
    pub r_c: Vector3<f64>,
    /// Of the axis t \[1].
    pub axis: Vector3<f64>,
    /// Of the velocity of c [m/s].
    pub v_c: Vector3<f64>,
    /// Of dt/dt [1/s].
    pub axis_rate: Vector3<f64>,
    /// Of ω_φ [rad/s].
    pub speed: f64,
}

impl Pose {
    /// Position of the station at `p` \[m] along t from c \[m].
    #[inline(always)]
    pub fn station(&self, p: f64) -> Vector3<f64> {
        let of_centre = self.centre + self.tilt.axis * p;
        // eq. 71: r_c = r_G − R b
        self.to_centre.map_or(of_centre, |to_centre| of_centre - self.tilt.attitude(self.phi) * to_centre)
    }

    /// Velocity of that station [m/s].
    #[inline(always)]
    pub fn station_velocity(&self, p: f64) -> Vector3<f64> {
        let of_centre = self.velocity + self.axis_rate * p;
        // eq. 79: v_c ≈ v_G − dφ/dt t×R b
        self.to_centre.map_or(of_centre, |to_centre| {
            of_centre - self.tilt.axis.cross(&(self.tilt.attitude(self.phi) * to_centre)) * self.speed
        })
    }
}

impl Change {
    /// Of the position of the station at `p` \[m] along t from c \[m].
    #[inline(always)]
    pub fn station(&self, p: f64) -> Vector3<f64> {
        self.r_c + self.axis * p
    }

    /// Of its velocity [m/s].
    #[inline(always)]
    pub fn station_velocity(&self, p: f64) -> Vector3<f64> {
        self.v_c + self.axis_rate * p
    }
}
