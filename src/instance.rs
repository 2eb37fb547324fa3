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
    /// Whether it was said that the tilt is large, that the motion grows, which it does still, and that all inputs are 0.
    warned: [bool; 4],
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
        let &Self { state, ref simulation, experiment, step_failed, warned } = self;
        Self { state, simulation: simulation.clone(), experiment, step_failed, warned }
    }

    /// In place, as that of a simulation.
    fn clone_from(&mut self, source: &Self) {
        let Self { state, simulation, experiment, step_failed, warned } = source;
        self.simulation.clone_from(simulation);
        (self.state, self.experiment, self.step_failed, self.warned) = (*state, *experiment, *step_failed, *warned);
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
            warned: [false; 4],
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

    /// Says once that the tilt is large, where that matters, whenever the linear motion begins to grow, and once where that is not known.
    fn warn(&mut self) {
        let [of_tilt, of_growth, _, of_unjudged] = &mut self.memory.warned;
        if !*of_tilt && let Some(message) = self.memory.simulation.warns_of_tilt() {
            *of_tilt = true;
            self.logger.log(Severity::Warning, Category::Warning, message);
        }
        let growth = self.memory.simulation.growth();
        let known = std::mem::replace(of_growth, growth.is_some());
        if !known && let Some(growth) = growth {
            let message = growth.to_string();
            self.logger.log(Severity::Warning, Category::Warning, &message);
        }
        if !*of_unjudged && let Some(unjudged) = self.memory.simulation.unjudged() {
            *of_unjudged = true;
            let message = unjudged.to_string();
            self.logger.log(Severity::Warning, Category::Warning, &message);
        }
    }

    /// Says once, where a run begins, that all inputs are 0 though the scene begins with others: some hosts send 0 to inputs that
    /// nobody connected.
    fn warn_of_zeros(&mut self) {
        let memory = &mut self.memory;
        if memory.warned[2] || memory.simulation.time() != Some(memory.experiment.start) {
            return;
        }
        let is_input = |reference| {
            Parameters::<Effects>::meta(Place::of(reference))
                .is_some_and(|meta| matches!(meta.role, Role::Input { .. }))
        };
        let values = scene::values();
        let mut inputs = values.starts().filter(|(reference, _)| is_input(*reference));
        let other = inputs.clone().find(|(_, start)| *start != 0.0);
        let is_zero = |reference| memory.simulation.value(Place::of(reference)) == Some(0.0);
        if let Some((reference, start)) = other
            && inputs.all(|(reference, _)| is_zero(reference))
        {
            memory.warned[2] = true;
            let name = Parameters::<Effects>::name(Place::of(reference)).unwrap_or_default();
            let message = format!(
                "all inputs are 0, and the scene begins with {name} = {start:?}: some hosts send 0 to inputs that nobody \
                 connected; connect them, or set them to their start values"
            );
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
