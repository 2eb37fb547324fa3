//! The 44 exported functions in each state of each kind of instance: what is legal succeeds, what is not is refused, with a
//! log line that says which function, which state or kind and what would be right, and changes nothing. `arguments.rs`
//! holds what is wrong with arguments, `stepping.rs` what a step does.

use crate::harness::{Instance, Life, NO_VARIABLE, RULES, Stage, inputs, reals, reference, refused, scene};
use split_rotor::abi::*;
use split_rotor::exports;
use split_rotor::scene::Simulation;
use std::ffi::CStr;
use std::ptr::{null, null_mut};

const STATES: usize = Simulation::STATES;
const INDICATORS: usize = Simulation::INDICATORS;

/// A function, called with arguments that are right.
struct Call {
    name: &'static str,
    run: fn(Component) -> Status,
}

macro_rules! calls {
    ($($name:ident($($argument:expr),*);)*) => {
        /// All functions that take an instance and return a status, in the order of the standard.
        const CALLS: [Call; 40] = [$(Call {
            name: stringify!($name),
            run: |component| {
                // SAFETY: null or a live instance; the arguments live to the end of the call, arrays are as long as told.
                unsafe { exports::$name(component, $($argument),*) }
            },
        }),*];
    };
}

calls! {
    fmi2SetDebugLogging(TRUE, 2, [c"logStatusError".as_ptr(), c"logStatusDiscard".as_ptr()].as_ptr());
    fmi2SetupExperiment(TRUE, 1e-6, 0.0, TRUE, 5.0);
    fmi2EnterInitializationMode();
    fmi2ExitInitializationMode();
    fmi2Terminate();
    fmi2Reset();
    fmi2GetReal([reference("r_c.x")].as_ptr(), 1, [0.0].as_mut_ptr());
    fmi2GetInteger([reference("solver.method")].as_ptr(), 1, [0].as_mut_ptr());
    fmi2GetBoolean(null(), 0, null_mut());
    fmi2GetString(null(), 0, null_mut());
    fmi2SetReal(settable().as_ptr(), settable().len(), [6.0].as_ptr());
    fmi2SetInteger([reference("solver.method")].as_ptr(), 1, [2].as_ptr());
    fmi2SetBoolean(null(), 0, null());
    fmi2SetString(null(), 0, null());
    // Those that take a saved state have tests of their own; without one they are refused.
    fmi2GetFMUstate(null_mut());
    fmi2SetFMUstate(null_mut());
    fmi2FreeFMUstate([null_mut()].as_mut_ptr());
    fmi2SerializedFMUstateSize(null_mut(), [0].as_mut_ptr());
    fmi2SerializeFMUstate(null_mut(), [0; 8].as_mut_ptr(), 8);
    fmi2DeSerializeFMUstate([0; 8].as_ptr(), 8, [null_mut()].as_mut_ptr());
    fmi2GetDirectionalDerivative(
        [reference("r_c.x")].as_ptr(), 1, [reference("state.r.x")].as_ptr(), 1, [1.0].as_ptr(), [0.0].as_mut_ptr()
    );
    fmi2EnterEventMode();
    fmi2NewDiscreteStates([EVENTS].as_mut_ptr());
    fmi2EnterContinuousTimeMode();
    fmi2CompletedIntegratorStep(TRUE, [0].as_mut_ptr(), [0].as_mut_ptr());
    fmi2SetTime(0.04);
    fmi2SetContinuousStates([0.0; STATES].as_ptr(), STATES);
    fmi2GetDerivatives([0.0; STATES].as_mut_ptr(), STATES);
    fmi2GetEventIndicators([0.0; INDICATORS].as_mut_ptr(), INDICATORS);
    fmi2GetContinuousStates([0.0; STATES].as_mut_ptr(), STATES);
    fmi2GetNominalsOfContinuousStates([0.0; STATES].as_mut_ptr(), STATES);
    fmi2SetRealInputDerivatives(inputs().as_ptr(), inputs().len(), [1; 64].as_ptr(), [0.0; 64].as_ptr());
    fmi2GetRealOutputDerivatives([reference("r_c.x")].as_ptr(), 1, [1].as_ptr(), [0.0].as_mut_ptr());
    fmi2DoStep(0.03, 0.01, TRUE);
    fmi2CancelStep();
    fmi2GetStatus(status_kind::DO_STEP, [Status::Ok].as_mut_ptr());
    fmi2GetRealStatus(status_kind::LAST_SUCCESSFUL_TIME, [0.0].as_mut_ptr());
    fmi2GetIntegerStatus(status_kind::DO_STEP, [0].as_mut_ptr());
    fmi2GetBooleanStatus(status_kind::TERMINATED, [0].as_mut_ptr());
    fmi2GetStringStatus(status_kind::PENDING, [null()].as_mut_ptr());
}

const EVENTS: EventInfo = EventInfo {
    new_discrete_states_needed: FALSE,
    terminate_simulation: FALSE,
    nominals_of_continuous_states_changed: FALSE,
    values_of_continuous_states_changed: FALSE,
    next_event_time_defined: FALSE,
    next_event_time: 0.0,
};

/// What may be set in every state in which anything may: an input, where the scene has one.
fn settable() -> Vec<ValueReference> {
    inputs().into_iter().take(1).collect()
}

/// Legal, but refused, with this reason, wherever it is called with the arguments above.
fn reason_to_refuse(name: &str) -> Option<&'static str> {
    Some(match name {
        "fmi2GetFMUstate" | "fmi2SetFMUstate" | "fmi2SerializedFMUstateSize" | "fmi2SerializeFMUstate" => {
            "FMUstate is a null pointer"
        }
        "fmi2DeSerializeFMUstate" => "not a serialized state",
        "fmi2CancelStep" => "none can be cancelled",
        "fmi2GetIntegerStatus" => "no status kind has an answer of type Integer",
        "fmi2GetStringStatus" => "no step is pending",
        _ => return None,
    })
}

