//! The states of an instance, and in which of them each function is legal.
//!
//! The table follows FMI 2.0.4, sections 3.2.3 and 4.2.4, but is lenient where real hosts need it (docs/fmi.md).

use split_rotor_model::simulation::Integrator;

/// Where an instance is in its life.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// After fmi2Instantiate or fmi2Reset.
    Instantiated = 1,
    /// Between fmi2EnterInitializationMode and fmi2ExitInitializationMode.
    Initialization = 2,
    /// Ready for a step.
    StepComplete = 4,
    /// After a step that could not be done.
    StepFailed = 8,
    /// After fmi2Terminate.
    Terminated = 16,
    /// After a caught panic: nothing but fmi2FreeInstance is legal.
    Lost = 32,
    /// Model exchange: at an event, and after fmi2ExitInitializationMode.
    EventMode = 64,
    /// Model exchange: while the host integrates.
    ContinuousTime = 128,
}

impl State {
    /// Its name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            State::Instantiated => "instantiated",
            State::Initialization => "initialization mode",
            State::StepComplete => "step complete",
            State::StepFailed => "step failed",
            State::Terminated => "terminated",
            State::Lost => "lost after an internal failure",
            State::EventMode => "event mode",
            State::ContinuousTime => "continuous-time mode",
        }
    }
}

/// A function of FMI and the states in which it is legal.
pub struct Call {
    /// Its C name.
    pub name: &'static str,
    /// A set of [`State`] bits.
    legal: u8,
    /// Of which instances it is legal; None: of all.
    kind: Option<Integrator>,
    /// What to do instead where it is not legal.
    remedy: &'static str,
}

impl Call {
    const fn new(name: &'static str, legal: u8, kind: Option<Integrator>, remedy: &'static str) -> Self {
        Self { name, legal, kind, remedy }
    }

    /// Whether it may be called in this state of an instance for this kind of simulation.
    #[inline(always)]
    pub fn is_legal(&self, state: State, integrator: Integrator) -> bool {
        self.legal & state as u8 != 0 && self.kind.is_none_or(|kind| kind == integrator)
    }

    /// Why it is not legal there, and what to do.
    pub fn refusal(&self, state: State, integrator: Integrator) -> String {
        match self.kind {
            Some(kind) if kind != integrator => {
                let (this, right) = (kind_name(integrator), kind_name(kind));
                format!("not legal of an instance for {this}: instantiate for {right}")
            }
            _ => format!("not legal in the state \"{}\": {}", state.name(), self.remedy),
        }
    }
}

/// What an instance is for.
pub const fn kind_name(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::Method => "co-simulation",
        Integrator::Host => "model exchange",
    }
}

const INSTANTIATED: u8 = State::Instantiated as u8;
const INITIALIZATION: u8 = State::Initialization as u8;
const STEPPING: u8 = State::StepComplete as u8 | State::StepFailed as u8;
const EVENT: u8 = State::EventMode as u8;
const CONTINUOUS: u8 = State::ContinuousTime as u8;
const TERMINATED: u8 = State::Terminated as u8;
/// After the initialization.
const RUNNING: u8 = STEPPING | EVENT | CONTINUOUS;
const ALIVE: u8 = INSTANTIATED | INITIALIZATION | RUNNING | TERMINATED;

const ANY: Option<Integrator> = None;
const CS: Option<Integrator> = Some(Integrator::Method);
const ME: Option<Integrator> = Some(Integrator::Host);

const RESET: &str = "call fmi2Reset first";
const INITIALIZE: &str = "call it between fmi2ExitInitializationMode and fmi2Terminate";
const IN_EVENT_MODE: &str = "call it in event mode, after fmi2ExitInitializationMode or fmi2EnterEventMode";
const IN_CONTINUOUS: &str = "call fmi2EnterContinuousTimeMode first";
const TO_SET: &str =
    "inputs are set until fmi2Terminate, parameters before fmi2ExitInitializationMode; or call fmi2Reset first";
const PARAMETERS: &str =
    "no input is of this type, and parameters are set before fmi2ExitInitializationMode: call fmi2Reset first";
const EXPERIMENT: &str = "call it before fmi2EnterInitializationMode, or fmi2Reset first";

/// The calls, in the order of the standard.
#[rustfmt::skip]
pub mod call {
    use super::*;

    macro_rules! calls {
        ($($constant:ident $name:literal $kind:ident $legal:expr, $remedy:expr;)*) => {
            $(
                #[doc = $name]
                pub const $constant: Call = Call::new($name, $legal, $kind, $remedy);
            )*
        };
    }

