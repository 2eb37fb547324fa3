//! Model exchange through the C interface: states, rates and nominals, the events at which the chart of the states changes,
//! and what an integrator is told that tries a state too far away.

use crate::harness::{Instance, only, scene, there, variable};
use split_rotor::abi::{Integer, MODEL_EXCHANGE, Real, Status};
use split_rotor::exports::fmi2GetEventIndicators;
use split_rotor::scene::Simulation;
use split_rotor_model::variable::{Kind, Role};
use split_rotor_model::variables::state_place;
use std::f64::consts::PI;

/// An instance in continuous-time mode whose motion has no symmetry.
fn somewhere() -> Instance {
    continuous(&[("start.phi", 20.0), ("start.gamma.z", 0.4), ("start.v_c.y", 1.0)])
}

fn continuous(values: &[(&str, Real)]) -> Instance {
    let mut instance = Instance::of(MODEL_EXCHANGE).started(values);
    instance.settled();
    instance
}

/// The states' names, in their order.
fn names() -> Vec<&'static str> {
    let name =
        |n| scene().variables.iter().find(|variable| variable.place == state_place(n)).expect("a state").name.as_str();
    (0..Simulation::STATES).map(name).collect()
}

/// The number of the state of this name.
fn number(name: &str) -> usize {
    names().iter().position(|one| *one == name).expect("a state")
}

/// The outputs, but for what the solver spends.
fn outputs() -> Vec<&'static str> {
    let is_shown = |v: &&split_rotor_model::variables::Variable| {
        v.meta.kind == Kind::Real && matches!(v.meta.role, Role::Output) && !v.name.starts_with("solver.")
    };
    scene().variables.iter().filter(is_shown).map(|variable| variable.name.as_str()).collect()
}

fn values(instance: &mut Instance, names: &[impl AsRef<str>]) -> Vec<Real> {
    names.iter().map(|name| instance.get(name.as_ref())).collect()
}

fn chart(instance: &mut Instance) -> Integer {
    instance.get_integer(variable("state.chart").place.value_reference()).expect("it can be read")
}

/// Tilts the rotor by `theta` [rad] from the axis of its chart, towards `azimuth` [rad].
fn tilt(instance: &mut Instance, theta: Real, azimuth: Real) {
    let mut states = instance.states().expect("they can be read");
    states[number("state.gamma.y")] = theta * azimuth.cos();
    states[number("state.gamma.z")] = theta * azimuth.sin();
    assert_eq!(instance.set_states(&states), Status::Ok);
}

/// Where a tilt points that has no special direction [rad].
const ASIDE: Real = 0.7;

#[test]
fn fmi_states_and_rates_are_the_variables_of_their_names() {
    let mut instance = somewhere();
    let rates: Vec<_> = names().iter().map(|name| format!("der({name})")).collect();
    assert_eq!(instance.states(), Ok(values(&mut instance, &names())));
    assert_eq!(instance.rates(), Ok(values(&mut instance, &rates)));
    assert!(instance.rates().expect("they can be calculated").iter().any(|rate| *rate != 0.0));
}

#[test]
fn fmi_states_are_what_was_set_until_an_event() {
    let mut instance = somewhere();
    let states = instance.states().expect("they can be read");
    let other: Vec<Real> = (0_u32..).zip(states).map(|(n, state)| state + 0.01 * Real::from(n)).collect();
    assert_eq!(instance.set_states(&other), Status::Ok);
    assert_eq!(values(&mut instance, &names()), other);
    assert_eq!(instance.set_time(1.5), Status::Ok);
    assert_eq!(instance.completed_integrator_step(), Ok(false));
    assert_eq!(instance.states(), Ok(other));
}

