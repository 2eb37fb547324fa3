//! One instance as a safe state machine: what each call means, without a pointer in sight.

use crate::abi::{Boolean, Choice, Integer, Real, Status, status_kind};
use crate::calls::State;
use crate::logger::Logger;
use crate::scene::{Effects, STARTS, Simulation};
use model::error::Invalid;
use model::integrate::Cost;
use model::log::Category;
use model::scalar::ulp;
use model::variable::{Kind, Meta, Place, Role};
use model::variables::{Parameters, TOLERANCES};

/// Why a call was refused, and what it returns.
#[derive(Debug)]
pub struct Failure {
    /// What the call returns.
    pub status: Status,
    /// Where it is logged.
    pub category: Category,
    /// What is wrong, and what would be right.
    pub message: String,
}

impl Failure {
    /// Bad arguments or a bad sequence; nothing changed.
    pub fn error(message: impl Into<String>) -> Self {
        Self { status: Status::Error, category: Category::Error, message: message.into() }
    }

    /// A step that cannot be done.
    fn discard(message: String) -> Self {
        Self { status: Status::Discard, category: Category::Discard, message }
    }
}

impl From<Invalid> for Failure {
    fn from(invalid: Invalid) -> Self {
        Self::error(invalid.to_string())
    }
}

/// What a call returns, or why it was refused.
pub type Reply = Result<Status, Failure>;

/// An instance of the FMU.
pub struct Instance {
    /// Where its messages go.
    pub logger: Logger,
    /// Everything else.
    pub memory: Memory,
}

/// All that a saved FMU state holds and brings back: what follows is then equal to the last bit, because the solver's own
/// history is in it.
#[derive(Clone)]
pub struct Memory {
    /// Where the instance is in its life.
    pub state: State,
    simulation: Simulation,
    experiment: Experiment,
    /// What the last fmi2DoStep returned.
    step_status: Status,
    /// Whether it was said that the tilt is large.
    warned: bool,
}

/// What fmi2SetupExperiment said, and what the host set itself.
#[derive(Clone, Copy, Default)]
struct Experiment {
    start: Real,
    stop: Option<Real>,
    tolerance: Option<Real>,
    /// The host set solver.relative_tolerance: it wins over the experiment's tolerance.
    host_set_tolerance: bool,
}

/// Two times are equal within this part of a step, and this many units in the last place.
const TIME_TOLERANCE: f64 = 1e-9;
const TIME_ULPS: f64 = 4.0;

impl Instance {
    /// A new instance with the scene's start values.
    pub fn new(logger: Logger) -> Self {
        logger.log(Status::Ok, Category::Events, "fmi2Instantiate: instantiated for co-simulation");
        Self { logger, memory: Memory::new() }
    }

    /// fmi2SetDebugLogging
    pub fn set_debug_logging(&mut self, on: bool, categories: &[&str]) -> Reply {
        self.logger.choose(on, categories).map_err(|unknown| {
            Failure::error(format!("there is no category {unknown:?}: modelDescription.xml lists those there are"))
        })?;
        Ok(Status::Ok)
    }

    /// fmi2SetupExperiment
    pub fn setup_experiment(&mut self, tolerance: Option<Real>, start: Real, stop: Option<Real>) -> Reply {
        if !start.is_finite() {
            return Err(Failure::error(format!("startTime = {start:?} must be a finite number of seconds")));
        }
        if let Some(stop) = stop.filter(|stop| stop.is_nan() || *stop < start) {
            return Err(Failure::error(format!("stopTime = {stop:?} must not be before startTime = {start:?}")));
        }
        if let Some(tolerance) = tolerance.filter(|value| !TOLERANCES.holds(*value)) {
            return Err(Invalid::new("tolerance", tolerance, TOLERANCES.words()).into());
        }
        self.memory.experiment = Experiment { start, stop, tolerance, ..self.memory.experiment };
        Ok(Status::Ok)
    }

    /// fmi2EnterInitializationMode
    pub fn enter_initialization_mode(&mut self) -> Reply {
        self.memory.state = State::Initialization;
        Ok(Status::Ok)
    }

