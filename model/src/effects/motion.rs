//! A motion as laws see it: where the rotor is and how it moves, never the coordinates in which it is integrated.

use crate::scalar::Scalar;
use crate::state::{Kinematics, Rates};
use nalgebra::{Vector2, Vector3};

/// An instant of a motion, for the law of one effect. The stator stands still, its line is the x axis.
#[derive(Clone, Copy)]
pub struct Motion<'m, S: Scalar> {
    kinematics: &'m Kinematics<S>,
    own: &'m [S],
}

impl<'m, S: Scalar> Motion<'m, S> {
    /// The motion that an effect with these `own` states sees.
    #[inline(always)]
    pub fn new(kinematics: &'m Kinematics<S>, own: &'m [S]) -> Self {
        Self { kinematics, own }
    }

    /// For what imposes a speed, and so must know all of the motion.
    #[cfg(imposed_speed)]
    #[inline(always)]
    pub(super) fn whole(&self) -> &'m Kinematics<S> {
        self.kinematics
    }

    /// A state of the effect's own, by its number.
    #[inline(always)]
    pub fn own(&self, n: usize) -> S {
        self.own[n]
    }

    /// Time \[s].
    #[inline(always)]
    pub fn t(&self) -> S {
        self.kinematics.t
    }

    /// Mass of the whole \[kg].
    #[inline(always)]
    pub fn mass(&self) -> f64 {
        self.kinematics.body.m
    }

    /// Distance from the support point a to c, along t \[m].
    #[inline(always)]
    pub fn l(&self) -> f64 {
        self.kinematics.body.l
    }

    /// The axis t \[1].
    #[inline(always)]
    pub fn axis(&self) -> &'m Vector3<S> {
        self.kinematics.axis()
    }

    /// dt/dt [1/s].
    #[inline(always)]
    pub fn axis_rate(&self) -> Vector3<S> {
        self.kinematics.axis_rate()
    }

    /// How far the axis leans: the Euler vector that turns e to t the shortest way, f e×t with f = θ/sinθ, y and z \[rad].
    #[inline(always)]
    pub fn lean(&self) -> Vector2<S> {
        self.kinematics.tilt.gamma()
    }

    /// n = (e + t)/(1 + e·t), along which a constant-velocity joint passes a torque on \[1].
    #[inline(always)]
    pub fn joint_axis(&self) -> Vector3<S> {
        self.kinematics.tilt.joint_axis()
    }

    /// ω [rad/s].
    #[inline(always)]
    pub fn omega(&self) -> &'m Vector3<S> {
        &self.kinematics.omega
    }

    /// ω_a = ω·t, the spin about the axis [rad/s].
    #[inline(always)]
    pub fn spin(&self) -> S {
        self.kinematics.omega.dot(self.kinematics.axis())
    }

    /// ω_φ, the rate of φ [rad/s].
    #[inline(always)]
    pub fn omega_phi(&self) -> S {
        self.kinematics.axial_rate()
    }

    /// φ \[rad]; a law that asks for it declares that it [follows φ](super::Effect::FOLLOWS_PHI).
    pub fn phi(&self) -> S {
        self.kinematics.phi()
    }

    /// dω_φ/dt [rad/s²] where the coordinates change at these rates.
    pub fn axial_acceleration(&self, rates: &Rates<S>) -> S {
        self.kinematics.axial_acceleration(&rates.coordinates)
    }

    /// From c to the mass centre of the whole \[m]; None where both are one.
    #[inline(always)]
    pub fn to_centre(&self) -> Option<Vector3<S>> {
        self.kinematics.to_centre
    }

    /// Position of the mass centre of the whole \[m].
    #[inline(always)]
    pub fn centre(&self) -> &'m Vector3<S> {
        &self.kinematics.at.r
    }

    /// Position of c \[m].
    #[inline(always)]
    pub fn r_c(&self) -> Vector3<S> {
        self.kinematics.r_c()
    }

    /// From c to the station at `p` \[m] along t \[m].
    #[inline(always)]
    pub fn lever(&self, p: f64) -> Vector3<S> {
        self.kinematics.lever(p)
    }

    /// Position of the station at `p` \[m] along t from c, relative to the stator \[m].
    #[inline(always)]
    pub fn station(&self, p: f64) -> Vector3<S> {
        self.kinematics.station(p)
    }

    /// Velocity of the station at `p` \[m] along t from c, relative to the stator [m/s].
    #[inline(always)]
    pub fn station_velocity(&self, p: f64) -> Vector3<S> {
        self.kinematics.station_velocity(p)
    }
}
