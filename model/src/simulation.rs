//! A whole run without FMI: the scene's parameters and inputs, a method that steps ahead or a host that integrates, and
//! what the communication point shows.

mod auto;
mod exchange;
mod growth;
mod integration;
mod method;
mod nominals;
mod plan;
mod start;
mod tangents;

pub use exchange::{Exchange, Settled};
pub use tangents::Tangents;

use crate::effects::{Effects, follows_all_inputs};
use crate::energy::Ledger;
use crate::error::Invalid;
use crate::integrate::sizes::LEAST;
use crate::integrate::{Cost, Fault, Refusal};
use crate::rotor;
use crate::signal::Signal;
use crate::state::{COORDINATES, WITH_WORK, Whole};
use crate::stored::{Damaged, Stored, Walk, choice};
use crate::variable::Place;
use crate::variables::{Parameters, Reading, numbers};
use integration::Integration;
use nominals::Nominals;
use start::{BESIDE, Motion};

/// Who integrates a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// A method of ours: co-simulation.
    #[default]
    Method,
    /// Somebody else, who asks for rates: model exchange.
    Host,
}

/// A rotor of the scene `E`, from its parameters to its motion.
#[derive(Clone, Default)]
pub struct Simulation<E> {
    integrator: Integrator,
    parameters: Parameters<E>,
    run: Option<Run<E>>,
    /// Whether an input was set of which the run has not heard.
    news: bool,
    /// What the communication point shows, once somebody asked.
    reading: Option<Reading>,
}

/// A motion under way; without the work integrals where nothing can do work.
#[derive(Clone)]
#[allow(clippy::large_enum_variant, reason = "a run is kept in place, so that it needs no allocation")]
enum Run<E> {
    Conservative(Integration<E, COORDINATES>),
    Working(Integration<E, WITH_WORK>),
    Exchange(Exchange<E>),
}

impl<E: Effects> From<Parameters<E>> for Simulation<E> {
    fn from(parameters: Parameters<E>) -> Self {
        Self::with(Integrator::Method, parameters)
    }
}

impl<E: Effects> Simulation<E> {
    /// How many continuous states a host integrates: the coordinates, and the work integrals where an effect could work.
    pub const STATES: usize = if E::COULD_WORK { WITH_WORK } else { COORDINATES };

    /// A simulation with these parameters.
    pub fn with(integrator: Integrator, parameters: Parameters<E>) -> Self {
        Self { integrator, parameters, ..Self::default() }
    }

    /// Who integrates.
    pub fn integrator(&self) -> Integrator {
        self.integrator
    }

    /// The parameters and inputs.
    pub fn parameters(&self) -> &Parameters<E> {
        &self.parameters
    }

    /// Sets a parameter; false where there is none at this place. It acts at the next [`Simulation::start`].
    pub fn set_parameter(&mut self, place: Place, value: f64) -> bool {
        self.reading = None;
        self.parameters.set(place, value)
    }

    /// Sets an input from the communication point on; false where there is none at this place.
    pub fn set_input(&mut self, place: Place, value: f64) -> bool {
        self.change_input(place, 0, |signal, t| signal.set(t, value))
    }

    /// Sets a derivative of an input, of order 1 or 2, at the communication point; false where there is no input.
    pub fn set_input_derivative(&mut self, place: Place, order: u32, value: f64) -> bool {
        self.change_input(place, order, |signal, t| signal.set_derivative(t, order, value))
    }

    fn change_input(&mut self, place: Place, order: u32, change: impl FnOnce(&mut Signal, f64)) -> bool {
        let t = self.time().unwrap_or_default();
        let changes = self.parameters.effects.change_input(place, order, t, |signal| change(signal, t));
        if changes == Some(true) {
            self.tell_of_inputs();
        }
        changes.is_some()
    }

    /// A host's motion hears of inputs at once, a method when it goes on. What is shown follows them at once.
    fn tell_of_inputs(&mut self) {
        if let Some(Run::Exchange(exchange)) = &mut self.run {
            exchange.hear(&self.parameters.effects);
        } else {
            self.news = true;
        }
        self.reading = None;
    }

