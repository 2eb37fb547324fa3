//! Arguments that are wrong: null pointers, value references, types, orders, counts, numbers that cannot be. Each is an
//! error that names the function, the argument and what would be right, and changes nothing.

use crate::harness::{
    Instance, Life, NO_VARIABLE, RULES, Saved, Stage, has, inputs, only, reference, refused, scene, there,
};
use split_rotor::abi::*;
use split_rotor::exports;
use split_rotor::scene::Simulation;
use split_rotor_model::variable::{Kind, Role};
use std::fmt::Debug;
use std::ptr::{null, null_mut};

const KINDS: [Choice; 2] = [CO_SIMULATION, MODEL_EXCHANGE];
const STATES: usize = Simulation::STATES;
const INDICATORS: usize = Simulation::INDICATORS;

/// Checks calls that have a null pointer for the argument of this name.
macro_rules! null_pointers {
    ($check:ident; $($function:ident($argument:literal: $($value:expr),*);)*) => {$(
        // SAFETY: a live instance and a state of its own; pointers are null or to arrays as long as told.
        $check(stringify!($function), $argument, &|c| unsafe { exports::$function(c, $($value),*) });
    )*};
}

#[test]
fn fmi_null_pointers_name_the_argument_and_change_nothing() {
    let (real, choice) = ([reference("rotor.m")], [reference("solver.method")]);
    let (output, state) = ([reference("r_c.x")], [reference("state.r.x")]);
    for life in Life::EACH {
        let mut instance = life.instance();
        let saved = Saved::of(&instance);
        let mut check = |function: &str, argument: &str, call: &dyn Fn(Component) -> Status| {
            let rule = RULES.iter().find(|rule| rule.name == function).expect("a function of FMI");
            if life.allows(rule) {
                refused(&mut instance, call, &[&format!("{function}: "), argument, "null pointer"]);
            }
        };
        let (pointer, bytes) = (saved.pointer(), saved.bytes(&life.instance()));
        let (n, packed) = (bytes.len(), bytes.as_ptr().cast());
        let (unknown, known, seed, mut place) = (output.as_ptr(), state.as_ptr(), [1.0], [0.0]);
        let (seed, place) = (seed.as_ptr(), place.as_mut_ptr());
        null_pointers! { check;
            fmi2GetReal("vr": null(), 1, [0.0].as_mut_ptr());
            fmi2GetReal("value": real.as_ptr(), 1, null_mut());
            fmi2GetInteger("vr": null(), 1, [0].as_mut_ptr());
            fmi2GetInteger("value": choice.as_ptr(), 1, null_mut());
            fmi2GetBoolean("vr": null(), 1, [0].as_mut_ptr());
            fmi2GetString("vr": null(), 1, [null()].as_mut_ptr());
            fmi2SetReal("vr": null(), 1, [6.0].as_ptr());
            fmi2SetReal("value": real.as_ptr(), 1, null());
            fmi2SetInteger("vr": null(), 1, [2].as_ptr());
            fmi2SetInteger("value": choice.as_ptr(), 1, null());
            fmi2SetBoolean("vr": null(), 1, [0].as_ptr());
            fmi2SetString("vr": null(), 1, [null()].as_ptr());
            fmi2SetDebugLogging("categories": TRUE, 1, null());
            fmi2SetDebugLogging("category": TRUE, 2, [c"logAll".as_ptr(), null()].as_ptr());
            fmi2GetFMUstate("FMUstate": null_mut());
            fmi2SetFMUstate("FMUstate": null_mut());
            fmi2SerializedFMUstateSize("FMUstate": null_mut(), [0].as_mut_ptr());
            fmi2SerializedFMUstateSize("size": pointer, null_mut());
            fmi2SerializeFMUstate("FMUstate": null_mut(), [0; 8].as_mut_ptr(), 8);
            fmi2SerializeFMUstate("serializedState": pointer, null_mut(), n);
            fmi2DeSerializeFMUstate("serializedState": null(), n, [null_mut()].as_mut_ptr());
            fmi2DeSerializeFMUstate("FMUstate": packed, n, null_mut());
            fmi2GetDirectionalDerivative("vUnknown_ref": null(), 1, known, 1, seed, place);
            fmi2GetDirectionalDerivative("vKnown_ref": unknown, 1, null(), 1, seed, place);
            fmi2GetDirectionalDerivative("dvKnown": unknown, 1, known, 1, null(), place);
            fmi2GetDirectionalDerivative("dvUnknown": unknown, 1, known, 1, seed, null_mut());
            fmi2NewDiscreteStates("eventInfo": null_mut());
            fmi2CompletedIntegratorStep("enterEventMode": TRUE, null_mut(), [0].as_mut_ptr());
            fmi2CompletedIntegratorStep("terminateSimulation": TRUE, [0].as_mut_ptr(), null_mut());
            fmi2SetContinuousStates("x": null(), STATES);
            fmi2GetDerivatives("derivatives": null_mut(), STATES);
            fmi2GetContinuousStates("x": null_mut(), STATES);
            fmi2GetNominalsOfContinuousStates("x_nominal": null_mut(), STATES);
            fmi2SetRealInputDerivatives("vr": null(), 1, [1].as_ptr(), [0.0].as_ptr());
            fmi2SetRealInputDerivatives("order": unknown, 1, null(), [0.0].as_ptr());
            fmi2SetRealInputDerivatives("value": unknown, 1, [1].as_ptr(), null());
            fmi2GetRealOutputDerivatives("vr": null(), 1, [1].as_ptr(), place);
            fmi2GetRealOutputDerivatives("order": unknown, 1, null(), place);
            fmi2GetRealOutputDerivatives("value": unknown, 1, [1].as_ptr(), null_mut());
            fmi2GetStatus("value": status_kind::DO_STEP, null_mut());
            fmi2GetRealStatus("value": status_kind::LAST_SUCCESSFUL_TIME, null_mut());
            fmi2GetBooleanStatus("value": status_kind::TERMINATED, null_mut());
        }
        saved.free(&instance);
        assert_eq!(life.future(instance), life.future(life.instance()), "{life:?}: the way on is the same");
    }
}