#[test]
fn fmi_nominals_come_from_the_scene() {
    let mut instance = somewhere();
    let nominals = instance.nominals().expect("possible parameters");
    assert!(nominals.iter().all(|nominal| nominal.is_finite() && *nominal > 0.0), "{nominals:?}");
    // One length and one angle, which go together as the radius of gyration has it.
    let radius = (instance.get("rotor.Jt") / instance.get("rotor.m")).sqrt();
    let found = nominals[number("state.r.y")] / nominals[number("state.gamma.y")];
    assert!((0.5..1.5).contains(&(found / radius)), "{found} m, and the radius is {radius} m");
    for (name, nominal) in names().iter().zip(&nominals) {
        let counts_with_1 = ["state.phi", "state.supplied", "state.dissipated"].contains(name);
        assert!(!counts_with_1 || *nominal == 1.0, "{name}: {nominal}");
    }
}

#[test]
fn exact_phi_begins_with_all_its_turns() {
    // Where turns and remainder stand apart in co-simulation, the host integrates their sum.
    let mut instance = somewhere();
    let phi = instance.states().expect("they can be read")[number("state.phi")];
    assert!((phi - 20.0).abs() < 1e-14, "{phi:?}");
    assert_eq!(instance.get("turns"), 3.0);
}

#[test]
fn fmi_the_solver_counts_nothing() {
    let mut instance = somewhere();
    tilt(&mut instance, 0.5, ASIDE);
    assert_eq!(instance.completed_integrator_step(), Ok(false));
    let spent =
        ["steps", "rejected", "evaluations", "error_estimate", "next_step"].map(|name| format!("solver.{name}"));
    assert_eq!(values(&mut instance, &spent), [0.0; 5]);
}

#[test]
fn fmi_indicators_change_their_sign_where_an_event_is_due() {
    let mut instance = somewhere();
    let signs = |instance: &mut Instance, theta: Real, psi: Real| {
        tilt(instance, theta, psi);
        let mut values = [Real::NAN; Simulation::INDICATORS];
        // SAFETY: a live instance, and room for all indicators.
        let status =
            unsafe { fmi2GetEventIndicators(instance.component(), values.as_mut_ptr(), Simulation::INDICATORS) };
        assert_eq!(status, Status::Ok);
        assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
        values.map(|value| value > 0.0)
    };
    let within = signs(&mut instance, 1.99, ASIDE);
    assert!(within.iter().all(|positive| *positive));
    // Beyond the border, and beyond what a completed step may be: a host tries such states until it has found the event.
    for theta in [2.01, 3.0] {
        assert!(!signs(&mut instance, theta, ASIDE)[0], "{theta}");
    }
}

#[test]
fn fmi_a_chart_that_is_left_asks_for_an_event() {
    /// What the change makes of what is shown, relative to the larger of it and 1 [1]; measured 1.2e-14 (dzhanibekov).
    const ROUNDING: Real = 3e-14;
    let mut instance = somewhere();
    tilt(&mut instance, 1.99, ASIDE);
    assert_eq!(instance.completed_integrator_step(), Ok(false));
    for next in [2, 1, 2] {
        tilt(&mut instance, 2.01, ASIDE);
        assert_eq!(instance.completed_integrator_step(), Ok(true));
        let (shown, before) = (values(&mut instance, &outputs()), instance.states().expect("they can be read"));
        assert_eq!(instance.enter_event_mode(), Status::Ok);
        assert_eq!([instance.new_discrete_states(), instance.new_discrete_states()], [Ok(true), Ok(false)]);
        assert_eq!(instance.enter_continuous_time_mode(), Status::Ok);
        assert_eq!(chart(&mut instance), next);
        for ((old, new), name) in shown.iter().zip(values(&mut instance, &outputs())).zip(outputs()) {
            assert!((new - old).abs() <= ROUNDING * old.abs().max(1.0), "{name}: {old:?} becomes {new:?}");
        }
        let after = instance.states().expect("they can be read");
        let changed = names().into_iter().enumerate().filter(|(n, _)| before[*n] != after[*n]).map(|(_, name)| name);
        assert_eq!(changed.collect::<Vec<_>>(), ["state.gamma.y", "state.gamma.z", "state.phi"]);
    }
}

