//! Inputs: what is held, what derivatives add, what belongs together, and what is forgotten when. They run where the scene
//! has the input `drive.tau`; without springs and gravity its torque τ turns the rotor about its axis e, and Ja dω/dt = τ.

use crate::harness::{Instance, Saved, reference, refused, scene};
use split_rotor::abi::{CO_SIMULATION, Integer, MODEL_EXCHANGE, Real, Status, ValueReference};
use split_rotor::exports::fmi2SetReal;

const TAU: &str = "drive.tau";

/// Nothing but the drive acts, and nothing moves.
const FREE: [(&str, Real); 8] = [
    ("gravity.g.z", 0.0),
    ("support.c1", 0.0),
    ("support.c2", 0.0),
    ("support.d1", 0.0),
    ("support.d2", 0.0),
    ("start.omega.x", 0.0),
    ("start.omega.y", 0.0),
    ("start.omega.z", 0.0),
];

/// The value of the input [N·m], its rate [N·m/s], its second [N·m/s²] and third derivative [N·m/s³]: of order 0 to 3.
type Sent = [(Integer, Real)];

fn tau() -> ValueReference {
    reference(TAU)
}

/// An instance under nothing but the drive's torque, which is what was sent before the start.
fn free(sent: &Sent) -> Instance {
    let mut instance = Instance::quiet();
    send(&mut instance, sent);
    instance.started(&FREE)
}

#[track_caller]
fn send(instance: &mut Instance, sent: &Sent) {
    for (order, value) in sent {
        let status = match order {
            0 => instance.write(&[tau()], &[*value]),
            _ => instance.send(tau(), *order, *value),
        };
        assert_eq!(status, Status::Ok, "{:?}", instance.journal.take());
    }
}

/// How near omega.x [rad/s] comes to its closed form, relative to the larger of its size and 1; measured 3e-14, allow 3e-13.
const NEARNESS: Real = 3e-13;

/// Steps from `from` [s]; at the end of each the input is u(s) [N·m] and omega.x is ω₀ + ∫u ds / Ja, s counting from `from`.
#[track_caller]
fn follows<const N: usize>(instance: &mut Instance, from: Real, polynomial: [Real; N]) {
    let [u, slope, curvature, third] = std::array::from_fn(|n| polynomial.get(n).copied().unwrap_or_default());
    let (start, inertia) = (instance.get("omega.x"), instance.get("rotor.Ja"));
    // All times are exact in binary.
    for n in 1..=8 {
        let step = 0.125;
        assert_eq!(
            instance.do_step(from + step * Real::from(n - 1), step),
            Status::Ok,
            "{:?}",
            instance.journal.take()
        );
        let s = step * Real::from(n);
        assert_eq!(
            instance.get(TAU),
            u + s * (slope + s * (0.5 * curvature + s * (third * (1.0 / 6.0)))),
            "the input after {s} s"
        );
        let expected = start + s * (u + s * (slope / 2.0 + s * (curvature / 6.0 + s * third / 24.0))) / inertia;
        let found = instance.get("omega.x");
        assert!(
            (found - expected).abs() < NEARNESS * expected.abs().max(1.0),
            "{found:?}, not {expected:?} after {s} s"
        );
    }
}

#[test]
#[cfg_attr(not(scene_is_driven), ignore = "needs a scene with drive, support and gravity")]
fn exact_a_value_is_held() {
    let mut instance = free(&[]);
    let own = scene().starts[&tau()];
    assert_eq!(instance.get(TAU), own, "the value of the scene, until somebody sets it");
    follows(&mut instance, 0.0, [own, 0.0, 0.0]);
    // It acts from the communication point on where it was set, and is seen there at once.
    send(&mut instance, &[(0, -0.75)]);
    assert_eq!(instance.get(TAU), -0.75);
    let expected = -0.75 / instance.get("rotor.Ja");
    assert!((instance.get("drive.a") - expected).abs() < NEARNESS * expected.abs());
    follows(&mut instance, 1.0, [-0.75, 0.0, 0.0]);
    follows(&mut instance, 2.0, [-0.75, 0.0, 0.0]);
}

