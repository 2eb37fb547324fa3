//! A whole run without FMI: the scene's parameters, a method that steps ahead, and what the communication point shows.

mod drive;
mod start;

use crate::effects::Effects;
use crate::energy::Ledger;
use crate::error::Invalid;
use crate::integrate::{Cost, Fault};
use crate::rotation::Angle;
use crate::rotor::{WITH_WORK, WITHOUT_WORK};
use crate::state::Kinematics;
use crate::variable::{Access, Place, Row};
use crate::variables::{self, Parameters, Reading};
use drive::Drive;
use start::Motion;

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

impl<E: Effects> From<Parameters<E>> for Simulation<E> {
    fn from(parameters: Parameters<E>) -> Self {
        Self { parameters, run: None, reading: None }
    }
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
    ///
    /// # Panics
    /// Where `t` is not finite.
    pub fn start(&mut self, t: f64, relative_tolerance: Option<f64>) -> Result<(), Invalid> {
        assert!(t.is_finite(), "a run starts at a finite time, not at {t:?}");
        let mut parameters = self.parameters.clone();
        let solver = &mut parameters.setup.solver;
        solver.relative_tolerance = relative_tolerance.unwrap_or(solver.relative_tolerance);
        parameters.check()?;
        self.reading = None;
        let (motion, reading) = at_start(&parameters)?;
        self.run = Some(if parameters.effects.works() {
            Run::Working(Drive::start(motion, &reading, &parameters.setup, t))
        } else {
            Run::Conservative(Drive::start(motion, &reading, &parameters.setup, t))
        });
        Ok(())
    }

    /// Moves the communication point to time `t` [s]. On a fault it stands at the last time reached.
    ///
    /// # Panics
    /// Before [`Simulation::start`], or where `t` lies before the communication point or is not a number.
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
            Run::Conservative(drive) => Some(drive.time()),
            Run::Working(drive) => Some(drive.time()),
        }
    }

    /// Whether |γ| ever exceeded π/2 under a law that has no limit at π: a warning is due.
    pub fn has_tilted(&self) -> bool {
        match &self.run {
            Some(Run::Conservative(drive)) => drive.has_tilted(),
            Some(Run::Working(drive)) => drive.has_tilted(),
            None => false,
        }
    }

    /// The value of a variable at the communication point, before the start as the parameters have it; None where there
    /// is none at this place. An error where the parameters are not possible.
    pub fn get(&mut self, place: Place) -> Result<Option<f64>, Invalid> {
        if let Some(value) = self.parameters.get(place) {
            return Ok(Some(value));
        }
        self.read()?;
        let reading = self.reading.as_ref().expect("just read");
        let Parameters { setup, effects } = &self.parameters;
        Ok(match variables::always(place) {
            None => effects.output(place, &reading.motion),
            Some(Row { access: Access::Output(read), .. }) => Some(read(setup, reading)),
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
                    at_start(&self.parameters)?.1
                }
            });
        }
        Ok(self.reading.as_ref().expect("just made"))
    }
}

/// The start as the parameters make it, and what it shows. An error where it overflows.
fn at_start<E: Effects>(parameters: &Parameters<E>) -> Result<(Motion<E>, Reading), Invalid> {
    let start = Motion::at_start(parameters);
    let Motion { rotor, coordinates, .. } = &start;
    let motion = Kinematics::new(rotor.body, rotor.chart, *coordinates);
    let phi = Angle { turns: 0.0, remainder: parameters.setup.start.phi }.wrapped();
    let mut ledger = Ledger::new(&motion, &rotor.effects, 0.0, 0.0, 0.0);
    ledger.total_at_start = ledger.total();
    if !ledger.total().is_finite() {
        let bound = "finite: the start values or parameters are too large";
        return Err(Invalid::new("energy.total", ledger.total(), bound));
    }
    Ok((start, Reading { motion, phi, ledger, cost: Cost::default() }))
}
