//! A machine whose spin is imposed, over one revolution.

use crate::effects::{All, Effects};
use crate::linear::{Machine, stop_drives};
use crate::log::shown;
use crate::rotation::{Chart, Tilt};
use crate::signal::Signal;
use crate::simulation::Any;
use crate::state::Kinematics;
use crate::variable::Place;
use crate::variables::{Parameters, Start, numbers};
use nalgebra::{SMatrix, SVector, Vector2, Vector3};
use std::f64::consts::TAU;
use std::fmt;

/// Numbers of a state where φ = 0: place and velocity of c, γ, and ω across e.
pub const NUMBERS: usize = 10;

/// Such a state, over sizes: √(Jt/m) for lengths, the speed for rates \[1].
pub type State = SVector<f64, NUMBERS>;

pub(super) type Slopes = SMatrix<f64, NUMBERS, NUMBERS>;

/// What imposes the spin.
const SPEED: &str = "imposed_speed.w";

/// Tolerance of a revolution, relative \[1], and in nominals \[1]: what only rounding moves would cost a thousand steps.
const TOLERANCE: [f64; 2] = [1e-10, 1e-13];

/// Differences are taken over this part of the motion's size, and of where it is \[1]: between its bend and what a revolution errs.
const APART: [f64; 2] = [1e-3, 1e-4];

/// And over this part of the speed \[1].
const SPEED_APART: f64 = 1e-6;

/// Number of looks per revolution, and the distance across e over √(Jt/m) at which the motion has left \[1]: a motion without a bound would
/// never be followed to the end.
const LOOKS: u32 = 16;
const LEFT: f64 = 100.0;

/// What grows by more than e to this power in a revolution is not followed: it would be far away by the first look \[1].
const MOST_GROWTH: f64 = 100.0;

/// Differences err by less than this \[1].
const DIFFERENCE: f64 = 1e-6;

/// A machine that turns at a speed which is imposed, its drives off.
#[derive(Clone)]
pub struct Rotating {
    run: Any,
    /// Where it would stand without its unbalance, were it symmetric.
    machine: Option<Machine>,
    /// √(Jt/m) \[m].
    pub(super) length: f64,
    speed: Place,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Obstacle {
    /// A parameter is not possible.
    Invalid(String),
    /// A revolution cannot be followed at this speed [rad/s].
    Fault {
        /// [rad/s].
        speed: f64,
        /// In words.
        reason: String,
    },
    /// No motion was found that repeats with each revolution at this speed [rad/s].
    NotFound {
        /// [rad/s].
        speed: f64,
    },
    /// At this speed [rad/s] small motions grow, so fast that no revolution can be followed.
    Grows {
        /// [rad/s].
        speed: f64,
        /// By a factor of e in the inverse of it [1/s].
        rate: f64,
    },
    /// At this speed [rad/s] a motion leaves within a revolution.
    Leaves {
        /// [rad/s].
        speed: f64,
    },
    /// At this speed [rad/s] a motion repeats with each revolution, and the search for what multiplies small motions beside it does not
    /// converge.
    NoMultipliers {
        /// [rad/s].
        speed: f64,
    },
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Invalid(reason) => write!(f, "{reason}"),
            Self::Fault { speed, reason } => write!(f, "at {speed} rad/s a revolution cannot be followed: {reason}"),
            Self::NotFound { speed } => write!(
                f,
                "at {speed} rad/s no motion was found that repeats with each revolution (what has no damping, or moves to and fro with \
                 another period, has none)"
            ),
            Self::Grows { speed, rate } => write!(
                f,
                "at {speed} rad/s small motions grow by a factor of e every {:?} s, too fast for a revolution to be followed",
                shown(1.0 / rate)
            ),
            Self::Leaves { speed } => {
                write!(
                    f,
                    "at {speed} rad/s the rotor leaves within a revolution, by more than {LEFT} radii of gyration"
                )
            }
            Self::NoMultipliers { speed } => write!(
                f,
                "at {speed} rad/s a motion repeats with each revolution, and whether it is stable is not known: the search for the eigenvalues \
                 of a revolution did not converge"
            ),
        }
    }
}

impl std::error::Error for Obstacle {}

impl Rotating {
    /// Of these parameters, which must be possible.
    ///
    /// # Errors
    /// Where they are not.
    pub fn of(parameters: &Parameters<All>) -> Result<Self, Obstacle> {
        parameters.check().map_err(|invalid| Obstacle::Invalid(invalid.to_string()))?;
        let mut parameters = parameters.clone();
        stop_drives(&mut parameters);
        let speed = Parameters::<All>::place(SPEED).expect("the list of all effects has it");
        parameters.effects.switch_on(speed.block);
        // The scene's run-up is off: at each speed the spin is steady.
        let imposes = parameters.effects.at_mut(speed).expect("its place is known");
        imposes.for_each_signal(&mut |signal| *signal = Signal::default());
        let setup = &mut parameters.setup;
        let solver = &mut setup.solver;
        (solver.method, solver.method_number) = (numbers::AUTO, 0);
        [solver.relative_tolerance, solver.absolute_tolerance] = TOLERANCE;
        setup.start = Start { r_c: setup.start.r_c, ..Start::default() };
        let body = parameters.shape().inertia();
        let machine = Machine::with_mean_inertia(&parameters).ok();
        Ok(Self { run: parameters.into(), machine, length: body.radius(), speed })
    }

