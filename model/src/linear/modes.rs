//! How a machine whirls about its steady state: eigenvalues, and shapes that tell what they are.

use super::machine::{Machine, Obstacle, STATES, Steady, across};
use crate::decompositions::{eigenvalues, singular_values};
use nalgebra::linalg::SymmetricEigen;
use nalgebra::{Complex, ComplexField, DMatrix, SMatrix, SVector, Vector2};

/// The state of a mode, its numbers over their sizes, of norm 1.
pub type Shape = SVector<Complex<f64>, STATES>;

pub(super) type Matrix = SMatrix<Complex<f64>, STATES, STATES>;

/// A mode: all numbers of the motion go as Re(shape e^(λt)).
#[derive(Clone, Debug)]
pub struct Mode {
    /// λ [rad/s]; of a pair, that above the real axis.
    pub eigenvalue: Complex<f64>,
    /// How it moves.
    pub shape: Shape,
    /// Which way it whirls.
    pub direction: Direction,
    /// The area that its orbits sweep over that of circles, forward if positive \[1]: ±1 of circles, 0 of lines, and of what does not swing
    /// across the axis.
    pub sense: f64,
    /// What rounding leaves of λ, at most [1/s].
    pub(super) rounding: f64,
}

/// Which way a mode whirls, by what its own orbits do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// As the rotor spins; where it does not, about e.
    Forward,
    /// Against it.
    Backward,
    /// In a plane, or forward as much as backward.
    Plane,
    /// Along the axis.
    Axial,
    /// It does not swing.
    Creep,
}

impl Direction {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Forward => "forward",
            Self::Backward => "backward",
            Self::Plane => "plane",
            Self::Axial => "axial",
            Self::Creep => "creep",
        }
    }
}

/// Orbits whose area is less than this part of a circle's count as a line \[1].
const LINE: f64 = 1e-6;

/// A mode moves along the axis where more than this part of its square does \[1].
const ALONG: f64 = 0.5;

/// Where nothing holds the rotor in some direction, an eigenvalue below this part of the largest is that \[1]: of a pair at 0, rounding
/// shows the root.
const UNHELD: f64 = 1e-7;

/// Eigenvalues that differ by less than this part of their size are one \[1]: of springs that are the same in all directions.
const EQUAL: f64 = 1e-9;

/// The eigenvectors of so few numbers take a few iterations each.
const ITERATIONS: usize = 1000;

/// A shape is sought beside its eigenvalue, by the first of these parts of its size at which the equations have a solution \[1].
const BESIDE: [f64; 4] = [1e-11, -3e-11, 1e-10, -3e-10];

/// A mode swings where its λ is further than this part of its size from the real axis \[1].
const SWINGS: f64 = 1e-7;

/// A mode grows where Re λ is more than this part of its size: less is rounding \[1].
const GROWS: f64 = 1e-9;

/// The same of the size of the fastest mode \[1]: an eigenvalue near 0 has the rounding of the largest.
const OF_FASTEST: f64 = 1e-10;

impl Mode {
    /// Its frequency [rad/s], negative where it whirls backward.
    pub fn frequency(&self) -> f64 {
        if self.direction == Direction::Backward { -self.eigenvalue.im } else { self.eigenvalue.im }
    }

    /// −Re λ/|λ| \[1].
    pub fn damping_ratio(&self) -> f64 {
        -self.eigenvalue.re / self.eigenvalue.modulus()
    }

    /// Whether it grows.
    pub fn grows(&self) -> bool {
        self.eigenvalue.re > self.rounding
    }

    /// How like another one it is, from 0 to 1.
    pub(super) fn likeness(&self, other: &Self) -> f64 {
        self.shape.dotc(&other.shape).modulus_squared()
    }
}

impl Steady {
    /// The modes about it, by frequency.
    ///
    /// # Errors
    /// Where the search for the eigenvalues does not converge in any of its ways.
    pub fn modes(&self) -> Result<Vec<Mode>, Obstacle> {
        let lost = Obstacle::NoEigenvalues { speed: self.speed };
        if !self.matrix.iter().all(|entry| entry.is_finite()) {
            return Err(lost);
        }
        let mut matrix = self.matrix;
        nalgebra::linalg::balancing::balance_parlett_reinsch(&mut matrix);
        let largest = self.matrix.amax();
        let held = |value: &Complex<f64>| {
            let size = value.modulus();
            (self.is_held || size > UNHELD * largest) && value.im >= -SWINGS * size
        };
        let all = eigenvalues(&matrix).ok_or(lost.clone())?;
        let fastest = all.iter().map(|value| value.modulus()).fold(0.0, f64::max);
        let mut values: Vec<_> = all.iter().copied().filter(held).collect();
        values.sort_by(|a, b| a.im.total_cmp(&b.im));
        let mut modes = Vec::new();
        while let Some(value) = values.first().copied() {
            let (equal, other): (Vec<_>, Vec<_>) =
                values.into_iter().partition(|other| (other - value).modulus() <= EQUAL * value.modulus());
            values = other;
            match self.apart(value, equal.len()) {
                Some(shapes) => modes.extend(shapes.into_iter().map(|shape| self.mode(value, shape, fastest))),
                None => {
                    for value in equal {
                        modes.push(self.refined(value, fastest).ok_or(lost.clone())?);
                    }
                }
            }
        }
        Ok(modes)
    }

