//! One instance as a safe state machine: what each call means in any version of FMI, without a pointer in sight.

mod bytes;
mod co_simulation;
mod derivatives;
mod failure;
mod logger;
mod model_exchange;
mod state;
mod values;

pub use failure::{Failure, Reply};
pub use logger::{Logger, Severity};
pub use state::{State, kind_name};
pub use values::{Room, Type, fill};

use crate::scene::{self, Effects, Simulation};
use split_rotor_model::effects::{Block, Effects as _};
use split_rotor_model::error::Invalid;
use split_rotor_model::integrate::Cost;
use split_rotor_model::log::{ALL, Category};
use split_rotor_model::simulation::Integrator;
use split_rotor_model::variable::{Kind, Place, Role};
use split_rotor_model::variables::{Parameters, TOLERANCES};

/// What a version of FMI calls the functions that messages name.
pub struct Names {
    /// What makes an instance.
    pub instantiate: &'static str,
    /// What tells the experiment: its tolerance, start and stop.
    pub experiment: &'static str,
    /// What ends the initialization.
    pub end_of_initialization: &'static str,
    /// What sets the continuous states.
    pub set_states: &'static str,
    /// What ends the run.
    pub terminate: &'static str,
    /// What makes an instance as good as new.
    pub reset: &'static str,
}

/// An instance of the FMU.
pub struct Instance {
    /// Where its messages go.
    pub logger: Logger,
    names: &'static Names,
    /// Everything else.
    pub memory: Memory,
}

/// All that a saved FMU state holds and brings back: what follows is then equal to the last bit, because the solver's own
/// history is in it.
pub struct Memory {
    /// Where the instance is in its life.
    pub state: State,
    simulation: Simulation,
    experiment: Experiment,
    /// Whether the last step could not be done.
    step_failed: bool,
    /// What was said of this run.
    warned: [bool; warned::COUNT],
    /// Of which ports it was said that they go on by what they learnt, each as the bit of its number.
    learnt: u32,
    /// Up to which ω_φ it was said that laws are doubtful: the lowest and the highest [rad/s].
    doubted: Option<[f64; 2]>,
}

/// What is said once of a run, by its place in [`Memory::warned`].
mod warned {
    /// That the tilt is large.
    pub const OF_TILT: usize = 0;
    /// That the motion grows, which it does still.
    pub const OF_GROWTH: usize = 1;
    /// That all inputs are 0.
    pub const OF_ZEROS: usize = 2;
    /// That something is set of an effect that is off.
    pub const OF_WHAT_IS_OFF: usize = 3;
    /// That the motion diverges.
    pub const OF_DIVERGENCE: usize = 4;
    /// That it is not known whether the motion grows.
    pub const OF_UNJUDGED: usize = 5;
    /// That contacts are chaotic.
    pub const OF_RATTLE: usize = 6;
    /// That the exchange with models at the ports is wrong.
    pub const OF_COUPLING: usize = 7;
    /// How many there are.
    pub const COUNT: usize = 8;
}

/// What the host said of the experiment, and what it set itself.
#[derive(Clone, Copy, Default)]
struct Experiment {
    start: f64,
    stop: Option<f64>,
    tolerance: Option<f64>,
    /// The host set solver.relative_tolerance: it wins over the experiment's tolerance.
    host_set_tolerance: bool,
}

impl Clone for Memory {
    fn clone(&self) -> Self {
        let &Self { state, ref simulation, experiment, step_failed, warned, learnt, doubted } = self;
        Self { state, simulation: simulation.clone(), experiment, step_failed, warned, learnt, doubted }
    }

    /// In place, as that of a simulation.
    fn clone_from(&mut self, source: &Self) {
        let Self { state, simulation, experiment, step_failed, warned, learnt, doubted } = source;
        self.simulation.clone_from(simulation);
        (self.state, self.experiment, self.step_failed, self.warned) = (*state, *experiment, *step_failed, *warned);
        (self.learnt, self.doubted) = (*learnt, *doubted);
    }
}

impl Memory {
    /// That of a new instance, with the scene's start values.
    fn new(integrator: Integrator) -> Self {
        let parameters = scene::values().starts().map(|(reference, value)| (Place::of(reference), value)).collect();
        Self {
            state: State::Instantiated,
            simulation: Simulation::with(integrator, parameters),
            experiment: Experiment::default(),
            step_failed: false,
            warned: [false; warned::COUNT],
            learnt: 0,
            doubted: None,
        }
    }

