//! The torque-free rotor with three moments of inertia, in closed form but for one quadrature. SI units, radians. Checks:
//! `tests/exact/elliptic.rs`.

use super::elliptic::{inverse, jacobi, quarter_period};
use super::numerics::integral;
use super::rotation;
use nalgebra::{Matrix3, Vector2, Vector3};
use std::f64::consts::TAU;

/// A torque-free rotor with moments of inertia J about its axis x, y and z, the first of which is t.
///
/// Source: Jacobi (1849); Landau and Lifshitz, Mechanics, §37. With the axes named a, b, c so that b is the middle one and
/// K goes round c: ω_a = A cn u, ω_b = B sn u, ω_c = C dn u, u = u₀ + p t.
#[derive(Clone, Debug)]
pub struct Asymmetric {
    /// Moments of inertia [kg·m²].
    j: Vector3<f64>,
    /// The attitude at the start.
    start: Matrix3<f64>,
    /// The places of a, b, c among x, y, z.
    names: [usize; 3],
    /// A, B, C [rad/s].
    amplitudes: [f64; 3],
    /// du/dt [1/s].
    p: f64,
    /// u at the start.
    u: f64,
    /// 1 − k².
    m1: f64,
    /// |K| [kg·m²/s].
    momentum: f64,
}

impl Asymmetric {
    /// With moments `j` [kg·m²], all different, that starts with φ, γ \[rad] and ω [rad/s] in O, along none of its axes.
    pub fn new(j: [f64; 3], phi: f64, gamma: &Vector2<f64>, omega: &Vector3<f64>) -> Self {
        let start = rotation::attitude(phi, gamma);
        let (j, w) = (Vector3::from(j), start.transpose() * omega);
        let mut names = [0, 1, 2];
        names.sort_by(|x, y| j[*x].total_cmp(&j[*y]));
        // K² − 2T J_b says which axis K goes round: that of the largest moment where it is positive.
        let part = |n: usize, other: usize| j[n] * (j[other] - j[n]) * w[n] * w[n];
        let [a, b, c] = names;
        if part(a, b) + part(c, b) > 0.0 {
            names.reverse();
        }
        let [a, b, c] = names;
        // Sums of squares in place of 2T J − K², which would cancel.
        let about = |n: usize| (0..3).map(|i| part(i, n)).sum::<f64>();
        let (swing, spin) = (about(c), about(a));
        let m1 = (j[c] - j[a]) * about(b) / ((j[c] - j[b]) * spin);
        let size = |numerator: f64, n: usize, other: usize| (numerator / (j[n] * (j[other] - j[n]))).sqrt();
        let top = libm::copysign(size(spin, c, a), w[c]);
        // Euler's equation of b: B has the sign of A C (J_c − J_a), if a, b, c are right-handed.
        let hand = if (a + 1) % 3 == b { 1.0 } else { -1.0 };
        let middle = libm::copysign(size(swing, b, c), hand * top * (j[c] - j[a]));
        let amplitudes = [size(swing, a, c), middle, top];
        let p = ((j[c] - j[b]) * -spin / (j[a] * j[b] * j[c])).sqrt();
        let u = inverse(w[b] / amplitudes[1], w[a] / amplitudes[0], m1);
        Self { j, start, names, amplitudes, p, u, m1, momentum: j.component_mul(&w).norm() }
    }

    /// ω at time `t` \[s] in the axes of the body [rad/s].
    pub fn body_rates(&self, t: f64) -> Vector3<f64> {
        let [sn, cn, dn] = jacobi(self.u + self.p * t, self.m1);
        let mut w = Vector3::zeros();
        for ((name, amplitude), part) in self.names.into_iter().zip(self.amplitudes).zip([cn, sn, dn]) {
            w[name] = amplitude * part;
        }
        w
    }

    /// After so long ω is the same in the body again \[s]; about the middle axis it has flipped twice.
    pub fn period(&self) -> f64 {
        4.0 * quarter_period(self.m1) / self.p
    }

    /// The attitude at time `t` \[s]: where K points in the body is known, and about K the axis a turns by an integral over
    /// the closed form (Π, here by quadrature).
    pub fn attitude(&self, t: f64) -> Matrix3<f64> {
        let turned = rotation::rodrigues(&(Vector3::z() * self.azimuth(t)));
        self.start * self.seen_from_momentum(0.0).transpose() * turned * self.seen_from_momentum(t)
    }

    /// Where the axes of the body stand seen from K: rows x′ towards a, y′, z′ along K.
    fn seen_from_momentum(&self, t: f64) -> Matrix3<f64> {
        let z = self.j.component_mul(&self.body_rates(t)).normalize();
        let mut a = Vector3::zeros();
        a[self.names[0]] = 1.0;
        let x = (a - z * z.dot(&a)).normalize();
        Matrix3::from_rows(&[x.transpose(), z.cross(&x).transpose(), z.transpose()])
    }

    /// How far the axis a has turned about K at time `t` \[s]: dψ/dt = |K|(2T − J_a ω_a²)/(K² − J_a² ω_a²). K goes round
    /// c, so a never points along it.
    fn azimuth(&self, t: f64) -> f64 {
        let a = self.names[0];
        let rate = |time: f64| {
            let w = self.body_rates(time);
            let part = |power: i32| {
                (0..3).filter(|n| *n != a).map(|n| libm::pow(self.j[n], f64::from(power)) * w[n] * w[n]).sum::<f64>()
            };
            self.momentum * part(1) / part(2)
        };
        // The rate has half the period of ω; where the body lingers at its middle axis, or a passes K closely, it changes fast.
        let half = 0.5 * self.period();
        let fastest = self.p + self.momentum / self.j.min();
        let panels = |time: f64| 1 + (10.0 * fastest * time) as usize;
        let (halves, rest) = ((t / half).floor(), t - half * (t / half).floor());
        // Less its whole turns.
        let whole =
            if halves == 0.0 { 0.0 } else { libm::remainder(halves * integral(rate, 0.0, half, panels(half)), TAU) };
        whole + integral(rate, 0.0, rest, panels(rest))
    }
}
