//! A whole run without FMI: the scene's parameters, a method that steps ahead, and what the communication point shows.

use crate::effects::Effects;
use crate::energy::{self, Ledger};
use crate::error::Invalid;
use crate::integrate::explicit::Explicit;
use crate::integrate::tableau::{DOP853, DOPRI5, Tableau};
use crate::integrate::{Cost, Fault, Tolerance};
use crate::rotation::Angle;
use crate::rotor::{DISSIPATED, Rotor, SUPPLIED, WITH_WORK, WITHOUT_WORK};
use crate::state::{Coordinates, Kinematics, PHI};
use crate::variable::{Access, Place, Row};
use crate::variables::{self, Parameters, Reading, Setup};

/// A rotor of the scene `E`, from its parameters to its motion.
#[derive(Clone, Default)]
pub struct Simulation<E> {
    parameters: Parameters<E>,
    run: Option<Run<E>>,
    /// What the communication point shows, once somebody asked.
    reading: Option<Reading>,
}

/// A motion under way; without the work integrals where nothing can do work.
#[derive(Clone)]
#[allow(clippy::large_enum_variant, reason = "a run is kept in place, so that it needs no allocation")]
enum Run<E> {
    Conservative(Drive<E, WITHOUT_WORK>),
    Working(Drive<E, WITH_WORK>),
}

/// A method that drives a rotor, and how far its answers are wanted.
#[derive(Clone)]
struct Drive<E, const N: usize> {
    rotor: Rotor<E>,
    method: Explicit<N>,
    /// Whole turns of φ at the start of the method's last step, and at its end.
    turns: [f64; 2],
    /// The communication point [s].
    t: f64,
    /// Total energy at the start [J].
    total_at_start: f64,
}

impl<E: Effects> Simulation<E> {
    /// A simulation with each parameter as the list gives it; `starts` are places and values.
    pub fn new(starts: impl IntoIterator<Item = (Place, f64)>) -> Self {
        let mut simulation = Self::default();
        for (place, value) in starts {
            simulation.set_parameter(place, value);
        }
        simulation
    }

    /// The parameters.
    pub fn parameters(&self) -> &Parameters<E> {
        &self.parameters
    }

    /// Sets a parameter; false where there is none at this place. It acts at the next [`Simulation::start`].
    pub fn set_parameter(&mut self, place: Place, value: f64) -> bool {
        self.reading = None;
        self.parameters.set(place, value)
    }

    /// Starts the motion at time `t` [s]; a relative tolerance [1] given here stands in for that of the parameters.
    pub fn start(&mut self, t: f64, relative_tolerance: Option<f64>) -> Result<(), Invalid> {
        self.parameters.check()?;
        self.reading = None;
        let Parameters { mut setup, effects } = self.parameters.clone();
        setup.solver.relative_tolerance = relative_tolerance.unwrap_or(setup.solver.relative_tolerance);
        let works = effects.works();
        let rotor = Rotor { body: setup.rotor, effects, chart: Default::default() };
        self.run = Some(if works {
            Run::Working(Drive::start(rotor, &setup, t))
        } else {
            Run::Conservative(Drive::start(rotor, &setup, t))
        });
        Ok(())
    }

    /// Moves the communication point to time `t` [s]. On a fault it stands at the last time reached.
    ///
    /// # Panics
    /// Before [`Simulation::start`].
    pub fn advance(&mut self, t: f64) -> Result<(), Fault> {
        self.reading = None;
        match self.run.as_mut().expect("a run was started") {
            Run::Conservative(drive) => drive.advance(t),
            Run::Working(drive) => drive.advance(t),
        }
    }

    /// The communication point [s]; None before the start.
    pub fn time(&self) -> Option<f64> {
        match self.run.as_ref()? {
            Run::Conservative(drive) => Some(drive.t),
            Run::Working(drive) => Some(drive.t),
        }
    }

    /// The value of a variable at the communication point, before the start as the parameters have it; None where there
    /// is none at this place. An error where the parameters are not possible.
    pub fn get(&mut self, place: Place) -> Result<Option<f64>, Invalid> {
        if let Some(value) = self.parameters.get(place) {
            return Ok(Some(value));
        }
        let reading = *self.read()?;
        let Parameters { setup, effects } = &self.parameters;
        Ok(match variables::always(place) {
            None => effects.output(place, &reading.motion),
            Some(Row { access: Access::Output(read), .. }) => Some(read(setup, &reading)),
            Some(_) => None,
        })
    }

