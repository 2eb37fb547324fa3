//! A run that is walked out and in goes on with the same bits: every kind of run, in both charts, at any moment. Damaged bytes:
//! tests/interface/serialized.rs.

use crate::harness::named::Named;
use split_rotor_model::simulation::{General, Integrator};
use split_rotor_model::stored::{from_bytes, to_bytes};
use split_rotor_model::variables::Parameters;

/// Somewhere in a run, in the chart from e, or `far` from e in that from −e.
fn under_way(scene: &str, integrator: Integrator, method: f64, far: bool) -> Named {
    let mut named = Named::new(scene, integrator);
    // Springs bring a rotor that is far from e back soon.
    let held = ["paper", "driven"].contains(&scene);
    let (tilt, until) = match (far, held) {
        (false, _) => (0.3, 0.15),
        (true, false) => (2.4, 0.02),
        (true, true) => (1.7, 0.003),
    };
    named.set("start.gamma.y", tilt);
    named.set("start.phi", 100.0);
    named.set("solver.method", method);
    named.start();
    if scene == "driven" {
        let tau = named.place("drive.tau");
        named.simulation.set_input_derivative(tau, 1, -3.0);
        named.simulation.set_input_derivative(tau, 2, 4.0);
    }
    go_on(&mut named, until);
    assert_eq!(named.get("state.chart"), if far { 2.0 } else { 1.0 }, "{scene} at {until} s");
    named
}

/// Ten steps onwards, so many seconds in all; a host's are Euler's, and its states drift slowly.
fn go_on(named: &mut Named, span: f64) -> Vec<Vec<u64>> {
    let from = named.simulation.time().expect("started");
    let one = |i: u32| {
        let t = from + span * f64::from(i) / 10.0;
        if named.simulation.integrator() == Integrator::Method {
            named.simulation.advance(t).expect("a possible motion");
        } else {
            let rates = named.simulation.rates().expect("possible parameters");
            let mut state = named.simulation.state().expect("possible parameters");
            state.iter_mut().zip(rates).for_each(|(x, rate)| *x += 1e-4 * rate);
            named.go_to(t, &state);
            if named.host().complete_step() {
                named.host().settle();
            }
        }
        named.bits()
    };
    (1..=10).map(one).collect()
}

/// The same simulation, from its bytes, in the place of `place`.
fn restored(of: &mut Named, place: General) -> Named {
    let bytes = to_bytes(&mut *of.simulation);
    let mut copy = Named::new(&of.scene.name, of.simulation.integrator());
    copy.simulation = place;
    from_bytes(&mut *copy.simulation, &bytes).expect("whole");
    assert_eq!(to_bytes(&mut *copy.simulation), bytes, "written once more");
    copy
}

fn nothing(integrator: Integrator) -> General {
    General::with(integrator, Parameters::default())
}

/// Conservative, working and model exchange runs of every method.
fn runs() -> impl Iterator<Item = (&'static str, Integrator, f64)> {
    let scenes = ["paper", "free_top", "tumbling", "driven"];
    let methods = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(|method| (Integrator::Method, method));
    let kinds = move || methods.into_iter().chain([(Integrator::Host, 3.0)]);
    scenes.into_iter().flat_map(move |scene| kinds().map(move |(integrator, method)| (scene, integrator, method)))
}

#[test]
fn a_restored_run_goes_on_with_the_same_bits() {
    for (scene, integrator, method) in runs() {
        for far in [false, true] {
            // As it stands: what was read last, and between two steps of the method, whose dense output is to come.
            let mut one = under_way(scene, integrator, method, far);
            if integrator == Integrator::Method {
                let t = one.simulation.time().expect("started");
                one.simulation.advance(t + 4e-4).expect("a possible motion");
            }
            let mut other = restored(&mut one, nothing(integrator));
            assert_eq!(other.bits(), one.bits(), "{scene} {integrator:?} {method} {far}");
            assert_eq!(go_on(&mut other, 0.5), go_on(&mut one, 0.5), "{scene} {integrator:?} {method}");
        }
    }
}

/// Between two nodes, in contact or out of it, with a torque on its way.
#[test]
fn laws_with_a_memory_are_restored() {
    for scene in ["film_bearings", "rubbing", "run_up"] {
        let mut one = Named::new(scene, Integrator::Method);
        one.start();
        go_on(&mut one, 3.0);
        let mut other = restored(&mut one, nothing(Integrator::Method));
        assert_eq!(go_on(&mut other, 3.0), go_on(&mut one, 3.0), "{scene}");
    }
}

#[test]
fn a_run_that_is_not_started_is_restored() {
    for integrator in [Integrator::Method, Integrator::Host] {
        let mut one = Named::new("driven", integrator);
        one.set("drive.tau", 7.0);
        one.set("rotor.m", 6.0);
        let started = under_way("paper", integrator, 3.0, false).simulation;
        let mut other = restored(&mut one, started);
        assert_eq!(other.simulation.time(), None);
        assert_eq!(other.bits(), one.bits());
        one.start();
        other.start();
        assert_eq!(go_on(&mut other, 0.5), go_on(&mut one, 0.5));
    }
}

#[test]
fn what_was_there_before_does_not_matter() {
    for (scene, integrator, method) in runs() {
        let mut one = under_way(scene, integrator, method, false);
        let mut first = restored(&mut one, nothing(integrator));
        let expected = go_on(&mut first, 0.1);
        for (before, other_kind, other_method) in runs() {
            let mut other = restored(&mut one, under_way(before, other_kind, other_method, true).simulation);
            assert_eq!(other.simulation.integrator(), integrator);
            assert_eq!(go_on(&mut other, 0.1), expected, "{scene} after {before}");
        }
    }
}
