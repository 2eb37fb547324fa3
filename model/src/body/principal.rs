//! Principal axes of an inertia tensor.

use nalgebra::{Matrix3, Vector3};

/// More rounds are never needed: each takes what is left to its square.
const ROUNDS: u32 = 10;

/// Moments of inertia about the principal axes of a symmetric `tensor`, and these as columns, the first one that is nearest to
/// x. By the rotations of Jacobi (1846), which keep small moments exact beside large ones: a needle has both.
pub fn principal(mut tensor: Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let mut axes = Matrix3::identity();
    for _ in 0..ROUNDS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if tensor[(p, q)] != 0.0 {
                let turn = rotation(&tensor, p, q);
                tensor = turn.transpose() * tensor * turn;
                // Zero but for rounding.
                (tensor[(p, q)], tensor[(q, p)]) = (0.0, 0.0);
                axes *= turn;
            }
        }
    }
    let (mut moments, along) = (tensor.diagonal(), axes.row(0).transpose().iamax());
    moments.swap_rows(0, along);
    axes.swap_columns(0, along);
    (moments, axes)
}

/// The turn in the plane of two axes after which the tensor does not couple them.
fn rotation(tensor: &Matrix3<f64>, p: usize, q: usize) -> Matrix3<f64> {
    let theta = (tensor[(q, q)] - tensor[(p, p)]) / (2.0 * tensor[(p, q)]);
    // The smaller root of τ² + 2θτ − 1 = 0, τ the tangent of the turn.
    let tangent = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
    let sine = tangent * cosine;
    let mut turn = Matrix3::identity();
    (turn[(p, p)], turn[(p, q)], turn[(q, p)], turn[(q, q)]) = (cosine, sine, -sine, cosine);
    turn
}
