//! What fmi2DoStep does through the C interface: which times it takes and refuses, what stands in the way of a step and
//! what is left then, and that a motion depends on nothing but its parameters: not on the communication steps, not on a
//! reset. `solver.rs` says which tolerance and method are in force; `tests/c` runs instances beside one another, and threads.

use crate::harness::{Instance, only, reference, scene, there, tumbling};
use split_rotor::abi::{Real, Status, TRUE, ValueReference};
use split_rotor::exports::fmi2DoStep;
use split_rotor_model::variable::{Kind, Role};

/// What the motion is, without what it cost: a reading between two steps of the solver's costs evaluations.
fn shown() -> Vec<&'static str> {
    let outputs = scene().variables.iter().filter(|v| v.meta.kind == Kind::Real && matches!(v.meta.role, Role::Output));
    outputs.map(|variable| variable.name.as_str()).filter(|name| !name.starts_with("solver.")).collect()
}

fn motion(instance: &mut Instance) -> Vec<u64> {
    shown().into_iter().map(|name| instance.get(name).to_bits()).collect()
}

/// An fmi2DoStep that must be refused with one log line that names these words, and must change nothing.
#[track_caller]
fn refused(instance: &mut Instance, from: Real, step: Real, words: &[&str]) {
    // SAFETY: a live instance.
    let call = |c| unsafe { fmi2DoStep(c, from, step, TRUE) };
    crate::harness::refused(instance, call, &[&["fmi2DoStep: "], words].concat());
}

#[test]
fn fmi_the_experiment_may_start_at_any_time() {
    /// What the rounding of times does to the motion, relative to the larger of its size and 1; measured 1.6e-11 (omega.y
    /// from −8 s), allow 1e-10.
    const ROUNDING: Real = 1e-10;
    // At 1e-4 with all that the solver does; at tighter tolerances rounding has a say in its first steps, where loads have hardly
    // changed, and so in those that follow: at 1e-6 two runs differ by up to 1.9e-8.
    let end = |start: Real, tolerance: Option<Real>| {
        let mut instance = Instance::quiet();
        assert_eq!(instance.setup(tolerance, start, None), Status::Ok);
        let mut instance = instance.initialized();
        assert_eq!(instance.last_successful_time(), Ok(start));
        assert_eq!(instance.do_step(start, 1.0), Status::Ok);
        assert_eq!(instance.last_successful_time(), Ok(start + 1.0));
        let spent = instance.get_all(["solver.steps", "solver.rejected", "solver.evaluations"]);
        (shown().into_iter().map(|name| instance.get(name)).collect::<Vec<_>>(), tolerance.map(|_| spent))
    };
    for (start, tolerance) in [-8.0, 0.5, 3.0, 1e3].into_iter().flat_map(|start| [(start, None), (start, Some(1e-4))]) {
        let ((found, spent), (expected, expected_spent)) = (end(start, tolerance), end(0.0, tolerance));
        assert_eq!(spent, expected_spent, "from {start} s");
        // Forces, of stiff springs, are measured on another scale.
        let all = found.into_iter().zip(expected).zip(shown()).filter(|(_, name)| !name.starts_with("support."));
        for ((value, expected), name) in all {
            let difference = (value - expected).abs() / expected.abs().max(1.0);
            assert!(difference < ROUNDING, "{name} from {start} s: {difference:e}");
        }
    }
}

#[test]
fn fmi_wrong_communication_points_are_refused() {
    let mut instance = Instance::quiet().started(&[]);
    for from in [0.1, -0.1, Real::NAN, Real::INFINITY] {
        refused(&mut instance, from, 0.1, &["currentCommunicationPoint", &format!("{from:?}"), "must be 0.0"]);
    }
    assert_eq!(instance.do_step(0.0, 0.1), Status::Ok);
    for from in [0.0, 0.2] {
        refused(&mut instance, from, 0.1, &["currentCommunicationPoint", &format!("{from:?}"), "must be 0.1"]);
    }
    assert_eq!(instance.do_step(0.1, 0.1), Status::Ok);
}

