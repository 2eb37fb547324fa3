//! fmi2Instantiate, and what an instance says: to whom, under which name, in which categories. That the struct of callbacks may go
//! meanwhile, the harness tries with each instance; percent signs in messages: tests/c/logs.c.

use crate::harness::{Instance, Record, Request, only, scene, tumbling};
use split_rotor::abi::*;
use split_rotor::exports;
use std::ffi::{CStr, CString};
use std::ptr::null;

/// The one record of a refused fmi2Instantiate.
#[track_caller]
fn not_instantiated(request: Request) -> Record {
    let Err(records) = request.instantiate() else { panic!("the request is wrong") };
    only(&records, Status::Error, &["fmi2Instantiate: "]).clone()
}

#[test]
fn fmi_instantiate_refuses_bad_arguments_and_says_why() {
    let right = Request::default;
    let guid = split_rotor_model::xml::guid(scene());
    for wrong in [c"".to_owned(), c"{00000000-0000-0000-0000-000000000000}".to_owned(), {
        CString::new(guid.trim_matches(['{', '}'])).expect("a GUID holds no zero")
    }] {
        let record = not_instantiated(Request { guid: Some(wrong.clone()), ..right() });
        let wrong = wrong.to_str().expect("ASCII");
        let differ = "the binary and the modelDescription.xml differ";
        assert!([&guid, wrong, differ].iter().all(|word| record.message.contains(word)), "{record:?}");
        assert_eq!(record.instance, "rotor");
    }
    assert!(not_instantiated(Request { guid: None, ..right() }).message.contains("fmuGUID is a null pointer"));
    let record = not_instantiated(Request { name: None, ..right() });
    assert!(record.message.contains("instanceName is a null pointer"));
    assert_eq!(record.instance, "", "no name, but a string all the same");
    for empty in [c"", c" \t"] {
        let record = not_instantiated(Request { name: Some(empty.into()), ..right() });
        assert!(record.message.contains("instanceName"), "{record:?}");
    }
    for kind in [2, -1, Choice::MAX] {
        let record = not_instantiated(Request { kind, ..right() });
        let words = format!("fmuType = {kind} must be fmi2ModelExchange (0) or fmi2CoSimulation (1)");
        assert!(record.message.ends_with(&words), "{record:?}");
    }
    // The same without a logger: null, and nobody is told.
    let silent = Request { has_logger: false, guid: None, ..right() };
    assert_eq!(silent.instantiate().err(), Some(vec![]));
}

#[test]
fn fmi_instantiate_without_callbacks_is_null() {
    let guid = CString::new(split_rotor_model::xml::guid(scene())).expect("a GUID holds no zero");
    let (name, place) = (c"rotor".as_ptr(), c"".as_ptr());
    // SAFETY: strings that live during the call, and null.
    let component =
        unsafe { exports::fmi2Instantiate(name, CO_SIMULATION, guid.as_ptr(), place, null(), FALSE, FALSE) };
    assert!(component.is_null());
}

#[test]
fn fmi_an_instance_without_a_logger_works() {
    let request = Request { has_logger: false, logging_on: true, ..Request::default() };
    let mut instance = request.instantiate().expect("a logger is not needed");
    assert_eq!(instance.do_step(0.0, 0.01), Status::Error);
    assert_eq!(instance.started(&[]).run(0.0, 0.01, 3), Instance::quiet().started(&[]).run(0.0, 0.01, 3));
}

#[test]
fn fmi_messages_go_to_the_environment_and_under_the_name_of_their_instance() {
    let named = |name: &CStr| Request { name: Some(name.into()), ..Request::default() }.instantiate().expect("right");
    // The name is no format either; it is handed back as it came.
    let (mut one, mut other) = (named(c"rotor № 1, 100% of it"), named(c"the other"));
    assert_eq!(one.terminate(), Status::Error);
    let (mine, theirs) = (one.journal.take(), other.journal.take());
    assert_eq!((mine.len(), theirs.len()), (1, 0));
    assert_eq!(mine[0].instance, "rotor № 1, 100% of it");
    assert_eq!(other.reset(), Status::Ok);
    assert_eq!(other.terminate(), Status::Error);
    let (mine, theirs) = (one.journal.take(), other.journal.take());
    assert_eq!((mine.len(), theirs.len()), (0, 1));
    assert_eq!(theirs[0].instance, "the other");
}