unsafe extern "C" fn set_states(c: Component, x: *mut Real, n: Size) -> Status {
    // SAFETY: as the caller has it.
    unsafe { exports::fmi2SetContinuousStates(c, x, n) }
}

#[test]
fn fmi_wrong_counts_name_the_right_one() {
    const ROOM: usize = 2 * STATES;
    for life in Life::EACH {
        let mut instance = life.instance();
        let allows = |name: &str| life.allows(RULES.iter().find(|rule| rule.name == name).expect("a function of FMI"));
        let mut values = [0.5; ROOM];
        for n in [0, 1, STATES - 1, STATES + 1, ROOM] {
            type Pass = unsafe extern "C" fn(Component, *mut Real, Size) -> Status;
            let passes: [(&str, &str, usize, Pass); 5] = [
                ("fmi2GetContinuousStates", "nx", STATES, exports::fmi2GetContinuousStates),
                ("fmi2GetDerivatives", "nx", STATES, exports::fmi2GetDerivatives),
                ("fmi2GetNominalsOfContinuousStates", "nx", STATES, exports::fmi2GetNominalsOfContinuousStates),
                ("fmi2SetContinuousStates", "nx", STATES, set_states),
                ("fmi2GetEventIndicators", "ni", INDICATORS, exports::fmi2GetEventIndicators),
            ];
            for (function, name, right, pass) in passes.into_iter().filter(|pass| allows(pass.0) && n != pass.2) {
                // SAFETY: a live instance, and an array at least as long as told.
                let call = |c| unsafe { pass(c, values.as_mut_ptr(), n) };
                refused(&mut instance, call, &[&format!("{function}: {name} = {n} "), &format!("must be {right}")]);
                assert_eq!(values, [0.5; ROOM], "nothing is written");
            }
        }
        let saved = Saved::of(&instance);
        let size = saved.bytes(&instance).len();
        let mut bytes = vec![0x55_u8; size + 1];
        for wrong in [0, 1, size - 1, size + 1] {
            // SAFETY: a live instance and a state of its own, and room for more bytes than told.
            let call =
                |c| unsafe { exports::fmi2SerializeFMUstate(c, saved.pointer(), bytes.as_mut_ptr().cast(), wrong) };
            let words = [format!("size = {wrong} must be {size}"), "fmi2SerializedFMUstateSize".into()];
            refused(&mut instance, call, &["fmi2SerializeFMUstate: ", &words[0], &words[1]]);
            assert!(bytes.iter().all(|byte| *byte == 0x55), "nothing is written");
        }
        saved.free(&instance);
    }
}

