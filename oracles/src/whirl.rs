//! A rigid rotor with gyroscopic moments in linear bearings, in the textbook form m q̈ + (C + ω G) q̇ + K q = 0 with place and tilt of the axis
//! across it, and all eigenvalues of that by a method that knows no matrix iteration.
//!
//! Sources: the equations, e.g. Genta, Dynamics of Rotating Systems (2005), chapter 2; the eigenvalues by Ehrlich's and Aberth's simultaneous
//! iteration for polynomial eigenproblems, Bini and Noferini (2013).

use nalgebra::{Complex, ComplexField, Matrix4};

/// A bearing at `position` from the mass centre \[m]: F = −K q − C q̇ across the axis [N/m, N·s/m].
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "see the struct")]
pub struct Bearing {
    pub position: f64,
    pub k: [[f64; 2]; 2],
    pub c: [[f64; 2]; 2],
}

/// The machine. Units: kg, kg·m², rad/s.
#[derive(Clone, Debug)]
#[allow(missing_docs, non_snake_case, reason = "the names of the variables")]
pub struct Whirl {
    pub m: f64,
    pub Ja: f64,
    pub Jt: f64,
    pub speed: f64,
    pub bearings: Vec<Bearing>,
}

/// Roots of the characteristic equation: two for each of four coordinates.
const ROOTS: usize = 8;

/// Rounds of the iteration at most.
const ROUNDS: usize = 500;

/// What is left of the equations then, over their size \[1].
const SETTLED: f64 = 1e-10;

impl Whirl {
    /// √(Jt/m) \[m].
    fn radius(&self) -> f64 {
        (self.Jt / self.m).sqrt()
    }

    /// C + ω G and K of (y, z, t_y ρ, t_z ρ), over m, ρ being √(Jt/m) \[1/s, 1/s²].
    fn matrices(&self) -> [Matrix4<f64>; 2] {
        let [mut c, mut k] = [Matrix4::zeros(); 2];
        for bearing in &self.bearings {
            let lever = [1.0, bearing.position / self.radius()];
            for (row, column) in (0..4).flat_map(|row| (0..4).map(move |column| (row, column))) {
                let arms = lever[row / 2] * lever[column / 2] / self.m;
                c[(row, column)] += arms * bearing.c[row % 2][column % 2];
                k[(row, column)] += arms * bearing.k[row % 2][column % 2];
            }
        }
        // K = Ja ω t + Jt t×ṫ: Jt ẗ_y + Ja ω ṫ_z = M_z, Jt ẗ_z − Ja ω ṫ_y = −M_y
        let gyroscopic = self.Ja / self.Jt * self.speed;
        c[(2, 3)] += gyroscopic;
        c[(3, 2)] -= gyroscopic;
        [c, k]
    }

    /// The equations at λ [rad/s], over m.
    fn at(&self, value: Complex<f64>) -> Matrix4<Complex<f64>> {
        let [c, k] = self.matrices().map(|matrix| matrix.map(Complex::from));
        Matrix4::identity() * (value * value) + c * value + k
    }

    /// All eight eigenvalues [rad/s], by Ehrlich's and Aberth's iteration on the determinant.
    ///
    /// # Panics
    /// Where the iteration does not settle.
    pub fn eigenvalues(&self) -> Vec<Complex<f64>> {
        let [c, k] = self.matrices();
        let c_complex = c.map(Complex::from);
        let rate = k.amax().sqrt().max(c.amax());
        // Spread over three decades and round the circle, at no symmetric places.
        let start = |n: usize| {
            let size = rate * libm::pow(10.0, 0.5 - 3.0 * n as f64 / ROOTS as f64);
            let angle = 0.4 + 2.4 * n as f64;
            Complex::new(libm::cos(angle), libm::sin(angle)) * size
        };
        let mut roots: Vec<_> = (0..ROOTS).map(start).collect();
        let mut still = 0;
        for _ in 0..ROUNDS {
            let mut largest: f64 = 0.0;
            for n in 0..ROOTS {
                let value = roots[n];
                let slope = Matrix4::identity() * (value * 2.0) + c_complex;
                // d/dλ ln det P = tr(P⁻¹ P')
                let Some(solved) = self.at(value).lu().solve(&slope) else { continue };
                let own = solved.trace();
                let others: Complex<f64> =
                    (0..ROOTS).filter(|other| *other != n).map(|other| (value - roots[other]).recip()).sum();
                let step = (own - others).recip();
                if step.re.is_finite() && step.im.is_finite() {
                    roots[n] -= step;
                    largest = largest.max(step.modulus() / (value.modulus() + 1e-9 * rate));
                }
            }
            still = if largest < 1e-10 { still + 1 } else { 0 };
            if still == 3 {
                return roots;
            }
        }
        // Equal roots, as those of directions in which nothing holds it, are met only to the root of rounding.
        let residual = roots.iter().map(|value| self.residual(*value)).fold(0.0, f64::max);
        assert!(residual < SETTLED, "the iteration does not settle, {residual}: {roots:?} of {self:?}");
        roots
    }

    /// How nearly the equations are singular at λ [rad/s]: the smallest singular value over the largest \[1].
    pub fn residual(&self, value: Complex<f64>) -> f64 {
        let sizes = self.at(value).svd(false, false).singular_values;
        sizes[3] / sizes[0]
    }
}