#[test]
fn exact_phi_counts_its_turns_from_step_to_step() {
    /// [rad], in 100 rad.
    const ROUNDING: Real = 1e-12;
    let mut instance = somewhere();
    tilt(&mut instance, 2.01, ASIDE);
    assert_eq!(instance.completed_integrator_step(), Ok(true));
    assert_eq!(instance.enter_event_mode(), Status::Ok);
    instance.settled();
    tilt(&mut instance, 0.5, 0.0);
    assert_eq!(instance.completed_integrator_step(), Ok(false));
    let start = instance.get("phi");
    // γ′ goes round −e eight times: φ = φ′ + 2β gains 16 turns, step by step, and loses them again.
    for i in (0_u32..=100).chain((0..=100).rev()) {
        let beta = Real::from(i) / 100.0 * 16.0 * PI;
        tilt(&mut instance, 0.5, beta);
        let tried = instance.get("phi");
        assert_eq!(instance.completed_integrator_step(), Ok(false));
        for phi in [tried, instance.get("phi")] {
            assert!((phi - start - 2.0 * beta).abs() < ROUNDING, "{phi:?} at beta = {beta:?}");
        }
    }
}

/// A call that must return fmi2Discard with one log line, which is this one.
#[track_caller]
fn discarded<T: std::fmt::Debug + PartialEq>(
    instance: &mut Instance,
    call: impl FnOnce(&mut Instance) -> Result<T, Status>,
    line: &str,
) {
    instance.journal.take();
    assert_eq!(call(instance), Err(Status::Discard));
    assert_eq!(only(&instance.journal.take(), Status::Discard, &[]).message, line);
}

/// Reads φ.
fn phi(instance: &mut Instance) -> Result<(), Status> {
    let status = instance.read(&[variable("phi").place.value_reference()], &mut [Real::NAN]);
    if status == Status::Ok { Ok(()) } else { Err(status) }
}

#[test]
fn fmi_a_state_beyond_the_chart_is_discarded_and_may_be_left() {
    let too_far = |function: &str| {
        format!(
            "{function}: |gamma| of the continuous states exceeds 3.1 rad, too far for their chart: complete a step \
             earlier, so that an event can change it"
        )
    };
    let mut instance = somewhere();
    tilt(&mut instance, 0.5, ASIDE);
    let before = (instance.rates(), instance.bits());
    // As an integrator tries it; it then tries a shorter step.
    tilt(&mut instance, 3.11, ASIDE);
    discarded(&mut instance, Instance::rates, &too_far("fmi2GetDerivatives"));
    discarded(&mut instance, phi, &too_far("fmi2GetReal"));
    discarded(&mut instance, Instance::completed_integrator_step, &too_far("fmi2CompletedIntegratorStep"));
    tilt(&mut instance, 0.5, ASIDE);
    assert_eq!((instance.rates(), instance.bits()), before);
}

#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn fmi_a_state_beyond_the_law_is_discarded() {
    const REASON: &str = "fmi2GetDerivatives: the tilt |gamma| reaches 3.1 rad, and the spring support.c2, which \
                          follows gamma, has no limit at pi";
    for (c2, is_refused) in [(500.0, true), (0.0, false)] {
        // In the chart from −e, whose tilts are those that are left to π.
        let values = [("start.gamma.y", 3.0), ("support.c2", c2), ("support.d2", 0.0), ("drive.tau", 0.0)];
        let mut instance = continuous(&there(&values));
        tilt(&mut instance, PI - 3.11, ASIDE);
        if is_refused {
            discarded(&mut instance, Instance::rates, REASON);
            tilt(&mut instance, PI - 3.09, ASIDE);
        }
        let rates = instance.rates().expect("a possible state");
        assert!(rates.iter().all(|rate| rate.is_finite()), "{rates:?}");
    }
}