#[test]
fn fmi_wrong_step_sizes_are_refused() {
    let mut instance = Instance::quiet().started(&[]);
    for step in [0.0, -0.0, -0.1, Real::NAN, Real::INFINITY, Real::NEG_INFINITY] {
        refused(&mut instance, 0.0, step, &["communicationStepSize", &format!("{step:?}")]);
    }
    assert_eq!(instance.do_step(0.0, 0.1), Status::Ok);
    for step in [0.0, -0.1, Real::NAN] {
        refused(&mut instance, 0.1, step, &["communicationStepSize", &format!("{step:?}")]);
    }
}

#[test]
fn fmi_a_step_that_does_not_advance_the_time_is_refused() {
    // An ulp of 1e6 is 1.2e-10.
    let mut instance = Instance::quiet();
    assert_eq!(instance.setup(None, 1e6, None), Status::Ok);
    let mut instance = instance.initialized();
    for step in [1e-11, 5e-11, Real::MIN_POSITIVE] {
        refused(&mut instance, 1e6, step, &["communicationStepSize", &format!("{step:?}"), "too small"]);
    }
    // The least step that does.
    let least = 1e6_f64.next_up() - 1e6;
    assert_eq!(instance.do_step(1e6, least), Status::Ok);
    assert_eq!(instance.last_successful_time(), Ok(1e6_f64.next_up()));
    // At 0 s any step advances.
    assert_eq!(Instance::quiet().started(&[]).do_step(0.0, Real::MIN_POSITIVE), Status::Ok);
}

#[test]
fn fmi_times_are_equal_within_a_part_of_the_step_and_some_ulps() {
    // 1e-9 h counts where the step is long: at 1 s an ulp is 2.2e-16.
    for (offset, expected) in
        [(0.9e-10, Status::Ok), (-0.9e-10, Status::Ok), (1.1e-10, Status::Error), (-1.1e-10, Status::Error)]
    {
        let mut instance = Instance::quiet().started(&[]);
        assert_eq!(instance.do_step(0.0, 1.0), Status::Ok);
        assert_eq!(instance.do_step(1.0 + offset, 0.1), expected, "{offset:e} s off");
    }
    // 4 ulps count where the time is large: at 1e6 s they are 4.7e-10, and 1e-9 h is 1e-13.
    let ulp = 1e6_f64.next_up() - 1e6;
    for (ulps, expected) in [(4.0, Status::Ok), (-4.0, Status::Ok), (5.0, Status::Error), (-5.0, Status::Error)] {
        let mut instance = Instance::quiet();
        assert_eq!(instance.setup(None, 1e6, None), Status::Ok);
        assert_eq!(instance.initialized().do_step(1e6 + ulps * ulp, 1e-4), expected, "{ulps} ulps off");
    }
}

#[test]
fn fmi_no_step_goes_past_the_stop_time() {
    let mut instance = Instance::quiet();
    assert_eq!(instance.setup(None, 0.0, Some(0.25)), Status::Ok);
    let mut instance = instance.initialized();
    instance.run(0.0, 0.125, 1);
    for step in [0.25, 0.125 + 1e-9, 1e300] {
        refused(&mut instance, 0.125, step, &["stop time 0.25", &format!("{:?}", 0.125 + step)]);
    }
    // Past it by no more than times are equal: 1e-9 h.
    assert_eq!(instance.do_step(0.125, 0.125 + 1e-10), Status::Ok);
    refused(&mut instance, 0.25 + 1e-10, 0.125, &["stop time"]);
    // Without a stop time there is no limit.
    let mut instance = Instance::quiet().started(&[]);
    assert_eq!(instance.do_step(0.0, 12.0), Status::Ok);
}