/// What to do instead, as each function says it where it is not legal; for those that are legal everywhere, nothing.
fn remedy(name: &str) -> &'static str {
    match name {
        "fmi2SetupExperiment" => "call it before fmi2EnterInitializationMode, or fmi2Reset first",
        "fmi2EnterInitializationMode" => "call fmi2Reset first",
        "fmi2ExitInitializationMode" => "call fmi2EnterInitializationMode first",
        "fmi2SetReal" | "fmi2SetInteger" | "fmi2SetBoolean" | "fmi2SetString" => "before fmi2ExitInitializationMode",
        "fmi2GetDirectionalDerivative" | "fmi2GetRealOutputDerivatives" => "call fmi2EnterInitializationMode first",
        "fmi2NewDiscreteStates" | "fmi2EnterContinuousTimeMode" => "call it in event mode",
        "fmi2EnterEventMode" | "fmi2CompletedIntegratorStep" | "fmi2SetContinuousStates" => {
            "call fmi2EnterContinuousTimeMode first"
        }
        "fmi2SetRealInputDerivatives" => "call fmi2Reset first",
        _ => "call it between fmi2ExitInitializationMode and fmi2Terminate",
    }
}

#[test]
fn fmi_there_are_44_functions() {
    // Those of RULES, and the four that take no instance or return no status.
    assert_eq!(RULES.len() + 4, 44);
    let names = |names: &mut dyn Iterator<Item = &'static str>| names.collect::<Vec<_>>();
    assert_eq!(names(&mut CALLS.iter().map(|call| call.name)), names(&mut RULES.iter().map(|rule| rule.name)));
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
    for life in Life::EACH {
        for (call, rule) in CALLS.iter().zip(&RULES) {
            if !life.allows(rule) || reason_to_refuse(call.name).is_some() {
                continue;
            }
            let instance = life.instance();
            let expected = match (call.name, life.stage) {
                // A step that failed leaves the communication point at the last successful time, not at 0.03 s.
                ("fmi2DoStep", Stage::StepFailed) => Status::Error,
                _ => Status::Ok,
            };
            let status = (call.run)(instance.component());
            assert_eq!(status, expected, "{} in {life:?}: {:?}", call.name, instance.journal.take());
        }
    }
}

#[test]
fn fmi_illegal_calls_name_function_and_state_and_remedy_and_change_nothing() {
    for life in Life::EACH {
        let mut instance = life.instance();
        let mut count = 0;
        for (call, rule) in CALLS.iter().zip(&RULES).filter(|(_, rule)| !life.allows(rule)) {
            let function = format!("{}: not legal ", call.name);
            if rule.legal_of(life.kind) == 0 {
                let right = if life.kind == CO_SIMULATION { "model exchange" } else { "co-simulation" };
                let words = [format!("of an instance for {}", life.kind_name()), format!("instantiate for {right}")];
                refused(&mut instance, call.run, &[&function, &words[0], &words[1]]);
            } else {
                let state = format!("in the state \"{}\": ", life.stage.name());
                refused(&mut instance, call.run, &[&function, &state, remedy(call.name)]);
            }
            count += 1;
        }
        assert!(count >= 14, "{life:?}");
        assert_eq!(life.future(instance), life.future(life.instance()), "{life:?}: the way on is the same");
    }
}

#[test]
fn fmi_what_has_no_answer_says_why_and_changes_nothing() {
    for life in Life::EACH {
        let mut instance = life.instance();
        for (call, rule) in CALLS.iter().zip(&RULES).filter(|(_, rule)| life.allows(rule)) {
            if let Some(reason) = reason_to_refuse(call.name) {
                refused(&mut instance, call.run, &[&format!("{}: ", rule.name), reason]);
            }
        }
        assert_eq!(life.future(instance), life.future(life.instance()), "{life:?}: the way on is the same");
    }
}

#[test]
fn fmi_parameters_are_fixed_once_the_motion_was_started() {
    for life in Life::EACH {
        let mut instance = life.instance();
        let parameter = [reference("rotor.m")];
        // SAFETY: a live instance, arrays of one.
        let call = |c| unsafe { exports::fmi2SetReal(c, parameter.as_ptr(), 1, [6.0].as_ptr()) };
        if !life.stage.has_started() {
            assert_eq!(call(instance.component()), Status::Ok);
            assert_eq!(instance.get("rotor.m"), 6.0);
        } else if life.stage != Stage::Terminated {
            let state = format!("\"{}\"", life.stage.name());
            let words = ["fmi2SetReal: ", "rotor.m", "fixed parameter", &state, "before fmi2ExitInitializationMode"];
            refused(&mut instance, call, &words);
        }
    }
}

#[test]
fn fmi_terminated_instances_can_still_be_read_and_reset() {
    for life in Life::EACH.into_iter().filter(|life| life.stage.has_started() && life.stage != Stage::Terminated) {
        let (kind, mut instance) = (life.kind, life.instance());
        let bits = instance.bits();
        assert_eq!([instance.terminate(), instance.terminate()], [Status::Ok, Status::Error]);
        assert_eq!(instance.bits(), bits, "{life:?}");
        assert_eq!(instance.reset(), Status::Ok);
        assert_eq!(instance.serialized(), Instance::of(kind).serialized(), "a reset forgets everything");
    }
}

#[test]
fn fmi_real_variables_are_there() {
    assert!(reals(scene()).len() > 40, "the tests of bits look at something");
    assert!(!reals(scene()).contains(&NO_VARIABLE));
}