#[test]
fn fmi_counts_beyond_memory_are_refused() {
    let one = [reference("rotor.m")];
    let mut instance = Instance::quiet();
    for n in [isize::MAX as usize / 4 + 1, usize::MAX] {
        // SAFETY: no array can be so long; nothing of it is looked at.
        let get = |c| unsafe { exports::fmi2GetReal(c, one.as_ptr(), n, [0.0].as_mut_ptr()) };
        refused(&mut instance, get, &["fmi2GetReal: ", &n.to_string(), "vr"]);
        // SAFETY: the same.
        let set = |c| unsafe { exports::fmi2SetReal(c, one.as_ptr(), n, [0.0].as_ptr()) };
        refused(&mut instance, set, &["fmi2SetReal: ", &n.to_string(), "vr"]);
        // SAFETY: the same.
        let read = |c| unsafe { exports::fmi2DeSerializeFMUstate(c, c"bytes".as_ptr(), n, [null_mut()].as_mut_ptr()) };
        refused(&mut instance, read, &["fmi2DeSerializeFMUstate: "]);
    }
}

#[test]
fn fmi_states_and_times_that_are_no_numbers_are_refused() {
    for stage in [Stage::EventMode, Stage::ContinuousTime] {
        let life = Life::new(MODEL_EXCHANGE, stage);
        let mut instance = life.instance();
        for wrong in [Real::NAN, Real::INFINITY, Real::NEG_INFINITY] {
            // SAFETY: a live instance.
            let call = |c| unsafe { exports::fmi2SetTime(c, wrong) };
            refused(&mut instance, call, &["fmi2SetTime: ", &format!("time = {wrong:?}"), "finite"]);
            if stage == Stage::EventMode {
                continue;
            }
            // A host may have tried a step that was too long: fmi2Discard, and it tries a shorter one.
            for n in [0, STATES - 1] {
                let (mut states, before) = (instance.states().expect("they can be read"), instance.serialized());
                states[n] = wrong;
                assert_eq!(instance.set_states(&states), Status::Discard);
                let words = format!("fmi2SetContinuousStates: state {} of {STATES} = {wrong:?} must be", n + 1);
                only(&instance.journal.take(), Status::Discard, &[&words]);
                assert_eq!(instance.serialized(), before);
            }
        }
        assert_eq!(life.future(instance), life.future(life.instance()), "{life:?}: the way on is the same");
    }
}

#[test]
fn regress_nominals_of_impossible_parameters_are_refused() {
    for life in Life::EACH.into_iter().filter(|life| life.kind == MODEL_EXCHANGE && !life.stage.has_started()) {
        for (name, wrong) in [("rotor.l", Real::NAN), ("rotor.Ja", Real::INFINITY), ("rotor.Jt", 0.0)] {
            let mut instance = life.instance();
            let nominals = instance.nominals().expect("the scene's parameters are possible");
            assert!(nominals.iter().all(|nominal| nominal.is_finite() && *nominal > 0.0), "{nominals:?}");
            instance.set_all(&[(name, wrong)]);
            let mut values = [0.5; STATES];
            // SAFETY: a live instance, and an array as long as told.
            let call = |c| unsafe { exports::fmi2GetNominalsOfContinuousStates(c, values.as_mut_ptr(), STATES) };
            refused(&mut instance, call, &["fmi2GetNominalsOfContinuousStates: ", name, "must be"]);
            assert_eq!(values, [0.5; STATES], "nothing is written");
        }
    }
}