    calls! {
        SET_DEBUG_LOGGING            "fmi2SetDebugLogging"            ANY ALIVE, RESET;
        SETUP_EXPERIMENT             "fmi2SetupExperiment"            ANY INSTANTIATED, EXPERIMENT;
        ENTER_INITIALIZATION_MODE    "fmi2EnterInitializationMode"    ANY INSTANTIATED, RESET;
        EXIT_INITIALIZATION_MODE     "fmi2ExitInitializationMode"     ANY INITIALIZATION, "call fmi2EnterInitializationMode first";
        TERMINATE                    "fmi2Terminate"                  ANY RUNNING, INITIALIZE;
        RESET_INSTANCE               "fmi2Reset"                      ANY ALIVE, "call fmi2FreeInstance";
        GET_REAL                     "fmi2GetReal"                    ANY ALIVE, RESET;
        GET_INTEGER                  "fmi2GetInteger"                 ANY ALIVE, RESET;
        GET_BOOLEAN                  "fmi2GetBoolean"                 ANY ALIVE, RESET;
        GET_STRING                   "fmi2GetString"                  ANY ALIVE, RESET;
        SET_REAL                     "fmi2SetReal"                    ANY INSTANTIATED | INITIALIZATION | RUNNING, TO_SET;
        SET_INTEGER                  "fmi2SetInteger"                 ANY INSTANTIATED | INITIALIZATION, PARAMETERS;
        SET_BOOLEAN                  "fmi2SetBoolean"                 ANY INSTANTIATED | INITIALIZATION, PARAMETERS;
        SET_STRING                   "fmi2SetString"                  ANY INSTANTIATED | INITIALIZATION, PARAMETERS;
        GET_FMU_STATE                "fmi2GetFMUstate"                ANY ALIVE, RESET;
        SET_FMU_STATE                "fmi2SetFMUstate"                ANY ALIVE, RESET;
        FREE_FMU_STATE               "fmi2FreeFMUstate"               ANY ALIVE, RESET;
        SERIALIZED_FMU_STATE_SIZE    "fmi2SerializedFMUstateSize"     ANY ALIVE, RESET;
        SERIALIZE_FMU_STATE          "fmi2SerializeFMUstate"          ANY ALIVE, RESET;
        DESERIALIZE_FMU_STATE        "fmi2DeSerializeFMUstate"        ANY ALIVE, RESET;
        GET_DIRECTIONAL_DERIVATIVE   "fmi2GetDirectionalDerivative"   ANY INITIALIZATION | RUNNING | TERMINATED, "call fmi2EnterInitializationMode first";
        ENTER_EVENT_MODE             "fmi2EnterEventMode"             ME CONTINUOUS, IN_CONTINUOUS;
        NEW_DISCRETE_STATES          "fmi2NewDiscreteStates"          ME EVENT, IN_EVENT_MODE;
        ENTER_CONTINUOUS_TIME_MODE   "fmi2EnterContinuousTimeMode"    ME EVENT, IN_EVENT_MODE;
        COMPLETED_INTEGRATOR_STEP    "fmi2CompletedIntegratorStep"    ME CONTINUOUS, IN_CONTINUOUS;
        SET_TIME                     "fmi2SetTime"                    ME EVENT | CONTINUOUS, INITIALIZE;
        SET_CONTINUOUS_STATES        "fmi2SetContinuousStates"        ME CONTINUOUS, IN_CONTINUOUS;
        GET_DERIVATIVES              "fmi2GetDerivatives"             ME INITIALIZATION | EVENT | CONTINUOUS | TERMINATED, INITIALIZE;
        GET_EVENT_INDICATORS         "fmi2GetEventIndicators"         ME INITIALIZATION | EVENT | CONTINUOUS | TERMINATED, INITIALIZE;
        GET_CONTINUOUS_STATES        "fmi2GetContinuousStates"        ME INITIALIZATION | EVENT | CONTINUOUS | TERMINATED, INITIALIZE;
        GET_NOMINALS                 "fmi2GetNominalsOfContinuousStates" ME INSTANTIATED | INITIALIZATION | EVENT | CONTINUOUS | TERMINATED, RESET;
        SET_INPUT_DERIVATIVES        "fmi2SetRealInputDerivatives"    CS INSTANTIATED | INITIALIZATION | STEPPING, RESET;
        GET_OUTPUT_DERIVATIVES       "fmi2GetRealOutputDerivatives"   CS INITIALIZATION | STEPPING | TERMINATED, "call fmi2EnterInitializationMode first";
        DO_STEP                      "fmi2DoStep"                     CS STEPPING, INITIALIZE;
        CANCEL_STEP                  "fmi2CancelStep"                 CS ALIVE, RESET;
        GET_STATUS                   "fmi2GetStatus"                  CS STEPPING | TERMINATED, INITIALIZE;
        GET_REAL_STATUS              "fmi2GetRealStatus"              CS STEPPING | TERMINATED, INITIALIZE;
        GET_INTEGER_STATUS           "fmi2GetIntegerStatus"           CS STEPPING | TERMINATED, INITIALIZE;
        GET_BOOLEAN_STATUS           "fmi2GetBooleanStatus"           CS STEPPING | TERMINATED, INITIALIZE;
        GET_STRING_STATUS            "fmi2GetStringStatus"            CS STEPPING | TERMINATED, INITIALIZE;
    }
}