    /// fmi2ExitInitializationMode
    pub fn exit_initialization_mode(&mut self) -> Reply {
        let Experiment { start, tolerance, host_set_tolerance, .. } = self.memory.experiment;
        let tolerance = tolerance.filter(|_| !host_set_tolerance);
        self.memory.simulation.start(start, tolerance)?;
        self.memory.state = State::StepComplete;
        self.memory.step_status = Status::Ok;
        if self.logger.hears(Category::Solver) {
            let scene = self.memory.simulation.parameters().setup.solver.relative_tolerance;
            let (value, origin) = match tolerance {
                Some(value) => (value, "of fmi2SetupExperiment"),
                None if host_set_tolerance => (scene, "that the host set as solver.relative_tolerance"),
                None => (scene, "of the scene"),
            };
            let message = format!("the relative tolerance in force is {value:?}, the one {origin}");
            self.logger.log(Status::Ok, Category::Solver, &message);
        }
        self.warn_of_tilt();
        Ok(Status::Ok)
    }

    /// fmi2Terminate
    pub fn terminate(&mut self) -> Reply {
        self.memory.state = State::Terminated;
        self.logger.log(Status::Ok, Category::Events, "fmi2Terminate: terminated");
        if self.logger.hears(Category::Solver)
            && let Ok(reading) = self.memory.simulation.read()
        {
            let Cost { steps, rejected, evaluations, .. } = reading.cost;
            let message =
                format!("the solver spent {steps} steps, {rejected} rejected ones, {evaluations} evaluations");
            self.logger.log(Status::Ok, Category::Solver, &message);
        }
        Ok(Status::Ok)
    }

    /// fmi2Reset
    pub fn reset(&mut self) -> Reply {
        self.memory = Memory::new();
        self.logger.log(Status::Ok, Category::Events, "fmi2Reset: all values are those of the scene again");
        Ok(Status::Ok)
    }

    /// fmi2SetFMUstate
    pub fn restore(&mut self, saved: &Memory) -> Reply {
        self.memory.clone_from(saved);
        Ok(Status::Ok)
    }

    /// fmi2GetReal
    pub fn get_real(&mut self, references: &[u32], values: &mut [Real]) -> Reply {
        self.get(references, values, Type::Real, |value| value)
    }

    /// fmi2GetInteger
    pub fn get_integer(&mut self, references: &[u32], values: &mut [Integer]) -> Reply {
        self.get(references, values, Type::Integer, |value| value as Integer)
    }

    /// fmi2GetBoolean and fmi2GetString: there is no variable of these types.
    pub fn get_other(&mut self, references: &[u32], kind: Type) -> Reply {
        self.get(references, &mut vec![(); references.len()], kind, |_| ())
    }

    /// fmi2SetReal
    pub fn set_real(&mut self, references: &[u32], values: &[Real]) -> Reply {
        self.set(references, values, Type::Real, |value| *value)
    }

    /// fmi2SetInteger
    pub fn set_integer(&mut self, references: &[u32], values: &[Integer]) -> Reply {
        self.set(references, values, Type::Integer, |value| f64::from(*value))
    }

    /// fmi2SetBoolean and fmi2SetString: there is no variable of these types.
    pub fn set_other(&mut self, references: &[u32], kind: Type) -> Reply {
        self.set(references, &vec![(); references.len()], kind, |()| 0.0)
    }

    fn get<T>(&mut self, references: &[u32], values: &mut [T], kind: Type, convert: fn(f64) -> T) -> Reply {
        for reference in references {
            // What cannot be calculated is refused before anything is written.
            if let Role::Output(_) = typed(*reference, kind)?.role {
                self.memory.simulation.read()?;
            }
        }
        for (reference, value) in references.iter().zip(values) {
            let got = self.memory.simulation.get(Place::of(*reference))?;
            *value = convert(got.ok_or_else(|| unknown(*reference))?);
        }
        Ok(Status::Ok)
    }

    fn set<T>(&mut self, references: &[u32], values: &[T], kind: Type, convert: fn(&T) -> f64) -> Reply {
        let mut sets_tolerance = false;
        for reference in references {
            let meta = typed(*reference, kind)?;
            sets_tolerance |= meta.name == "solver.relative_tolerance";
            if let Role::Output(_) = meta.role {
                return Err(Failure::error(format!("{} is an output: only parameters can be set", shown(*reference))));
            }
        }
        for (reference, value) in references.iter().zip(values) {
            self.memory.simulation.set_parameter(Place::of(*reference), convert(value));
        }
        self.memory.experiment.host_set_tolerance |= sets_tolerance;
        Ok(Status::Ok)
    }