#[test]
fn fmi_wrong_orders_and_derivatives_of_inputs_are_refused() {
    let output = reference("r_c.x");
    for life in Life::EACH.into_iter().filter(|life| life.kind == CO_SIMULATION && life.stage != Stage::Terminated) {
        let mut instance = life.instance();
        let mut check = |reference: ValueReference, order: Integer, value: Real, words: &[&str]| {
            // SAFETY: a live instance, arrays of one.
            let call = |c| unsafe {
                exports::fmi2SetRealInputDerivatives(c, [reference].as_ptr(), 1, [order].as_ptr(), [value].as_ptr())
            };
            refused(&mut instance, call, &[&["fmi2SetRealInputDerivatives: "], words].concat());
        };
        check(output, 1, 0.0, &["r_c.x", "is not an input"]);
        check(reference("rotor.m"), 1, 0.0, &["rotor.m", "is not an input"]);
        check(reference("solver.method"), 1, 0.0, &["solver.method", "not Real"]);
        check(NO_VARIABLE, 1, 0.0, &["value reference", &NO_VARIABLE.to_string()]);
        for input in inputs() {
            for order in [0, 4, -1, Integer::MAX, Integer::MIN] {
                check(input, order, 0.0, &[&input.to_string(), &format!("order = {order} "), "must be from 1 to 3"]);
            }
            for value in [Real::NAN, Real::INFINITY, Real::NEG_INFINITY] {
                for order in [1, 2, 3] {
                    check(input, order, value, &[&input.to_string(), &format!("{value:?}"), "finite"]);
                }
            }
        }
        assert_eq!(life.future(instance), life.future(life.instance()), "{life:?}: the way on is the same");
    }
}

#[test]
fn fmi_wrong_orders_of_output_derivatives_are_refused() {
    let output = reference("r_c.x");
    for life in Life::EACH.into_iter().filter(|life| life.kind == CO_SIMULATION) {
        if life.stage == Stage::Instantiated {
            continue;
        }
        let mut instance = life.instance();
        let mut check = |references: [ValueReference; 2], order: Integer, words: &[&str]| {
            let mut values = [0.5; 2];
            // SAFETY: a live instance, arrays of two.
            let call = |c| unsafe {
                let orders = [1, order];
                exports::fmi2GetRealOutputDerivatives(c, references.as_ptr(), 2, orders.as_ptr(), values.as_mut_ptr())
            };
            refused(&mut instance, call, &[&["fmi2GetRealOutputDerivatives: "], words].concat());
            assert_eq!(values, [0.5; 2], "nothing is written");
        };
        for order in [0, 2, -1, Integer::MAX, Integer::MIN] {
            check([output; 2], order, &["r_c.x", &format!("order = {order} "), "must be 1"]);
        }
        for (wrong, words) in [("rotor.m", "is not an output"), ("state.r.x", "is not an output")] {
            check([output, reference(wrong)], 1, &[wrong, words]);
        }
        check([output, reference("state.chart")], 1, &["state.chart", "not Real"]);
        check([output, NO_VARIABLE], 1, &["value reference", &NO_VARIABLE.to_string()]);
    }
}