#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn exact_a_step_that_cannot_be_done_stands_at_the_last_successful_time() {
    /// How near the last time [s], the tilt [rad], the fall [m], the speed [rad/s] and the energy [1] come to what is
    /// exact: the steps shrink until they advance no more. Measured 1.8e-15, allow 1e-14.
    /// The drifts of a composition are rounded more often: measured 1.5e-14; so is what follows from an axis.
    const NEARNESS: Real = 1e-14;
    const OF_DRIFTS: Real = 5e-14;
    // γ_y = 30 rad/s · t until 3.1 rad.
    let tumbling = tumbling();
    for method in [2, 3, 4, 5, 6] {
        let nearness = if [4, 6].contains(&method) { OF_DRIFTS } else { NEARNESS };
        let mut instance = Instance::quiet();
        instance.set_method(method);
        let mut instance = instance.started(&tumbling);
        instance.run(0.0, 0.01, 10);
        assert_eq!((instance.step_status(), instance.terminated()), (Ok(Status::Ok), Ok(false)));
        // Past pi/2 it is warned, once.
        only(&instance.journal.take(), Status::Warning, &[]);
        assert_eq!(instance.do_step(0.1, 0.01), Status::Discard);
        let words = ["fmi2DoStep: ", "|gamma|", "3.1 rad", "t = 0.1033"];
        only(&instance.journal.take(), Status::Discard, &words);
        assert_eq!((instance.step_status(), instance.terminated()), (Ok(Status::Discard), Ok(true)));
        let last = instance.last_successful_time().expect("a step was made");
        assert!((3.1 / 30.0 - last).abs() < nearness, "{last:?}");
        // The values are those of that time: exactly γ_y = 30 t, and gravity has let the rotor fall.
        assert!(instance.bits().into_iter().all(|bits| Real::from_bits(bits).is_finite()));
        let [gamma_y, gamma_z, z, phi, omega_y] = instance.get_all(["gamma.y", "gamma.z", "r_c.z", "phi", "omega.y"]);
        let axis = instance.get_all(["axis.x", "axis.y", "axis.z"]);
        for (found, exact) in axis.into_iter().zip([gamma_y.cos(), 0.0, -gamma_y.sin()]) {
            assert!((found - exact).abs() < nearness, "{axis:?}");
        }
        assert!(
            gamma_y <= 3.1 + nearness && (gamma_y - 30.0 * last).abs() < nearness,
            "{gamma_y:?} {:e}",
            gamma_y - 30.0 * last
        );
        assert!((z + 0.5 * 9.81 * last * last).abs() < nearness, "{z:?}");
        assert!(gamma_z == 0.0 && (omega_y - 30.0).abs() < nearness);
        assert!(phi == 0.0 || (method == 4 && phi.abs() < nearness), "{phi:e}");
        assert!(instance.get("energy.residual").abs() < nearness * instance.get("energy.total"));
    }
}

#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn regress_a_step_that_cannot_be_done_ends_wherever_it_is_on_the_time_axis() {
    // Near t = 0 the time has far finer digits than the state, so that it still advances is no reason to go on.
    let law_ends = 3.1 / 30.0;
    for start in [0.0, -law_ends, -0.1, -0.05, 1e6] {
        let mut instance = Instance::quiet();
        instance.set_all(&tumbling());
        assert_eq!(instance.setup(None, start, None), Status::Ok);
        let mut instance = instance.initialized();
        assert_eq!(instance.do_step(start, 1.0), Status::Discard, "from {start:?} s");
        let last = instance.last_successful_time().expect("a step was made");
        // At 1e6 s the time is rounded to 1e-10 s.
        assert!((last - start - law_ends).abs() < 1e-9, "{last:?} from {start:?} s");
    }
    // From where the law ends.
    let mut instance = Instance::quiet().started(&[tumbling(), vec![("start.gamma.y", 3.0999999)]].concat());
    assert_eq!(instance.do_step(0.0, 0.05), Status::Discard);
    assert!(instance.last_successful_time().is_ok_and(|last| (0.0..=1e-6).contains(&last)));
}

#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn fmi_after_a_step_that_cannot_be_done() {
    let tumbling = tumbling();
    // Up to the end of the law all is well: the step is refused, not the motion.
    let mut instance = Instance::quiet().started(&tumbling);
    for (from, step, expected) in [(0.0, 0.1, Status::Ok), (0.1, 1e-3, Status::Ok), (0.101, 0.01, Status::Discard)] {
        assert_eq!(instance.do_step(from, step), expected);
        assert_eq!(instance.terminated(), Ok(expected == Status::Discard));
    }
    let mut instance = Instance::quiet().started(&tumbling);
    assert_eq!(instance.do_step(0.0, 1.0), Status::Discard);
    let last = instance.last_successful_time().expect("a step was made");
    let shown = motion(&mut instance);
    // The step repeated, from where it started: that is not where the instance stands.
    refused(&mut instance, 0.0, 1.0, &["currentCommunicationPoint", &format!("{last:?}")]);
    // A step from where it stands fails again, however short, and nothing moves.
    for step in [0.5, 1e-3, 1e-9] {
        assert_eq!(instance.do_step(last, step), Status::Discard);
        assert_eq!(instance.last_successful_time(), Ok(last));
        assert_eq!(motion(&mut instance), shown);
        assert_eq!((instance.step_status(), instance.terminated()), (Ok(Status::Discard), Ok(true)));
    }
    // It can be ended like any other, and its last values stay.
    assert_eq!(instance.terminate(), Status::Ok);
    assert_eq!(instance.last_successful_time(), Ok(last));
    assert_eq!(motion(&mut instance), shown);
    // A reset makes it new: the scene's values, and no trace of the failure.
    assert_eq!(instance.reset(), Status::Ok);
    let mut instance = instance.started(&[]);
    assert_eq!((instance.step_status(), instance.terminated()), (Ok(Status::Ok), Ok(false)));
    assert_eq!(instance.run(0.0, 0.01, 20), Instance::quiet().started(&[]).run(0.0, 0.01, 20));
}

