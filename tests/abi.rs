//! The contract of the 44 exported functions: what each returns for a null instance, for bad arguments and in each state
//! of an instance's life; that a refusal changes nothing and says which function, which argument or state, and what would
//! be right; what is logged, and to whom. `stepping.rs` holds what a step does.
#![allow(unsafe_code, reason = "the exported functions are those of a C interface")]

mod harness;

use harness::{Instance, NO_VARIABLE, Record, Request, reals, reference, scene};
use model::variable::{Kind, Role};
use split_rotor::abi::*;
use split_rotor::exports;
use std::ffi::{CStr, CString};
use std::ptr::{null, null_mut};

/// Where an instance can be in its life.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(u8)]
enum Stage {
    Instantiated = 1,
    Initialization = 2,
    StepComplete = 4,
    StepFailed = 8,
    Terminated = 16,
}

impl Stage {
    const EACH: [Self; 5] =
        [Self::Instantiated, Self::Initialization, Self::StepComplete, Self::StepFailed, Self::Terminated];

    /// Its name in messages.
    fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "instantiated",
            Self::Initialization => "initialization mode",
            Self::StepComplete => "step complete",
            Self::StepFailed => "step failed",
            Self::Terminated => "terminated",
        }
    }

    /// An instance that is there, and the values that it started from.
    fn instance(self) -> Instance {
        let mut instance = Instance::quiet();
        if self == Self::StepFailed {
            instance.set_all(&TUMBLING);
        }
        if self != Self::Instantiated {
            assert_eq!(instance.enter_initialization(), Status::Ok);
        }
        if !matches!(self, Self::Instantiated | Self::Initialization) {
            assert_eq!(instance.exit_initialization(), Status::Ok);
        }
        match self {
            Self::Instantiated | Self::Initialization => {}
            Self::StepComplete | Self::Terminated => {
                instance.run(0.0, 0.01, 3);
            }
            Self::StepFailed => {
                assert_eq!(instance.do_step(0.0, 1.0), Status::Discard);
                instance.journal.take();
            }
        }
        if self == Self::Terminated {
            assert_eq!(instance.terminate(), Status::Ok);
        }
        instance
    }
}

/// A rotor that tumbles, held by next to no spring, but by one: where |γ| = 3.1 rad, its law ends.
const TUMBLING: [(&str, Real); 4] =
    [("support.c1", 0.0), ("support.c2", 1e-300), ("start.omega.x", 0.0), ("start.omega.y", 30.0)];

/// A function, called with arguments that are right.
struct Call {
    name: &'static str,
    /// The [`Stage`]s in which it is legal, as a set of bits.
    legal: u8,
    /// Whether there is nothing behind it yet: legal, but refused.
    absent: bool,
    run: fn(Component) -> Status,
}

const I: u8 = Stage::Instantiated as u8;
const N: u8 = Stage::Initialization as u8;
const S: u8 = Stage::StepComplete as u8 | Stage::StepFailed as u8;
const T: u8 = Stage::Terminated as u8;
const ANY: u8 = I | N | S | T;

macro_rules! calls {
    ($($name:ident($($argument:expr),*) $legal:expr $(, $absent:ident)?;)*) => {
        /// All functions that take an instance and return a status, in the order of the standard.
        const CALLS: &[Call] = &[$(Call {
            name: stringify!($name),
            legal: $legal,
            absent: !<[&str]>::is_empty(&[$(stringify!($absent)),*]),
            run: |component| {
                // SAFETY: null or a live instance; the arguments live to the end of the call, arrays are as long as told.
                unsafe { exports::$name(component, $($argument),*) }
            },
        }),*];
    };
}