    /// Starts the motion at time `t` \[s]; a relative tolerance \[1] given here stands in for that of the parameters.
    ///
    /// # Panics
    /// Where `t` is not finite.
    pub fn start(&mut self, t: f64, relative_tolerance: Option<f64>) -> Result<(), Invalid> {
        self.start_until(t, relative_tolerance, None)
    }

    /// [`Simulation::start`] of a run that is known to stop at `stop` \[s]: no step runs ahead of that.
    pub fn start_until(&mut self, t: f64, relative_tolerance: Option<f64>, stop: Option<f64>) -> Result<(), Invalid> {
        assert!(t.is_finite(), "a run starts at a finite time, not at {t:?}");
        let parameters = self.in_force(t, relative_tolerance);
        parameters.check()?;
        let (motion, reading) = self.at_start(&parameters, t)?;
        let span = stop.map(|stop| stop - t);
        // From here on nothing is refused any more: what is refused leaves everything as it was.
        self.parameters.effects.for_each_signal(&mut |signal| signal.begin(t));
        self.parameters.effects.begin(&reading.motion);
        self.reading = None;
        self.news = false;
        self.run = Some(match self.integrator {
            Integrator::Host => Run::Exchange(Exchange::start(motion, &reading)),
            Integrator::Method if parameters.effects.works() => {
                Run::Working(Integration::start(motion, &reading, &parameters.setup, t, span))
            }
            Integrator::Method => Run::Conservative(Integration::start(motion, &reading, &parameters.setup, t, span)),
        });
        Ok(())
    }

    /// What `auto` does and why; None where the parameters name the method.
    pub fn auto(&self) -> Option<String> {
        let is_auto = self.parameters.setup.solver.method_in_force() == numbers::AUTO;
        match self.run.as_ref().filter(|_| is_auto)? {
            Run::Conservative(integration) => Some(integration.auto()),
            Run::Working(integration) => Some(integration.auto()),
            Run::Exchange(_) => None,
        }
    }

    /// How often it has gone on with another method.
    pub fn changes_of_method(&self) -> u32 {
        match &self.run {
            Some(Run::Conservative(integration)) => integration.changes_of_method(),
            Some(Run::Working(integration)) => integration.changes_of_method(),
            Some(Run::Exchange(_)) | None => 0,
        }
    }

    /// The parameters with this tolerance \[1], the inputs as they are at time `t` \[s].
    fn in_force(&self, t: f64, relative_tolerance: Option<f64>) -> Parameters<E> {
        let mut parameters = self.parameters.clone();
        parameters.effects.for_each_signal(&mut |signal| signal.begin(t));
        let solver = &mut parameters.setup.solver;
        solver.relative_tolerance = relative_tolerance.unwrap_or(solver.relative_tolerance);
        parameters
    }

    /// Moves the communication point to time `t` \[s]. On a fault it stands at the last time reached.
    ///
    /// # Panics
    /// Before [`Simulation::start`], where a host integrates, or where `t` lies before the communication point or is not
    /// a number.
    pub fn advance(&mut self, t: f64) -> Result<(), Fault> {
        self.reading = None;
        if self.parameters.effects.extrapolates() {
            self.extrapolate();
        }
        let news = self.news.then_some(&self.parameters.effects);
        match self.run.as_mut().expect("a run was started") {
            Run::Conservative(integration) => integration.advance(t, news)?,
            Run::Working(integration) => integration.advance(t, news)?,
            Run::Exchange(_) => panic!("the host integrates"),
        }
        self.news = false;
        if E::IMPOSES && self.parameters.effects.imposed::<f64>(t).is_some() {
            self.tell_of_step();
        }
        Ok(())
    }

    /// Effects hear where a communication step ended.
    fn tell_of_step(&mut self) {
        if let Ok(Reading { motion, .. }) = self.read() {
            let end = *motion;
            self.parameters.effects.step_to(&end);
        }
    }

    /// Extrapolates inputs over the step that begins, where an effect does so.
    fn extrapolate(&mut self) {
        const { assert!(follows_all_inputs::<E>(), "extrapolation.rs: MOST is less than this list has inputs") };
        let t = self.time().unwrap_or_default();
        let effects = &mut self.parameters.effects;
        effects.step_from(t);
        let (mut extrapolated, mut number, mut changes) = (effects.clone(), 0, false);
        extrapolated.for_each_extrapolated(&mut |signal| {
            let before = *signal;
            effects.extrapolate(number, signal);
            if signal.goes_on_like(&before) {
                *signal = before;
            }
            changes |= *signal != before;
            number += 1;
        });
        effects.hear(&extrapolated);
        self.news |= changes;
    }

