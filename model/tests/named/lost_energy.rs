//! Steps of compositions that are too long to keep the energy: told, not shown as a motion.

use crate::harness::largest;
use crate::harness::named::Named;
use model::simulation::Integrator;

/// r_c over l of `high_spin` at this spin, with an order and a step [s], at points 5 ms apart; the reason where it ends.
fn places(spin: f64, order: f64, step: f64, end: f64) -> (Vec<[f64; 3]>, Option<String>) {
    let mut named = Named::new("high_spin", Integrator::Method);
    named.set("start.omega.x", spin);
    for (name, value) in [("solver.method", 4.0), ("solver.order", order), ("solver.step_size", step)] {
        named.set(name, value);
    }
    named.start();
    let mut shown = Vec::new();
    for i in 1..=(end / 5e-3) as u32 {
        if let Err(fault) = named.simulation.advance(5e-3 * f64::from(i)) {
            return (shown, Some(fault.to_string()));
        }
        shown.push(["r_c.x", "r_c.y", "r_c.z"].map(|name| named.get(name) / 0.75));
    }
    (shown, None)
}

#[test]
fn explore() {
    for spin in [50.0, 1e3, 1e4, 1e5, 1e6] {
        let (exact, _) = places(spin, 8.0, 0.2 / f64::max(spin, 2000.0), 1.0);
        for order in [2.0, 4.0, 6.0, 8.0] {
            for step in [1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 0.1, 0.2, 0.5] {
                let (shown, fault) = places(spin, order, step, 1.0);
                let errors = shown.iter().zip(&exact).map(|(a, b)| largest([0, 1, 2].map(|n| (a[n] - b[n]).abs())));
                let (last, worst) = (shown.len(), largest(errors));
                println!("{spin:.0e} {order} {step:.0e} {worst:.2e} till {last} {}", if fault.is_some() { "TOLD" } else { "" });
            }
        }
    }
}
