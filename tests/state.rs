//! Rollback: after fmi2SetFMUstate everything goes on with the bits that followed when the state was saved, whatever
//! happened in between.
#![allow(unsafe_code, reason = "FMU states are raw pointers")]

mod harness;

use harness::{Instance, Saved, reference, scene, there, tumbling};
use proptest::prelude::*;
use split_rotor::abi::{Real, Status};
use split_rotor::exports::{fmi2FreeFMUstate, fmi2GetFMUstate, fmi2SetFMUstate};
use std::ptr::null_mut;

/// The paper's rotor; one that is damped; one that tumbles through both charts.
const STARTS: [&[(&str, Real)]; 3] = [
    &[],
    &[("support.d1", 30.0), ("support.d2", 0.5)],
    &[("support.c2", 0.0), ("start.omega.x", 1.0), ("start.omega.y", 20.0)],
];

/// Walks through steps [s] from a time, and what all variables show after each.
fn walk(instance: &mut Instance, from: Real, steps: &[Real]) -> Vec<Vec<u64>> {
    let mut t = from;
    let one = |step: &Real| {
        assert_eq!(instance.do_step(t, *step), Status::Ok);
        t += step;
        instance.bits()
    };
    steps.iter().map(one).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(48) })]

    #[test]
    fn exact_what_follows_a_rollback_has_the_same_bits(
        start in 0..STARTS.len(),
        method in 2..=3,
        before in prop::collection::vec(1e-4..0.1_f64, 0..8),
        after in prop::collection::vec(1e-4..0.1_f64, 1..8),
        detour in prop::collection::vec(1e-4..0.3_f64, 0..4),
    ) {
        let mut instance = Instance::quiet();
        instance.set_method(method);
        let mut instance = instance.started(&there(STARTS[start]));
        walk(&mut instance, 0.0, &before);
        let now: Real = before.iter().fold(0.0, |t, step| t + step);
        let here = instance.bits();
        let mut saved = Saved::of(&instance);
        let expected = walk(&mut instance, now, &after);
        saved.restore(&instance);
        prop_assert_eq!(instance.bits(), here.clone());
        // Another way, and back; saved once more into the same object.
        walk(&mut instance, now, &detour);
        saved.restore(&instance);
        prop_assert_eq!(saved.again(&instance), Status::Ok);
        prop_assert_eq!(walk(&mut instance, now, &after), expected.clone());
        // After the end, and after a reset.
        assert_eq!(instance.terminate(), Status::Ok);
        saved.restore(&instance);
        prop_assert_eq!(walk(&mut instance, now, &after), expected.clone());
        assert_eq!(instance.reset(), Status::Ok);
        saved.restore(&instance);
        prop_assert_eq!(walk(&mut instance, now, &after), expected.clone());
        // In another instance.
        let mut other = Instance::quiet();
        saved.restore(&other);
        prop_assert_eq!(walk(&mut other, now, &after), expected);
        saved.free(&instance);
    }
}

#[test]
fn exact_a_state_brings_back_a_failed_step_and_settings() {
    let Some(tumbling) = tumbling() else { return };
    let mut instance = Instance::quiet();
    let fresh = Saved::of(&instance);
    instance.set_all(&tumbling);
    let mut instance = instance.initialized();
    let start = Saved::of(&instance);
    assert_eq!(instance.do_step(0.0, 1.0), Status::Discard);
    let failed = (Saved::of(&instance), instance.last_successful_time(), instance.bits());
    start.restore(&instance);
    assert_eq!(instance.last_successful_time(), Ok(0.0));
    assert_eq!(instance.do_step(0.0, 0.05), Status::Ok);
    failed.0.restore(&instance);
    assert_eq!((instance.last_successful_time(), instance.bits()), (failed.1, failed.2));
    assert_eq!((instance.step_status(), instance.terminated()), (Ok(Status::Discard), Ok(true)));
    // Back to before anything was set.
    fresh.restore(&instance);
    assert_eq!(instance.get("support.c1"), scene().starts[&reference("support.c1")]);
    let expected = Instance::quiet().started(&[]).run(0.0, 0.01, 20);
    assert_eq!(instance.started(&[]).run(0.0, 0.01, 20), expected);
}

#[test]
fn fmi_null_states_are_errors() {
    let instance = Instance::quiet();
    // SAFETY: a live instance and null pointers.
    unsafe {
        assert_eq!(fmi2GetFMUstate(instance.component(), null_mut()), Status::Error);
        assert_eq!(fmi2SetFMUstate(instance.component(), null_mut()), Status::Error);
        assert_eq!(fmi2FreeFMUstate(instance.component(), null_mut()), Status::Ok);
    }
    let messages: Vec<_> = instance.journal.take().into_iter().map(|record| record.message).collect();
    let null = "FMUstate is a null pointer";
    assert_eq!(messages, [format!("fmi2GetFMUstate: {null}"), format!("fmi2SetFMUstate: {null}")]);
}
