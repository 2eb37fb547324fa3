//! Coefficients of Radau IIA of order 5 with 3 stages: collocation at the nodes c_i, the last of which is the end of a step.
//!
//! Source: Hairer and Wanner, Solving Ordinary Differential Equations II, sections IV.5 and IV.8 (radau5). Γ, α ± iβ are the
//! eigenvalues of A⁻¹, and T⁻¹ A⁻¹ T is in real Jordan form; from √6 with 40 digits, rounded once.

use nalgebra::Complex;

/// Stages.
pub const STAGES: usize = 3;

/// c_i.
pub const C: [f64; STAGES] = [0.1550510257216822, 0.6449489742783178, 1.0];

/// The real eigenvalue.
pub const GAMMA: f64 = 3.637834252744496;

/// α + iβ.
pub const PAIR: Complex<f64> = Complex::new(2.6810828736277523, 3.0504301992474105);

/// T.
pub const T: [[f64; STAGES]; STAGES] = [
    [0.09443876248897524, -0.1412552950209542, -0.030029194105147424],
    [0.2502131229653333, 0.20412935229379994, 0.3829421127572619],
    [1.0, 1.0, 0.0],
];

/// T⁻¹.
pub const T_INVERSE: [[f64; STAGES]; STAGES] = [
    [4.178718591551905, 0.32768282076106237, 0.5233764454994495],
    [-4.178718591551905, -0.32768282076106237, 0.47662355450055044],
    [-0.5028726349457868, 2.571926949855605, -0.5960392048282249],
];

/// e_i of the embedded result of order 3: −(13 + 7√6)/3, −(13 − 7√6)/3, −1/3.
pub const ERROR: [f64; STAGES] = [-10.048809399827416, 1.382142733160749, -0.3333333333333333];

/// K: of y' = λy, z = hλ, a step errs by z⁶/7200, and the estimate is z⁴/216.367…; (γ − z)² z⁻² of the one over the other at z = 0.
pub const LOCAL: f64 = 0.3976902420588938;

/// What each stage gives the polynomial of collocation at σ.
pub fn weights(sigma: f64) -> [f64; STAGES] {
    let [a, b, c] = C;
    [
        sigma * (sigma - b) * (sigma - c) / (a * (a - b) * (a - c)),
        sigma * (sigma - a) * (sigma - c) / (b * (b - a) * (b - c)),
        sigma * (sigma - a) * (sigma - b) / (c * (c - a) * (c - b)),
    ]
}

/// Σ a_i v_i.
pub fn combined<const N: usize>(a: &[f64; STAGES], v: &[[f64; N]; STAGES]) -> [f64; N] {
    std::array::from_fn(|n| a[0] * v[0][n] + a[1] * v[1][n] + a[2] * v[2][n])
}