calls! {
    fmi2SetDebugLogging(TRUE, 2, [c"logStatusError".as_ptr(), c"logStatusDiscard".as_ptr()].as_ptr()) ANY;
    fmi2SetupExperiment(TRUE, 1e-6, 0.0, TRUE, 5.0) I;
    fmi2EnterInitializationMode() I;
    fmi2ExitInitializationMode() N;
    fmi2Terminate() S;
    fmi2Reset() ANY;
    fmi2GetReal([reference("r_c.x")].as_ptr(), 1, [0.0].as_mut_ptr()) ANY;
    fmi2GetInteger([reference("solver.method")].as_ptr(), 1, [0].as_mut_ptr()) ANY;
    fmi2GetBoolean(null(), 0, null_mut()) ANY;
    fmi2GetString(null(), 0, null_mut()) ANY;
    fmi2SetReal([reference("rotor.m")].as_ptr(), 1, [6.0].as_ptr()) I | N;
    fmi2SetInteger([reference("solver.method")].as_ptr(), 1, [2].as_ptr()) I | N;
    fmi2SetBoolean(null(), 0, null()) I | N;
    fmi2SetString(null(), 0, null()) I | N;
    fmi2GetFMUstate([null_mut()].as_mut_ptr()) ANY;
    fmi2SetFMUstate(null_mut()) ANY, absent;
    fmi2FreeFMUstate([null_mut()].as_mut_ptr()) ANY;
    fmi2SerializedFMUstateSize(null_mut(), [0].as_mut_ptr()) ANY, absent;
    fmi2SerializeFMUstate(null_mut(), [0; 8].as_mut_ptr(), 8) ANY, absent;
    fmi2DeSerializeFMUstate([0; 8].as_ptr(), 8, [null_mut()].as_mut_ptr()) ANY, absent;
    fmi2GetDirectionalDerivative(
        [reference("r_c.x")].as_ptr(), 1, [reference("v_c.x")].as_ptr(), 1, [1.0].as_ptr(), [0.0].as_mut_ptr()
    ) ANY, absent;
    fmi2EnterEventMode() ANY, absent;
    fmi2NewDiscreteStates(null_mut()) ANY, absent;
    fmi2EnterContinuousTimeMode() ANY, absent;
    fmi2CompletedIntegratorStep(TRUE, [0].as_mut_ptr(), [0].as_mut_ptr()) ANY, absent;
    fmi2SetTime(0.0) ANY, absent;
    fmi2SetContinuousStates([0.0; 12].as_ptr(), 12) ANY, absent;
    fmi2GetDerivatives([0.0; 12].as_mut_ptr(), 12) ANY, absent;
    fmi2GetEventIndicators(null_mut(), 0) ANY, absent;
    fmi2GetContinuousStates([0.0; 12].as_mut_ptr(), 12) ANY, absent;
    fmi2GetNominalsOfContinuousStates([0.0; 12].as_mut_ptr(), 12) ANY, absent;
    fmi2SetRealInputDerivatives([NO_VARIABLE].as_ptr(), 1, [1].as_ptr(), [0.0].as_ptr()) ANY, absent;
    fmi2GetRealOutputDerivatives([reference("r_c.x")].as_ptr(), 1, [1].as_ptr(), [0.0].as_mut_ptr()) ANY, absent;
    fmi2DoStep(0.03, 0.01, TRUE) S;
    fmi2CancelStep() ANY, absent;
    fmi2GetStatus(status_kind::DO_STEP, [Status::Ok].as_mut_ptr()) S | T;
    fmi2GetRealStatus(status_kind::LAST_SUCCESSFUL_TIME, [0.0].as_mut_ptr()) S | T;
    fmi2GetIntegerStatus(status_kind::DO_STEP, [0].as_mut_ptr()) S | T, absent;
    fmi2GetBooleanStatus(status_kind::TERMINATED, [0].as_mut_ptr()) S | T;
    fmi2GetStringStatus(status_kind::PENDING, [null()].as_mut_ptr()) S | T, absent;
}

/// Calls a function that must be refused with one log line that says so in these words, and must change nothing.
#[track_caller]
fn refused(instance: &mut Instance, call: impl FnOnce(Component) -> Status, words: &[&str]) {
    let before = instance.snapshot();
    instance.journal.take();
    let status = call(instance.component());
    let records = instance.journal.take();
    assert_eq!(status, Status::Error, "{words:?}: {records:?}");
    let [record] = &records[..] else { panic!("{words:?}: one line, not {records:?}") };
    assert_eq!((record.status, record.category.as_str()), (Status::Error, "logStatusError"), "{record:?}");
    for word in words {
        assert!(record.message.contains(word), "{word:?} must be in {:?}", record.message);
    }
    assert_eq!(before, instance.snapshot(), "{words:?}");
}

#[test]
fn fmi_there_are_44_functions() {
    // Those of CALLS, and the four that take no instance or return no status.
    assert_eq!(CALLS.len() + 4, 44);
    let mut names: Vec<_> = CALLS.iter().map(|call| call.name).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), CALLS.len());
}

#[test]
fn fmi_version_and_platform() {
    // SAFETY: both functions return strings that live for ever.
    let [version, platform] =
        [exports::fmi2GetVersion(), exports::fmi2GetTypesPlatform()].map(|text| unsafe { CStr::from_ptr(text) });
    assert_eq!((version, platform), (c"2.0", c"default"));
}

