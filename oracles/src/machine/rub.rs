//! Contact with a ring, the law of `rub` (eq. 97 to 99) in its two branches: it presses, or it does not.

use super::Rub;
use nalgebra::Vector3;

impl Rub {
    /// Away from the line of the stator, how far the shaft is in the ring \[m], and the rate of that [m/s].
    fn approach(&self, [r, v]: &[Vector3<f64>; 2]) -> (Vector3<f64>, f64, f64) {
        let distance = libm::hypot(r.y, r.z);
        let outward = if distance > 0.0 { Vector3::new(0.0, r.y, r.z) / distance } else { Vector3::zeros() };
        (outward, distance - self.gap, outward.dot(v))
    }

    /// Positive where the ring presses, from place and velocity of the station: the lesser of depth and normal force, the latter
    /// over the stiffness \[m].
    pub fn pressed(&self, station: &[Vector3<f64>; 2]) -> f64 {
        let (_, depth, rate) = self.approach(station);
        depth.min(depth + self.damping / self.stiffness * rate)
    }

    /// Speed at which the shaft slides on the ring [m/s], at this ω_φ [rad/s].
    pub fn sliding(&self, station: &[Vector3<f64>; 2], speed: f64) -> f64 {
        let (outward, ..) = self.approach(station);
        Vector3::x().cross(&outward).dot(&station[1]) + self.radius * speed
    }

    /// Force on the rotor of a ring that presses \[N], and its torque about n [N·m], at this ω_φ [rad/s].
    pub fn load(&self, station: &[Vector3<f64>; 2], speed: f64) -> (Vector3<f64>, f64) {
        let (outward, ..) = self.approach(station);
        let along = Vector3::x().cross(&outward);
        let friction = self.friction(station, speed);
        (-outward * self.normal(station) - along * friction, -friction * self.radius)
    }

    /// What of that force is friction \[N]; nothing where the ring does not press.
    pub fn friction_force(&self, station: &[Vector3<f64>; 2], speed: f64) -> Vector3<f64> {
        if self.pressed(station) <= 0.0 {
            return Vector3::zeros();
        }
        let (outward, ..) = self.approach(station);
        -Vector3::x().cross(&outward) * self.friction(station, speed)
    }

    fn normal(&self, station: &[Vector3<f64>; 2]) -> f64 {
        let (_, depth, rate) = self.approach(station);
        self.stiffness * depth + self.damping * rate
    }

    fn friction(&self, station: &[Vector3<f64>; 2], speed: f64) -> f64 {
        self.friction * self.normal(station) * libm::tanh(self.sliding(station, speed) / self.v0)
    }
}
