//! Functions for model exchange (FMI 2.0.4, section 3.2).

use crate::abi::*;
use crate::calls::call;
use crate::guard::{enter, room, values};
use crate::instance::Failure;

/// Enters event mode.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterEventMode(component: Component) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { enter(component, &call::ENTER_EVENT_MODE, |instance| instance.enter_event_mode()) }
}

/// Changes the chart of the states, where it should be.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2NewDiscreteStates(component: Component, info: *mut EventInfo) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::NEW_DISCRETE_STATES, |instance| {
            if info.is_null() {
                return Err(Failure::error("eventInfo is a null pointer"));
            }
            let events = instance.new_discrete_states()?;
            info.write(EventInfo {
                new_discrete_states_needed: FALSE,
                terminate_simulation: FALSE,
                nominals_of_continuous_states_changed: FALSE,
                values_of_continuous_states_changed: events.states_changed.into(),
                next_event_time_defined: FALSE,
                next_event_time: 0.0,
            });
            Ok(Status::Ok)
        })
    }
}

/// Enters continuous-time mode.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterContinuousTimeMode(component: Component) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { enter(component, &call::ENTER_CONTINUOUS_TIME_MODE, |instance| instance.enter_continuous_time_mode()) }
}

/// The host completed a step; asks for event mode where the chart should be changed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CompletedIntegratorStep(
    component: Component,
    _no_set_state_before: Boolean,
    enter_event_mode: *mut Boolean,
    terminate: *mut Boolean,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::COMPLETED_INTEGRATOR_STEP, |instance| {
            if enter_event_mode.is_null() || terminate.is_null() {
                return Err(Failure::error("enterEventMode or terminateSimulation is a null pointer"));
            }
            enter_event_mode.write(instance.completed_integrator_step()?.into());
            terminate.write(FALSE);
            Ok(Status::Ok)
        })
    }
}

/// Sets the time \[s].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetTime(component: Component, time: Real) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { enter(component, &call::SET_TIME, |instance| instance.set_time(time)) }
}

/// Sets the continuous states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetContinuousStates(component: Component, states: *const Real, n: Size) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::SET_CONTINUOUS_STATES, |instance| {
            instance.set_continuous_states(values(states, n, "x")?)
        })
    }
}

/// Reads the rates of the continuous states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDerivatives(component: Component, derivatives: *mut Real, n: Size) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::GET_DERIVATIVES, |instance| instance.derivatives(room(derivatives, n, "derivatives")?))
    }
}

/// Reads the event indicators, of which there are none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetEventIndicators(component: Component, _indicators: *mut Real, n: Size) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { enter(component, &call::GET_EVENT_INDICATORS, |instance| instance.event_indicators(n)) }
}

/// Reads the continuous states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetContinuousStates(component: Component, states: *mut Real, n: Size) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::GET_CONTINUOUS_STATES, |instance| instance.continuous_states(room(states, n, "x")?))
    }
}

/// Reads what each continuous state counts with.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetNominalsOfContinuousStates(
    component: Component,
    nominals: *mut Real,
    n: Size,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { enter(component, &call::GET_NOMINALS, |instance| instance.nominals(room(nominals, n, "x_nominal")?)) }
}
