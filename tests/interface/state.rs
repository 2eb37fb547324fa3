//! Rollback: after fmi2SetFMUstate everything goes on with the bits that followed when the state was saved, whatever
//! happened in between.

use crate::harness::{Instance, Life, Saved, Traveller, reference, refused, scene, tumbling};
use split_rotor::abi::{MODEL_EXCHANGE, Status};
use split_rotor::exports::{fmi2FreeFMUstate, fmi2SetFMUstate};
use std::ptr::null_mut;

#[test]
fn exact_what_follows_a_rollback_has_the_same_bits() {
    for mut traveller in Traveller::all() {
        let (mut saved, here) = (Saved::of(&traveller.instance), traveller.instance.snapshot());
        let bytes = saved.bytes(&traveller.instance);
        let expected = traveller.way_on();
        saved.restore(&traveller.instance);
        assert_eq!((traveller.instance.serialized(), traveller.instance.snapshot()), (bytes.clone(), here));
        // Saved once more into the same object; after the end, and after a reset.
        let object = saved.pointer();
        assert_eq!((saved.again(&traveller.instance), saved.pointer()), (Status::Ok, object));
        assert_eq!(saved.bytes(&traveller.instance), bytes);
        assert_eq!(traveller.way_on(), expected);
        for leave in [Instance::terminate, Instance::reset] {
            assert_eq!(leave(&mut traveller.instance), Status::Ok);
            saved.restore(&traveller.instance);
            assert_eq!(traveller.way_on(), expected);
        }
        // In another instance, after the first is gone.
        let other = Instance::of(traveller.kind);
        traveller.instance = other;
        saved.restore(&traveller.instance);
        assert_eq!(traveller.way_on(), expected);
        saved.free(&traveller.instance);
        Saved::unpack(&traveller.instance, &bytes);
        assert_eq!(traveller.way_on(), expected);
    }
}

#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn exact_a_state_brings_back_a_failed_step_and_settings() {
    let tumbling = tumbling();
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
fn exact_a_state_of_model_exchange_brings_back_its_chart() {
    let start = [("start.gamma.y", 1.9), ("start.omega.x", 1.0), ("start.omega.y", 20.0)];
    let mut instance = Instance::of(MODEL_EXCHANGE).started(&start);
    instance.settled();
    let chart = |instance: &mut Instance| instance.get_integer(reference("state.chart"));
    let before = (chart(&mut instance), Saved::of(&instance));
    // Through the event at 2 rad.
    let expected = instance.integrate(0.0, 1e-3, 30);
    let after = chart(&mut instance);
    assert_ne!(before.0, after);
    let mut other = Instance::of(MODEL_EXCHANGE);
    Saved::unpack(&other, &before.1.bytes(&instance));
    before.1.restore(&instance);
    for instance in [&mut instance, &mut other] {
        assert_eq!(chart(instance), before.0);
        assert_eq!(instance.integrate(0.0, 1e-3, 30), expected);
        assert_eq!(chart(instance), after);
    }
    before.1.free(&instance);
}

#[test]
fn fmi_a_state_of_one_kind_does_not_fit_the_other() {
    for (from, to) in Life::EACH.into_iter().flat_map(|from| Life::EACH.map(|to| (from, to))) {
        let (source, mut target) = (from.instance(), to.instance());
        let saved = Saved::of(&source);
        if from.kind == to.kind {
            saved.restore(&target);
            assert_eq!(target.serialized(), source.serialized(), "{from:?} into {to:?}");
        } else {
            let words = [format!("instance for {}", from.kind_name()), format!("this one is for {}", to.kind_name())];
            // SAFETY: a live instance and a state of this FMU's.
            let call = |c| unsafe { fmi2SetFMUstate(c, saved.pointer()) };
            refused(&mut target, call, &["fmi2SetFMUstate: ", &words[0], &words[1]]);
            assert_eq!(to.future(target), to.future(to.instance()), "{from:?} into {to:?}: the way on is the same");
        }
        saved.free(&source);
    }
}

#[test]
fn fmi_to_free_nothing_is_no_error() {
    for life in Life::EACH {
        let instance = life.instance();
        let (before, mut nothing) = (instance.serialized(), null_mut());
        // SAFETY: a live instance, and null or a place that holds null.
        let statuses = unsafe {
            let c = instance.component();
            [fmi2FreeFMUstate(c, null_mut()), fmi2FreeFMUstate(c, &raw mut nothing)]
        };
        assert_eq!((statuses, nothing), ([Status::Ok; 2], null_mut()));
        assert_eq!(instance.serialized(), before);
        assert_eq!(instance.journal.take(), []);
    }
}