/// The categories of which an instance logs something on the way through an error, a chosen tolerance, a step that cannot
/// be done, and a reset.
fn heard(instance: &mut Instance) -> Vec<String> {
    let tumbling = tumbling();
    instance.journal.take();
    assert_eq!(instance.terminate(), Status::Error);
    instance.set_all(&tumbling);
    assert_eq!(instance.enter_initialization(), Status::Ok);
    assert_eq!(instance.exit_initialization(), Status::Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Status::Discard);
    assert_eq!(instance.terminate(), Status::Ok);
    assert_eq!(instance.reset(), Status::Ok);
    let mut categories: Vec<_> = instance.journal.take().into_iter().map(|record| record.category).collect();
    categories.sort();
    categories.dedup();
    categories
}

#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn fmi_logging_on_says_everything_and_off_what_goes_wrong() {
    let everything = ["logEvents", "logSolver", "logStatusDiscard", "logStatusError", "logStatusWarning"];
    let unasked = ["logStatusDiscard", "logStatusError", "logStatusWarning"];
    assert_eq!(heard(&mut Instance::talkative()), everything);
    assert_eq!(heard(&mut Instance::quiet()), unasked);
}

#[test]
fn fmi_a_run_that_goes_well_says_what_was_asked_for() {
    for (mut instance, asked, expected) in [
        (Instance::quiet(), &[][..], &[][..]),
        // The tolerance in force, and what was spent.
        (Instance::quiet(), &[c"logSolver"][..], &["logSolver", "logSolver"][..]),
    ] {
        if !asked.is_empty() {
            assert_eq!(instance.debug_logging(true, asked), Status::Ok);
        }
        let mut instance = instance.started(&[]);
        instance.run(0.0, 0.1, 1);
        assert_eq!(instance.terminate(), Status::Ok);
        let records = instance.journal.take();
        assert_eq!(records.iter().map(|record| record.category.as_str()).collect::<Vec<_>>(), expected, "{records:?}");
    }
}

#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn fmi_categories_that_are_disabled_are_not_called() {
    let everything = ["logEvents", "logSolver", "logStatusDiscard", "logStatusError", "logStatusWarning"];
    let mut instance = Instance::quiet();
    let mut check = |on: bool, names: &[&CStr], expected: &[&str]| {
        assert_eq!(instance.debug_logging(on, names), Status::Ok);
        assert_eq!(heard(&mut instance), expected, "{on} {names:?}");
    };
    check(true, &[], &everything);
    check(false, &[], &[]);
    check(true, &[c"logEvents"], &["logEvents"]);
    check(true, &[c"logSolver", c"logStatusError"], &["logSolver", "logStatusError"]);
    check(false, &[c"logSolver"], &["logStatusError"]);
    check(true, &[c"logStatusWarning", c"logStatusError"], &["logStatusError", "logStatusWarning"]);
    check(false, &[c"logStatusWarning"], &["logStatusError"]);
    check(true, &[c"logAll"], &everything);
    let rest = ["logEvents", "logSolver", "logStatusError", "logStatusWarning"];
    check(false, &[c"logStatusDiscard", c"logStatusDiscard"], &rest);
    check(false, &[c"logAll"], &[]);
}

#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn fmi_an_unknown_category_is_an_error_and_changes_nothing() {
    let mut instance = Instance::quiet();
    assert_eq!(instance.debug_logging(true, &[c"logSolver", c"logStatusError"]), Status::Ok);
    for names in [&[c"logEvents", c"nonsense"][..], &[c"nonsense", c"logAll"], &[c"logall"], &[c""], &[c"\xff\xfe"]] {
        for on in [true, false] {
            assert_eq!(instance.debug_logging(on, names), Status::Error);
            let records = instance.journal.take();
            assert_eq!(records.len(), 1);
            assert!(records[0].message.starts_with("fmi2SetDebugLogging: there is no category"), "{records:?}");
            assert_eq!(heard(&mut instance), ["logSolver", "logStatusError"], "{names:?}");
        }
    }
}

#[test]
fn fmi_the_categories_are_those_of_the_model_description() {
    let xml = split_rotor_model::xml::model_description(scene());
    let mut instance = Instance::quiet();
    let mut count = 0;
    for part in xml.split("<Category name=\"").skip(1) {
        let name = part.split('"').next().expect("a name ends");
        let name = CString::new(name).expect("XML holds no zero");
        assert_eq!(instance.debug_logging(true, &[&name]), Status::Ok, "{name:?}");
        count += 1;
    }
    assert_eq!(count, 6);
}