    /// The communication point \[s]; None before the start.
    #[inline(always)]
    pub fn time(&self) -> Option<f64> {
        match self.run.as_ref()? {
            Run::Conservative(integration) => Some(integration.time()),
            Run::Working(integration) => Some(integration.time()),
            Run::Exchange(exchange) => Some(exchange.time()),
        }
    }

    /// Whether |γ| ever exceeded π/2 under a law that has no limit at π: a warning is due.
    pub fn has_tilted(&self) -> bool {
        match &self.run {
            Some(Run::Conservative(integration)) => integration.has_tilted(),
            Some(Run::Working(integration)) => integration.has_tilted(),
            Some(Run::Exchange(exchange)) => exchange.has_tilted(),
            None => false,
        }
    }

    /// How fast the linear motion about a state on the way grows [1/s], if it does, and when that was \[s].
    pub fn growth(&self) -> Option<(f64, f64)> {
        match self.run.as_ref()? {
            Run::Conservative(integration) => integration.growth(),
            Run::Working(integration) => integration.growth(),
            Run::Exchange(exchange) => exchange.growth(),
        }
    }

    /// The value of a variable at the communication point, before the start as the parameters have it; None where there
    /// is none at this place. An error where the parameters are not possible.
    pub fn get(&mut self, place: Place) -> Result<Option<f64>, Invalid> {
        if Parameters::<E>::meta(place).is_some_and(|meta| !meta.has_start()) {
            self.read()?;
        }
        Ok(self.value(place))
    }

    /// [`Simulation::get`] without asking for a reading; None of a calculated variable where there was none.
    #[inline(always)]
    pub fn value(&self, place: Place) -> Option<f64> {
        self.parameters.value(place, self.time().unwrap_or_default(), self.reading.as_ref())
    }

    /// The values of Real variables that are at hand, by their value references; false, and the values are void, where one
    /// is not, or is not finite.
    #[inline(always)]
    pub fn reals_at_hand(&self, references: &[u32], values: &mut [f64]) -> bool {
        let Some(reading) = &self.reading else { return false };
        self.parameters.reals(references, values, reading)
    }

    /// What the communication point shows; before the start, what the parameters make of it.
    #[inline(always)]
    pub fn read(&mut self) -> Result<&Reading, Invalid> {
        if self.reading.is_none() {
            let news = self.news.then_some(&self.parameters.effects);
            self.reading = Some(match &mut self.run {
                Some(Run::Conservative(integration)) => integration.read(news),
                Some(Run::Working(integration)) => integration.read(news),
                Some(Run::Exchange(exchange)) => exchange.read(),
                None => {
                    self.parameters.check()?;
                    let reading = self.at_start(&self.parameters, 0.0)?.1;
                    self.parameters.effects.begin(&reading.motion);
                    reading
                }
            });
        }
        Ok(self.reading.as_ref().expect("just made"))
    }

    /// The state at the communication point.
    pub fn state(&mut self) -> Result<Whole<f64>, Invalid> {
        match &self.run {
            Some(Run::Exchange(exchange)) => Ok(exchange.state()),
            _ => Ok(self.read()?.state()),
        }
    }

    /// The rates of the state at the communication point, units per second.
    pub fn rates(&mut self) -> Result<Whole<f64>, Invalid> {
        let motion = self.read()?.motion;
        Ok(rotor::whole_rates(&self.parameters.effects, &motion))
    }

    /// How states and inputs differ from what they are, as derivatives go with them: of each place that is named, by its
    /// seed. Places of other variables count for nothing.
    pub fn tangents(&mut self, seeds: impl Iterator<Item = (Place, f64)>) -> Result<Tangents<E>, Invalid> {
        let reading = *self.read()?;
        Ok(Tangents::new(&self.parameters, &reading, seeds))
    }