#[test]
fn fmi_wrong_unknowns_knowns_and_seeds_are_refused() {
    let (output, state) = (reference("r_c.x"), reference("state.r.x"));
    for life in Life::EACH.into_iter().filter(|life| life.stage != Stage::Instantiated) {
        let mut instance = life.instance();
        let mut check = |unknown: ValueReference, known: ValueReference, seed: Real, words: &[&str]| {
            let mut values = [0.5; 2];
            // SAFETY: a live instance, arrays of two.
            let call = |c| unsafe {
                let (unknowns, knowns, seeds) = ([output, unknown], [state, known], [1.0, seed]);
                let place = values.as_mut_ptr();
                let (unknowns, knowns, seeds) = (unknowns.as_ptr(), knowns.as_ptr(), seeds.as_ptr());
                exports::fmi2GetDirectionalDerivative(c, unknowns, 2, knowns, 2, seeds, place)
            };
            refused(&mut instance, call, &[&["fmi2GetDirectionalDerivative: "], words].concat());
            assert_eq!(values, [0.5; 2], "nothing is written");
        };
        check(reference("rotor.m"), state, 1.0, &["rotor.m", "is no unknown"]);
        check(reference("state.chart"), state, 1.0, &["state.chart", "not Real"]);
        check(NO_VARIABLE, state, 1.0, &["value reference", &NO_VARIABLE.to_string()]);
        check(output, reference("rotor.m"), 1.0, &["rotor.m", "is no known"]);
        check(output, reference("r_c.y"), 1.0, &["r_c.y", "is no known"]);
        check(output, reference("der(state.r.x)"), 1.0, &["der(state.r.x)", "is no known"]);
        check(output, NO_VARIABLE, 1.0, &["value reference", &NO_VARIABLE.to_string()]);
        for seed in [Real::NAN, Real::INFINITY, Real::NEG_INFINITY] {
            check(output, state, seed, &["state.r.x", &format!("seed {seed:?}"), "finite"]);
        }
        for input in inputs() {
            check(input, state, 1.0, &[&input.to_string(), "is no unknown"]);
            check(output, input, Real::NAN, &[&input.to_string(), "seed NaN", "finite"]);
        }
    }
}

/// The status of a call that writes one value, which it leaves as it was where it is refused.
fn asked<T: Copy + PartialEq + Debug>(untouched: T, call: impl FnOnce(*mut T) -> Status) -> Status {
    let mut value = untouched;
    let status = call(&raw mut value);
    assert!(status == Status::Ok || value == untouched, "{value:?}: nothing is written");
    status
}

