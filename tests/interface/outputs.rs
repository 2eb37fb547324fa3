//! What a host lends to be written: where a call succeeds, all of it is written and nothing beyond, whatever was there
//! before; nobody need have initialised it. `arguments.rs` holds what refusals leave alone.

use crate::harness::{Instance, Life, Saved, Stage, reals, reference, scene};
use split_rotor::abi::*;
use split_rotor::exports::*;
use split_rotor::scene::Simulation;
use std::fmt::Debug;
use std::mem::MaybeUninit;

const STATES: usize = Simulation::STATES;

/// Calls a function that writes `n` values to room that nobody initialised, then to room full of one byte and of another;
/// what it wrote is the same each time.
#[track_caller]
fn written<T: Copy + PartialEq + Debug>(n: usize, call: impl Fn(*mut T) -> Status) {
    let mut raw = Vec::<T>::with_capacity(n);
    assert_eq!(call(raw.as_mut_ptr()), Status::Ok);
    // SAFETY: the call succeeded. Were less written, the values below would differ, and memcheck would see it here.
    unsafe { raw.set_len(n) };
    for byte in [0x55_u8, 0x2a] {
        let mut room = vec![MaybeUninit::<T>::uninit(); n + 1];
        // SAFETY: room for n + 1 values.
        unsafe { room.as_mut_ptr().write_bytes(byte, n + 1) };
        assert_eq!(call(room.as_mut_ptr().cast()), Status::Ok);
        // SAFETY: the call succeeded; what it did not write would be other bytes, which are a number all the same.
        let values: Vec<T> = room[..n].iter().map(|value| unsafe { value.assume_init() }).collect();
        assert_eq!(values, raw);
        // SAFETY: the last value is bytes of this test's.
        let last = unsafe { std::slice::from_raw_parts(room[n].as_ptr().cast::<u8>(), size_of::<T>()) };
        assert!(last.iter().all(|there| *there == byte), "nothing is written beyond");
    }
}

/// An instance where all of its variables are finite.
fn moving(kind: Choice) -> Instance {
    let stage = if kind == MODEL_EXCHANGE { Stage::ContinuousTime } else { Stage::StepComplete };
    Life::new(kind, stage).instance()
}

#[test]
fn fmi_values_are_written_in_full() {
    for kind in [CO_SIMULATION, MODEL_EXCHANGE] {
        let instance = moving(kind);
        let c = instance.component();
        // A short list takes another way than a long one.
        let all = reals(scene());
        for vr in [&all[..1], &all[..5], &all.repeat(3)] {
            // SAFETY: a live instance, and arrays of the same length.
            written::<Real>(vr.len(), |values| unsafe { fmi2GetReal(c, vr.as_ptr(), vr.len(), values) });
        }
        let method = [reference("solver.method"); 2];
        // SAFETY: the same.
        written::<Integer>(2, |values| unsafe { fmi2GetInteger(c, method.as_ptr(), 2, values) });
        let (unknowns, knowns, seeds) = ([reference("r_c.x"); 2], [reference("state.r.x")], [1.0]);
        // SAFETY: the same.
        written::<Real>(2, |values| unsafe {
            fmi2GetDirectionalDerivative(c, unknowns.as_ptr(), 2, knowns.as_ptr(), 1, seeds.as_ptr(), values)
        });
        let saved = Saved::of(&instance);
        let size = saved.bytes(&instance).len();
        // SAFETY: a live instance, a state of its own, and room for as many bytes as told.
        written::<Byte>(size, |bytes| unsafe { fmi2SerializeFMUstate(c, saved.pointer(), bytes, size) });
        saved.free(&instance);
    }
}

#[test]
fn fmi_states_and_rates_are_written_in_full() {
    let instance = moving(MODEL_EXCHANGE);
    for get in [fmi2GetContinuousStates, fmi2GetDerivatives, fmi2GetNominalsOfContinuousStates] {
        // SAFETY: a live instance, and room for as many values as told.
        written::<Real>(STATES, |values| unsafe { get(instance.component(), values, STATES) });
    }
}

#[test]
fn fmi_statuses_and_output_derivatives_are_written_in_full() {
    let instance = moving(CO_SIMULATION);
    let c = instance.component();
    let (outputs, orders) = ([reference("r_c.x"); 2], [1; 2]);
    // SAFETY: a live instance, and room for as many values as told.
    written::<Real>(2, |values| unsafe {
        fmi2GetRealOutputDerivatives(c, outputs.as_ptr(), 2, orders.as_ptr(), values)
    });
    // SAFETY: the same. A status is a number in C, and what was there before need not be one.
    written::<Choice>(1, |value| unsafe { fmi2GetStatus(c, status_kind::DO_STEP, value.cast()) });
    // SAFETY: the same.
    written::<Real>(1, |value| unsafe { fmi2GetRealStatus(c, status_kind::LAST_SUCCESSFUL_TIME, value) });
    // SAFETY: the same.
    written::<Boolean>(1, |value| unsafe { fmi2GetBooleanStatus(c, status_kind::TERMINATED, value) });
}
