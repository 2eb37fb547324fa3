//! The motion of a body with three moments of inertia that nothing acts on, in closed form (Jacobi 1849).
//!
//! Principal axes a, b, c: b has the middle moment, and K goes round c. Seen from the body K follows elliptic functions; the turn
//! about K is an integral of the third kind. The azimuth about K is that of a or c, whichever stays well away from K, and it
//! is reckoned from where the shortest turn takes that axis to K, which has no limit even where both meet.

use crate::rotation::Turn;
use crate::rotation::arc::{atan2, cosine_and_sine};
use crate::rotation::elliptic::Elliptic;
use nalgebra::Vector3;

/// A free body that tumbles.
#[derive(Clone, Copy, Debug)]
pub struct Poinsot {
    /// The places of a, b, c among the principal axes.
    places: [usize; 3],
    /// K/|K| at the start, along a, b, c \[1].
    start: [f64; 3],
    /// The amplitudes of its parts along them \[1].
    amplitudes: [f64; 3],
    /// sn, cn ≥ 0 and dn at the start.
    phase: [f64; 3],
    elliptic: Elliptic,
    /// How fast the argument of sn grows [1/s].
    rate: f64,
    /// Whether c is the axis whose azimuth is reckoned, and not a.
    about_c: bool,
    /// How fast the azimuth grows evenly [rad/s], and by how much of the integral besides \[rad].
    mean: f64,
    rest: f64,
    /// ν of the integral.
    nu: f64,
    /// An angular velocity that is not exceeded [rad/s].
    bound: f64,
}

/// K that is not farther from an axis of inertia stays there \[1], squared: nothing that turns by so little is seen.
const NEAR: f64 = 1e-290;

impl Poinsot {
    /// With `excess` of 1/J about the principal axes over `per_j` [1/(kg·m²)], and angular momentum `k` along them [kg·m²/s].
    /// None of a body that turns steadily.
    pub fn new(excess: [f64; 3], per_j: f64, k: &Vector3<f64>) -> Option<Self> {
        let momentum = k.norm();
        let u = k / momentum;
        let mut places = [0, 1, 2];
        places.sort_unstable_by(|i, j| excess[*i].total_cmp(&excess[*j]));
        let difference = |[i, j]: [usize; 2]| excess[i] - excess[j];
        let [least, middle, most] = places;
        // eq. 74: K goes round the axis of the largest 1/J where u²(1/J − 1/J_b) of it exceeds that of the other
        let share = |n: usize| u[n] * u[n] * difference([n, middle]).abs();
        if share(most) < share(least) {
            places = [most, middle, least];
        }
        let [a, b, c] = places;
        let whole = difference([c, a]);
        let (near, far) = (difference([c, b]) / whole, difference([b, a]) / whole);
        let (root, ratio) = (near.sqrt(), far / near);
        let start = places.map(|n| u[n]);
        let [square_a, square_b, square_c] = start.map(|u| u * u);
        // eq. 74: A² = u_a² + ρ u_b², C² = u_c² + (1 − ρ) u_b², B² = A²/ρ, ρ = (1/J_c − 1/J_b)/(1/J_c − 1/J_a)
        let (swing, spin) = (square_a + (root * start[1]) * (root * start[1]), square_c + far * square_b);
        let (amplitude, top) = (swing.sqrt(), spin.sqrt());
        // eq. 74: dw/dt = ∓|K| (1/J_c − 1/J_a) √ρ C
        let hand = if (a + 1) % 3 == b { -1.0 } else { 1.0 };
        let rate = momentum * whole * root * top * hand * start[2].signum();
        let still = u.cross(&Vector3::from(excess).component_mul(&u)) == Vector3::zeros();
        // Not a number where the body is spherical, or the square of K zero.
        if still || !(swing > NEAR && spin > NEAR && rate.abs() > 0.0) {
            return None;
        }
        // eq. 74: 1 − k² = (u_c² − u_a² (1 − ρ)/ρ)/C²
        let m1 = ((square_c - square_a * ratio) / spin).clamp(f64::MIN_POSITIVE, 1.0);
        // Half a period on, a and b have changed their signs, and nothing else.
        let flip = 1.0_f64.copysign(start[0]);
        let amplitudes = [flip * amplitude, flip * amplitude / root, top.copysign(start[2])];
        let phase = [start[1] / amplitudes[1], start[0] / amplitudes[0], start[2] / amplitudes[2]];
        let about_c = near >= 0.5;
        let lowest = per_j + excess[if about_c { a } else { c }];
        // eq. 94
        let (nu, asymmetric) = if about_c { (ratio, ratio) } else { (swing / spin, -swing / spin) };
        Some(Self {
            places,
            start,
            amplitudes,
            phase,
            elliptic: Elliptic::new(m1),
            rate,
            about_c,
            mean: momentum * lowest,
            rest: asymmetric * momentum * whole / rate,
            nu,
            bound: momentum * (per_j + excess[least].max(excess[most])),
        })
    }