#[test]
#[cfg_attr(not(scene_is_driven), ignore = "needs a scene with drive, support and gravity")]
fn exact_a_value_and_its_derivatives_belong_together_in_any_order() {
    let (value, slope, curvature) = ((0, 2.0), (1, -3.0), (2, 5.0));
    let orders = [
        [value, slope, curvature],
        [value, curvature, slope],
        [slope, value, curvature],
        [slope, curvature, value],
        [curvature, value, slope],
        [curvature, slope, value],
    ];
    for (place, sent) in (0..4).cycle().zip(orders) {
        let (before, after) = sent.split_at(place);
        let with_third = [before, &[(3, -12.0)], after].concat();
        // Before the start, and on the way, over what was sent before.
        let mut instance = free(&sent);
        follows(&mut instance, 0.0, [2.0, -3.0, 5.0]);
        send(&mut instance, &[(0, 1.0), (1, 40.0), (2, -70.0)]);
        follows(&mut instance, 1.0, [1.0, 40.0, -70.0]);
        send(&mut instance, &with_third);
        follows(&mut instance, 2.0, [2.0, -3.0, 5.0, -12.0]);
        send(&mut instance, &sent);
        follows(&mut instance, 3.0, [2.0, -3.0, 5.0]);
    }
}

#[test]
#[cfg_attr(not(scene_is_driven), ignore = "needs a scene with drive, support and gravity")]
fn exact_what_is_not_sent_is_zero_and_the_value_goes_on() {
    // Each alone and without the others, at a point where the polynomial of before has the value 2 − 3 + 5/2.
    let before: [(Integer, Real); 3] = [(0, 2.0), (1, -3.0), (2, 5.0)];
    let cases: [(&Sent, [Real; 3]); 6] = [
        (&[(0, 4.0)], [4.0, 0.0, 0.0]),
        (&[(1, 6.0)], [1.5, 6.0, 0.0]),
        (&[(2, 7.0)], [1.5, 0.0, 7.0]),
        (&[(0, 4.0), (2, 7.0)], [4.0, 0.0, 7.0]),
        (&[(2, 7.0), (1, 6.0)], [1.5, 6.0, 7.0]),
        (&[(1, 6.0), (0, 4.0)], [4.0, 6.0, 0.0]),
    ];
    for (sent, polynomial) in cases {
        let mut instance = free(&before);
        follows(&mut instance, 0.0, [2.0, -3.0, 5.0]);
        send(&mut instance, sent);
        follows(&mut instance, 1.0, polynomial);
    }
    // Sent twice at one point, the last counts.
    let mut instance = free(&[(1, 9.0), (0, 8.0), (1, 6.0), (0, 4.0)]);
    follows(&mut instance, 0.0, [4.0, 6.0, 0.0]);
    // Not sent again, a polynomial stays in force.
    let mut instance = free(&before);
    follows(&mut instance, 0.0, [2.0, -3.0, 5.0]);
    follows(&mut instance, 1.0, [2.0 - 3.0 + 2.5, -3.0 + 5.0, 5.0]);
}

#[test]
#[cfg_attr(not(scene_is_driven), ignore = "needs a scene with drive, support and gravity")]
fn exact_what_is_sent_before_the_run_counts_from_its_start() {
    for start in [4.0, -8.0] {
        let mut instance = Instance::quiet();
        // Some before fmi2SetupExperiment, some after it, some in initialization mode.
        send(&mut instance, &[(2, 5.0)]);
        assert_eq!(instance.setup(None, start, None), Status::Ok);
        send(&mut instance, &[(1, -3.0)]);
        instance.set_all(&FREE);
        assert_eq!(instance.enter_initialization(), Status::Ok);
        send(&mut instance, &[(0, 2.0)]);
        assert_eq!(instance.get(TAU), 2.0);
        assert_eq!(instance.exit_initialization(), Status::Ok);
        follows(&mut instance, start, [2.0, -3.0, 5.0]);
    }
}

