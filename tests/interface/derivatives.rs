//! Directional derivatives and derivatives of outputs through the C interface, against differences of what the FMU shows.

use crate::harness::{Instance, inputs, reference, scene};
use split_rotor::abi::{Integer, MODEL_EXCHANGE, Real, Status, ValueReference};
use split_rotor::exports::{fmi2GetDirectionalDerivative, fmi2GetRealOutputDerivatives};
use split_rotor::scene::Simulation;
use split_rotor_model::variable::{Kind, Role};
use split_rotor_model::variables::{Variable, state_place};

const STATES: usize = Simulation::STATES;

/// The derivative at 0 by central differences of `step`. Against extrapolated ones: model/tests/all/tangents.rs.
fn difference(step: Real, mut f: impl FnMut(Real) -> Vec<Real>) -> Vec<Real> {
    let (above, below) = (f(step), f(-step));
    above.iter().zip(&below).map(|(above, below)| (above - below) / (2.0 * step)).collect()
}

/// The Real variables that change smoothly with the motion: not whole turns, nor what is left of them, nor what the solver
/// spends.
fn smooth(role: impl Fn(Role) -> bool) -> Vec<&'static Variable> {
    let is_smooth = |v: &&Variable| {
        v.meta.kind == Kind::Real
            && role(v.meta.role)
            && !["turns", "angle"].contains(&&*v.name)
            && !v.name.starts_with("solver.")
    };
    scene().variables.iter().filter(is_smooth).collect()
}

fn references(variables: &[&Variable]) -> Vec<ValueReference> {
    variables.iter().map(|variable| variable.place.value_reference()).collect()
}

fn values(instance: &mut Instance, references: &[ValueReference]) -> Vec<Real> {
    let mut values = vec![Real::NAN; references.len()];
    assert_eq!(instance.read(references, &mut values), Status::Ok, "{:?}", instance.journal.take());
    values
}

/// fmi2GetDirectionalDerivative
fn directional(instance: &Instance, unknown: &[ValueReference], known: &[ValueReference], seeds: &[Real]) -> Vec<Real> {
    let mut found = vec![Real::NAN; unknown.len()];
    let (u, k) = (unknown.as_ptr(), known.as_ptr());
    // SAFETY: a live instance, and arrays as long as told.
    let status = unsafe {
        let place = found.as_mut_ptr();
        fmi2GetDirectionalDerivative(instance.component(), u, unknown.len(), k, known.len(), seeds.as_ptr(), place)
    };
    assert_eq!(status, Status::Ok, "{:?}", instance.journal.take());
    found
}

#[test]
fn exact_directional_derivatives_in_both_charts() {
    /// Of a state or an input whose size is about 1.
    const STEP: Real = 1e-5;
    /// Relative to the largest derivative of the variable, and 1 [1]; measured 2.2e-10.
    const NEARNESS: Real = 1e-9;
    let variables = smooth(|role| matches!(role, Role::Output | Role::State));
    let unknown = references(&variables);
    let known: Vec<_> = (0..STATES).map(|n| state_place(n).value_reference()).chain(inputs()).collect();
    for tilt in [0.6, 2.5] {
        let mut instance = Instance::of(MODEL_EXCHANGE).started(&[("start.gamma.y", tilt)]);
        instance.settled();
        // A state without symmetry.
        let mut here: Vec<Real> = (1_u32..).map(|n| (7.3 * Real::from(n)).sin()).take(STATES).collect();
        (here[9], here[10]) = (0.5, -0.4);
        here.extend(inputs().iter().map(|_| 0.75));
        let show = |instance: &mut Instance, at: &[Real]| {
            assert_eq!(instance.set_states(&at[..STATES]), Status::Ok);
            assert_eq!(instance.write(&known[STATES..], &at[STATES..]), Status::Ok);
            values(instance, &unknown)
        };
        show(&mut instance, &here);
        let columns: Vec<_> = known.iter().map(|one| directional(&instance, &unknown, &[*one], &[1.0])).collect();
        for (n, column) in columns.iter().enumerate() {
            let expected = difference(STEP, |x| {
                let mut there = here.clone();
                there[n] += x;
                show(&mut instance, &there)
            });
            for (i, variable) in variables.iter().enumerate() {
                let size = columns.iter().map(|column| column[i].abs()).fold(1.0, Real::max);
                let error = (column[i] - expected[i]).abs() / size;
                assert!(error < NEARNESS, "{} by {} from a tilt of {tilt}: {error:e}", variable.name, known[n]);
            }
        }
        // A direction is the sum of its parts.
        show(&mut instance, &here);
        let seeds: Vec<Real> = (0_u32..).map(|n| 0.25 * Real::from(n) - 1.0).take(known.len()).collect();
        for (i, together) in directional(&instance, &unknown, &known, &seeds).into_iter().enumerate() {
            let parts = columns.iter().zip(&seeds).map(|(column, seed)| column[i] * seed);
            let (sum, size) = parts.fold((0.0, 1.0), |(sum, size), part| (sum + part, size + part.abs()));
            assert!((together - sum).abs() <= 1e-12 * size, "{}: {together:?}, not {sum:?}", variables[i].name);
        }
        assert_eq!(directional(&instance, &[reference("turns")], &known, &seeds), [0.0], "whole turns jump");
    }
}

#[test]
fn exact_output_derivatives_are_those_along_the_motion() {
    /// The difference in time [s], and the moment [s].
    const STEP: Real = 1e-5;
    const NOW: Real = 0.25;
    /// Relative to the derivative and 1, of energies to the kinetic one [1]; measured 8.1e-7 (support.M).
    const NEARNESS: Real = 3e-6;
    let variables = smooth(|role| matches!(role, Role::Output));
    let outputs = references(&variables);
    // What is shown at a time: a run of its own, so that the difference may be of any sign.
    let arrive = |time: Real| {
        let mut instance = Instance::quiet().started(&[("solver.relative_tolerance", 1e-13)]);
        for input in inputs() {
            assert_eq!(instance.write(&[input], &[1.0]), Status::Ok);
            assert_eq!([instance.send(input, 1, -3.0), instance.send(input, 2, 8.0)], [Status::Ok; 2]);
        }
        assert_eq!(instance.do_step(0.0, time), Status::Ok);
        instance
    };
    let mut now = arrive(NOW);
    let mut rates = vec![Real::NAN; outputs.len()];
    let orders: Vec<Integer> = vec![1; outputs.len()];
    // SAFETY: a live instance, and arrays of one length.
    let status = unsafe {
        let (references, n) = (outputs.as_ptr(), outputs.len());
        fmi2GetRealOutputDerivatives(now.component(), references, n, orders.as_ptr(), rates.as_mut_ptr())
    };
    assert_eq!(status, Status::Ok, "{:?}", now.journal.take());
    let kinetic = now.get("energy.kinetic");
    let expected = difference(STEP, |h| values(&mut arrive(NOW + h), &outputs));
    for ((variable, rate), expected) in variables.iter().zip(rates).zip(expected) {
        let least = if variable.name.starts_with("energy.") { kinetic } else { 1.0 };
        let error = (rate - expected).abs() / expected.abs().max(least);
        assert!(error < NEARNESS, "{}: {rate:?}, not {expected:?}", variable.name);
    }
}