#[test]
fn fmi_a_null_instance_is_an_error_in_every_function() {
    for call in CALLS {
        assert_eq!((call.run)(null_mut()), Status::Error, "{}", call.name);
    }
    // SAFETY: the standard lets a host free null.
    unsafe { exports::fmi2FreeInstance(null_mut()) };
}

#[test]
fn fmi_legal_calls_succeed_in_every_state() {
    for stage in Stage::EACH {
        for call in CALLS.iter().filter(|call| call.legal & stage as u8 != 0 && !call.absent) {
            let instance = stage.instance();
            let expected = match (call.name, stage) {
                // A step that failed leaves the communication point at the last successful time, not at 0.03 s.
                ("fmi2DoStep", Stage::StepFailed) => Status::Error,
                _ => Status::Ok,
            };
            let status = (call.run)(instance.component());
            assert_eq!(status, expected, "{} in {stage:?}: {:?}", call.name, instance.journal.take());
        }
    }
}

#[test]
fn fmi_illegal_calls_name_function_and_state_and_change_nothing() {
    for stage in Stage::EACH {
        let mut instance = stage.instance();
        let illegal: Vec<_> = CALLS.iter().filter(|call| call.legal & stage as u8 == 0).collect();
        assert!(illegal.len() >= 4, "{stage:?}");
        for call in illegal {
            let state = format!("\"{}\"", stage.name());
            refused(&mut instance, call.run, &[&format!("{}: ", call.name), &state]);
        }
        assert_eq!(future(instance, stage), future(stage.instance(), stage), "{stage:?}: the way on is the same");
    }
}

#[test]
fn fmi_functions_that_are_not_there_yet_say_so_and_change_nothing() {
    for stage in Stage::EACH {
        let mut instance = stage.instance();
        for call in CALLS.iter().filter(|call| call.legal & stage as u8 != 0 && call.absent) {
            refused(&mut instance, call.run, &[&format!("{}: ", call.name)]);
        }
        assert_eq!(future(instance, stage), future(stage.instance(), stage), "{stage:?}: the way on is the same");
    }
}

/// The rest of an instance's life, in bits.
fn future(mut instance: Instance, from: Stage) -> Vec<Vec<u64>> {
    if from == Stage::Instantiated {
        assert_eq!(instance.enter_initialization(), Status::Ok);
    }
    match from {
        Stage::Instantiated | Stage::Initialization => {
            assert_eq!(instance.exit_initialization(), Status::Ok);
            instance.run(0.0, 0.02, 5)
        }
        Stage::StepComplete => instance.run(0.03, 0.02, 5),
        Stage::StepFailed | Stage::Terminated => {
            let last = instance.bits();
            assert_eq!(instance.reset(), Status::Ok);
            let mut all = instance.started(&[]).run(0.0, 0.02, 5);
            all.push(last);
            all
        }
    }
}

