//! The linear equations of a step of Radau IIA: one real and one complex system of N instead of one of 3N.

use super::lu::Lu;
use super::radau::{GAMMA, PAIR, STAGES, T, T_INVERSE, combined};
use nalgebra::Complex;

/// Both systems of a step of one size.
pub struct Collocation<'a, const N: usize> {
    jacobian: &'a [[f64; N]; N],
    /// On so many components the system depends.
    size: usize,
    /// Size of the step \[s].
    pub h: f64,
    real: Lu<f64, N>,
    complex: Lu<Complex<f64>, N>,
}

impl<'a, const N: usize> Collocation<'a, N> {
    /// For a step of size `h` \[s] of a system that depends on the first `size` components.
    pub fn new(jacobian: &'a [[f64; N]; N], h: f64, size: usize) -> Self {
        let (gamma, pair) = (GAMMA / h, PAIR / h);
        let real = std::array::from_fn(|i| {
            std::array::from_fn(|j| if i == j { gamma - jacobian[i][j] } else { -jacobian[i][j] })
        });
        let complex = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let derivative = Complex::from(jacobian[i][j]);
                if i == j { pair - derivative } else { -derivative }
            })
        });
        Self { jacobian, size, h, real: Lu::new(real, size), complex: Lu::new(complex, size) }
    }

    /// w = (T⁻¹ ⊗ I) z.
    pub fn transformed(&self, z: &[[f64; N]; STAGES]) -> [[f64; N]; STAGES] {
        T_INVERSE.map(|row| combined(&row, z))
    }

    /// The change of w that Newton's method makes where the stages have these rates.
    pub fn newton(&self, rates: &[[f64; N]; STAGES], w: &[[f64; N]; STAGES]) -> [[f64; N]; STAGES] {
        // eq. 43: (Λ/h − J) Δw = (T⁻¹ ⊗ I) f − Λw/h, Λ = T⁻¹ A⁻¹ T
        let f = self.transformed(rates);
        let (gamma, pair) = (GAMMA / self.h, PAIR / self.h);
        let real = self.real.solve(&std::array::from_fn(|n| f[0][n] - gamma * w[0][n]));
        let complex = self
            .complex
            .solve(&std::array::from_fn(|n| Complex::new(f[1][n], f[2][n]) - pair * Complex::new(w[1][n], w[2][n])));
        [real, complex.map(|x| x.re), complex.map(|x| x.im)]
    }

    /// x where (γ/h I − J) x is b.
    pub fn filtered(&self, b: &[f64; N]) -> [f64; N] {
        self.real.solve(b)
    }

    /// hJ (γ I − hJ)⁻¹ x: little of what is slow, and −x of what is stiff.
    pub fn unresolved(&self, x: &[f64; N]) -> [f64; N] {
        let filtered = self.filtered(x);
        std::array::from_fn(|n| GAMMA / self.h * filtered[n] - x[n])
    }

    /// R(hJ) x: what a difference x between two states becomes in the step.
    pub fn advanced(&self, x: &[f64; N]) -> [f64; N] {
        let rate = self.jacobian.map(|row| row[..self.size].iter().zip(x).map(|(slope, x)| slope * x).sum());
        let gained = self.newton(&[rate; STAGES], &[[0.0; N]; STAGES]);
        let gained = combined(&T[STAGES - 1], &gained);
        std::array::from_fn(|n| x[n] + gained[n])
    }
}
