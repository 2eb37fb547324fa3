//! Functions for co-simulation (FMI 2.0.4, section 4.2).

use super::absent;
use crate::abi::*;
use crate::calls::{Call, call};
use crate::guard::{enter, room, values};
use crate::instance::{Failure, Instance};

/// Asks for one status and writes the answer to `value`.
///
/// # Safety
/// As [`enter`]; `value` is null or can be written.
unsafe fn answer<T>(
    component: Component,
    call: &Call,
    value: *mut T,
    ask: impl FnOnce(&Instance) -> Result<T, Failure>,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        enter(component, call, |instance| {
            if value.is_null() {
                return Err(Failure::error("value is a null pointer"));
            }
            value.write(ask(instance)?);
            Ok(Status::Ok)
        })
    }
}

/// Sends derivatives of inputs, of order 1 or 2, at the communication point.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    component: Component,
    references: *const ValueReference,
    n: Size,
    order: *const Integer,
    value: *const Real,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::SET_INPUT_DERIVATIVES, |instance| {
            instance.set_input_derivatives(
                values(references, n, "vr")?,
                values(order, n, "order")?,
                values(value, n, "value")?,
            )
        })
    }
}

/// Reads derivatives of outputs with respect to time, of order 1, at the communication point.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    component: Component,
    references: *const ValueReference,
    n: Size,
    order: *const Integer,
    value: *mut Real,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::GET_OUTPUT_DERIVATIVES, |instance| {
            instance.output_derivatives(
                values(references, n, "vr")?,
                values(order, n, "order")?,
                room(value, n, "value")?,
            )
        })
    }
}

/// Moves the communication point from `from` by `step` \[s].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    component: Component,
    from: Real,
    step: Real,
    _no_set_state_before: Boolean,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { enter(component, &call::DO_STEP, |instance| instance.do_step(from, step)) }
}

/// No step is asynchronous.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(component: Component) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::CANCEL_STEP, "no step is asynchronous, so none can be cancelled") }
}

/// What the last step returned.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStatus(component: Component, kind: Choice, value: *mut Status) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { answer(component, &call::GET_STATUS, value, |instance| instance.status(kind)) }
}

/// The last successful time \[s].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(component: Component, kind: Choice, value: *mut Real) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { answer(component, &call::GET_REAL_STATUS, value, |instance| instance.real_status(kind)) }
}

/// No status is an Integer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetIntegerStatus(component: Component, _kind: Choice, _value: *mut Integer) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::GET_INTEGER_STATUS, "no status kind has an answer of type Integer") }
}

/// Whether no further step is possible.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(component: Component, kind: Choice, value: *mut Boolean) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { answer(component, &call::GET_BOOLEAN_STATUS, value, |instance| instance.boolean_status(kind)) }
}

/// No step is ever pending.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStringStatus(component: Component, _kind: Choice, _value: *mut Text) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { absent(component, &call::GET_STRING_STATUS, "no step is pending: none is asynchronous") }
}
