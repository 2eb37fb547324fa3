//! Whatever the scene, a call ends after a bounded count of evaluations, and says why.

use crate::harness::named::Named;
use crate::harness::within;
use split_rotor_model::integrate::Fault;
use split_rotor_model::simulation::Integrator;

/// The number of each method, and its order where that counts.
const METHODS: [(f64, f64); 8] =
    [(1.0, 6.0), (2.0, 6.0), (3.0, 6.0), (4.0, 2.0), (4.0, 4.0), (4.0, 6.0), (4.0, 8.0), (5.0, 6.0)];

const MOST: f64 = 1e5;

/// What a step that was begun may add [1].
const BEGUN: f64 = 2e4;

/// What is asked of a scene: a step to `end` [s] that cannot be done within [`MOST`] evaluations ends and says so, or why not.
fn ends(what: &str, make: impl Fn() -> Named, end: f64, reasons: &[&str]) {
    for (method, order) in METHODS {
        let mut named = make();
        for (name, value) in [("solver.method", method), ("solver.order", order), ("solver.max_evaluations", MOST)] {
            named.set(name, value);
        }
        named.start();
        let outcome = named.simulation.advance(end);
        let evaluations = named.get("solver.evaluations");
        println!("{what} by {method} of order {order}: {evaluations} evaluations, {outcome:?}");
        within("evaluations", evaluations, MOST + BEGUN);
        let Err(fault) = outcome else { continue };
        let said = fault.to_string();
        assert!(reasons.iter().any(|reason| said.contains(reason)), "{said}");
        let (Fault::Spent { t } | Fault::Refused { t, .. } | Fault::NotFinite { t } | Fault::Underflow { t }) = fault;
        assert_eq!(named.simulation.time(), Some(t));
        assert!(named.get("energy.total").is_finite());
        if let Fault::Spent { .. } = fault {
            // It goes on in steps that are short enough.
            let next = named.get("solver.next_step");
            named.simulation.advance(t + next).expect("a possible motion");
        }
    }
}

const SPENT: &str = "solver.max_evaluations";

#[test]
fn regress_what_spins_too_fast_ends() {
    let make = || {
        let mut named = Named::new("heavy_top", Integrator::Method);
        named.set("start.omega.x", 1e12);
        named
    };
    ends("a top at 10¹² rad/s", make, 1.0, &[SPENT, "keeps the tolerance"]);
}

#[test]
fn regress_a_step_of_a_million_years_ends_with_the_right_reason() {
    ends("the paper's rotor for 10¹² s", || Named::new("paper", Integrator::Method), 1e12, &[SPENT]);
}

#[test]
fn regress_a_stiff_default_ends() {
    let make = || {
        let mut named = Named::new("paper", Integrator::Method);
        named.set("support.d1", 1e10);
        named
    };
    ends("support.d1 = 1e10", make, 1.0, &[SPENT, "infinite or not a number", "the energy is not kept"]);
}
