//! The attitude of the body as a matrix, where φ matters.

use super::Tilt;
use super::arc::cosine_and_sine;
use crate::scalar::Scalar;
use nalgebra::{Matrix3, Vector3};

impl<S: Scalar> Tilt<S> {
    /// L(ϑ), 3×3 \[1], of a body with φ \[rad] in the chart: its columns are the axes of the body in O, the first one t.
    #[inline(always)]
    pub fn attitude(&self, phi: S) -> Matrix3<S> {
        let ([y, z], [cosine, sine]) = (self.across(), cosine_and_sine(phi));
        // eq. 70: L(ϑ) = (t, u_y cos φ + u_z sin φ, u_z cos φ − u_y sin φ)
        Matrix3::from_columns(&[self.axis, y * cosine + z * sine, z * cosine - y * sine])
    }

    /// The axes across t of a body with φ = 0 in the chart \[1].
    #[inline(always)]
    fn across(&self) -> [Vector3<S>; 2] {
        let (gamma, sign) = (self.gamma_in_chart(), S::constant(self.chart().sign()));
        let versine = self.versine();
        let (yy, yz, zz) = (gamma.x * gamma.x, gamma.x * gamma.y, gamma.y * gamma.y);
        // eq. 70: u = L(γ) v = v cos θ + (sin θ/θ) γ×v + ((1 − cos θ)/θ²)(γ·v) γ, of y and ±z; t holds the first two terms
        [
            Vector3::new(-(sign * self.axis.y), sign * self.axis.x + versine * yy, versine * yz),
            Vector3::new(-self.axis.z, sign * versine * yz, self.axis.x + sign * versine * zz),
        ]
    }
}