    /// fmi2DoStep
    pub fn do_step(&mut self, from: Real, step: Real) -> Reply {
        let now = self.memory.simulation.time().unwrap_or(self.memory.experiment.start);
        let to = from + step;
        if !(step > 0.0 && step.is_finite()) {
            return Err(Failure::error(format!("communicationStepSize = {step:?} must be a finite number > 0")));
        }
        if !same_time(from, now, step) {
            return Err(Failure::error(format!(
                "currentCommunicationPoint = {from:?} must be {now:?}, where the last step ended"
            )));
        }
        if to <= now {
            return Err(Failure::error(format!(
                "communicationStepSize = {step:?} is too small to advance the time {now:?}: about {:?} is needed",
                2.0 * ulp(now)
            )));
        }
        if let Some(stop) = self.memory.experiment.stop.filter(|stop| to > *stop && !same_time(to, *stop, step)) {
            return Err(Failure::error(format!("the step to {to:?} goes past the stop time {stop:?}")));
        }
        let outcome = self.memory.simulation.advance(to);
        self.warn_of_tilt();
        match outcome {
            Ok(()) => {
                self.memory.state = State::StepComplete;
                self.memory.step_status = Status::Ok;
                Ok(Status::Ok)
            }
            Err(fault) => {
                self.memory.state = State::StepFailed;
                self.memory.step_status = Status::Discard;
                Err(Failure::discard(fault.to_string()))
            }
        }
    }

    /// Says once that the tilt is large, where that matters.
    fn warn_of_tilt(&mut self) {
        if self.memory.simulation.has_tilted() && !self.memory.warned {
            self.memory.warned = true;
            let message = "the tilt |gamma| exceeds pi/2; a spring or torque that follows gamma has no limit at pi, and \
                           beyond 3.1 rad no step is possible";
            self.logger.log(Status::Warning, Category::Warning, message);
        }
    }

    /// fmi2GetStatus
    pub fn status(&self, kind: Choice) -> Result<Status, Failure> {
        match kind {
            status_kind::DO_STEP => Ok(self.memory.step_status),
            _ => Err(wrong_kind(kind, "fmi2DoStepStatus")),
        }
    }

    /// fmi2GetRealStatus
    pub fn real_status(&self, kind: Choice) -> Result<Real, Failure> {
        match kind {
            status_kind::LAST_SUCCESSFUL_TIME => {
                Ok(self.memory.simulation.time().unwrap_or(self.memory.experiment.start))
            }
            _ => Err(wrong_kind(kind, "fmi2LastSuccessfulTime")),
        }
    }

    /// fmi2GetBooleanStatus: after a step that could not be done, no shorter one can.
    pub fn boolean_status(&self, kind: Choice) -> Result<Boolean, Failure> {
        match kind {
            status_kind::TERMINATED => Ok(Boolean::from(self.memory.step_status == Status::Discard)),
            _ => Err(wrong_kind(kind, "fmi2Terminated")),
        }
    }
}

/// The FMI type through which a variable is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Type {
    /// fmi2Real
    Real,
    /// fmi2Integer, of enumerations too
    Integer,
    /// fmi2Boolean
    Boolean,
    /// fmi2String
    String,
}

impl Memory {
    /// That of a new instance, with the scene's start values.
    fn new() -> Self {
        let starts = STARTS.iter().map(|(reference, value)| (Place::of(*reference), *value));
        Self {
            state: State::Instantiated,
            simulation: Simulation::new(starts),
            experiment: Experiment::default(),
            step_status: Status::Ok,
            warned: false,
        }
    }
}

/// What is said of a variable, if it is of this type.
fn typed(reference: u32, kind: Type) -> Result<&'static Meta, Failure> {
    let meta = Parameters::<Effects>::meta(Place::of(reference)).ok_or_else(|| unknown(reference))?;
    let own = match meta.kind {
        Kind::Real => Type::Real,
        Kind::Enumeration(_) => Type::Integer,
    };
    if own == kind {
        return Ok(meta);
    }
    Err(Failure::error(format!("{} is of type {own:?}, not {kind:?}", shown(reference))))
}

/// A variable in a message.
fn shown(reference: u32) -> String {
    let name = Parameters::<Effects>::name(Place::of(reference)).unwrap_or_default();
    format!("{name} (value reference {reference})")
}

fn unknown(reference: u32) -> Failure {
    Failure::error(format!("there is no variable with value reference {reference}: modelDescription.xml lists them"))
}

fn wrong_kind(kind: Choice, right: &str) -> Failure {
    Failure::error(format!("status kind {kind} has no answer of this type: ask for {right}"))
}

fn same_time(a: f64, b: f64, step: f64) -> bool {
    (a - b).abs() <= TIME_TOLERANCE * step + TIME_ULPS * ulp(b)
}
