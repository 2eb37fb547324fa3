//! Rotations by `libm` and quaternions: Rodrigues' formula (1840), Hamilton's product, and the split of an attitude.
//! Vectors in O, angles in radians. Checks: `tests/exact/numerics.rs`.

use nalgebra::{Matrix3, Vector2, Vector3};

/// The unit quaternion (w, v) of the rotation by |a| about a.
pub fn quaternion(a: &Vector3<f64>) -> (f64, Vector3<f64>) {
    let angle = a.norm();
    if angle == 0.0 {
        return (1.0, Vector3::zeros());
    }
    (libm::cos(0.5 * angle), a * (libm::sin(0.5 * angle) / angle))
}

/// Hamilton's product: the rotation q after p.
pub fn product(q: (f64, Vector3<f64>), p: (f64, Vector3<f64>)) -> (f64, Vector3<f64>) {
    (q.0 * p.0 - q.1.dot(&p.1), p.1 * q.0 + q.1 * p.0 + q.1.cross(&p.1))
}

/// The matrix of a unit quaternion.
pub fn matrix((w, v): (f64, Vector3<f64>)) -> Matrix3<f64> {
    let column = |u: Vector3<f64>| u + v.cross(&(v.cross(&u) + u * w)) * 2.0;
    Matrix3::from_columns(&[column(Vector3::x()), column(Vector3::y()), column(Vector3::z())])
}

/// The unit quaternion of the attitude with φ \[rad] about e, then γ \[rad].
pub fn split(phi: f64, gamma: &Vector2<f64>) -> (f64, Vector3<f64>) {
    product(quaternion(&Vector3::new(0.0, gamma.x, gamma.y)), quaternion(&(Vector3::x() * phi)))
}

/// The matrix of a quaternion whose length has drifted.
pub fn drifted((w, v): (f64, Vector3<f64>)) -> Matrix3<f64> {
    let norm = (w * w + v.norm_squared()).sqrt();
    matrix((w / norm, v / norm))
}

/// v× as a matrix.
pub fn cross(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// Rodrigues: L = cos θ I + (sin θ/θ) a× + ((1 − cos θ)/θ²) a aᵀ.
pub fn rodrigues(a: &Vector3<f64>) -> Matrix3<f64> {
    let angle = a.norm();
    if angle == 0.0 {
        return Matrix3::identity();
    }
    // 1 − cos θ = 2 sin²(θ/2), so that small angles keep their digits.
    let (half, n) = (libm::sin(0.5 * angle), a / angle);
    Matrix3::identity() * libm::cos(angle) + cross(&n) * libm::sin(angle) + n * n.transpose() * (2.0 * half * half)
}

/// The axis t of the transverse Euler vector γ: the great circle from e towards γ×e.
pub fn axis(gamma: &Vector2<f64>) -> Vector3<f64> {
    let theta = libm::hypot(gamma.x, gamma.y);
    if theta == 0.0 {
        return Vector3::x();
    }
    let sine = libm::sin(theta) / theta;
    Vector3::new(libm::cos(theta), sine * gamma.y, -sine * gamma.x)
}

/// The transverse Euler vector of an axis t: the angle between e and t about e×t.
pub fn gamma(axis: &Vector3<f64>) -> Vector2<f64> {
    let sine = libm::hypot(axis.y, axis.z);
    if sine == 0.0 {
        return Vector2::zeros();
    }
    Vector2::new(-axis.z, axis.y) * (libm::atan2(sine, axis.x) / sine)
}

/// The attitude of φ and γ: L(γ)·L(φe) by quaternions.
pub fn attitude(phi: f64, gamma: &Vector2<f64>) -> Matrix3<f64> {
    let transverse = quaternion(&Vector3::new(0.0, gamma.x, gamma.y));
    matrix(product(transverse, quaternion(&(Vector3::x() * phi))))
}

/// φ in (−π, π] of an attitude: what is left of it once its transverse part is undone.
pub fn phi(attitude: &Matrix3<f64>) -> f64 {
    let t = attitude.column(0).into_owned();
    let g = gamma(&t);
    let spin = rodrigues(&Vector3::new(0.0, g.x, g.y)).transpose() * attitude;
    libm::atan2(spin[(2, 1)], spin[(1, 1)])
}
