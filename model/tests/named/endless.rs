//! A step that would take hours ends, and says so.

use crate::harness::named::Named;
use model::integrate::Fault;
use model::simulation::Integrator;

#[test]
#[ignore = "long: cargo xtask test --long runs it, optimised"]
fn exact_what_would_take_hours_is_told() {
    let mut named = Named::new("free_top", Integrator::Method);
    named.set("solver.method", 3.0);
    named.set("start.omega.x", 1e12);
    named.start();
    let fault = named.simulation.advance(1.0).expect_err("10¹² rad take more than 10⁹ evaluations");
    let Fault::Refused { t, reason } = fault else { panic!("{fault}") };
    assert!(reason.0.contains("more than 1e9 evaluations"), "{fault}");
    assert!(t > 0.0 && named.simulation.time() == Some(t), "{t}");
    // The instance is usable.
    named.simulation.advance(t + 1e-9).expect("a possible motion");
}
