//! The frequencies of small motions about a state, and how much of each the motion holds there.

use super::inputs::Inputs;
use super::laws::{Laws, State, at};
use nalgebra::{Complex, ComplexField, SMatrix, SVector, Vector3};

/// Without φ, which nothing follows.
const N: usize = at::PHI;

/// The linear equations about a state, dy/dt = f + J(y − y₀), each number counted in a unit of its own.
#[derive(Clone, Debug)]
pub struct Spectrum {
    jacobian: SMatrix<Complex<f64>, N, N>,
    rates: SVector<Complex<f64>, N>,
    units: State,
    quaternion: Vector3<f64>,
    scalar: f64,
    /// The eigenvalues [rad/s].
    pub values: Vec<Complex<f64>>,
}

/// An oscillation.
#[derive(Clone, Copy, Debug)]
pub struct Mode {
    /// Its eigenvalue, of a positive imaginary part [rad/s].
    pub value: Complex<f64>,
    /// How far it moves G across e [m].
    pub place: f64,
    /// How far it tilts the axis [rad].
    pub tilt: f64,
}

/// Differences are taken over so much of each number's unit [1].
const STEP: f64 = 1e-5;

/// Eigenvalues that lie nearer together than this part of their size count as one [1].
const TOGETHER: f64 = 1e-3;

/// An eigenvalue whose imaginary part is a smaller part of the largest is that of no oscillation [1].
const REAL: f64 = 1e-7;

/// Points of the circle on which the resolvent is summed, and its radius over the distance of the next eigenvalue [1]: others
/// count 0.4⁴⁰ = 1e-16.
const POINTS: u32 = 40;
const RADIUS: f64 = 0.4;

impl Spectrum {
    /// About this state; None where no eigenvalues are found.
    pub(super) fn new(laws: &Laws, inputs: &Inputs, t: f64, y: &State) -> Option<Self> {
        let units = laws.units(y);
        let shifted = |n: usize, by: f64| {
            let mut moved = *y;
            moved[n] += by;
            laws.rates(t, &moved, inputs)
        };
        let mut jacobian = SMatrix::<f64, N, N>::zeros();
        for n in 0..N {
            let step = STEP * units[n];
            let (ahead, behind) = (shifted(n, step), shifted(n, -step));
            for row in 0..N {
                jacobian[(row, n)] = (ahead[row] - behind[row]) / (2.0 * STEP * units[row]);
            }
        }
        let fastest = jacobian.amax().max(f64::MIN_POSITIVE);
        let schur = nalgebra::Schur::try_new(jacobian / fastest, 1e-15, 10_000)?;
        let values = schur.complex_eigenvalues().iter().map(|value| value * fastest).collect();
        let rates = laws.rates(t, y, inputs);
        let rates = SVector::from_fn(|n, _| Complex::from(rates[n] / units[n]));
        let quaternion = Vector3::new(y[at::P + 1], y[at::P + 2], y[at::P + 3]);
        Some(Self { jacobian: jacobian.map(Complex::from), rates, units, quaternion, scalar: y[at::P], values })
    }

    /// The largest size of an eigenvalue [rad/s].
    pub fn fastest(&self) -> f64 {
        self.values.iter().map(|value| value.modulus()).fold(0.0, f64::max)
    }

    /// The oscillations, the fastest first. Those that lie together are one.
    pub fn modes(&self) -> Vec<Mode> {
        let least = REAL * self.fastest();
        let mut left: Vec<_> = self.values.iter().copied().filter(|value| value.im > least).collect();
        left.sort_by(|a, b| b.im.total_cmp(&a.im));
        let mut modes = Vec::new();
        while let Some(value) = left.first().copied() {
            let near = |other: &Complex<f64>| (other - value).modulus() <= TOGETHER * value.modulus();
            left.retain(|other| !near(other));
            let others = self.values.iter().filter(|other| !near(other)).map(|other| (other - value).modulus());
            modes.push(self.mode(value, RADIUS * others.fold(f64::INFINITY, f64::min)));
        }
        modes
    }

    /// What the motion holds of the eigenvalues within this radius of one [rad/s].
    fn mode(&self, value: Complex<f64>, radius: f64) -> Mode {
        // Riesz's projector: f of the mode = 1/(2πi) ∮ (z − J)⁻¹ f dz; the motion is f/λ.
        let mut held = SVector::<Complex<f64>, N>::zeros();
        for point in 0..POINTS {
            let angle = std::f64::consts::TAU * f64::from(point) / f64::from(POINTS);
            let out = Complex::new(libm::cos(angle), libm::sin(angle)) * radius;
            let resolvent = SMatrix::from_diagonal_element(value + out) - self.jacobian;
            if let Some(solved) = resolvent.lu().solve(&self.rates) {
                held += solved * (out / f64::from(POINTS) / value);
            }
        }
        // With its conjugate it is twice its real part.
        let held = SVector::<Complex<f64>, N>::from_fn(|n, _| held[n] * (2.0 * self.units[n]));
        let place = libm::hypot(held[at::R + 1].modulus(), held[at::R + 2].modulus());
        let tilt = [|z: Complex<f64>| z.re, |z: Complex<f64>| z.im].map(|part| self.tilt(&held.map(part)).norm());
        Mode { value, place, tilt: libm::hypot(tilt[0], tilt[1]) }
    }

    /// By how much the axis moves where the state does so.
    fn tilt(&self, moved: &SVector<f64, N>) -> Vector3<f64> {
        let (w, v) = (moved[at::P], Vector3::new(moved[at::P + 1], moved[at::P + 2], moved[at::P + 3]));
        // dP = ½ δ P, so δ = 2 dP P*; the axis moves by δ×t.
        let turn = (v * self.scalar - self.quaternion * w - v.cross(&self.quaternion)) * 2.0;
        let frame = crate::oracles::rotation::drifted((self.scalar, self.quaternion));
        turn.cross(&frame.column(0))
    }
}
