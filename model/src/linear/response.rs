//! What an unbalance makes of a steady state: a whirl with the spin, by the linear equations.

use super::machine::{Machine, Obstacle, Steady, across};
use super::modes::{Matrix, Mode, Shape};
use nalgebra::{Complex, ComplexField, Vector2, Vector3};

/// A whirl so many times what pushes it, both over their sizes, may have no bound \[1].
const LARGE: f64 = 1e6;

/// Nor has it where a mode's λ lies within this part of its size from iω \[1]: less is rounding.
const RESONANT: f64 = 1e-8;

/// How a machine whirls about its steady state by its unbalance: each number goes as Re(x e^(iφ)), φ being the angle that the rotor has
/// turned by.
#[derive(Clone, Debug)]
pub struct Response {
    /// Where it would stand without.
    pub steady: Steady,
    /// Of the mass centre \[m], and of γ \[rad].
    pub place: Vector3<Complex<f64>>,
    /// See `place`.
    pub gamma: Vector2<Complex<f64>>,
    /// From c to the mass centre, along t \[m].
    centre: f64,
}

/// The orbit of a station across the x axis: y = Re(Y e^(iφ)), z = Re(Z e^(iφ)).
#[derive(Clone, Copy, Debug)]
pub struct Orbit {
    /// Y \[m].
    pub y: Complex<f64>,
    /// Z \[m].
    pub z: Complex<f64>,
}

impl Orbit {
    /// Its larger half axis \[m].
    pub fn major(&self) -> f64 {
        let [forward, backward] = self.circles();
        forward + backward
    }

    /// Its smaller half axis \[m], negative where it is run against the spin.
    pub fn minor(&self) -> f64 {
        let [forward, backward] = self.circles();
        forward - backward
    }

    /// Radii of the two circles that it is the sum of, forward and backward.
    fn circles(&self) -> [f64; 2] {
        // y + iz = ½(Y + iZ) e^(iφ) + ½(Ȳ + iZ̄) e^(−iφ)
        let turned = Complex::<f64>::i() * self.z;
        [self.y + turned, self.y - turned].map(|twice: Complex<f64>| 0.5 * twice.modulus())
    }
}

impl Response {
    /// The orbit of the station at `position` from c along t \[m].
    pub fn orbit(&self, position: f64) -> Orbit {
        let arm = (self.steady.turning * (position - self.centre)).map(Complex::from);
        let moved = self.place + arm * self.gamma;
        Orbit { y: moved.y, z: moved.z }
    }
}

impl Machine {
    /// How its unbalance makes it whirl at `speed` [rad/s], about the steady state sought from `near`.
    ///
    /// # Errors
    /// Where there is no steady state, and where an undamped mode swings as fast as the rotor spins.
    pub fn response(&self, speed: f64, near: Option<&Steady>) -> Result<Response, Obstacle> {
        let steady = self.steady(speed, near)?;
        let pushed = self.pushed(&steady);
        // eq. 117: (iω − A) x = b
        let moved = steady.swung(&pushed, speed)?;
        let sizes = self.sizes(steady.rate).map(Complex::from);
        let moved = moved.ok_or(Obstacle::Resonant { speed })?.component_mul(&sizes);
        let (place, gamma) = (moved.fixed_rows::<3>(0).into_owned(), moved.fixed_rows::<2>(6).into_owned());
        Ok(Response { steady, place, gamma, centre: self.centre })
    }

    /// What the unbalance adds to the linear equations about a steady state, over its rate.
    fn pushed(&self, steady: &Steady) -> Shape {
        let attitude = steady.attitude.map(Complex::from);
        // (y, z) of the body is y + iz times e^(iφ) along its y axis at φ = 0, and that a quarter turn earlier along its z axis.
        let turning = |[y, z]: [f64; 2]| {
            let along = Complex::new(y, z);
            attitude * Vector3::new(Complex::from(0.0), along, -Complex::<f64>::i() * along)
        };
        let [first, couple] = self.unbalance.map(|across| turning(across.into()));
        let [axis, gravity] = [steady.axis, self.gravity].map(|vector| vector.map(Complex::from));
        let square = Complex::from(steady.speed * steady.speed);
        // eq. 117: F = ω² U, M = ω² t × W + U × g
        let moment = axis.cross(&couple) * square + first.cross(&gravity);
        let across = across(&steady.axis).map(Complex::from).transpose();
        let mut pushed = Shape::zeros();
        pushed.fixed_rows_mut::<3>(3).copy_from(&(first * (square / self.mass)));
        pushed.fixed_rows_mut::<2>(8).copy_from(&(across * moment));
        pushed.component_div(&(self.sizes(steady.rate) * steady.rate).map(Complex::from))
    }
}

impl Steady {
    /// The motion that goes as e^(iΩt) where it is pushed so, Ω being the `frequency` [rad/s], motion and push over their sizes; None where
    /// it has no bound.
    ///
    /// # Errors
    /// Where that depends on eigenvalues that are not found.
    pub(super) fn swung(&self, pushed: &Shape, frequency: f64) -> Result<Option<Shape>, Obstacle> {
        let size = pushed.norm();
        if size == 0.0 {
            return Ok(Some(Shape::zeros()));
        }
        let swing = Matrix::from_diagonal_element(Complex::new(0.0, frequency / self.rate));
        let moved = (swing - self.matrix.map(Complex::from)).lu().solve(pushed);
        let Some(moved) = moved else { return Ok(None) };
        Ok((moved.norm() <= LARGE * size || !self.swings_at(frequency)?).then_some(moved))
    }

    /// Whether a mode swings at this frequency [rad/s] without damping; at 0, whether nothing holds it in some direction.
    fn swings_at(&self, frequency: f64) -> Result<bool, Obstacle> {
        if frequency == 0.0 {
            return Ok(!self.is_held);
        }
        let whirl = Complex::new(0.0, frequency.abs());
        let swings = |mode: &Mode| {
            mode.eigenvalue.im > 0.0 && (mode.eigenvalue - whirl).modulus() <= RESONANT * mode.eigenvalue.modulus()
        };
        Ok(self.modes()?.iter().any(swings))
    }
}
