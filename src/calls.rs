//! The states of a co-simulation instance, and in which of them each function is legal.
//!
//! The table follows FMI 2.0.4, section 4.2.4, but lets a host read and set values already in the instantiated state and
//! go on after a discarded step from the last successful time, as real hosts do.

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
        }
    }
}

/// A function of FMI and the states in which it is legal.
pub struct Call {
    /// Its C name.
    pub name: &'static str,
    /// A set of [`State`] bits.
    legal: u8,
    /// What to do instead where it is not legal.
    pub remedy: &'static str,
}

impl Call {
    const fn new(name: &'static str, legal: u8, remedy: &'static str) -> Self {
        Self { name, legal, remedy }
    }

    /// Whether it may be called in this state.
    pub const fn is_legal(&self, state: State) -> bool {
        self.legal & state as u8 != 0
    }
}

const INSTANTIATED: u8 = State::Instantiated as u8;
const INITIALIZATION: u8 = State::Initialization as u8;
const STEPPING: u8 = State::StepComplete as u8 | State::StepFailed as u8;
const ALIVE: u8 = INSTANTIATED | INITIALIZATION | STEPPING | State::Terminated as u8;

const RESET: &str = "call fmi2Reset first";
const INITIALIZE: &str = "call it between fmi2ExitInitializationMode and fmi2Terminate";
const MODEL_EXCHANGE: &str = "instantiate for co-simulation and use fmi2DoStep";

/// The calls, in the order of the standard.
#[rustfmt::skip]
pub mod call {
    use super::*;

    macro_rules! calls {
        ($($constant:ident $name:literal $legal:expr, $remedy:expr;)*) => {
            $(
                #[doc = $name]
                pub const $constant: Call = Call::new($name, $legal, $remedy);
            )*
        };
    }

    calls! {
        SET_DEBUG_LOGGING            "fmi2SetDebugLogging"            ALIVE, RESET;
        SETUP_EXPERIMENT             "fmi2SetupExperiment"            INSTANTIATED, "call it before fmi2EnterInitializationMode, or fmi2Reset first";
        ENTER_INITIALIZATION_MODE    "fmi2EnterInitializationMode"    INSTANTIATED, RESET;
        EXIT_INITIALIZATION_MODE     "fmi2ExitInitializationMode"     INITIALIZATION, "call fmi2EnterInitializationMode first";
        TERMINATE                    "fmi2Terminate"                  STEPPING, INITIALIZE;
        RESET_INSTANCE               "fmi2Reset"                      ALIVE, "call fmi2FreeInstance";
        GET_REAL                     "fmi2GetReal"                    ALIVE, RESET;
        GET_INTEGER                  "fmi2GetInteger"                 ALIVE, RESET;
        GET_BOOLEAN                  "fmi2GetBoolean"                 ALIVE, RESET;
        GET_STRING                   "fmi2GetString"                  ALIVE, RESET;
        SET_REAL                     "fmi2SetReal"                    INSTANTIATED | INITIALIZATION, PARAMETERS;
        SET_INTEGER                  "fmi2SetInteger"                 INSTANTIATED | INITIALIZATION, PARAMETERS;
        SET_BOOLEAN                  "fmi2SetBoolean"                 INSTANTIATED | INITIALIZATION, PARAMETERS;
        SET_STRING                   "fmi2SetString"                  INSTANTIATED | INITIALIZATION, PARAMETERS;
        GET_FMU_STATE                "fmi2GetFMUstate"                ALIVE, RESET;
        SET_FMU_STATE                "fmi2SetFMUstate"                ALIVE, RESET;
        FREE_FMU_STATE               "fmi2FreeFMUstate"               ALIVE, RESET;
        SERIALIZED_FMU_STATE_SIZE    "fmi2SerializedFMUstateSize"     ALIVE, RESET;
        SERIALIZE_FMU_STATE          "fmi2SerializeFMUstate"          ALIVE, RESET;
        DESERIALIZE_FMU_STATE        "fmi2DeSerializeFMUstate"        ALIVE, RESET;
        GET_DIRECTIONAL_DERIVATIVE   "fmi2GetDirectionalDerivative"   ALIVE, RESET;
        ENTER_EVENT_MODE             "fmi2EnterEventMode"             ALIVE, MODEL_EXCHANGE;
        NEW_DISCRETE_STATES          "fmi2NewDiscreteStates"          ALIVE, MODEL_EXCHANGE;
        ENTER_CONTINUOUS_TIME_MODE   "fmi2EnterContinuousTimeMode"    ALIVE, MODEL_EXCHANGE;
        COMPLETED_INTEGRATOR_STEP    "fmi2CompletedIntegratorStep"    ALIVE, MODEL_EXCHANGE;
        SET_TIME                     "fmi2SetTime"                    ALIVE, MODEL_EXCHANGE;
        SET_CONTINUOUS_STATES        "fmi2SetContinuousStates"        ALIVE, MODEL_EXCHANGE;
        GET_DERIVATIVES              "fmi2GetDerivatives"             ALIVE, MODEL_EXCHANGE;
        GET_EVENT_INDICATORS         "fmi2GetEventIndicators"         ALIVE, MODEL_EXCHANGE;
        GET_CONTINUOUS_STATES        "fmi2GetContinuousStates"        ALIVE, MODEL_EXCHANGE;
        GET_NOMINALS                 "fmi2GetNominalsOfContinuousStates" ALIVE, MODEL_EXCHANGE;
        SET_INPUT_DERIVATIVES        "fmi2SetRealInputDerivatives"    ALIVE, RESET;
        GET_OUTPUT_DERIVATIVES       "fmi2GetRealOutputDerivatives"   ALIVE, RESET;
        DO_STEP                      "fmi2DoStep"                     STEPPING, INITIALIZE;
        CANCEL_STEP                  "fmi2CancelStep"                 ALIVE, RESET;
        GET_STATUS                   "fmi2GetStatus"                  STEPPING | State::Terminated as u8, INITIALIZE;
        GET_REAL_STATUS              "fmi2GetRealStatus"              STEPPING | State::Terminated as u8, INITIALIZE;
        GET_INTEGER_STATUS           "fmi2GetIntegerStatus"           STEPPING | State::Terminated as u8, INITIALIZE;
        GET_BOOLEAN_STATUS           "fmi2GetBooleanStatus"           STEPPING | State::Terminated as u8, INITIALIZE;
        GET_STRING_STATUS            "fmi2GetStringStatus"            STEPPING | State::Terminated as u8, INITIALIZE;
    }

    const PARAMETERS: &str = "all settable variables are fixed parameters: set them before fmi2ExitInitializationMode, or call fmi2Reset first";
}
