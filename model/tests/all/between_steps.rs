//! What a pair shows between the ends of a step that spans many nutations too small to matter there.

use crate::harness::named::Named;
use crate::harness::{largest, within};
use split_rotor_model::simulation::Integrator;

const POINTS: u32 = 80;

/// Axis and r_c over l at points of the first 0.4 ms, with these settings.
fn shown(spin: f64, settings: &[(&str, f64)]) -> Vec<[f64; 6]> {
    let mut named = Named::new("high_spin", Integrator::Method);
    named.set("start.omega.x", spin);
    settings.iter().for_each(|(name, value)| named.set(name, *value));
    named.start();
    let mut show = |i: u32| {
        named.simulation.advance(4e-4 * (1e5 / spin) * f64::from(i) / f64::from(POINTS)).expect("a possible motion");
        let shown = ["axis.x", "axis.y", "axis.z", "r_c.x", "r_c.y", "r_c.z"].map(|name| named.get(name));
        std::array::from_fn(|n| if n < 3 { shown[n] } else { shown[n] / 0.75 })
    };
    (1..=POINTS).map(&mut show).collect()
}

/// Error of any point over the tolerance [1]. Measured: up to 57. The polynomials alone are off by up to 1e35 rad.
const BETWEEN: f64 = 100.0;

#[test]
fn a_first_step_over_many_nutations_shows_no_nonsense() {
    for spin in [3e3, 1e4, 1e5] {
        let exact = shown(spin, &[("solver.method", 4.0), ("solver.order", 8.0), ("solver.step_size", 0.5 / spin)]);
        for method in [2.0, 3.0] {
            for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8] {
                let found = shown(spin, &[("solver.method", method), ("solver.relative_tolerance", tolerance)]);
                let off = largest(found.iter().zip(&exact).flat_map(|(a, b)| (0..6).map(|n| (a[n] - b[n]).abs())));
                within(&format!("{spin:e} rad/s, method {method}, {tolerance:e}"), off / tolerance, BETWEEN);
            }
        }
    }
}
