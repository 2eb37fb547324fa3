//! Jacobi's elliptic functions, and the integral of the third kind that a free body needs.
//!
//! All take the complementary parameter m₁ = 1 − k² instead of the modulus k: near k = 1, where a body lingers at its middle
//! axis, m₁ keeps its digits. Only sums, products and roots: the same bits everywhere. Measured against a second way in
//! `model/tests/all/free_flow.rs`.

use super::arc::cosine_and_sine;
use super::series;
use std::f64::consts::FRAC_PI_2;

/// More means than these are never needed: down to the smallest m₁ eight halve its exponent, and five double the digits.
const DEPTH: usize = 16;

/// Two numbers whose difference, relative, is less have one mean, to the last digit.
const ALIKE: f64 = 1e-8;

/// The elliptic functions of a modulus.
#[derive(Clone, Copy, Debug)]
pub struct Elliptic {
    /// 1 − k², in (0, 1].
    m1: f64,
    /// The arithmetic and geometric means on the way from 1 and √m₁.
    means: [[f64; 2]; DEPTH],
    /// How many of them.
    depth: usize,
    /// Their common limit.
    limit: f64,
}

impl Elliptic {
    /// Those with 1 − k² = `m1`, in (0, 1].
    pub fn new(m1: f64) -> Self {
        let (mut means, mut depth, mut pair) = ([[1.0; 2]; DEPTH], 0, [1.0, m1.sqrt()]);
        // eq. 91: M(1, √m₁), the means of Gauss
        loop {
            let [a, b] = pair;
            (means[depth], depth) = (pair, depth + 1);
            pair = [0.5 * (a + b), (a * b).sqrt()];
            if (a - b).abs() <= ALIKE * a || depth == DEPTH {
                return Self { m1, means, depth, limit: pair[0] };
            }
        }
    }

    /// K = ∫dϑ/√(1 − k² sin²ϑ) from 0 to π/2, the quarter period of sn and cn.
    pub fn quarter_period(&self) -> f64 {
        // eq. 91: K = π/(2M)
        FRAC_PI_2 / self.limit
    }

    /// sn w, cn w and dn w, |w| ≤ K (Bulirsch 1965, by the means backwards).
    pub fn jacobi(&self, w: f64) -> [f64; 3] {
        let [cosine, sine] = cosine_and_sine(w * self.limit);
        if sine == 0.0 {
            return [0.0, 1.0, 1.0];
        }
        let mut quotient = cosine / sine;
        let (mut cotangent, mut dn) = (self.limit * quotient, 1.0);
        for [a, b] in self.means[..self.depth].iter().rev() {
            // eq. 91: the ascending steps of cs = cn/sn and dn
            quotient *= cotangent;
            cotangent *= dn;
            dn = (b + quotient) / (a + quotient);
            quotient = cotangent / a;
        }
        let sn = (1.0 / (cotangent * cotangent + 1.0).sqrt()).copysign(sine);
        [sn, cotangent * sn, dn]
    }

    /// dn w of sn w and cn w.
    pub fn slope(&self, sn: f64, cn: f64) -> f64 {
        // eq. 91: dn² = cn² + m₁ sn²
        (cn * cn + self.m1 * (sn * sn)).sqrt()
    }

    /// ∫sn²/(1 + ν sn²) dw from 0 to the w of these sn, and cn ≥ 0; ν ≥ 0.
    pub fn third(&self, nu: f64, sn: f64, cn: f64) -> f64 {
        let (square, cosine) = (sn * sn, cn * cn);
        // eq. 92: ⅓ sn³ R_J(cn², dn², 1, 1 + ν sn²)
        let dn = cosine + self.m1 * square;
        let beyond = [(1.0 + nu) * square, (1.0 - self.m1 + nu) * square, nu * square];
        sn * square * carlson([cosine, dn, 1.0], 1.0 + nu * square, beyond) / 3.0
    }

    /// The same from 0 to K.
    pub fn third_to_quarter(&self, nu: f64) -> f64 {
        self.third(nu, 1.0, 0.0)
    }
}

/// Duplications, at most: few are needed once no two of the numbers are many decades apart.
const DUPLICATIONS: u32 = 40;

/// What the series below leaves out is of the eighth order in differences of this size.
const NEAR: f64 = 6e-3;

/// R_J(x, y, z, p) of numbers that p exceeds by those in `beyond`.
///
/// Source: Carlson (1995), Numer. Algorithms 10, duplication and a series of seventh order; DLMF 19.36.
fn carlson(mut xyz: [f64; 3], mut p: f64, beyond: [f64; 3]) -> f64 {
    let mean = |[x, y, z]: [f64; 3], p: f64| 0.2 * ((x + y) + z + 2.0 * p);
    // Each duplication divides the differences by four, and so their product by 64.
    let (mut sum, mut scale, mut product) = (0.0, 1.0, beyond[0] * beyond[1] * beyond[2]);
    let mut a = mean(xyz, p);
    for _ in 0..DUPLICATIONS {
        if xyz.into_iter().all(|v| (a - v).abs() < NEAR * a) && (p - a).abs() < NEAR * a {
            break;
        }
        let ([x, y, z], root) = (xyz.map(f64::sqrt), p.sqrt());
        let d = (root + x) * (root + y) * (root + z);
        // R_C(1, 1 + e) = arctan √e/√e, 0 ≤ e ≤ 1
        sum += scale / d * series::arctangent((product / (d * d)).min(1.0));
        let shift = x * y + x * z + y * z;
        xyz = xyz.map(|v| 0.25 * (v + shift));
        (p, scale, product) = (0.25 * (p + shift), 0.25 * scale, product / 64.0);
        a = mean(xyz, p);
    }
    let [x, y, z] = xyz.map(|v| (a - v) / a);
    let q = -0.5 * (x + y + z);
    let (xyz, qq) = (x * y * z, q * q);
    let e2 = x * y + x * z + y * z - 3.0 * qq;
    let e3 = xyz + 2.0 * e2 * q + 4.0 * qq * q;
    let e4 = (2.0 * xyz + e2 * q + 3.0 * qq * q) * q;
    let e5 = xyz * qq;
    let low = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0 - 3.0 * e4 / 22.0 - 9.0 * e2 * e3 / 52.0;
    let high = 3.0 * e5 / 26.0 - e2 * e2 * e2 / 16.0 + 3.0 * e3 * e3 / 40.0 + 3.0 * e2 * e4 / 20.0;
    let highest = 45.0 * e2 * e2 * e3 / 272.0 - 9.0 * (e3 * e4 + e2 * e5) / 68.0;
    scale / (a * a.sqrt()) * (low + (high + highest)) + 6.0 * sum
}
