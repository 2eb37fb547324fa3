//! Functions for co-simulation (FMI 2.0.4, section 4.2).

use crate::arguments::{place, room, values};
use crate::fmi2::abi::*;
use crate::instance::{Failure, Reply};

/// Answers a question for a status of the kind `right`, the only one of its type.
///
/// # Safety
/// `value` is null or can be written.
unsafe fn answer<T>(kind: Choice, (right, name): (Choice, &str), value: *mut T, status: T) -> Reply {
    // SAFETY: the caller's promise.
    let place = unsafe { place(value, "value") }?;
    if kind != right {
        return Err(Failure::Error(format!("status kind {kind} has no answer of this type: ask for {name}")));
    }
    place.write(status);
    Ok(())
}

/// Refuses what this FMU has no answer to.
fn absent(why: &str) -> Reply {
    Err(Failure::Error(why.into()))
}

export! {
    /// Sends derivatives of inputs, of order 1 or 2, at the communication point.
    fmi2SetRealInputDerivatives(
        instance, vr: *const ValueReference, n: Size, order: *const Integer, value: *const Real
    ) {
        instance.set_input_derivatives(values(vr, n, "vr")?, values(order, n, "order")?, values(value, n, "value")?)
    }

    /// Reads derivatives of outputs with respect to time, of order 1, at the communication point.
    fmi2GetRealOutputDerivatives(
        instance, vr: *const ValueReference, n: Size, order: *const Integer, value: *mut Real
    ) {
        instance.output_derivatives(values(vr, n, "vr")?, values(order, n, "order")?, room(value, n, "value")?)
    }

    /// Moves the communication point from `from` by `step` \[s].
    fmi2DoStep(instance, from: Real, step: Real, _no_set_state_before: Boolean) { instance.do_step(from, step) }

    /// No step is asynchronous.
    fmi2CancelStep(_instance) { absent("no step is asynchronous, so none can be cancelled") }

    /// What the last step returned.
    fmi2GetStatus(instance, kind: Choice, value: *mut Status) {
        let status = if instance.step_failed() { Status::Discard } else { Status::Ok };
        answer(kind, (status_kind::DO_STEP, "fmi2DoStepStatus"), value, status)
    }

    /// The last successful time \[s].
    fmi2GetRealStatus(instance, kind: Choice, value: *mut Real) {
        answer(kind, (status_kind::LAST_SUCCESSFUL_TIME, "fmi2LastSuccessfulTime"), value, instance.now())
    }

    /// No status is an Integer.
    fmi2GetIntegerStatus(_instance, _kind: Choice, _value: *mut Integer) {
        absent("no status kind has an answer of type Integer")
    }

    /// Whether no further step is possible.
    fmi2GetBooleanStatus(instance, kind: Choice, value: *mut Boolean) {
        answer(kind, (status_kind::TERMINATED, "fmi2Terminated"), value, instance.step_failed().into())
    }

    /// No step is ever pending.
    fmi2GetStringStatus(_instance, _kind: Choice, _value: *mut Text) {
        absent("no step is pending: none is asynchronous")
    }
}
