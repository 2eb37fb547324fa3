//! Jacobi's elliptic functions and the integral that they invert.
//!
//! All take the complementary parameter m₁ = 1 − k² in place of the modulus k: near k = 1, where a body lingers at an
//! unstable axis, m₁ keeps its digits. Checks: `tests/exact/elliptic.rs`.

use std::f64::consts::FRAC_PI_2;

/// Halvings of the descending transformation; each doubles the digits.
const DEPTH: usize = 12;

/// K(k) = ∫dϑ/√(1 − k² sin²ϑ) from 0 to π/2, the quarter period of sn and cn.
///
/// Source: Gauss (1818): K = π/(2 M(1, √m₁)), M the arithmetic-geometric mean.
pub fn quarter_period(m1: f64) -> f64 {
    let (mut a, mut b) = (1.0, m1.sqrt());
    for _ in 0..DEPTH {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    FRAC_PI_2 / a
}

/// (sn u, cn u, dn u).
///
/// Source: Abramowitz and Stegun 16.4, descending Landen transformation: φ_N = 2^N a_N u, then
/// sin(2φ_{n−1} − φ_n) = (c_n/a_n) sin φ_n down to φ₀ = am u. dn² = cn² + m₁ sn².
pub fn jacobi(u: f64, m1: f64) -> [f64; 3] {
    // Beyond a few periods the sines of large angles would lose digits.
    let u = libm::remainder(u, 4.0 * quarter_period(m1));
    let (mut a, mut b) = (1.0, m1.sqrt());
    let mut ratios = [0.0; DEPTH];
    let mut scale = 1.0;
    for ratio in &mut ratios {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        *ratio = c / a;
        scale *= 2.0;
    }
    let mut phi = scale * a * u;
    for ratio in ratios.into_iter().rev() {
        phi = 0.5 * (phi + libm::asin(ratio * libm::sin(phi)));
    }
    let (sn, cn) = (libm::sin(phi), libm::cos(phi));
    [sn, cn, (cn * cn + m1 * sn * sn).sqrt()]
}

/// The u in (−2K, 2K] of which these are, up to a common factor, sn u and cn u.
///
/// Source: F(φ, k) = sin φ · R_F(cos²φ, 1 − k² sin²φ, 1) for |φ| ≤ π/2 (DLMF 19.25.5), F(π − φ) = 2K − F(φ).
pub fn inverse(sn: f64, cn: f64, m1: f64) -> f64 {
    let norm = libm::hypot(sn, cn);
    let (s, c) = (sn / norm, cn / norm);
    let near = s * carlson(c * c, c * c + m1 * s * s, 1.0);
    if c >= 0.0 { near } else { libm::copysign(2.0 * quarter_period(m1), s) - near }
}

/// R_F(x, y, z) = ½∫dt/√((t + x)(t + y)(t + z)) from 0 to ∞.
///
/// Source: Carlson (1979), DLMF 19.36.1, duplication until all three agree, then a series of fifth order.
pub fn carlson(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    // Each pass divides the differences by four.
    for _ in 0..100 {
        let mean = (x + y + z) / 3.0;
        let [dx, dy] = [x, y].map(|v| 1.0 - v / mean);
        let dz = -dx - dy;
        // What the series leaves out is of sixth order in these.
        if dx.abs().max(dy.abs()).max(dz.abs()) < 1e-3 {
            let (e2, e3) = (dx * dy - dz * dz, dx * dy * dz);
            return (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0) / mean.sqrt();
        }
        let [p, q, r] = [x, y, z].map(f64::sqrt);
        let shift = p * q + p * r + q * r;
        (x, y, z) = (0.25 * (x + shift), 0.25 * (y + shift), 0.25 * (z + shift));
    }
    f64::NAN
}