    /// At rest but for its spin: where it would stand without its unbalance, else where the scene places it.
    pub(super) fn at_rest(&self, speed: f64) -> State {
        let mut state = State::zeros();
        let steady = self.machine.as_ref().and_then(|machine| Some((machine, machine.steady(speed, None).ok()?)));
        let place = steady.map_or(self.run.parameters().setup.start.r_c, |(machine, steady)| {
            state.fixed_rows_mut::<2>(6).copy_from(&steady.gamma);
            // ω = ω_φ t
            state.fixed_rows_mut::<2>(8).copy_from(&(steady.axis.yz() * speed.signum()));
            steady.r - steady.axis * machine.centre
        });
        state.fixed_rows_mut::<3>(0).copy_from(&(place / self.length));
        state
    }

    /// The motion at a start with φ = 0.
    fn motion(&self, speed: f64, state: &State) -> Start {
        let [place, velocity] = [0, 3].map(|first| state.fixed_rows::<3>(first).into_owned());
        let (gamma, across) = (Vector2::new(state[6], state[7]), Vector2::new(state[8], state[9]) * speed.abs());
        let axis = Tilt::new(Chart::FromE, gamma).axis;
        // eq. 6: ω·(e + t) = ω_φ (1 + e·t)
        let along = speed - across.dot(&axis.yz()) / (1.0 + axis.x);
        let omega = Vector3::new(along, across.x, across.y);
        Start {
            r_c: place * self.length,
            v_c: velocity * (self.length * speed.abs()),
            phi: 0.0,
            gamma,
            omega,
            at_rest: false,
        }
    }

    fn state(&self, speed: f64, motion: &Kinematics<f64>) -> State {
        let (r, v, gamma) =
            (motion.r_c() / self.length, motion.v_c() / (self.length * speed.abs()), motion.tilt.gamma());
        let across = motion.omega / speed.abs();
        State::from([r.x, r.y, r.z, v.x, v.y, v.z, gamma.x, gamma.y, across.y, across.z])
    }

    /// Follows a motion from φ = 0 over so many revolutions at `speed` [rad/s]; shows it at so many points of each, and ends where it
    /// then is.
    pub(super) fn follow(
        &self,
        speed: f64,
        from: &State,
        [revolutions, points]: [u32; 2],
        mut show: impl FnMut(&Kinematics<f64>),
    ) -> Result<State, Obstacle> {
        let fault = |reason: String| Obstacle::Fault { speed, reason };
        let mut run = self.run.clone();
        run.set_input(self.speed, speed);
        run.start_elsewhere(0.0, &self.motion(speed, from)).map_err(|invalid| fault(invalid.to_string()))?;
        let (period, mut end) = (TAU / speed.abs(), *from);
        let growth = run.growth().map(|growth| Obstacle::Grows { speed, rate: growth.rate });
        if let Some(Obstacle::Grows { rate, .. }) = growth
            && rate * period > MOST_GROWTH
        {
            return Err(Obstacle::Grows { speed, rate });
        }
        let between = LOOKS.div_ceil(points);
        let looks = points * between;
        for n in 1..=revolutions * looks {
            if let Err(stuck) = run.advance(period * f64::from(n) / f64::from(looks)) {
                return Err(growth.unwrap_or_else(|| fault(stuck.to_string())));
            }
            let motion = run.read().map_err(|invalid| fault(invalid.to_string()))?.motion;
            let state = self.state(speed, &motion);
            let way = (state - from).fixed_rows::<2>(1).norm();
            // What is no number has left too.
            if way > LEFT || way.is_nan() {
                return Err(growth.unwrap_or(Obstacle::Leaves { speed }));
            }
            if n % between == 0 {
                show(&motion);
                end = state;
            }
        }
        if end.iter().all(|number| number.is_finite()) { Ok(end) } else { Err(Obstacle::NotFound { speed }) }
    }

    /// Where a revolution leads to.
    pub(super) fn turn(&self, speed: f64, from: &State) -> Result<State, Obstacle> {
        self.follow(speed, from, [1, 1], |_| {})
    }

    /// How that changes with the state, whose motion has this size.
    pub(super) fn slopes(&self, speed: f64, at: &State, size: f64) -> Result<Slopes, Obstacle> {
        let column = |column: usize| -> Result<State, Obstacle> {
            // Along e it may be anywhere.
            let place = if column == 0 { at[0].abs() } else { at.fixed_rows::<9>(1).amax() };
            let apart = APART[0] * size + APART[1] * place;
            let beside = |by: f64| {
                let mut state = *at;
                state[column] += by;
                self.turn(speed, &state)
            };
            Ok((beside(apart)? - beside(-apart)?) / (2.0 * apart))
        };
        let (lower, upper) = std::thread::scope(|scope| {
            let upper = scope.spawn(|| (NUMBERS / 2..NUMBERS).map(column).collect::<Result<Vec<_>, _>>());
            let lower = (0..NUMBERS / 2).map(column).collect::<Result<Vec<_>, _>>();
            (lower, upper.join().expect("it does not panic"))
        });
        let mut slopes = Slopes::from_columns(&[lower?, upper?].concat());
        // Where nothing holds it along the axis, it does not matter where it is: what rounding leaves would be taken for a spring.
        let moved = State::ith(0, 1.0);
        if (slopes.column(0) - moved).amax() < DIFFERENCE {
            slopes.set_column(0, &moved);
        }
        Ok(slopes)
    }

    /// And how with the speed, per rad/s.
    pub(super) fn slope_by_speed(&self, speed: f64, at: &State) -> Result<State, Obstacle> {
        let apart = SPEED_APART * speed.abs();
        Ok((self.turn(speed + apart, at)? - self.turn(speed - apart, at)?) / (2.0 * apart))
    }
}