#[test]
fn fmi_null_pointers_name_the_argument_and_change_nothing() {
    let (real, choice) = ([reference("rotor.m")], [reference("solver.method")]);
    for stage in [Stage::Instantiated, Stage::Initialization] {
        let mut instance = stage.instance();
        let mut check = |function: &str, argument: &str, call: &dyn Fn(Component) -> Status| {
            refused(&mut instance, call, &[&format!("{function}: "), argument, "null pointer"]);
        };
        // SAFETY: a live instance; pointers are null or to arrays of one.
        unsafe {
            check("fmi2GetReal", "vr", &|c| exports::fmi2GetReal(c, null(), 1, [0.0].as_mut_ptr()));
            check("fmi2GetReal", "value", &|c| exports::fmi2GetReal(c, real.as_ptr(), 1, null_mut()));
            check("fmi2GetInteger", "vr", &|c| exports::fmi2GetInteger(c, null(), 1, [0].as_mut_ptr()));
            check("fmi2GetInteger", "value", &|c| exports::fmi2GetInteger(c, choice.as_ptr(), 1, null_mut()));
            check("fmi2GetBoolean", "vr", &|c| exports::fmi2GetBoolean(c, null(), 1, [0].as_mut_ptr()));
            check("fmi2GetString", "vr", &|c| exports::fmi2GetString(c, null(), 1, [null()].as_mut_ptr()));
            check("fmi2SetReal", "vr", &|c| exports::fmi2SetReal(c, null(), 1, [6.0].as_ptr()));
            check("fmi2SetReal", "value", &|c| exports::fmi2SetReal(c, real.as_ptr(), 1, null()));
            check("fmi2SetInteger", "vr", &|c| exports::fmi2SetInteger(c, null(), 1, [2].as_ptr()));
            check("fmi2SetInteger", "value", &|c| exports::fmi2SetInteger(c, choice.as_ptr(), 1, null()));
            check("fmi2SetBoolean", "vr", &|c| exports::fmi2SetBoolean(c, null(), 1, [0].as_ptr()));
            check("fmi2SetString", "vr", &|c| exports::fmi2SetString(c, null(), 1, [null()].as_ptr()));
            check("fmi2SetDebugLogging", "categories", &|c| exports::fmi2SetDebugLogging(c, TRUE, 1, null()));
            check("fmi2SetDebugLogging", "category", &|c| {
                exports::fmi2SetDebugLogging(c, TRUE, 2, [c"logAll".as_ptr(), null()].as_ptr())
            });
        }
    }
    for stage in [Stage::StepComplete, Stage::StepFailed, Stage::Terminated] {
        let mut instance = stage.instance();
        let mut check = |function: &str, call: &dyn Fn(Component) -> Status| {
            refused(&mut instance, call, &[&format!("{function}: "), "value", "null pointer"]);
        };
        // SAFETY: a live instance and null pointers.
        unsafe {
            check("fmi2GetStatus", &|c| exports::fmi2GetStatus(c, status_kind::DO_STEP, null_mut()));
            let time = status_kind::LAST_SUCCESSFUL_TIME;
            check("fmi2GetRealStatus", &|c| exports::fmi2GetRealStatus(c, time, null_mut()));
            check("fmi2GetBooleanStatus", &|c| exports::fmi2GetBooleanStatus(c, status_kind::TERMINATED, null_mut()));
        }
    }
}

#[test]
fn fmi_no_values_from_null_arrays_is_fine() {
    let instance = Instance::quiet();
    let c = instance.component();
    // SAFETY: a live instance; no element is read or written.
    let statuses = unsafe {
        [
            exports::fmi2GetReal(c, null(), 0, null_mut()),
            exports::fmi2GetInteger(c, null(), 0, null_mut()),
            exports::fmi2GetBoolean(c, null(), 0, null_mut()),
            exports::fmi2GetString(c, null(), 0, null_mut()),
            exports::fmi2SetReal(c, null(), 0, null()),
            exports::fmi2SetInteger(c, null(), 0, null()),
            exports::fmi2SetBoolean(c, null(), 0, null()),
            exports::fmi2SetString(c, null(), 0, null()),
            exports::fmi2SetDebugLogging(c, FALSE, 0, null()),
        ]
    };
    assert_eq!(statuses, [Status::Ok; 9]);
    assert_eq!(instance.journal.take(), []);
}

