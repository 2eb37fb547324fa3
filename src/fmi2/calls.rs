//! In which states of an instance each function is legal.
//!
//! The table follows FMI 2.0.4, sections 3.2.3 and 4.2.4, but is lenient where real hosts need it (docs/fmi.md).

use crate::instance::{State, kind_name};
use split_rotor_model::simulation::Integrator;

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

/// The calls, in the order of the standard, each under the name of its function.
#[rustfmt::skip]
#[allow(non_upper_case_globals)]
pub mod call {
    use super::*;

    macro_rules! calls {
        ($($name:ident $kind:ident $legal:expr, $remedy:expr;)*) => {
            $(
                pub const $name: Call = Call::new(stringify!($name), $legal, $kind, $remedy);
            )*
        };
    }

    calls! {
        fmi2SetDebugLogging               ANY ALIVE, RESET;
        fmi2SetupExperiment               ANY INSTANTIATED, EXPERIMENT;
        fmi2EnterInitializationMode       ANY INSTANTIATED, RESET;
        fmi2ExitInitializationMode        ANY INITIALIZATION, "call fmi2EnterInitializationMode first";
        fmi2Terminate                     ANY RUNNING, INITIALIZE;
        fmi2Reset                         ANY ALIVE, "call fmi2FreeInstance";
        fmi2GetReal                       ANY ALIVE, RESET;
        fmi2GetInteger                    ANY ALIVE, RESET;
        fmi2GetBoolean                    ANY ALIVE, RESET;
        fmi2GetString                     ANY ALIVE, RESET;
        fmi2SetReal                       ANY INSTANTIATED | INITIALIZATION | RUNNING, TO_SET;
        fmi2SetInteger                    ANY INSTANTIATED | INITIALIZATION, PARAMETERS;
        fmi2SetBoolean                    ANY INSTANTIATED | INITIALIZATION, PARAMETERS;
        fmi2SetString                     ANY INSTANTIATED | INITIALIZATION, PARAMETERS;
        fmi2GetFMUstate                   ANY ALIVE, RESET;
        fmi2SetFMUstate                   ANY ALIVE, RESET;
        fmi2FreeFMUstate                  ANY ALIVE, RESET;
        fmi2SerializedFMUstateSize        ANY ALIVE, RESET;
        fmi2SerializeFMUstate             ANY ALIVE, RESET;
        fmi2DeSerializeFMUstate           ANY ALIVE, RESET;
        fmi2GetDirectionalDerivative      ANY INITIALIZATION | RUNNING | TERMINATED, "call fmi2EnterInitializationMode first";
        fmi2EnterEventMode                ME CONTINUOUS, IN_CONTINUOUS;
        fmi2NewDiscreteStates             ME EVENT, IN_EVENT_MODE;
        fmi2EnterContinuousTimeMode       ME EVENT, IN_EVENT_MODE;
        fmi2CompletedIntegratorStep       ME CONTINUOUS, IN_CONTINUOUS;
        fmi2SetTime                       ME EVENT | CONTINUOUS, INITIALIZE;
        fmi2SetContinuousStates           ME CONTINUOUS, IN_CONTINUOUS;
        fmi2GetDerivatives                ME INITIALIZATION | EVENT | CONTINUOUS | TERMINATED, INITIALIZE;
        fmi2GetEventIndicators            ME INITIALIZATION | EVENT | CONTINUOUS | TERMINATED, INITIALIZE;
        fmi2GetContinuousStates           ME INITIALIZATION | EVENT | CONTINUOUS | TERMINATED, INITIALIZE;
        fmi2GetNominalsOfContinuousStates ME INSTANTIATED | INITIALIZATION | EVENT | CONTINUOUS | TERMINATED, RESET;
        fmi2SetRealInputDerivatives       CS INSTANTIATED | INITIALIZATION | STEPPING, RESET;
        fmi2GetRealOutputDerivatives      CS INITIALIZATION | STEPPING | TERMINATED, "call fmi2EnterInitializationMode first";
        fmi2DoStep                        CS STEPPING, INITIALIZE;
        fmi2CancelStep                    CS ALIVE, RESET;
        fmi2GetStatus                     CS STEPPING | TERMINATED, INITIALIZE;
        fmi2GetRealStatus                 CS STEPPING | TERMINATED, INITIALIZE;
        fmi2GetIntegerStatus              CS STEPPING | TERMINATED, INITIALIZE;
        fmi2GetBooleanStatus              CS STEPPING | TERMINATED, INITIALIZE;
        fmi2GetStringStatus               CS STEPPING | TERMINATED, INITIALIZE;
    }
}