    /// How everything changes with time at the communication point, per second.
    pub fn time_derivatives(&mut self) -> Result<Tangents<E>, Invalid> {
        let rates = self.rates()?;
        let reading = *self.read()?;
        Ok(Tangents::along_motion(&self.parameters, &reading, &rates))
    }

    /// The motion that a host integrates, once it was started; None where a method of ours does.
    pub fn exchange(&mut self) -> Option<&mut Exchange<E>> {
        let Some(Run::Exchange(exchange)) = &mut self.run else { return None };
        self.reading = None;
        Some(exchange)
    }

    /// Whether anything can be calculated of the present state; always, where a method of ours reached it.
    #[inline(always)]
    pub fn admits(&self) -> Result<(), Refusal> {
        match &self.run {
            Some(Run::Exchange(exchange)) => exchange.admits(),
            _ => Ok(()),
        }
    }

    /// What a continuous state of the host's counts with, in its unit.
    pub fn nominals(&self) -> Whole<f64> {
        let t = self.time().unwrap_or_default();
        Nominals::of(&Motion::at_start(&self.parameters, t), t).each()
    }

    /// Below which place \[m], velocity [m/s], angular momentum [kg·m²/s] and tilt \[rad] errors are not compared with a smaller
    /// motion.
    pub fn least_sizes(&self) -> [f64; 4] {
        let nominals = self.nominals();
        [0, 3, 6, 9].map(|n| LEAST * BESIDE * nominals[n])
    }

    /// The energy at the start \[J].
    fn total_at_start(&self, parameters: &Parameters<E>, t: f64) -> f64 {
        let Motion { rotor, state } = Motion::at_start(parameters, t);
        Ledger::new(&rotor.motion(t, &state), &rotor.effects, [0.0; 2], 0.0).total()
    }

    /// The start as the parameters make it, and what it shows. An error where it overflows.
    fn at_start(&self, parameters: &Parameters<E>, t: f64) -> Result<(Motion<E>, Reading), Invalid> {
        let mut start = Motion::at_start(parameters, t);
        if self.integrator == Integrator::Host {
            start.unwrap_turns();
        }
        let Motion { rotor, state } = &start;
        let motion = rotor.motion(t, state);
        let mut reading = Reading::new(motion, &rotor.effects, [0.0; 2], 0.0, Cost::default());
        reading.ledger.total_at_start = reading.ledger.total();
        if !reading.ledger.total().is_finite() {
            return Err(parameters.blamed(|parameters| self.total_at_start(parameters, t).is_finite()));
        }
        Ok((start, reading))
    }
}

impl<E: Effects> Stored for Simulation<E> {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let Self { integrator, parameters, run, news, reading } = self;
        choice(integrator, &[Integrator::Method, Integrator::Host], walk)?;
        parameters.walk(walk)?;
        news.walk(walk)?;
        // What it shows follows from the rest.
        *reading = None;
        let mut kind = match run {
            None => 0,
            Some(Run::Conservative(_)) => 1,
            Some(Run::Working(_)) => 2,
            Some(Run::Exchange(_)) => 3,
        };
        kind.walk(walk)?;
        match (kind, &run) {
            (0, _) => *run = None,
            (1, Some(Run::Conservative(_))) | (2, Some(Run::Working(_))) | (3, Some(Run::Exchange(_))) => {}
            (1, _) => *run = Some(Run::Conservative(Integration::blank())),
            (2, _) => *run = Some(Run::Working(Integration::blank())),
            (3, _) => *run = Some(Run::Exchange(Exchange::blank())),
            _ => return Err(Damaged),
        }
        let (integrates, fits) = match run {
            None => return Ok(()),
            Some(Run::Conservative(integration)) => {
                integration.walk(walk)?;
                (Integrator::Method, integration.is_of(parameters))
            }
            Some(Run::Working(integration)) => {
                integration.walk(walk)?;
                (Integrator::Method, integration.is_of(parameters))
            }
            Some(Run::Exchange(exchange)) => {
                exchange.walk(walk)?;
                (Integrator::Host, exchange.is_of(parameters))
            }
        };
        // A run begins with parameters that were checked.
        if integrates == *integrator && fits && parameters.check().is_ok() { Ok(()) } else { Err(Damaged) }
    }
}