/// Tries one value reference through all eight functions that get and set; those that `right` names must succeed.
fn through_every_type(instance: &mut Instance, reference: ValueReference, right: &[&str], words: &[&str]) {
    type Attempt = (&'static str, unsafe fn(Component, ValueReference) -> Status);
    // SAFETY of the calls below: a live instance, arrays of one.
    let attempts: [Attempt; 8] = [
        ("fmi2GetReal", |c, r| {
            let mut value = [0.5];
            // SAFETY: see above.
            let status = unsafe { exports::fmi2GetReal(c, [r].as_ptr(), 1, value.as_mut_ptr()) };
            assert!(status == Status::Ok || value == [0.5], "nothing is written");
            status
        }),
        ("fmi2GetInteger", |c, r| {
            let mut value = [77];
            // SAFETY: see above.
            let status = unsafe { exports::fmi2GetInteger(c, [r].as_ptr(), 1, value.as_mut_ptr()) };
            assert!(status == Status::Ok || value == [77], "nothing is written");
            status
        }),
        ("fmi2GetBoolean", |c, r| {
            let mut value = [77];
            // SAFETY: see above.
            let status = unsafe { exports::fmi2GetBoolean(c, [r].as_ptr(), 1, value.as_mut_ptr()) };
            assert_eq!(value, [77], "nothing is written");
            status
        }),
        ("fmi2GetString", |c, r| {
            let mut value = [null()];
            // SAFETY: see above.
            let status = unsafe { exports::fmi2GetString(c, [r].as_ptr(), 1, value.as_mut_ptr()) };
            assert_eq!(value, [null()], "nothing is written");
            status
        }),
        // SAFETY: see above.
        ("fmi2SetReal", |c, r| unsafe { exports::fmi2SetReal(c, [r].as_ptr(), 1, [6.0].as_ptr()) }),
        // SAFETY: see above.
        ("fmi2SetInteger", |c, r| unsafe { exports::fmi2SetInteger(c, [r].as_ptr(), 1, [2].as_ptr()) }),
        // SAFETY: see above.
        ("fmi2SetBoolean", |c, r| unsafe { exports::fmi2SetBoolean(c, [r].as_ptr(), 1, [1].as_ptr()) }),
        // SAFETY: see above.
        ("fmi2SetString", |c, r| unsafe { exports::fmi2SetString(c, [r].as_ptr(), 1, [c"text".as_ptr()].as_ptr()) }),
    ];
    for (function, attempt) in attempts {
        // SAFETY: a live instance.
        let call = |component| unsafe { attempt(component, reference) };
        if right.contains(&function) {
            assert_eq!(call(instance.component()), Status::Ok, "{function} {reference}");
        } else {
            let mut all = vec![function];
            all.extend(words);
            refused(instance, call, &all);
        }
    }
}

#[test]
fn fmi_every_variable_answers_to_its_own_type_and_role_only() {
    for variable in &scene().variables {
        let mut instance = Instance::quiet();
        let right: &[&str] = match (variable.meta.kind, variable.meta.role) {
            (Kind::Real, Role::Parameter { .. }) => &["fmi2GetReal", "fmi2SetReal"],
            (Kind::Real, Role::Input { .. }) => &["fmi2GetReal", "fmi2SetReal"],
            (Kind::Real, _) => &["fmi2GetReal"],
            (Kind::Enumeration(_), Role::Parameter { .. }) => &["fmi2GetInteger", "fmi2SetInteger"],
            (Kind::Integer | Kind::Enumeration(_), _) => &["fmi2GetInteger"],
        };
        let reference = variable.place.value_reference();
        through_every_type(&mut instance, reference, right, &[&reference.to_string(), variable.meta.name]);
    }
}

#[test]
fn fmi_wrong_value_references_name_the_number() {
    let known: Vec<_> = scene().variables.iter().map(|variable| variable.place.value_reference()).collect();
    let last_of_a_block = known.iter().find(|r| !known.contains(&(*r + 1))).expect("a block ends") + 1;
    for reference in [last_of_a_block, 0x0600, 0x0fff, 0x1fff, NO_VARIABLE, u32::MAX] {
        assert!(!known.contains(&reference));
        for stage in [Stage::Instantiated, Stage::Initialization] {
            through_every_type(&mut stage.instance(), reference, &[], &[&reference.to_string(), "value reference"]);
        }
    }
}

#[test]
fn fmi_one_wrong_reference_refuses_the_whole_list() {
    let mut instance = Instance::quiet();
    let (m, l) = (reference("rotor.m"), reference("rotor.l"));
    for wrong in [NO_VARIABLE, reference("solver.method"), reference("r_c.x")] {
        let set = [m, wrong, l];
        // SAFETY: a live instance, and arrays of three.
        let call = |c| unsafe { exports::fmi2SetReal(c, set.as_ptr(), 3, [7.0; 3].as_ptr()) };
        refused(&mut instance, call, &["fmi2SetReal", &wrong.to_string()]);
    }
    for wrong in [NO_VARIABLE, reference("solver.method")] {
        let (get, mut values) = ([m, wrong, l], [0.5; 3]);
        // SAFETY: a live instance, and arrays of three.
        let call = |c| unsafe { exports::fmi2GetReal(c, get.as_ptr(), 3, values.as_mut_ptr()) };
        refused(&mut instance, call, &["fmi2GetReal", &wrong.to_string()]);
        assert_eq!(values, [0.5; 3], "nothing is written");
    }
}

#[test]
fn fmi_values_come_in_the_order_asked_for_and_may_repeat() {
    let mut instance = Instance::quiet();
    let [m, l] = [reference("rotor.m"), reference("rotor.l")];
    let mut values = [0.0; 4];
    assert_eq!(instance.read(&[l, m, m, l], &mut values), Status::Ok);
    assert_eq!(values, [0.75, 5.0, 5.0, 0.75]);
    assert_eq!(instance.write(&[m, l, m], &[1.0, 2.0, 3.0]), Status::Ok);
    assert_eq!(instance.get_all(["rotor.m", "rotor.l"]), [3.0, 2.0], "the last one counts");
}

#[test]
fn fmi_start_values_are_those_of_the_scene() {
    let mut instance = Instance::quiet();
    for (reference, start) in &scene().starts {
        let variable = scene().variables.iter().find(|variable| variable.place.value_reference() == *reference);
        if variable.expect("each start belongs to a variable").meta.kind == Kind::Real {
            let mut value = [Real::NAN];
            assert_eq!(instance.read(&[*reference], &mut value), Status::Ok);
            assert_eq!(value[0].to_bits(), start.to_bits());
        } else {
            assert_eq!(instance.get_integer(*reference).map(f64::from), Ok(*start));
        }
    }
}

#[test]
fn fmi_status_kinds_without_an_answer_are_errors() {
    for stage in [Stage::StepComplete, Stage::StepFailed, Stage::Terminated] {
        let mut instance = stage.instance();
        let (do_step, pending) = (status_kind::DO_STEP, status_kind::PENDING);
        let (time, terminated) = (status_kind::LAST_SUCCESSFUL_TIME, status_kind::TERMINATED);
        for kind in [pending, time, terminated, -1, 4, Choice::MAX] {
            let mut value = Status::Pending;
            // SAFETY: a live instance, and a place to write to.
            let call = |c| unsafe { exports::fmi2GetStatus(c, kind, &raw mut value) };
            refused(&mut instance, call, &["fmi2GetStatus", &kind.to_string(), "fmi2DoStepStatus"]);
            assert_eq!(value, Status::Pending, "nothing is written");
        }
        for kind in [do_step, pending, terminated, -1, 4, Choice::MIN] {
            let mut value = 0.5;
            // SAFETY: a live instance, and a place to write to.
            let call = |c| unsafe { exports::fmi2GetRealStatus(c, kind, &raw mut value) };
            refused(&mut instance, call, &["fmi2GetRealStatus", &kind.to_string(), "fmi2LastSuccessfulTime"]);
            assert_eq!(value, 0.5, "nothing is written");
        }
        for kind in [do_step, pending, time, -1, 4] {
            let mut value = 77;
            // SAFETY: a live instance, and a place to write to.
            let call = |c| unsafe { exports::fmi2GetBooleanStatus(c, kind, &raw mut value) };
            refused(&mut instance, call, &["fmi2GetBooleanStatus", &kind.to_string(), "fmi2Terminated"]);
            assert_eq!(value, 77, "nothing is written");
        }
    }
}

/// The one record of a refused fmi2Instantiate.
#[track_caller]
fn not_instantiated(request: Request) -> Record {
    let Err(records) = request.instantiate() else { panic!("the request is wrong") };
    let [record] = &records[..] else { panic!("one line, not {records:?}") };
    assert_eq!((record.status, record.category.as_str()), (Status::Error, "logStatusError"));
    assert!(record.message.starts_with("fmi2Instantiate: "), "{record:?}");
    record.clone()
}

#[test]
fn fmi_instantiate_refuses_bad_arguments_and_says_why() {
    let right = Request::default;
    let guid = model::xml::guid(scene());
    for wrong in [c"".to_owned(), c"{00000000-0000-0000-0000-000000000000}".to_owned(), {
        CString::new(guid.trim_matches(['{', '}'])).expect("a GUID holds no zero")
    }] {
        let record = not_instantiated(Request { guid: Some(wrong.clone()), ..right() });
        let wrong = wrong.to_str().expect("ASCII");
        assert!(record.message.contains(&guid) && record.message.contains(wrong), "{record:?}");
        assert_eq!(record.instance, "rotor");
    }
    assert!(not_instantiated(Request { guid: None, ..right() }).message.contains("fmuGUID is a null pointer"));
    let record = not_instantiated(Request { name: None, ..right() });
    assert!(record.message.contains("instanceName is a null pointer"));
    assert_eq!(record.instance, "", "no name, but a string all the same");
    for kind in [2, -1, Choice::MAX] {
        let record = not_instantiated(Request { kind, ..right() });
        assert!(record.message.contains("fmuType") && record.message.contains("fmi2CoSimulation"), "{record:?}");
    }
    // The same without a logger: null, and nobody is told.
    let silent = Request { has_logger: false, guid: None, ..right() };
    assert_eq!(silent.instantiate().err(), Some(vec![]));
}

#[test]
fn fmi_instantiate_without_callbacks_is_null() {
    let guid = CString::new(model::xml::guid(scene())).expect("a GUID holds no zero");
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
fn fmi_the_struct_of_callbacks_may_go_after_instantiate() {
    // The harness overwrites it (with a logger that aborts) and frees it in each test; here its messages still arrive.
    let mut instance = Instance::talkative();
    assert_eq!(instance.journal.take().len(), 1);
    assert_eq!(instance.do_step(0.0, 0.01), Status::Error);
    assert_eq!(instance.journal.take().len(), 1);
}

#[test]
fn fmi_messages_go_to_the_environment_and_under_the_name_of_their_instance() {
    let named = |name: &CStr| Request { name: Some(name.into()), ..Request::default() }.instantiate().expect("right");
    // The name is no format either; it is handed back as it came.
    let (mut one, mut other) = (named(c"one 100% of it"), named(c"the other"));
    assert_eq!(one.terminate(), Status::Error);
    let (mine, theirs) = (one.journal.take(), other.journal.take());
    assert_eq!((mine.len(), theirs.len()), (1, 0));
    assert_eq!(mine[0].instance, "one 100% of it");
    assert_eq!(other.reset(), Status::Ok);
    assert_eq!(other.terminate(), Status::Error);
    let (mine, theirs) = (one.journal.take(), other.journal.take());
    assert_eq!((mine.len(), theirs.len()), (0, 1));
    assert_eq!(theirs[0].instance, "the other");
}

#[test]
fn fmi_percent_signs_are_doubled_in_messages() {
    let mut instance = Instance::quiet();
    assert_eq!(instance.debug_logging(true, &[c"100%"]), Status::Error);
    assert_eq!(instance.debug_logging(true, &[c"%s%n"]), Status::Error);
    let records = instance.journal.take();
    assert!(records[0].message.contains("100%%\""), "{records:?}");
    assert!(records[1].message.contains("\"%%s%%n\""), "{records:?}");
    let record = not_instantiated(Request { guid: Some(c"%d".into()), ..Request::default() });
    assert!(record.message.contains("\"%%d\""), "{record:?}");
}

/// The categories of which an instance logs something on the way through an error, a chosen tolerance, a step that cannot
/// be done, and a reset.
fn heard(instance: &mut Instance) -> Vec<String> {
    instance.journal.take();
    assert_eq!(instance.terminate(), Status::Error);
    instance.set_all(&TUMBLING);
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
fn fmi_logging_on_says_everything_and_off_what_goes_wrong() {
    let everything = ["logEvents", "logSolver", "logStatusDiscard", "logStatusError", "logStatusWarning"];
    let unasked = ["logStatusDiscard", "logStatusError", "logStatusWarning"];
    assert_eq!(heard(&mut Instance::talkative()), everything);
    assert_eq!(heard(&mut Instance::quiet()), unasked);
}

#[test]
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
fn fmi_logging_choices_survive_a_reset() {
    let mut instance = Instance::quiet();
    assert_eq!(instance.debug_logging(false, &[]), Status::Ok);
    assert_eq!(instance.reset(), Status::Ok);
    assert_eq!(heard(&mut instance), [""; 0]);
}

#[test]
fn fmi_the_categories_are_those_of_the_model_description() {
    let xml = model::xml::model_description(scene());
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

/// Parameters that cannot be simulated, and what the message must name.
const IMPOSSIBLE: [(&str, Real, [&str; 3]); 22] = [
    ("rotor.m", 0.0, ["rotor.m = 0.0", "> 0", ""]),
    ("rotor.m", -1.0, ["rotor.m = -1.0", "> 0", ""]),
    ("rotor.m", Real::NAN, ["rotor.m = NaN", "finite", "> 0"]),
    ("rotor.m", Real::INFINITY, ["rotor.m = inf", "finite", "> 0"]),
    ("rotor.Ja", 0.0, ["rotor.Ja = 0.0", "> 0", ""]),
    ("rotor.Ja", Real::NEG_INFINITY, ["rotor.Ja = -inf", "finite", "> 0"]),
    // Two moments of inertia that no body has: the axial one is above twice the transverse one.
    ("rotor.Ja", 0.2, ["rotor.Ja = 0.2", "rotor.Jt", "0.15625"]),
    ("rotor.Jt", 0.07, ["rotor.Ja = 0.15625", "rotor.Jt", "0.14"]),
    ("rotor.Jt", Real::NAN, ["rotor.Jt = NaN", "finite", "> 0"]),
    ("rotor.l", Real::NAN, ["rotor.l = NaN", "finite", ""]),
    ("start.gamma.y", 3.2, ["|start.gamma| = 3.2", "pi", ""]),
    ("start.gamma.z", -3.2, ["|start.gamma| = 3.2", "pi", ""]),
    ("start.gamma.y", Real::NAN, ["start.gamma.y = NaN", "finite", ""]),
    ("start.omega.z", Real::NEG_INFINITY, ["start.omega.z = -inf", "finite", ""]),
    ("gravity.g.z", Real::NAN, ["gravity.g.z = NaN", "finite", ""]),
    ("support.c1", -1.0, ["support.c1 = -1.0", ">= 0", ""]),
    ("support.d2", Real::NAN, ["support.d2 = NaN", "finite", ">= 0"]),
    ("solver.relative_tolerance", 0.0, ["solver.relative_tolerance = 0.0", "1e-14", "0.1"]),
    ("solver.relative_tolerance", 1e-15, ["solver.relative_tolerance = 1e-15", "1e-14", "0.1"]),
    ("solver.relative_tolerance", 0.2, ["solver.relative_tolerance = 0.2", "1e-14", "0.1"]),
    ("solver.relative_tolerance", Real::NAN, ["solver.relative_tolerance = NaN", "1e-14", "0.1"]),
    ("solver.absolute_tolerance", -1e-9, ["solver.absolute_tolerance = -1e-9", ">= 0", ""]),
];

#[test]
fn fmi_impossible_parameters_are_named_at_exit_of_initialization_and_can_be_mended() {
    // SAFETY: a live instance.
    let exit = |c| unsafe { exports::fmi2ExitInitializationMode(c) };
    for (name, value, words) in IMPOSSIBLE {
        let mut instance = Instance::quiet();
        let right = instance.get(name);
        instance.set_all(&[(name, value)]);
        assert_eq!(instance.enter_initialization(), Status::Ok);
        refused(&mut instance, exit, &[&["fmi2ExitInitializationMode: ", "must be"], &words[..]].concat());
        instance.set_all(&[(name, right)]);
        // What a host set itself as the tolerance is the scene's again: nothing is left of the detour.
        let stage = Stage::Initialization;
        assert_eq!(future(instance, stage), future(stage.instance(), stage), "{name} = {value}");
    }
    for method in [0, 1, 4, -1, Integer::MAX, Integer::MIN] {
        let mut instance = Instance::quiet();
        instance.set_method(method);
        assert_eq!(instance.enter_initialization(), Status::Ok);
        refused(&mut instance, exit, &["solver.method", &method.to_string(), "2 (dopri5)", "3 (dop853)"]);
    }
}

#[test]
fn fmi_setup_experiment_refuses_what_cannot_be_and_changes_nothing() {
    let nan = Real::NAN;
    let wrong: [(Option<Real>, Real, Option<Real>, &str); 10] = [
        (None, nan, None, "startTime"),
        (None, Real::INFINITY, None, "startTime"),
        (None, 0.0, Some(nan), "stopTime"),
        (None, 0.0, Some(-1.0), "stopTime"),
        (None, 2.0, Some(1.0), "stopTime"),
        (Some(nan), 0.0, None, "tolerance"),
        (Some(0.0), 0.0, None, "tolerance"),
        (Some(-1e-6), 0.0, None, "tolerance"),
        (Some(1e-15), 0.0, None, "tolerance"),
        (Some(0.5), 0.0, None, "tolerance"),
    ];
    let mut instance = Instance::quiet();
    assert_eq!(instance.setup(Some(1e-6), 1.0, Some(1.1)), Status::Ok);
    for (tolerance, start, stop, argument) in wrong {
        let before = instance.snapshot();
        assert_eq!(instance.setup(tolerance, start, stop), Status::Error, "{argument}");
        let records = instance.journal.take();
        assert_eq!(records.len(), 1);
        assert!(records[0].message.contains(&format!("fmi2SetupExperiment: {argument} = ")), "{records:?}");
        assert_eq!(before, instance.snapshot());
    }
    let mut undisturbed = Instance::quiet();
    assert_eq!(undisturbed.setup(Some(1e-6), 1.0, Some(1.1)), Status::Ok);
    let (mut instance, mut undisturbed) = (instance.initialized(), undisturbed.initialized());
    assert_eq!(instance.run(1.0, 0.05, 2), undisturbed.run(1.0, 0.05, 2));
    assert_eq!(instance.do_step(1.1, 0.05), Status::Error, "the stop time holds");
}

#[test]
fn fmi_real_variables_are_there() {
    assert!(reals(scene()).len() > 40, "the tests of bits look at something");
}
