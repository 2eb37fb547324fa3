//! Functions for model exchange (FMI 2.0.4, section 3.2), which is not there yet: an instance for it cannot be made.

use super::absent;
use crate::abi::*;
use crate::calls::call;

const ABSENT: &str = "there is no model exchange yet";

/// Not there yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterEventMode(component: Component) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::ENTER_EVENT_MODE, ABSENT) }
}

/// Not there yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2NewDiscreteStates(component: Component, _info: *mut EventInfo) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::NEW_DISCRETE_STATES, ABSENT) }
}

/// Not there yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterContinuousTimeMode(component: Component) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::ENTER_CONTINUOUS_TIME_MODE, ABSENT) }
}

/// Not there yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CompletedIntegratorStep(
    component: Component,
    _no_set_state_before: Boolean,
    _enter_event_mode: *mut Boolean,
    _terminate: *mut Boolean,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::COMPLETED_INTEGRATOR_STEP, ABSENT) }
}

/// Not there yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetTime(component: Component, _time: Real) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::SET_TIME, ABSENT) }
}

/// Not there yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetContinuousStates(component: Component, _states: *const Real, _n: Size) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::SET_CONTINUOUS_STATES, ABSENT) }
}

/// Not there yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDerivatives(component: Component, _derivatives: *mut Real, _n: Size) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::GET_DERIVATIVES, ABSENT) }
}

/// Not there yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetEventIndicators(component: Component, _indicators: *mut Real, _n: Size) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::GET_EVENT_INDICATORS, ABSENT) }
}

/// Not there yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetContinuousStates(component: Component, _states: *mut Real, _n: Size) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::GET_CONTINUOUS_STATES, ABSENT) }
}

/// Not there yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetNominalsOfContinuousStates(
    component: Component,
    _nominals: *mut Real,
    _n: Size,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::GET_NOMINALS, ABSENT) }
}
