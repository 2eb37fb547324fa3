//! `taylor`: its order, and where it leaves the motion to dop853. That it keeps its tolerance, whatever acts: random_scenes.

use crate::harness::named::Named;
use crate::harness::swinging::{dense_errors, driven, within_order};
use crate::harness::tolerance;
use split_rotor_model::integrate::taylor::Taylor;
use split_rotor_model::simulation::Integrator;

/// A tolerance, the power of its last term, and steps whose errors tell it \[s].
const ORDERS: [(f64, f64, [f64; 4]); 2] =
    [(1e-2, 14.0, [0.008, 0.01, 0.0125, 0.015]), (1e-4, 22.0, [0.014, 0.016, 0.018, 0.02])];

/// From that power: measured below.
const OFF: f64 = 0.8;

#[test]
fn exact_what_is_left_out_begins_with_the_next_power() {
    let (rotor, y) = driven(20.0, 0.5);
    for (relative, order, sizes) in ORDERS {
        let errors = dense_errors(&rotor, &[(0.0, y)], &sizes, |t, y, h| {
            let mut method = Taylor::start(tolerance(relative), &rotor, t, y);
            method.limit_step(h);
            assert_eq!(method.step(&rotor, f64::INFINITY, f64::INFINITY), Ok(true));
            let rotor = &rotor;
            move |t| method.dense(rotor, t)
        });
        println!("{errors:?}");
        within_order(&format!("at {relative:e}"), errors, order, OFF);
    }
}

/// A scene by `taylor`, after a tenth of its run.
fn on_its_way(name: &str) -> Named {
    let mut named = Named::new(name, Integrator::Method);
    named.set("solver.method", 6.0);
    named.set("solver.relative_tolerance", 1e-6);
    named.start();
    named.simulation.advance(0.1 * named.scene.experiment.stop).expect("a possible motion");
    named
}

#[test]
fn what_it_does_and_why() {
    const SERIES: &str = "taylor takes power series";
    const NONE: &str = "taylor takes dop853: the motion has no power series while";
    for (name, words) in
        [("paper", SERIES), ("tumbling", SERIES), ("driven", SERIES), ("jeffcott", NONE), ("dzhanibekov", NONE)]
    {
        let named = on_its_way(name);
        let said = named.simulation.auto().expect("it says what it does");
        println!("{name}: {said}");
        assert!(said.starts_with(words), "{name}: {said}");
        assert_eq!(named.simulation.changes_of_method(), 0, "{name}");
    }
}

#[test]
fn it_comes_back_to_power_series_after_a_contact() {
    let named = on_its_way("rubbing");
    assert!(named.simulation.changes_of_method() > 1, "{}", named.simulation.changes_of_method());
}