    /// An angular velocity that is not exceeded [rad/s].
    pub fn bound(&self) -> f64 {
        self.bound
    }

    /// How the body has turned after a time `h` \[s], backwards where it is negative; in principal axes at the start.
    pub fn turn(&self, h: f64) -> Turn {
        let half = 2.0 * self.elliptic.quarter_period();
        let argument = self.rate * h;
        let halves = (argument / half).round();
        let [sn, cn, dn] = self.elliptic.jacobi(argument - halves * half);
        let [sn_0, cn_0, dn_0] = self.phase;
        // eq. 74: the addition theorem, its denominator without a difference
        let per = 1.0 / (cn_0 * cn_0 + sn_0 * sn_0 * (dn * dn));
        let (sine, cosine) = (per * (sn_0 * cn * dn + sn * cn_0 * dn_0), per * (cn_0 * cn - sn_0 * dn_0 * (sn * dn)));
        // Steps of one size would miss the circle by the same last digit, and the energy would go with them.
        let onto = 1.5 - 0.5 * (sine * sine + cosine * cosine);
        let (sine, cosine) = (sine * onto, cosine * onto);
        let slope = self.elliptic.slope(sine, cosine);
        let sign = if halves == 2.0 * (0.5 * halves).round() { 1.0 } else { -1.0 };
        let [x, y, z] = self.amplitudes;
        let end = [x * sign * cosine, y * sign * sine, z * slope];
        // eq. 94: the integral from where u is at the start, by whole half periods and what is left
        let quarter = if halves == 0.0 && cosine >= 0.0 { 0.0 } else { self.elliptic.third_to_quarter(self.nu) };
        let mut third = self.elliptic.third(self.nu, sine, cosine.abs());
        if cosine < 0.0 {
            third = (2.0 * quarter).copysign(sn_0 + sine) - third;
        }
        third += 2.0 * halves * quarter - self.elliptic.third(self.nu, sn_0, cn_0);
        self.seen_from_body(self.mean * h + self.rest * third, &end)
    }

    /// The turn that takes K in the body from the start to `end` and the axis by an azimuth \[rad] about K.
    fn seen_from_body(&self, azimuth: f64, end: &[f64; 3]) -> Turn {
        let figure = if self.about_c { 2 } else { 0 };
        let (i, j) = ((self.places[figure] + 1) % 3, (self.places[figure] + 2) % 3);
        let [before, after] = [&self.start, end].map(|along| {
            let mut u = Vector3::zeros();
            self.places.into_iter().zip(along).for_each(|(n, part)| u[n] = *part);
            u
        });
        // K goes round c one way: the end of the axis that it is nearer to.
        let mut axis = Vector3::zeros();
        axis[self.places[figure]] = if self.about_c { 1.0_f64.copysign(self.start[2]) } else { 1.0 };
        let (cross, dot) = (before[i] * after[j] - before[j] * after[i], before[i] * after[i] + before[j] * after[j]);
        let round = axis[self.places[figure]] * atan2(cross, dot);
        // eq. 94: L(γ_0) L((ψ − χ) e) L(γ_1)ᵀ
        let [cosine, sine] = cosine_and_sine(0.5 * (azimuth - round));
        let shortest = |u: &Vector3<f64>| Turn::of(u.norm() + axis.dot(u), axis.cross(u));
        shortest(&before).after(&Turn::of(cosine, axis * sine)).after(&shortest(&after).back())
    }
}