#[test]
#[cfg_attr(not(scene_is_driven), ignore = "needs a scene with drive, support and gravity")]
fn exact_a_rollback_brings_the_input_back_and_it_can_be_set_again() {
    let mut instance = free(&[(0, 2.0), (1, -3.0), (2, 5.0)]);
    follows(&mut instance, 0.0, [2.0, -3.0, 5.0]);
    let saved = Saved::of(&instance);
    let bytes = saved.bytes(&instance);
    send(&mut instance, &[(0, 100.0), (1, 200.0)]);
    follows(&mut instance, 1.0, [100.0, 200.0, 0.0]);
    saved.restore(&instance);
    assert_eq!(instance.get(TAU), 1.5);
    follows(&mut instance, 1.0, [1.5, 2.0, 5.0]);
    // Set at the point of the rollback; also in an instance that gets it as bytes.
    saved.restore(&instance);
    saved.free(&instance);
    let mut other = Instance::quiet();
    Saved::unpack(&other, &bytes);
    for instance in [&mut instance, &mut other] {
        send(instance, &[(1, 6.0)]);
        follows(instance, 1.0, [1.5, 6.0, 0.0]);
    }
    assert_eq!(instance.bits(), other.bits());
}

#[test]
#[cfg_attr(not(scene_is_driven), ignore = "needs a scene with drive, support and gravity")]
fn exact_a_saved_point_remembers_what_was_already_sent_there() {
    let mut instance = free(&[]);
    follows(&mut instance, 0.0, [scene().starts[&tau()], 0.0, 0.0]);
    send(&mut instance, &[(1, 6.0)]);
    let saved = Saved::of(&instance);
    send(&mut instance, &[(0, 4.0)]);
    follows(&mut instance, 1.0, [4.0, 6.0, 0.0]);
    saved.restore(&instance);
    saved.free(&instance);
    // The derivative sent before the state was saved, and the value sent now, are of one point.
    send(&mut instance, &[(0, 4.0)]);
    follows(&mut instance, 1.0, [4.0, 6.0, 0.0]);
}

#[test]
#[cfg_attr(not(scene_is_driven), ignore = "needs a scene with drive, support and gravity")]
fn fmi_values_that_are_no_numbers_are_refused_and_the_old_ones_kept() {
    for kind in [CO_SIMULATION, MODEL_EXCHANGE] {
        let mut instance = Instance::of(kind);
        send(&mut instance, &[(0, 2.0)]);
        let mut instance = instance.started(&FREE);
        for wrong in [Real::NAN, Real::INFINITY, Real::NEG_INFINITY] {
            // Of derivatives: arguments.rs.
            // SAFETY: a live instance, arrays of one or two.
            let set = |c| unsafe { fmi2SetReal(c, [tau()].as_ptr(), 1, [wrong].as_ptr()) };
            refused(&mut instance, set, &["fmi2SetReal: ", TAU, &format!("{wrong:?}"), "finite"]);
            // SAFETY: the same.
            let list = |c| unsafe { fmi2SetReal(c, [tau(); 2].as_ptr(), 2, [7.0, wrong].as_ptr()) };
            refused(&mut instance, list, &["fmi2SetReal: ", TAU, &format!("{wrong:?}")]);
        }
        assert_eq!(instance.get(TAU), 2.0);
        if kind == CO_SIMULATION {
            follows(&mut instance, 0.0, [2.0, 0.0, 0.0]);
        }
    }
}

#[test]
#[cfg_attr(not(scene_is_driven), ignore = "needs a scene with drive, support and gravity")]
fn exact_in_model_exchange_an_input_acts_at_once() {
    let mut instance = Instance::of(MODEL_EXCHANGE).started(&FREE);
    instance.settled();
    let inertia = instance.get("rotor.Ja");
    for (time, value) in [(0.0, 2.0), (0.5, -3.0), (0.25, 7.0), (0.25, 0.0)] {
        assert_eq!(instance.set_time(time), Status::Ok);
        send(&mut instance, &[(0, value)]);
        assert_eq!(instance.get_all([TAU, "der(state.K.x)"]), [value; 2]);
        assert!((instance.get("drive.a") * inertia - value).abs() <= NEARNESS * value.abs());
        let rates = instance.rates().expect("they can be calculated");
        assert_eq!(rates[6], value, "the rate of K.x");
        // It is held, whatever time the host then tries.
        assert_eq!(instance.set_time(time + 10.0), Status::Ok);
        assert_eq!(instance.get(TAU), value);
    }
}

