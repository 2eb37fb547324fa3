//! Where a balanced machine runs steadily, and its linear equations about that.

use crate::body::{Asymmetric, ROTOR};
use crate::effects::{All, Effects};
use crate::rotation::Tilt;
use crate::rotor::Rotor;
use crate::simulation::numbers_of_state;
use crate::simulation::rest::{self, Balance, Rest, Spinning};
use crate::simulation::start::Motion;
use crate::variables::Parameters;
use nalgebra::{Matrix3, Matrix3x2, SMatrix, SVector, Vector2, Vector3};
use std::fmt;

/// Numbers of the linear state: place, its rate, tilt, and the part of K across the axis, divided by their sizes.
pub const STATES: usize = 10;

/// How many numbers the state of the nonlinear equations has.
pub(super) const N: usize = numbers_of_state::<All>();

/// What a drive is: it is off, for the spin is held.
pub(super) const DRIVES: [&str; 3] = ["drive", "motor", "imposed_speed"];

/// Its first three rows are the acceleration.
const GRAVITY: &str = "gravity";

/// The effect that makes the transverse moments of inertia differ.
const ASYMMETRY: &str = "asymmetry";

/// Principal moments that differ by less than this are one \[1].
const ROUNDING: f64 = 1e-12;

/// A machine with its drives off, and its unbalance put onto the axis.
#[derive(Clone)]
pub struct Machine {
    parameters: Parameters<All>,
    /// Moments of inertia about the axis and across it, about the mass centre [kg·m²].
    about_axis: f64,
    across: f64,
    /// √(Jt/m) \[m].
    length: f64,
    /// Mass \[kg], and where its centre lies from c along t \[m].
    pub(super) mass: f64,
    pub(crate) centre: f64,
    /// What was put onto the axis: [`Shape::unbalance`](crate::body::Shape::unbalance).
    pub(super) unbalance: [Vector2<f64>; 2],
    /// Acceleration of gravity [m/s²].
    pub(super) gravity: Vector3<f64>,
}

/// Where it stands while it spins steadily.
#[derive(Clone, Debug)]
pub struct Steady {
    /// ω_φ [rad/s].
    pub speed: f64,
    /// Place of the mass centre G \[m].
    pub r: Vector3<f64>,
    /// γ \[rad].
    pub gamma: Vector2<f64>,
    /// The axis t \[1].
    pub axis: Vector3<f64>,
    /// The axes of the body where φ = 0, as columns, t first \[1].
    pub attitude: Matrix3<f64>,
    /// ∂t/∂γ \[1].
    pub turning: Matrix3x2<f64>,
    /// The torque about the axis that holds the spin [N·m].
    pub torque: f64,
    /// Whether springs hold it in all directions.
    pub is_held: bool,
    /// Of the linear equations about it: a rate [1/s], for numbers of the size 1.
    pub rate: f64,
    /// The matrix of the linear equations over `rate` \[1].
    pub matrix: SMatrix<f64, STATES, STATES>,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Obstacle {
    /// The body is not symmetric about its axis: no linear equations with constant coefficients.
    Asymmetric,
    /// A parameter is not possible.
    Invalid(String),
    /// Nothing balances what acts on the rotor at this speed [rad/s], or Newton's method does not get there.
    NoSteadyState {
        /// [rad/s].
        speed: f64,
    },
    /// An undamped mode swings as fast as the rotor spins \[rad/s].
    Resonant {
        /// [rad/s].
        speed: f64,
    },
    /// The search for the eigenvalues of the linear equations at this speed [rad/s] does not converge.
    NoEigenvalues {
        /// [rad/s].
        speed: f64,
    },
    /// A law switches between the start and the steady state at this speed [rad/s].
    Switches {
        /// [rad/s].
        speed: f64,
    },
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Asymmetric => {
                write!(
                    f,
                    "the body is not symmetric about its axis (effects.asymmetry): its modes change as it turns, and only those of \
                     symmetric bodies are found"
                )
            }
            Self::Invalid(reason) => write!(f, "{reason}"),
            Self::NoSteadyState { speed } => {
                write!(
                    f,
                    "at {speed} rad/s nothing balances what acts on the rotor: no steady state was found (a support or bearings \
                     must hold it where a load acts)"
                )
            }
            Self::Resonant { speed } => {
                write!(f, "at {speed} rad/s a mode that nothing damps swings with the spin: the whirl has no bound")
            }
            Self::NoEigenvalues { speed } => {
                write!(
                    f,
                    "at {speed} rad/s the modes are not known: the search for the eigenvalues of the linear equations did not converge, \
                     or they hold numbers that are not finite; choose other speeds, and report the scene"
                )
            }
            Self::Switches { speed } => {
                write!(
                    f,
                    "at {speed} rad/s the steady state touches a ring (effects.rub), which has no linear law there"
                )
            }
        }
    }
}

