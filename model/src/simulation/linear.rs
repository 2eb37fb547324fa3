//! The linear equations of a motion at its start: how fast what changes, and how far the start excites the fastest of it.

use crate::state::{GAMMA, PHI};
use nalgebra::linalg::Schur;
use nalgebra::{Complex, Normed, SMatrix, SVector};

/// Equations without the quadratures.
const LINEAR: usize = PHI;

/// A motion has died out soon if it decays so many times faster than slower ones change [1].
const DEAD: f64 = 3.0;

/// Ones that are slower by this, but move [1].
const SLOWER: [f64; 2] = [1e-7, 0.1];

/// dy/dt = f + J (y − y₀).
pub(super) struct Linear {
    jacobian: SMatrix<f64, LINEAR, LINEAR>,
    /// The eigenvalues [1/s], those of largest modulus first; none where they cannot be found.
    rates: Vec<Complex<f64>>,
    /// f, and the size of r and of γ.
    start: SVector<f64, LINEAR>,
    length: f64,
}

impl Linear {
    /// Of these derivatives and rates at the start, r in units of `length` [m].
    pub fn new<const N: usize>(jacobian: &[[f64; N]; N], rates: &[f64; N], length: f64) -> Self {
        const ITERATIONS: usize = 1000;
        let jacobian = SMatrix::from_fn(|i, j| jacobian[i][j]);
        let found: Option<SVector<Complex<f64>, LINEAR>> =
            Schur::try_new(jacobian, f64::EPSILON, ITERATIONS).map(|schur| schur.complex_eigenvalues());
        let mut eigenvalues: Vec<_> = found.iter().flat_map(|rates| rates.iter().copied()).collect();
        eigenvalues.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
        Self { jacobian, rates: eigenvalues, start: SVector::from_fn(|i, _| rates[i]), length }
    }

    /// The largest modulus [rad/s].
    pub fn fastest(&self) -> f64 {
        self.rates.first().map_or(0.0, |rate| rate.norm())
    }

    /// The fastest decay, the largest −Re λ [1/s].
    pub fn decay(&self) -> f64 {
        self.rates.iter().fold(f64::MIN_POSITIVE, |most, rate| most.max(-rate.re))
    }

    /// The largest modulus of what does not die out soon; of everything, where nothing slower is left [rad/s].
    pub fn lasting(&self) -> f64 {
        let dies = |rate: &Complex<f64>| {
            let [still, slow] = SLOWER.map(|part| part * rate.norm());
            let slower = self.rates.iter().find(|other| (still..=slow).contains(&other.norm()));
            slower.is_some_and(|slower| -rate.re > DEAD * slower.norm())
        };
        self.rates.iter().find(|rate| !dies(rate)).map_or(0.0, |rate| rate.norm())
    }

    /// How long a motion that dies out keeps a method busy [s], whose steps grow with the sixth root of what is left.
    pub fn waning(&self) -> f64 {
        let still = SLOWER[0] * self.fastest();
        let moving = self.rates.iter().filter(|rate| rate.norm() > still);
        let slowest = moving.map(|rate| -rate.re).fold(f64::INFINITY, f64::min);
        if slowest > 0.0 { 6.0 / slowest } else { f64::INFINITY }
    }

    /// The largest modulus beyond the first gap below the fastest ones [rad/s]; none where there is no gap.
    pub fn slower(&self) -> Option<f64> {
        let moduli = self.rates.iter().map(|rate| rate.norm());
        moduli.clone().zip(moduli.skip(1)).find(|(above, below)| *below < SLOWER[1] * above).map(|(_, below)| below)
    }

    /// How fast the fastest motion decays, and the slowest of those above the first gap [1/s]; not below 0.
    pub fn fading(&self) -> [f64; 2] {
        let slower = self.slower().unwrap_or(0.0);
        let fast = self.rates.iter().filter(|rate| rate.norm() > slower).map(|rate| -rate.re);
        // Not `max`, which takes either zero of 0 and −0, each build its own.
        let decays = |fading: f64| if fading > 0.0 { fading } else { 0.0 };
        [fast.clone().next().unwrap_or(0.0), fast.fold(f64::INFINITY, f64::min)].map(decays)
    }

    /// How far the start excites the motions above the first gap, in r [length] and γ [rad].
    pub fn excited(&self) -> f64 {
        let slower = self.slower().unwrap_or(0.0);
        let (mut rest, mut most) = (self.start, 0.0);
        for rate in self.rates.iter().filter(|rate| rate.norm() > slower && rate.im >= 0.0) {
            let (scaled, damped) = (self.jacobian / rate.norm(), rate.re / rate.norm());
            most = self.amplitude(&scaled, &rest, rate.norm()).max(most);
            // What moves at this rate is taken out, since J² = 2 Re λ J − |λ|² there.
            let once = scaled * rest;
            rest = if rate.im == 0.0 { once - rest * damped } else { scaled * once - once * (2.0 * damped) + rest };
        }
        most
    }

    /// How far something moves in r [length] and γ [rad] whose rate is `start`, and most of which changes at `modulus` [rad/s], J
    /// over which is `scaled`.
    fn amplitude(&self, scaled: &SMatrix<f64, LINEAR, LINEAR>, start: &SVector<f64, LINEAR>, modulus: f64) -> f64 {
        // eq. 84: a = |Jᵏf|/|λ|ᵏ⁺¹, where slower motions have died away; k = 3, 4, for an oscillation is at rest twice a turn
        let power = scaled * (scaled * (scaled * start)) / modulus;
        let shown = |v: &SVector<f64, LINEAR>| {
            let [r, gamma] = [v.fixed_rows::<3>(0).norm() / self.length, v.fixed_rows::<2>(GAMMA.start).norm()];
            r.max(gamma)
        };
        shown(&power).max(shown(&(scaled * power)))
    }
}