    /// Who integrates: the kind of the instance.
    #[inline(always)]
    pub fn integrator(&self) -> Integrator {
        self.simulation.integrator()
    }
}

impl Instance {
    /// A new instance with the scene's start values.
    pub fn new(logger: Logger, names: &'static Names, integrator: Integrator) -> Self {
        let instance = Self { logger, names, memory: Memory::new(integrator) };
        let kind = kind_name(integrator);
        instance.tell(Category::Events, || format!("{}: instantiated for {kind}", names.instantiate));
        instance
    }

    /// Enables or disables messages of these categories; without any, of all.
    pub fn set_debug_logging(&mut self, on: bool, categories: &[&str]) -> Reply {
        self.logger.choose(on, categories).map_err(|unknown| {
            let names = Category::EACH.map(|category| category.words().0).join(", ");
            Failure::Error(format!("there is no category {unknown:?}: there are {names} and {ALL}"))
        })
    }

    /// Takes tolerance, start and stop \[s] of the experiment.
    pub fn setup_experiment(&mut self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Reply {
        if !start.is_finite() {
            return Err(Failure::Error(format!("startTime = {start:?} must be a finite number of seconds")));
        }
        if let Some(stop) = stop.filter(|stop| stop.is_nan() || *stop < start) {
            return Err(Failure::Error(format!("stopTime = {stop:?} must not be before startTime = {start:?}")));
        }
        if let Some(tolerance) = tolerance.filter(|value| !TOLERANCES.holds(*value)) {
            return Err(Invalid::new("tolerance", tolerance, TOLERANCES.words(Kind::Real)).into());
        }
        self.memory.experiment = Experiment { start, stop, tolerance, ..self.memory.experiment };
        Ok(())
    }

    /// Enters initialization mode.
    pub fn enter_initialization_mode(&mut self) -> Reply {
        self.memory.state = State::Initialization;
        Ok(())
    }

    /// Checks all parameters and starts the motion.
    pub fn exit_initialization_mode(&mut self) -> Reply {
        let Experiment { start, stop, tolerance, host_set_tolerance } = self.memory.experiment;
        let tolerance = tolerance.filter(|_| !host_set_tolerance);
        self.memory.simulation.start_until(start, tolerance, stop)?;
        self.memory.step_failed = false;
        self.memory.state = match self.memory.integrator() {
            Integrator::Host => State::EventMode,
            Integrator::Method => {
                self.tell_tolerance(tolerance);
                self.tell_auto(0);
                State::StepComplete
            }
        };
        self.warn();
        self.warn_of_unheld();
        self.warn_of_what_is_off();
        Ok(())
    }

    /// Says which tolerance is in force: the one given, which is the experiment's, or that of the parameters.
    fn tell_tolerance(&self, given: Option<f64>) {
        self.tell(Category::Solver, || {
            let own = self.memory.simulation.parameters().setup.solver.relative_tolerance;
            let (value, origin) = match given {
                Some(value) => (value, format!("of {}", self.names.experiment)),
                None if self.memory.experiment.host_set_tolerance => {
                    (own, "that the host set as solver.relative_tolerance".into())
                }
                None => (own, "of the scene".into()),
            };
            let [place, velocity, momentum, tilt] = self.memory.simulation.least_sizes();
            format!(
                "the relative tolerance in force is {value:?}, the one {origin}; it is relative to the size of the motion, which \
                 counts from {place:.1e} m, {velocity:.1e} m/s, {momentum:.1e} kg.m2/s and {tilt:.1e} rad on"
            )
        });
    }

    /// Says what the method goes on with and why, after so many changes in this step.
    fn tell_auto(&self, changes: u32) {
        if self.logger.hears(Category::Solver)
            && let Some(mut words) = self.memory.simulation.auto()
        {
            if changes > 1 {
                words += &format!(" (the last of {changes} changes in this communication step)");
            }
            self.logger.log(Severity::Ok, Category::Solver, &words);
        }
    }

    /// Ends the run; values can still be read.
    pub fn terminate(&mut self) -> Reply {
        self.memory.state = State::Terminated;
        self.tell(Category::Events, || format!("{}: terminated", self.names.terminate));
        if self.memory.integrator() == Integrator::Method
            && self.logger.hears(Category::Solver)
            && let Ok(reading) = self.memory.simulation.read()
        {
            let Cost { steps, rejected, evaluations, .. } = reading.cost;
            self.tell(Category::Solver, || {
                format!("the solver spent {steps} steps, {rejected} rejected ones, {evaluations} evaluations")
            });
        }
        Ok(())
    }

    /// As good as new; what the host set is forgotten.
    pub fn reset(&mut self) -> Reply {
        self.memory = Memory::new(self.memory.integrator());
        self.tell(Category::Events, || format!("{}: all values are those of the scene again", self.names.reset));
        Ok(())
    }

    /// Brings back all that was saved.
    pub fn restore(&mut self, saved: &Memory) -> Reply {
        self.check_kind(saved)?;
        self.memory.clone_from(saved);
        Ok(())
    }

    /// An FMU state goes back only to the kind of instance from which it came.
    fn check_kind(&self, saved: &Memory) -> Result<(), Failure> {
        let (from, to) = (saved.integrator(), self.memory.integrator());
        if from == to {
            return Ok(());
        }
        let (from, to) = (kind_name(from), kind_name(to));
        Err(Failure::Error(format!("the FMU state comes from an instance for {from}, and this one is for {to}")))
    }

    /// Says once that the tilt is large, where that matters, that the motion diverges, that contacts are chaotic, and that the exchange with
    /// models at the ports is wrong; and whenever the linear motion begins to grow.
    fn warn(&mut self) {
        let told = &mut self.memory.warned;
        if !told[warned::OF_TILT]
            && let Some(message) = self.memory.simulation.warns_of_tilt()
        {
            told[warned::OF_TILT] = true;
            self.logger.log(Severity::Warning, Category::Warning, message);
        }
        let growth = self.memory.simulation.growth();
        let known = std::mem::replace(&mut told[warned::OF_GROWTH], growth.is_some());
        if !known && let Some(growth) = growth {
            let message = growth.to_string();
            self.logger.log(Severity::Warning, Category::Warning, &message);
        }
        let told = &mut self.memory.warned;
        if !told[warned::OF_UNJUDGED]
            && let Some(unjudged) = self.memory.simulation.unjudged()
        {
            told[warned::OF_UNJUDGED] = true;
            self.logger.log(Severity::Warning, Category::Warning, &unjudged.to_string());
        }
        if !told[warned::OF_DIVERGENCE]
            && let Some(divergence) = self.memory.simulation.divergence()
        {
            told[warned::OF_DIVERGENCE] = true;
            self.logger.log(Severity::Warning, Category::Warning, &divergence.to_string());
        }
        if !told[warned::OF_RATTLE]
            && let Some(rattle) = self.memory.simulation.rattle()
        {
            told[warned::OF_RATTLE] = true;
            self.logger.log(Severity::Warning, Category::Warning, &rattle.to_string());
        }
        if !told[warned::OF_COUPLING]
            && let Some(coupling) = self.memory.simulation.coupling()
        {
            told[warned::OF_COUPLING] = true;
            self.logger.log(Severity::Warning, Category::Warning, &coupling.to_string());
        }
        self.warn_of_doubts();
        self.report_learnt();
    }

    /// Logs once for each port that it goes on by what it learnt of the values that were set.
    fn report_learnt(&mut self) {
        let (learnt, known) = (self.memory.simulation.learnt(), self.memory.learnt);
        self.memory.learnt |= learnt;
        if learnt & !known == 0 {
            return;
        }
        let effects = &self.memory.simulation.parameters().effects;
        let ports = effects.blocks().map(Block::kind).filter(|kind| kind.facts.partners > 0);
        for (_, kind) in ports.enumerate().filter(|(number, _)| (learnt & !known) >> number & 1 == 1) {
            let (port, learn) = (kind.block_name(), kind.full_name("learn"));
            self.tell(Category::Events, || {
                format!(
                    "{port}: between communication points its load goes on by what was learnt of the values that were set (to hold these \
                     instead, set {learn} = false)"
                )
            });
        }
    }

    /// Says once of each effect where its law is doubtful: a table is left, or a rotor turns backwards.
    fn warn_of_doubts(&mut self) {
        let Some(speeds) = self.memory.simulation.speeds_met() else { return };
        let before = self.memory.doubted.replace(speeds);
        if before != Some(speeds) {
            let effects = &self.memory.simulation.parameters().effects;
            effects.doubts(speeds, before, &mut |block, doubt| {
                self.logger.log(Severity::Warning, Category::Warning, &doubt.words(block));
            });
        }
    }

    /// Says where a run begins in which directions nothing holds the rotor.
    fn warn_of_unheld(&self) {
        match self.memory.simulation.unheld() {
            Some(unheld) if unheld.is_mere_axial() => self.tell(Category::Events, || unheld.to_string()),
            Some(unheld) => self.logger.log(Severity::Warning, Category::Warning, &unheld.to_string()),
            None => {}
        }
    }

    /// Says once, where a run begins, which variables of effects that are off the host has set: they do nothing.
    fn warn_of_what_is_off(&mut self) {
        let simulation = &self.memory.simulation;
        let is_set = |(reference, start): &(u32, f64)| {
            let place = Place::of(*reference);
            self.off_for(place).is_some() && simulation.value(place).is_some_and(|value| value != *start)
        };
        let set: Vec<_> = scene::values().starts().filter(is_set).map(|(reference, _)| Place::of(reference)).collect();
        self.say_what_is_off(&set);
    }

    /// Says it of inputs that are set while it runs; what was set before is looked at where the run begins.
    fn warn_of_inputs_off(&mut self, set: impl Iterator<Item = (u32, f64)>) {
        if Effects::FACTS.switched
            && !self.memory.warned[warned::OF_WHAT_IS_OFF]
            && self.memory.simulation.time().is_some()
        {
            let places = set.filter(|(_, value)| *value != 0.0).map(|(reference, _)| Place::of(reference));
            let off: Vec<_> = places.filter(|place| self.off_for(*place).is_some()).collect();
            self.say_what_is_off(&off);
        }
    }

    /// The switch of the effect that has this variable, where that is off.
    fn off_for(&self, place: Place) -> Option<String> {
        let (block, _) = self.memory.simulation.parameters().effects.at(place)?;
        (place.row != Place::SWITCH && block.kind().facts.switched && !block.is_active())
            .then(|| block.kind().switch_name())
    }

    /// Says it of these variables, if it was not said of any.
    fn say_what_is_off(&mut self, set: &[Place]) {
        let words = set.iter().filter_map(|place| {
            let name = Parameters::<Effects>::name(*place).unwrap_or_default();
            Some(format!("{name} is set, but {} is off", self.off_for(*place)?))
        });
        let words: Vec<_> = words.collect();
        if !words.is_empty() && !self.memory.warned[warned::OF_WHAT_IS_OFF] {
            self.memory.warned[warned::OF_WHAT_IS_OFF] = true;
            let message = format!(
                "{}: what is off does nothing; set the switch to true before {}",
                words.join(", "),
                self.names.end_of_initialization
            );
            self.logger.log(Severity::Warning, Category::Warning, &message);
        }
    }

    /// Says once, where a run begins, that all inputs of what is on are 0 though the scene begins with others: some hosts send 0 to what
    /// nobody connected.
    fn warn_of_zeros(&mut self) {
        let memory = &self.memory;
        let begins = memory.simulation.time() == Some(memory.experiment.start);
        if memory.warned[warned::OF_ZEROS] || !begins || !memory.simulation.parameters().effects.have_inputs() {
            return;
        }
        let is_input =
            |place| Parameters::<Effects>::meta(place).is_some_and(|meta| matches!(meta.role, Role::Input { .. }));
        let is_zero = |place| memory.simulation.value(place) == Some(0.0);
        let values = scene::values();
        let inputs = values.starts().map(|(reference, start)| (Place::of(reference), start));
        // Whether an effect is on is asked last: of the few that are not 0.
        let mut inputs = inputs
            .filter(|(place, start)| is_input(*place) && (*start != 0.0 || !is_zero(*place)))
            .filter(|(place, _)| self.off_for(*place).is_none());
        let other = inputs.clone().find(|(_, start)| *start != 0.0);
        if let Some((place, start)) = other
            && inputs.all(|(place, _)| is_zero(place))
        {
            let name = Parameters::<Effects>::name(place).unwrap_or_default();
            let message = format!(
                "all inputs are 0, and the scene begins with {name} = {start:?}: some hosts send 0 to inputs that nobody \
                 connected; connect them, or set them to their start values"
            );
            self.memory.warned[warned::OF_ZEROS] = true;
            self.logger.log(Severity::Warning, Category::Warning, &message);
        }
    }

    /// Logs what is not a failure, where somebody listens.
    fn tell(&self, category: Category, message: impl FnOnce() -> String) {
        if self.logger.hears(category) {
            self.logger.log(Severity::Ok, category, &message());
        }
    }
}