impl std::error::Error for Obstacle {}

/// Switches off what drives the spin.
pub(crate) fn stop_drives(parameters: &mut Parameters<All>) {
    switch_off(&DRIVES, parameters);
}

fn switch_off(effects: &[&str], parameters: &mut Parameters<All>) {
    parameters.effects.for_each(|block| {
        if effects.contains(&block.kind().name) {
            block.switch_to(false);
        }
    });
}

/// The same with its drives off, and what is out of balance on the axis.
pub fn balanced(parameters: &Parameters<All>) -> Parameters<All> {
    let mut parameters = parameters.clone();
    stop_drives(&mut parameters);
    rest::put_on_axis(&mut parameters.effects);
    parameters
}

impl Machine {
    /// Of these parameters; why not.
    pub fn of(parameters: &Parameters<All>) -> Result<Self, Obstacle> {
        parameters.check().map_err(|invalid| Obstacle::Invalid(invalid.to_string()))?;
        let unbalance = parameters.shape().unbalance();
        let mut parameters = balanced(parameters);
        let mut gravity = Vector3::zeros();
        parameters.effects.for_each(|block| {
            if block.kind().name == GRAVITY && block.is_active() {
                gravity = Vector3::from_fn(|row, _| block.value(row, 0.0, None, None).expect("it is a parameter"));
            }
        });
        let start = &mut parameters.setup.start;
        (start.gamma, start.v_c, start.phi) = (Vector2::zeros(), Vector3::zeros(), 0.0);
        let shape = parameters.shape();
        let (body, centre) = (shape.inertia(), shape.centre().x);
        let lies_off = |asymmetric: &Asymmetric| {
            asymmetric.centre.yz() != Vector2::zeros() || asymmetric.excess.abs() > ROUNDING * body.per_jt
        };
        if body.asymmetric.as_ref().is_some_and(lies_off) {
            return Err(Obstacle::Asymmetric);
        }
        let [about_axis, across] = [body.spin + body.per_jt, body.per_jt].map(|per| 1.0 / per);
        let (mass, length) = (body.m, (across * body.per_m).sqrt());
        Ok(Self { parameters, about_axis, across, length, mass, centre, unbalance, gravity })
    }

    /// The same with the mean of both transverse moments of inertia, where the body is not symmetric: its modes are of the size of the body's.
    ///
    /// # Errors
    /// As [`of`](Self::of).
    pub fn with_mean_inertia(parameters: &Parameters<All>) -> Result<Self, Obstacle> {
        let mut parameters = parameters.clone();
        if let Some(second) = parameters.shape().Jt2 {
            parameters.setup.rotor.Jt = 0.5 * (parameters.setup.rotor.Jt + second);
            switch_off(&[ASYMMETRY], &mut parameters);
        }
        Self::of(&parameters)
    }

    /// Where it runs steadily at `speed` [rad/s], sought from `near`, and its linear equations there.
    ///
    /// # Errors
    /// Where nothing balances what acts, or a law switches on the way from the start.
    pub fn steady(&self, speed: f64, near: Option<&Steady>) -> Result<Steady, Obstacle> {
        let (parameters, start) = self.spinning(speed);
        let rotor = start.bodies.under(&parameters.effects);
        let r = near.map_or(All::layout::<N>().read(&start.state, ROTOR).r, |near| near.r);
        let gamma = near.map_or(Vector2::zeros(), |near| near.gamma);
        let spinning = self.spins(&rotor, speed);
        let rest: Rest<N> = spinning.rest(r, gamma).ok_or(Obstacle::NoSteadyState { speed })?;
        let Rest { r, gamma, is_held, balance } = rest;
        if rest::sides(&rotor, &spinning.state(r, gamma)) != rest::sides(&rotor, &start.state) {
            return Err(Obstacle::Switches { speed });
        }
        let (rate, matrix) = self.linear(&balance);
        let Balance { axis, turning, moment, .. } = balance;
        let attitude = Tilt::new(rotor.frame.chart, gamma).attitude(0.0);
        Ok(Steady { speed, r, gamma, axis, attitude, turning, torque: -moment, is_held, rate, matrix })
    }

