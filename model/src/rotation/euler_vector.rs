//! Matrices of a general Euler vector ϑ: the rotation L, its rate B and the inverse of B. The motion itself needs only
//! their closed forms in [`super::split`]; these serve the attitude as a matrix and the tests that hold the closed forms
//! against the paper's equations.

use super::series;
use crate::scalar::Scalar;
use nalgebra::{Matrix3, Vector3};

/// Functions of θ² shared by L, B and B⁻¹.
struct Coefficients<S> {
    /// sin θ/θ
    sinc: S,
    /// (1 − cos θ)/θ²
    versine: S,
    /// (θ − sin θ)/θ³
    cubic: S,
    /// (1 − q)/θ², q = (θ/2) cot(θ/2)
    inverse: S,
}

impl<S: Scalar> Coefficients<S> {
    fn new(theta_squared: S) -> Self {
        let [c, j_quarter] = series::cosine_and_bessel(theta_squared);
        // eq. 9
        let s = c + theta_squared * j_quarter;
        let quarter = s * s * S::constant(0.25);
        // eq. 10; 1 − sc = (1 − c²) + c(c − s) = x s² − x j c, and 1 − q = 1 − c/s = x j/s
        Self { sinc: s * c, versine: quarter + quarter, cubic: quarter - j_quarter * c, inverse: j_quarter / s }
    }
}

/// v× as a matrix [unit of v]: `cross(v) * w` = v×w.
fn cross<S: Scalar>(v: &Vector3<S>) -> Matrix3<S> {
    let o = S::zero();
    Matrix3::new(o, -v.z, v.y, v.z, o, -v.x, -v.y, v.x, o)
}

/// L(ϑ), 3×3 \[1]: the rotation by |ϑ| ≤ π \[rad] about ϑ.
pub fn rotation<S: Scalar>(euler_vector: &Vector3<S>) -> Matrix3<S> {
    let k = Coefficients::new(euler_vector.dot(euler_vector));
    let e = cross(euler_vector);
    // eq. 1, Rodrigues: L = I + (sin θ/θ) ϑ× + ((1 − cos θ)/θ²) (ϑ×)²
    Matrix3::identity() + e * k.sinc + e * e * k.versine
}

/// B(ϑ), 3×3 \[1]: ω = B dϑ/dt, |ϑ| ≤ π \[rad].
pub fn rate<S: Scalar>(euler_vector: &Vector3<S>) -> Matrix3<S> {
    let k = Coefficients::new(euler_vector.dot(euler_vector));
    let e = cross(euler_vector);
    // eq. 3: B = I + ((1 − cos θ)/θ²) ϑ× + ((θ − sin θ)/θ³) (ϑ×)²
    Matrix3::identity() + e * k.versine + e * e * k.cubic
}

/// B⁻¹(ϑ), 3×3 \[1]: dϑ/dt = B⁻¹ω, |ϑ| ≤ π \[rad].
pub fn inverse_rate<S: Scalar>(euler_vector: &Vector3<S>) -> Matrix3<S> {
    let k = Coefficients::new(euler_vector.dot(euler_vector));
    let e = cross(euler_vector);
    // eq. 4: B⁻¹ = I − ½ ϑ× + ((1 − q)/θ²) (ϑ×)²
    Matrix3::identity() - e * S::constant(0.5) + e * e * k.inverse
}
