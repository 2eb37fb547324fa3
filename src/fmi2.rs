//! FMI 2.0: `abi` names the C types, `exports` the 44 functions, each one line through the door in `guard`; `calls` tells
//! where a function is legal, `logger` speaks to the host.

pub mod abi;
mod calls;
pub mod exports;
mod guard;
mod logger;

use crate::instance::Names;

/// The functions that the messages of an instance name.
const NAMES: Names = Names {
    instantiate: "fmi2Instantiate",
    experiment: "fmi2SetupExperiment",
    end_of_initialization: "fmi2ExitInitializationMode",
    set_states: "fmi2SetContinuousStates",
    terminate: "fmi2Terminate",
    reset: "fmi2Reset",
};