    /// What the communication point shows; before the start, what the parameters make of it.
    pub fn read(&mut self) -> Result<&Reading, Invalid> {
        if self.reading.is_none() {
            self.reading = Some(match &mut self.run {
                Some(Run::Conservative(drive)) => drive.read(),
                Some(Run::Working(drive)) => drive.read(),
                None => {
                    self.parameters.check()?;
                    let (motion, turns) = at_start(&self.parameters.setup);
                    reading(motion, turns, &self.parameters.effects, [0.0, 0.0], None, Cost::default())
                }
            });
        }
        Ok(self.reading.as_ref().expect("just made"))
    }
}

impl<E: Effects, const N: usize> Drive<E, N> {
    fn start(rotor: Rotor<E>, setup: &Setup, t: f64) -> Self {
        let (motion, turns) = at_start(setup);
        let mut y = [0.0; N];
        motion.at.write(&mut y);
        let total_at_start = energy::kinetic(&motion) + rotor.effects.potential(&motion);
        let method = Explicit::start(tableau(setup.solver.method), tolerance(setup), &rotor, t, y);
        Self { rotor, method, turns: [turns; 2], t, total_at_start }
    }

    fn advance(&mut self, t: f64) -> Result<(), Fault> {
        while self.method.time() < t {
            if let Err(fault) = self.method.step(&self.rotor) {
                self.t = self.method.time();
                return Err(fault);
            }
            self.turns[0] = self.turns[1];
            let phi = Angle { turns: self.turns[1], remainder: self.method.state()[PHI] }.wrapped();
            self.turns[1] = phi.turns;
            self.method.replace(PHI, phi.remainder);
        }
        self.t = t;
        Ok(())
    }

    fn read(&mut self) -> Reading {
        let (y, turns) = if self.t == self.method.time() {
            (*self.method.state(), self.turns[1])
        } else {
            (self.method.dense(&self.rotor, self.t), self.turns[0])
        };
        let motion = Kinematics::new(self.rotor.body, Coordinates::from_slice(&y));
        let work = if N == WITH_WORK { [y[SUPPLIED], y[DISSIPATED]] } else { [0.0, 0.0] };
        reading(motion, turns, &self.rotor.effects, work, Some(self.total_at_start), self.method.cost())
    }
}

/// What an instant shows; `work` supplied and lost [J], `total_at_start` [J] where it is not this instant's own.
fn reading<E: Effects>(
    motion: Kinematics<f64>,
    turns: f64,
    effects: &E,
    [supplied, dissipated]: [f64; 2],
    total_at_start: Option<f64>,
    cost: Cost,
) -> Reading {
    let phi = Angle { turns, remainder: motion.at.phi }.wrapped();
    let mut ledger = Ledger::new(&motion, effects, supplied, dissipated, 0.0);
    ledger.total_at_start = total_at_start.unwrap_or(ledger.total());
    Reading { motion, phi, ledger, cost }
}

/// The motion at the start, its φ in [0, 2π), and the whole turns that go with it.
fn at_start(setup: &Setup) -> (Kinematics<f64>, f64) {
    let (body, start) = (setup.rotor, &setup.start);
    let phi = Angle { turns: 0.0, remainder: start.phi }.wrapped();
    let axis = crate::rotation::Tilt::new(start.gamma).axis;
    let coordinates = Coordinates {
        r_c: start.r_c,
        v_c: start.v_c,
        k_c: body.angular_momentum(&start.omega, &axis),
        gamma: start.gamma,
        phi: phi.remainder,
    };
    (Kinematics::new(body, coordinates), phi.turns)
}

/// The method of this number; checked before.
fn tableau(number: i32) -> &'static Tableau {
    if number == 2 { &DOPRI5 } else { &DOP853 }
}

/// The tolerance of each component: relative to the larger of its size and its nominal (INTERFACE.md).
fn tolerance<const N: usize>(setup: &Setup) -> Tolerance<N> {
    let solver = &setup.solver;
    let nominal_tolerance =
        if solver.absolute_tolerance > 0.0 { solver.absolute_tolerance } else { solver.relative_tolerance };
    let (rotor, mut nominal) = (&setup.rotor, [1.0; N]);
    let length = if rotor.l == 0.0 { 1.0 } else { rotor.l.abs() };
    nominal[0..3].fill(length);
    nominal[6..9].fill(rotor.Ja.max(rotor.Jt));
    let mut tolerance = Tolerance {
        absolute: nominal.map(|nominal| nominal_tolerance * nominal),
        relative: [solver.relative_tolerance; N],
    };
    // φ counts with 1 rad, not with its size, which the whole turns would make arbitrary.
    tolerance.absolute[PHI] += solver.relative_tolerance;
    tolerance.relative[PHI] = 0.0;
    tolerance
}