    /// What it is and where it starts at this speed [rad/s]: tables take their stretch from it, and axial springs their length from the
    /// place at the start.
    pub(super) fn spinning(&self, speed: f64) -> (Parameters<All>, Motion<N>) {
        let mut parameters = self.parameters.clone();
        parameters.setup.start.omega = Vector3::x() * speed;
        let start = Motion::at_start(&mut parameters, 0.0);
        (parameters, start)
    }

    /// It, as it spins at this speed [rad/s].
    pub(super) fn spins<'r>(&self, rotor: &'r Rotor<'r, All>, speed: f64) -> Spinning<'r, All, N> {
        Spinning { rotor, own: [0.0; N], about_axis: self.about_axis, speed, t: 0.0 }
    }

    /// The matrix of the linear equations over the rate, and that.
    fn linear(&self, at: &Balance<N>) -> (f64, SMatrix<f64, STATES, STATES>) {
        let across = across(&at.axis);
        // What the linear numbers are of the coordinates: r, v, K and γ.
        let mut all = SMatrix::<f64, 11, STATES>::zeros();
        all.fixed_view_mut::<6, 6>(0, 0).fill_with_identity();
        all.fixed_view_mut::<2, 2>(9, 6).fill_with_identity();
        // eq. 116: δK·t = 0 where K·t is held
        all.fixed_view_mut::<3, 2>(6, 8).copy_from(&across);
        let first = All::layout::<N>().body(ROTOR).start;
        let slopes = SMatrix::<f64, 11, 11>::from_fn(|row, column| at.jacobian[first + row][first + column]);
        let rates = slopes * all;
        let mut matrix = SMatrix::<f64, STATES, STATES>::zeros();
        matrix.fixed_rows_mut::<6>(0).copy_from(&rates.fixed_rows::<6>(0));
        matrix.fixed_rows_mut::<2>(6).copy_from(&rates.fixed_rows::<2>(9));
        matrix.fixed_rows_mut::<2>(8).copy_from(&(across.transpose() * rates.fixed_rows::<3>(6)));
        // eq. 115: the torque that holds the spin turns with the axis
        let turned = across.transpose() * at.turning * at.moment;
        let mut by_tilt = matrix.fixed_view_mut::<2, 2>(8, 6);
        by_tilt -= turned;
        let inertia = self.across;
        // The fastest of what springs, dampers and spin make of mass and inertia.
        let springs =
            matrix.fixed_view::<3, 3>(3, 0).amax().max(matrix.fixed_view::<2, 2>(8, 6).amax() / inertia).sqrt();
        let rate = springs.max(matrix.fixed_view::<2, 2>(6, 6).amax());
        let rate = if rate > 0.0 { rate } else { 1.0 };
        let sizes = self.sizes(rate);
        (rate, SMatrix::from_fn(|row, column| matrix[(row, column)] * sizes[column] / (sizes[row] * rate)))
    }

    /// What the linear numbers are divided by.
    pub(super) fn sizes(&self, rate: f64) -> SVector<f64, STATES> {
        let [place, momentum] = [self.length, self.across * rate];
        let v = place * rate;
        SVector::from([place, place, place, v, v, v, 1.0, 1.0, momentum, momentum])
    }
}

/// Two directions that are with the axis t a right-handed system: y and z, where that is e.
pub(super) fn across(axis: &Vector3<f64>) -> Matrix3x2<f64> {
    let beside = if axis.z.abs() < 0.9 { Vector3::z() } else { -Vector3::x() };
    let first = beside.cross(axis).normalize();
    Matrix3x2::from_columns(&[first, axis.cross(&first)])
}