/// What a second of the scene's own motion shows, the input set so many times before each of 64 steps: to one value in the
/// first half, to another in the second.
fn second(times: impl Fn(u32) -> u32) -> [Real; 6] {
    let mut instance = Instance::quiet().started(&[]);
    for n in 0..64 {
        for _ in 0..times(n) {
            send(&mut instance, &[(0, if n < 32 { 1.5 } else { -2.5 })]);
        }
        assert_eq!(instance.do_step(Real::from(n) / 64.0, 1.0 / 64.0), Status::Ok);
    }
    instance.get_all(["phi", "r_c.z", "gamma.y", "omega.x", "omega.y", "energy.residual"])
}

#[test]
#[cfg_attr(not(scene_is_driven), ignore = "needs a scene with drive, support and gravity")]
fn fmi_the_motion_does_not_depend_on_how_often_the_same_value_is_set() {
    /// Of the energy ledger [J]; measured 5e-13, allow 5e-12.
    const LEDGER: Real = 5e-12;
    let once = second(|n| u32::from(n == 0 || n == 32));
    for often in [second(|_| 1), second(|n| if n % 32 == 0 { 1 } else { n % 3 })] {
        assert_eq!(once[..5], often[..5]);
        assert!(often[5].abs() < LEDGER, "{:?}", often[5]);
    }
}

#[test]
#[cfg_attr(not(scene_is_driven), ignore = "needs a scene with drive, support and gravity")]
fn regress_a_refused_start_leaves_the_inputs_as_they_were() {
    let mut instance = Instance::quiet();
    assert_eq!(instance.setup(None, 4.0, None), Status::Ok);
    send(&mut instance, &[(1, -3.0), (2, 5.0)]);
    instance.set_all(&FREE);
    let right = instance.get("rotor.m");
    instance.set_all(&[("rotor.m", -1.0)]);
    assert_eq!(instance.enter_initialization(), Status::Ok);
    let before = instance.serialized();
    assert_eq!(instance.exit_initialization(), Status::Error);
    assert!(instance.serialized() == before, "nothing changed");
    // A value sent now still belongs to the derivatives.
    instance.set_all(&[("rotor.m", right)]);
    send(&mut instance, &[(0, 2.0)]);
    assert_eq!(instance.exit_initialization(), Status::Ok);
    follows(&mut instance, 4.0, [2.0, -3.0, 5.0]);
}

/// The warnings of an instance on its inputs since it was last asked. A free rotor under a torque warns of other things too.
fn warnings(instance: &Instance) -> Vec<String> {
    let records = instance.journal.take().into_iter().filter(|record| record.category == "logStatusWarning");
    records.map(|record| record.message).filter(|message| message.contains("input")).collect()
}

#[test]
#[cfg_attr(not(scene_is_driven), ignore = "needs a scene with drive, support and gravity")]
fn fmi_a_host_that_sends_zeros_where_the_scene_has_others_is_warned_once() {
    // By nobody, by a host that connects nothing, by one that does, and by one that sends 0 later.
    let cases: [(Option<Real>, usize); 4] = [(None, 0), (Some(0.0), 1), (Some(-0.0), 1), (Some(0.1), 0)];
    for (first, expected) in cases {
        for kind in [CO_SIMULATION, MODEL_EXCHANGE] {
            let mut instance = Instance::of(kind).started(&FREE);
            for n in 0..3 {
                if let Some(value) = first {
                    send(&mut instance, &[(0, if n == 0 { value } else { 0.0 })]);
                }
                if kind == CO_SIMULATION {
                    assert_eq!(instance.do_step(0.1 * Real::from(n), 0.1), Status::Ok);
                } else {
                    instance.settled();
                    assert_eq!(instance.set_time(0.1 * Real::from(n + 1)), Status::Ok);
                    assert_eq!(instance.enter_event_mode(), Status::Ok);
                }
            }
            let found = warnings(&instance);
            assert_eq!(found.len(), expected, "{first:?}: {found:?}");
            let own = scene().starts[&tau()];
            let words = ["all inputs are 0".to_owned(), format!("{TAU} = {own:?}"), "connect".to_owned()];
            assert!(found.iter().all(|message| words.iter().all(|word| message.contains(word))), "{found:?}");
        }
    }
}
