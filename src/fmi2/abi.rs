//! The C types of FMI 2.0 (fmi2TypesPlatform.h, fmi2FunctionTypes.h). What a host passes as an enumeration arrives as a
//! plain integer, since a value outside the enumeration would otherwise be undefined behaviour.
#![allow(unsafe_code)]

use libc::{c_char, c_double, c_int, c_uint, c_void, size_t};

/// fmi2Component
pub type Component = *mut c_void;
/// fmi2ComponentEnvironment
pub type Environment = *mut c_void;
/// fmi2FMUstate
pub type FmuState = *mut c_void;
/// fmi2ValueReference
pub type ValueReference = c_uint;
/// fmi2Real
pub type Real = c_double;
/// fmi2Integer
pub type Integer = c_int;
/// fmi2Boolean
pub type Boolean = c_int;
/// fmi2Char
pub type Char = c_char;
/// fmi2String
pub type Text = *const Char;
/// fmi2Byte
pub type Byte = c_char;
/// fmi2Type and fmi2StatusKind, as they arrive
pub type Choice = c_int;
/// size_t
pub type Size = size_t;

/// fmi2False
pub const FALSE: Boolean = 0;
/// fmi2True
pub const TRUE: Boolean = 1;
/// fmi2ModelExchange
pub const MODEL_EXCHANGE: Choice = 0;
/// fmi2CoSimulation
pub const CO_SIMULATION: Choice = 1;

/// fmi2Status
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// All well.
    Ok = 0,
    /// All well, but look at the log.
    Warning = 1,
    /// Not done; the instance stands where it stood, or at the last successful time.
    Discard = 2,
    /// Refused; nothing changed.
    Error = 3,
    /// The instance is lost.
    Fatal = 4,
    /// Never returned: no step is asynchronous.
    Pending = 5,
}

/// fmi2StatusKind
pub mod status_kind {
    use super::Choice;

    /// fmi2DoStepStatus
    pub const DO_STEP: Choice = 0;
    /// fmi2PendingStatus
    pub const PENDING: Choice = 1;
    /// fmi2LastSuccessfulTime
    pub const LAST_SUCCESSFUL_TIME: Choice = 2;
    /// fmi2Terminated
    pub const TERMINATED: Choice = 3;
}

/// fmi2CallbackLogger
pub type LoggerCallback =
    unsafe extern "C" fn(environment: Environment, instance: Text, Status, category: Text, message: Text, ...);

/// fmi2CallbackFunctions
#[repr(C)]
#[derive(Clone, Copy)]
pub struct CallbackFunctions {
    /// logger
    pub logger: Option<LoggerCallback>,
    /// allocateMemory, which is not used
    pub allocate_memory: Option<unsafe extern "C" fn(size_t, size_t) -> *mut c_void>,
    /// freeMemory, which is not used
    pub free_memory: Option<unsafe extern "C" fn(*mut c_void)>,
    /// stepFinished, which is not used
    pub step_finished: Option<unsafe extern "C" fn(Environment, Status)>,
    /// componentEnvironment, handed back to the logger
    pub environment: Environment,
}

/// fmi2EventInfo
#[repr(C)]
pub struct EventInfo {
    /// newDiscreteStatesNeeded
    pub new_discrete_states_needed: Boolean,
    /// terminateSimulation
    pub terminate_simulation: Boolean,
    /// nominalsOfContinuousStatesChanged
    pub nominals_of_continuous_states_changed: Boolean,
    /// valuesOfContinuousStatesChanged
    pub values_of_continuous_states_changed: Boolean,
    /// nextEventTimeDefined
    pub next_event_time_defined: Boolean,
    /// nextEventTime
    pub next_event_time: Real,
}