#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn fmi_a_force_that_overflows_is_a_discarded_step() {
    // A mass so small that the acceleration overflows, though force and energy do not.
    let mut instance = Instance::quiet().started(&[("rotor.m", 1e-300), ("support.c1", 1e10), ("start.r_c.x", 1e3)]);
    assert_eq!(instance.do_step(0.0, 0.01), Status::Discard);
    only(&instance.journal.take(), Status::Discard, &["infinite or not a number"]);
    assert_eq!(instance.terminated(), Ok(true));
    assert_eq!(instance.last_successful_time(), Ok(0.0));
}

#[test]
fn fmi_the_reset_of_any_state_gives_the_same_bits_again() {
    let expected = Instance::quiet().started(&[]).run(0.0, 0.01, 50);
    type Way = (&'static str, fn(&mut Instance));
    // Others: abi.rs.
    let ways: [Way; 3] = [
        ("instantiated", |instance| instance.set_method(2)),
        ("impossible parameters", |instance| {
            instance.set_all(&[("rotor.m", -1.0)]);
            assert_eq!(instance.enter_initialization(), Status::Ok);
            assert_eq!(instance.exit_initialization(), Status::Error);
        }),
        ("step complete", |instance| {
            instance.set_all(&[("rotor.m", 6.0), ("solver.relative_tolerance", 1e-5)]);
            assert_eq!(instance.setup(Some(1e-3), 7.0, Some(7.5)), Status::Ok);
            assert_eq!(instance.enter_initialization(), Status::Ok);
            assert_eq!(instance.exit_initialization(), Status::Ok);
            instance.run(7.0, 0.01, 7);
        }),
    ];
    for (state, lead) in ways {
        let mut instance = Instance::quiet();
        let fresh = instance.snapshot();
        lead(&mut instance);
        assert_ne!(fresh, instance.snapshot(), "{state}: there is something to forget");
        assert_eq!(instance.reset(), Status::Ok, "{state}");
        instance.journal.take();
        assert_eq!(fresh, instance.snapshot(), "{state}");
        assert_eq!(instance.serialized(), Instance::quiet().serialized(), "{state}");
        // Once more without fmi2SetupExperiment: what it said is forgotten too.
        assert_eq!(instance.initialized().run(0.0, 0.01, 50), expected, "{state}");
    }
}

#[test]
fn fmi_outputs_follow_the_parameters_before_the_start() {
    const SHOWN: [&str; 7] = ["phi", "turns", "angle", "r_c.y", "omega.x", "K_c.x", "energy.kinetic"];
    // 7 − 2π, not 7 less the nearest double.
    let expected = [7.0, 1.0, 0.716_814_692_820_413_5, 0.01, 40.0, 0.15625 * 40.0, 0.5 * 0.15625 * 40.0 * 40.0];
    let values = [("start.phi", 7.0), ("start.r_c.y", 0.01), ("start.omega.x", 40.0)];
    for set_in_initialization_mode in [false, true] {
        let mut instance = Instance::quiet();
        if !set_in_initialization_mode {
            instance.set_all(&values);
            assert_eq!(instance.get_all(SHOWN), expected);
        }
        assert_eq!(instance.enter_initialization(), Status::Ok);
        if set_in_initialization_mode {
            instance.set_all(&values);
        }
        assert_eq!(instance.get_all(SHOWN), expected);
        assert_eq!(instance.exit_initialization(), Status::Ok);
        assert_eq!(instance.get_all(SHOWN), expected);
    }
}

#[test]
fn exact_the_ledger_is_the_sum_of_its_parts() {
    let mut instance = Instance::quiet().started(&there(&[("support.d1", 4.0), ("support.d2", 0.5)]));
    let first = instance.get("energy.total");
    for i in 0..50 {
        assert_eq!(instance.do_step(0.02 * f64::from(i), 0.02), Status::Ok);
        let [kinetic, potential, total] = instance.get_all(["energy.kinetic", "energy.potential", "energy.total"]);
        assert_eq!(total, kinetic + potential);
        let [supplied, dissipated] = instance.get_all(["energy.supplied", "energy.dissipated"]);
        assert_eq!(instance.get("energy.residual"), total - first - supplied + dissipated);
    }
}

#[test]
fn fmi_no_set_state_before_is_only_a_hint() {
    let [mut never, mut always] = [0, 1].map(|_| Instance::quiet().started(&[]));
    for i in 0..10 {
        // SAFETY: live instances.
        let statuses = unsafe {
            let t = f64::from(i) * 0.01;
            [fmi2DoStep(never.component(), t, 0.01, 0), fmi2DoStep(always.component(), t, 0.01, 1)]
        };
        assert_eq!(statuses, [Status::Ok; 2]);
    }
    assert_eq!(never.bits(), always.bits());
}

#[test]
fn fmi_reading_twice_gives_the_same_bits() {
    let mut instance = Instance::quiet().started(&[]);
    assert_eq!(instance.do_step(0.0, 0.123), Status::Ok);
    let first = instance.bits();
    assert_eq!(instance.bits(), first);
    // One by one, backwards, and all at once: a reading depends on no other.
    let references: Vec<ValueReference> = shown().into_iter().map(reference).rev().collect();
    let mut values = vec![0.0; references.len()];
    assert_eq!(instance.read(&references, &mut values), Status::Ok);
    values.reverse();
    assert_eq!(values.into_iter().map(Real::to_bits).collect::<Vec<_>>(), motion(&mut instance));
}

/// Some hosts ignore what fmi2DoStep returns: the time that the motion has reached is an output, and the log says that it stands.
#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn regress_a_host_that_ignores_a_discarded_step_is_told_and_sees_how_far_the_motion_came() {
    let mut instance = Instance::quiet().started(&tumbling());
    assert_eq!(instance.get("solver.time"), 0.0);
    assert_eq!(instance.do_step(0.0, 0.05), Status::Ok);
    assert_eq!(instance.get("solver.time"), 0.05);
    let mut said = 0;
    for n in 1..5 {
        let from = 0.05 * Real::from(n);
        let expected = [Status::Ok, Status::Discard, Status::Error, Status::Error][n as usize - 1];
        assert_eq!(instance.do_step(from, 0.05), expected);
        let last = instance.last_successful_time().expect("a step was made");
        assert_eq!(instance.get("solver.time").to_bits(), last.to_bits());
        assert!(last <= 3.1 / 30.0 + 1e-9);
        assert_eq!(instance.terminated(), Ok(n > 1));
        let records = instance.journal.take();
        said += records.iter().filter(|record| record.message.contains("solver.time")).count();
    }
    assert_eq!(said, 2);
}

/// Whatever a host asks or does wrong between them, fmi2Terminated is true after every fmi2Discard, until a step is done.
#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn regress_terminated_stays_true_after_every_discard() {
    let mut instance = Instance::quiet();
    instance.set_method(3);
    instance.set_all(&[("solver.max_evaluations", 1e3)]);
    let mut instance = instance.started(&[]);
    let mut discarded = 0;
    for _ in 0..5 {
        let from = instance.last_successful_time().expect("it was initialized");
        assert_eq!(instance.do_step(from, 10.0 - from), Status::Discard);
        discarded += 1;
        for _ in 0..2 {
            assert_eq!((instance.step_status(), instance.terminated()), (Ok(Status::Discard), Ok(true)));
            refused(&mut instance, 9.0, 1.0, &["currentCommunicationPoint"]);
            instance.get("energy.residual");
        }
    }
    assert_eq!(discarded, 5);
    // Another step that can be done ends that.
    let from = instance.last_successful_time().expect("it was initialized");
    assert_eq!(instance.do_step(from, 1e-3), Status::Ok);
    assert_eq!((instance.step_status(), instance.terminated()), (Ok(Status::Ok), Ok(false)));
}