    /// The mode of a value that no other one equals; None where its shape is not found.
    fn refined(&self, value: Complex<f64>, fastest: f64) -> Option<Mode> {
        let matrix = self.matrix.map(Complex::from);
        let right = inverse_iterated(&matrix, value)?;
        let left = inverse_iterated(&matrix.transpose(), value)?;
        let both = left.dot(&right);
        // Rayleigh's quotient of both sides errs by the square of what they err; of values that nearly agree it says nothing.
        let refined = (left.dot(&(matrix * right))) / both;
        let is_near = both.modulus() > 1e-4 && (refined - value).modulus() < 1e-6 * (1.0 + value.modulus());
        Some(self.mode(if is_near { refined } else { value }, right, fastest))
    }

    /// The shapes of a value that so many modes have, parted by the way they whirl; None of a single one, and where there are fewer.
    fn apart(&self, value: Complex<f64>, count: usize) -> Option<Vec<Shape>> {
        if count == 1 {
            return None;
        }
        let all = singular_values(&(self.matrix.map(Complex::from) - Matrix::from_diagonal_element(value)))?;
        let (rows, sizes) = (all.v_t?, all.singular_values);
        if sizes[STATES - count] > EQUAL * sizes[0] {
            return None;
        }
        let basis: Vec<Shape> = (STATES - count..STATES).map(|row| rows.row(row).adjoint()).collect();
        let orbits: Vec<_> = basis.iter().map(|shape| self.orbits(shape)).collect();
        let swept = DMatrix::from_fn(count, count, |i, j| swept(&orbits[i], &orbits[j]));
        let mixed = SymmetricEigen::try_new(swept, f64::EPSILON, ITERATIONS)?.eigenvectors;
        let shape = |column: usize| (0..count).map(|row| basis[row] * mixed[(row, column)]).sum();
        Some((0..count).map(shape).collect())
    }

    fn mode(&self, value: Complex<f64>, shape: Shape, fastest: f64) -> Mode {
        let swings = value.im > SWINGS * value.modulus();
        let value = if swings { value } else { Complex::from(value.re) };
        let (direction, sense) = self.direction(&shape, swings);
        let rounding = self.rate * f64::max(GROWS * value.modulus(), OF_FASTEST * fastest);
        Mode { eigenvalue: value * self.rate, shape, direction, sense, rounding }
    }

    /// How place and tilt move across the axis.
    fn orbits(&self, shape: &Shape) -> [Vector2<Complex<f64>>; 2] {
        let across = across(&self.axis).map(Complex::from);
        let tilt = self.turning.map(Complex::from) * Vector2::new(shape[6], shape[7]);
        [shape.fixed_rows::<3>(0).into_owned(), tilt].map(|moved| across.transpose() * moved)
    }

    /// Which way it whirls, and [`Mode::sense`].
    fn direction(&self, shape: &Shape, swings: bool) -> (Direction, f64) {
        if !swings {
            return (Direction::Creep, 0.0);
        }
        let orbits = self.orbits(shape);
        let wide: f64 = orbits.iter().map(Vector2::norm_squared).sum();
        let along = self.axis.map(Complex::from).dot(&shape.fixed_rows::<3>(0)).modulus_squared();
        if along > ALONG * (along + wide) {
            return (Direction::Axial, 0.0);
        }
        let spin = if self.speed < 0.0 { -1.0 } else { 1.0 };
        let sense = spin * swept(&orbits, &orbits).re / wide;
        let direction = match sense {
            sense if sense > LINE => Direction::Forward,
            sense if sense < -LINE => Direction::Backward,
            _ => Direction::Plane,
        };
        (direction, sense)
    }
}

/// The area that orbits sweep in a turn, over π/2 and by the motion's square: 1 of a circle, forward; of two motions its Hermitian form.
fn swept(a: &[Vector2<Complex<f64>>; 2], b: &[Vector2<Complex<f64>>; 2]) -> Complex<f64> {
    let area = |(a, b): (&Vector2<Complex<f64>>, &Vector2<Complex<f64>>)| a.x.conj() * b.y - a.y.conj() * b.x;
    Complex::<f64>::i() * a.iter().zip(b).map(area).sum::<Complex<f64>>()
}

/// The vector that the matrix multiplies by nearly this value; None where it is not found.
fn inverse_iterated(matrix: &Matrix, value: Complex<f64>) -> Option<Shape> {
    // A little beside it, or the equations have no solution.
    BESIDE.into_iter().find_map(|beside| {
        let beside = value + Complex::new(beside, beside) * (value.modulus() + 1e-3);
        let equations = (matrix - Matrix::from_diagonal_element(beside)).lu();
        let mut vector = Shape::from_fn(|n, _| Complex::new(1.0, 0.1 * n as f64));
        for _ in 0..3 {
            vector = equations.solve(&vector)?;
            vector.unscale_mut(vector.norm());
        }
        vector.iter().all(|part| part.is_finite()).then_some(vector)
    })
}

impl Machine {
    /// Its modes at `speed` [rad/s] about the steady state sought from `near`, and that.
    ///
    /// # Errors
    /// Where there is no steady state, and where its eigenvalues are not found.
    pub fn modes(&self, speed: f64, near: Option<&Steady>) -> Result<(Steady, Vec<Mode>), Obstacle> {
        let steady = self.steady(speed, near)?;
        let modes = steady.modes()?;
        Ok((steady, modes))
    }
}