/// Tries one value reference through all eight functions that get and set; those that `right` names must succeed.
fn through_every_type(instance: &mut Instance, reference: ValueReference, right: &[&str], words: &[&str]) {
    type Attempt = (&'static str, unsafe fn(Component, ValueReference) -> Status);
    // SAFETY of the calls below: a live instance, arrays of one.
    let attempts: [Attempt; 8] = [
        // SAFETY: see above.
        ("fmi2GetReal", |c, r| asked(0.5, |value| unsafe { exports::fmi2GetReal(c, &raw const r, 1, value) })),
        // SAFETY: see above.
        ("fmi2GetInteger", |c, r| asked(77, |value| unsafe { exports::fmi2GetInteger(c, &raw const r, 1, value) })),
        // SAFETY: see above.
        ("fmi2GetBoolean", |c, r| asked(77, |value| unsafe { exports::fmi2GetBoolean(c, &raw const r, 1, value) })),
        // SAFETY: see above.
        ("fmi2GetString", |c, r| asked(null(), |value| unsafe { exports::fmi2GetString(c, &raw const r, 1, value) })),
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
    for (variable, kind) in scene().variables.iter().flat_map(|variable| KINDS.map(|kind| (variable, kind))) {
        let mut instance = Instance::of(kind);
        let right: &[&str] = match (variable.meta.kind, variable.meta.role) {
            (Kind::Real, Role::Parameter { .. }) => &["fmi2GetReal", "fmi2SetReal"],
            (Kind::Real, Role::Input { .. }) => &["fmi2GetReal", "fmi2SetReal"],
            (Kind::Real, _) => &["fmi2GetReal"],
            (Kind::Boolean, _) => &["fmi2GetBoolean", "fmi2SetBoolean"],
            (Kind::Integer | Kind::Enumeration(_), Role::Parameter { .. }) => &["fmi2GetInteger", "fmi2SetInteger"],
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
        for life in Life::EACH.into_iter().filter(|life| !life.stage.has_started()) {
            through_every_type(&mut life.instance(), reference, &[], &[&reference.to_string(), "value reference"]);
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
    let [own_m, own_l] = [m, l].map(|reference| scene().starts[&reference]);
    assert_eq!(values, [own_l, own_m, own_m, own_l]);
    assert_eq!(instance.write(&[m, l, m], &[1.0, 2.0, 3.0]), Status::Ok);
    assert_eq!(instance.get_all(["rotor.m", "rotor.l"]), [3.0, 2.0], "the last one counts");
}

#[test]
fn fmi_status_kinds_without_an_answer_are_errors() {
    for stage in [Stage::StepComplete, Stage::StepFailed, Stage::Terminated] {
        let mut instance = Life::new(CO_SIMULATION, stage).instance();
        let (do_step, pending) = (status_kind::DO_STEP, status_kind::PENDING);
        let (time, terminated) = (status_kind::LAST_SUCCESSFUL_TIME, status_kind::TERMINATED);
        for kind in [pending, time, terminated, -1, 4, Choice::MAX] {
            // SAFETY: a live instance, and a place to write to; the same below.
            let call = |c| asked(Status::Pending, |value| unsafe { exports::fmi2GetStatus(c, kind, value) });
            refused(&mut instance, call, &["fmi2GetStatus", &kind.to_string(), "fmi2DoStepStatus"]);
        }
        for kind in [do_step, pending, terminated, -1, 4, Choice::MIN] {
            // SAFETY: see above.
            let call = |c| asked(0.5, |value| unsafe { exports::fmi2GetRealStatus(c, kind, value) });
            refused(&mut instance, call, &["fmi2GetRealStatus", &kind.to_string(), "fmi2LastSuccessfulTime"]);
        }
        for kind in [do_step, pending, time, -1, 4] {
            // SAFETY: see above.
            let call = |c| asked(77, |value| unsafe { exports::fmi2GetBooleanStatus(c, kind, value) });
            refused(&mut instance, call, &["fmi2GetBooleanStatus", &kind.to_string(), "fmi2Terminated"]);
        }
    }
}

/// Parameters that cannot be simulated, and what the message must name.
const IMPOSSIBLE: [(&str, Real, [&str; 3]); 40] = [
    ("rotor.m", 0.0, ["rotor.m = 0.0", "> 0", ""]),
    ("rotor.m", -1.0, ["rotor.m = -1.0", "> 0", ""]),
    ("rotor.m", Real::NAN, ["rotor.m = NaN", "finite", "> 0"]),
    ("rotor.m", Real::INFINITY, ["rotor.m = inf", "finite", "> 0"]),
    ("rotor.Ja", 0.0, ["rotor.Ja = 0.0", "> 0", ""]),
    ("rotor.Ja", Real::NEG_INFINITY, ["rotor.Ja = -inf", "finite", "> 0"]),
    // Two moments of inertia that no body has: the axial one is above twice the transverse one.
    ("rotor.Ja", 1e3, ["rotor.Ja = 1000.0", "rotor.Jt", "thin disk"]),
    ("rotor.Jt", 1e-9, ["rotor.Ja", "rotor.Jt", "2e-9"]),
    ("rotor.Jt", -0.1, ["rotor.Jt = -0.1", "finite", "> 0"]),
    ("rotor.Jt", Real::NAN, ["rotor.Jt = NaN", "finite", "> 0"]),
    ("rotor.Jt", Real::INFINITY, ["rotor.Jt = inf", "finite", "> 0"]),
    ("rotor.l", Real::NAN, ["rotor.l = NaN", "finite", ""]),
    ("start.gamma.y", 3.2, ["|start.gamma| = 3.2", "pi", ""]),
    ("start.gamma.z", -3.2, ["|start.gamma| = 3.2", "pi", ""]),
    ("start.gamma.y", Real::NAN, ["start.gamma.y = NaN", "finite", ""]),
    ("start.r_c.z", Real::INFINITY, ["start.r_c.z = inf", "finite", ""]),
    ("start.phi", 5.66e16, ["start.phi = 5.66e16", "from -5.659390201622", "to 5.659390201622"]),
    ("start.phi", -1e300, ["start.phi = -1e300", "from -5.65", "whole turns"]),
    ("start.omega.z", Real::NEG_INFINITY, ["start.omega.z = -inf", "finite", ""]),
    ("gravity.g.z", Real::NAN, ["gravity.g.z = NaN", "finite", ""]),
    ("support.c1", -1.0, ["support.c1 = -1.0", ">= 0", ""]),
    ("support.d2", -1.0, ["support.d2 = -1.0", ">= 0", ""]),
    ("support.d2", Real::NAN, ["support.d2 = NaN", "finite", ">= 0"]),
    ("solver.relative_tolerance", 0.0, ["solver.relative_tolerance = 0.0", "1e-14", "0.1"]),
    ("solver.relative_tolerance", 5e-324, ["solver.relative_tolerance = 5e-324", "from 1e-14", "0.1"]),
    ("solver.relative_tolerance", 1e-30, ["solver.relative_tolerance = 1e-30", "from 1e-14", "0.1"]),
    ("solver.relative_tolerance", 1e-16, ["solver.relative_tolerance = 1e-16", "from 1e-14", "0.1"]),
    ("solver.relative_tolerance", 1e-15, ["solver.relative_tolerance = 1e-15", "1e-14", "0.1"]),
    ("solver.relative_tolerance", 0.2, ["solver.relative_tolerance = 0.2", "1e-14", "0.1"]),
    ("solver.relative_tolerance", Real::NAN, ["solver.relative_tolerance = NaN", "1e-14", "0.1"]),
    ("solver.absolute_tolerance", -1e-9, ["solver.absolute_tolerance = -1e-9", "0 or", "from 1e-20 to 0.01"]),
    ("solver.absolute_tolerance", 9e-21, ["solver.absolute_tolerance = 9e-21", "0 or", "from 1e-20 to 0.01"]),
    ("solver.absolute_tolerance", 0.011, ["solver.absolute_tolerance = 0.011", "0 or", "from 1e-20 to 0.01"]),
    ("solver.absolute_tolerance", 1e20, ["solver.absolute_tolerance = 1e20", "0 or", "from 1e-20 to 0.01"]),
    ("solver.absolute_tolerance", Real::NAN, ["solver.absolute_tolerance = NaN", "0 or", "from 1e-20 to 0.01"]),
    ("solver.max_evaluations", 999.0, ["solver.max_evaluations = 999.0", "from 1000.0 to 1000000000000.0", ""]),
    ("solver.max_evaluations", 2e12, ["solver.max_evaluations = 2000000000000.0", "from 1000.0", ""]),
    ("solver.max_evaluations", Real::NAN, ["solver.max_evaluations = NaN", "from 1000.0", ""]),
    ("solver.step_size", -1e-3, ["solver.step_size = -0.001", ">= 0", ""]),
    ("solver.step_size", Real::INFINITY, ["solver.step_size = inf", "finite", ">= 0"]),
];

#[test]
fn fmi_impossible_parameters_are_named_at_exit_of_initialization_and_can_be_mended() {
    // SAFETY: a live instance.
    let exit = |c| unsafe { exports::fmi2ExitInitializationMode(c) };
    for (name, value, words) in IMPOSSIBLE.into_iter().filter(|(name, _, _)| has(&[name])) {
        let mut instance = Instance::quiet();
        let right = instance.get(name);
        instance.set_all(&[(name, value)]);
        assert_eq!(instance.enter_initialization(), Status::Ok);
        refused(&mut instance, exit, &[&["fmi2ExitInitializationMode: ", "must be"], &words[..]].concat());
        instance.set_all(&[(name, right)]);
        // What a host set itself as the tolerance is the scene's again: nothing is left of the detour.
        let life = Life::new(CO_SIMULATION, Stage::Initialization);
        assert_eq!(life.future(instance), life.future(life.instance()), "{name} = {value}");
    }
    const WHOLE: [(&str, &[Integer], &str); 3] = [
        ("solver.method", &[0, 7, -1, Integer::MAX, Integer::MIN], "2 (dopri5) or 3 (dop853)"),
        ("solver.method_number", &[-1, 7, Integer::MAX, Integer::MIN], "0 or 1 or 2 or 3 or 4 or 5 or 6"),
        ("solver.order", &[0, 1, 3, 5, 10, -2, Integer::MAX, Integer::MIN], "2 or 4 or 6 or 8"),
    ];
    for (name, number, words) in
        WHOLE.iter().flat_map(|(name, these, words)| these.iter().map(move |n| (name, n, words)))
    {
        let mut instance = Instance::quiet();
        assert_eq!(instance.set_integer(reference(name), *number), Status::Ok);
        assert_eq!(instance.enter_initialization(), Status::Ok);
        refused(&mut instance, exit, &[name, &number.to_string(), words]);
    }
}

#[test]
fn fmi_the_limits_themselves_are_possible() {
    let mut instance = Instance::quiet();
    let jt = instance.get("rotor.Jt");
    // Above the limit of both components together, though each alone is below it.
    instance.set_all(&[("start.gamma.y", 3.0), ("start.gamma.z", 4.0)]);
    assert_eq!(instance.enter_initialization(), Status::Ok);
    // SAFETY: a live instance.
    let exit = |c| unsafe { exports::fmi2ExitInitializationMode(c) };
    refused(&mut instance, exit, &["|start.gamma| = 5.0 is not possible: it must be at most pi"]);
    instance.set_all(&[("start.gamma.z", 0.0), ("rotor.Ja", 2.0 * jt)]);
    instance.set_all(&there(&[("support.c1", 0.0), ("support.c2", 0.0)]));
    assert_eq!(instance.exit_initialization(), Status::Ok);
}

#[test]
fn regress_an_energy_that_overflows_at_the_start_names_the_parameters() {
    // SAFETY: a live instance.
    let exit = |c| unsafe { exports::fmi2ExitInitializationMode(c) };
    const CASES: [(&[(&str, Real)], &str); 5] = [
        (&[("gravity.g.y", -Real::MAX), ("start.r_c.y", 0.5)], "gravity.g.y = -1.7976931348623157e308"),
        (&[("rotor.m", 1e308), ("start.v_c.x", 100.0)], "rotor.m = 1e308"),
        (&[("start.omega.y", -1e200)], "start.omega.y = -1e200"),
        (&[("start.v_c.x", 1e155), ("start.v_c.z", 1e160)], "start.v_c.z = 1e160 and start.v_c.x = 1e155"),
        (&[("rotor.Jt", 1e300), ("start.omega.z", 1e10)], "rotor.Jt = 1e300"),
    ];
    for (values, name) in CASES.into_iter().filter(|(values, _)| values.iter().all(|(name, _)| has(&[name]))) {
        let mut instance = Instance::quiet();
        instance.set_all(values);
        assert_eq!(instance.enter_initialization(), Status::Ok);
        refused(&mut instance, exit, &[&format!("{name} cannot"), "the energy at the start overflows"]);
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
        let defined = |value: Option<Real>| Boolean::from(value.is_some());
        // SAFETY: a live instance.
        let call = |c| unsafe {
            let (of_tolerance, of_stop) = (tolerance.unwrap_or(0.0), stop.unwrap_or(0.0));
            exports::fmi2SetupExperiment(c, defined(tolerance), of_tolerance, start, defined(stop), of_stop)
        };
        refused(&mut instance, call, &[&format!("fmi2SetupExperiment: {argument} = ")]);
    }
    let mut undisturbed = Instance::quiet();
    assert_eq!(undisturbed.setup(Some(1e-6), 1.0, Some(1.1)), Status::Ok);
    let (mut instance, mut undisturbed) = (instance.initialized(), undisturbed.initialized());
    assert_eq!(instance.run(1.0, 0.05, 2), undisturbed.run(1.0, 0.05, 2));
    assert_eq!(instance.do_step(1.1, 0.05), Status::Error, "the stop time holds");
}
