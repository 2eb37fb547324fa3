//! What every visitor brings, of the general rotor: 12 kg on two bearings with an unbalance, run up from rest; and 12 kg on one soft
//! bearing that is dropped and whirls on.

use crate::harness::named::Named;
use crate::harness::{largest, within};
use split_rotor_model::simulation::Integrator;

/// Names and values that are not as in the scene `rotor`, and when the run stops [s].
pub type Machine = (&'static [(&'static str, f64)], f64);

const RUN_UP: [(&str, f64); 16] = [
    ("effects.bearing[1]", 1.0),
    ("bearing[1].position", -0.12),
    ("bearing[1].kyy", 2e7),
    ("bearing[1].kzz", 1.5e7),
    ("bearing[1].cyy", 2000.0),
    ("bearing[1].czz", 2000.0),
    ("effects.bearing[2]", 1.0),
    ("bearing[2].position", 0.12),
    ("bearing[2].kyy", 2e7),
    ("bearing[2].kzz", 1.5e7),
    ("bearing[2].cyy", 2000.0),
    ("bearing[2].czz", 2000.0),
    ("unbalance[1].mass", 0.002),
    ("unbalance[1].radius", 0.02),
    ("effects.drive", 1.0),
    ("drive.tau", 24.0),
];

/// From rest through its critical speeds.
pub const ORDINARY: Machine = (&RUN_UP, 3.3);

/// Of a drop by 2 mm nothing is left in the end; it then whirls at 3.36 µm.
pub const DROPPED: Machine = (
    &[
        ("effects.gravity", 1.0),
        ("start.omega.x", 1000.0),
        ("effects.bearing[1]", 1.0),
        ("bearing[1].kyy", 1e5),
        ("bearing[1].kzz", 1e5),
        ("bearing[1].cyy", 200.0),
        ("bearing[1].czz", 200.0),
        ("unbalance[1].mass", 0.002),
        ("unbalance[1].radius", 0.02),
    ],
    5.0,
);

/// [kg]
const WHOLE: f64 = 12.002;

/// What both have.
const BARE: [(&str, f64); 9] = [
    ("effects.gravity", 0.0),
    ("effects.support", 0.0),
    ("effects.unbalance[1]", 1.0),
    ("rotor.m", 12.0),
    ("rotor.Ja", 0.04),
    ("rotor.Jt", 0.12),
    ("rotor.l", 0.0),
    ("start.r_c.x", 0.0),
    ("start.omega.x", 0.0),
];

/// One of them by this method, at this tolerance [1], not yet started.
pub fn machine(changes: &[(&str, f64)], method: f64, tolerance: f64) -> Named {
    let mut named = Named::new("rotor", Integrator::Method);
    let solver = [("solver.method", method), ("solver.relative_tolerance", tolerance)];
    BARE.iter().chain(changes).chain(&solver).for_each(|(name, value)| named.set(name, *value));
    named
}

/// auto, dopri5, dop853 and stiff.
const ADAPTIVE: [f64; 4] = [1.0, 2.0, 3.0, 5.0];
const TOLERANCES: [f64; 8] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10];

/// The largest distance of r_c [m] from this z [m] that is shown from time `from` to the end [s], each 0.1 ms.
fn largest_whirl((changes, end): Machine, z: f64, from: f64, method: f64, tolerance: f64) -> f64 {
    let mut named = machine(changes, method, tolerance);
    named.simulation.start_until(0.0, None, Some(end)).expect("a possible scene");
    let first = (from * 1e4).round() as u32;
    let radius = |i: u32| {
        named.simulation.advance(f64::from(i) * 1e-4).expect("a possible motion");
        let [y, z] = [named.get("r_c.y"), named.get("r_c.z") - z];
        (y * y + z * z).sqrt()
    };
    largest((first.max(1)..=(end * 1e4).round() as u32).map(radius))
}

/// What an error may be at a tolerance [1].
fn allowed(tolerance: f64) -> f64 {
    match tolerance {
        1e-3 => 0.1,
        1e-4 => 0.01,
        _ => 100.0 * tolerance,
    }
}

/// Errors of the largest whirl, of the whirl itself, at all tolerances by all methods; what an outside check found it to be is within
/// half its last digit.
fn whirls_as_it_should(machine: Machine, z: f64, from: f64, known: f64, digit: f64) {
    let exact = largest_whirl(machine, z, from, 3.0, 1e-13);
    within("from what is known", (exact - known).abs(), 0.5 * digit);
    for method in ADAPTIVE {
        for tolerance in TOLERANCES {
            let error = (largest_whirl(machine, z, from, method, tolerance) / exact - 1.0).abs();
            within(&format!("{method} at {tolerance:e}"), error, allowed(tolerance));
        }
    }
}

#[test]
fn exact_an_ordinary_rotor_whirls_as_it_should_at_any_tolerance() {
    whirls_as_it_should(ORDINARY, 0.0, 0.0, 20.492_464e-6, 1e-12);
}

#[test]
fn exact_a_dropped_rotor_whirls_on_as_it_should_at_any_tolerance() {
    let sag = -WHOLE * 9.81 / 1e5;
    whirls_as_it_should(DROPPED, sag, 4.9, 3.36e-6, 1e-8);
}

/// What is coupled across drives the ordinary rotor's whirl.
pub fn unstable(cross: f64) -> Vec<(&'static str, f64)> {
    RUN_UP.into_iter().chain([("bearing[1].kyz", cross), ("bearing[1].kzy", -cross)]).collect()
}

/// How fast the unstable whirl grows [1/s], by the eigenvalues of the rotor at rest, which another program found.
const GROWTH: [(f64, f64); 2] = [(1e7, 245.481_702_9), (1e8, 2_705.799_231)];

#[test]
fn regress_an_unstable_rotor_is_told_of_and_ends() {
    for (cross, growth) in GROWTH {
        for method in ADAPTIVE {
            let mut named = machine(&unstable(cross), method, 1e-4);
            named.set("solver.max_evaluations", 1e6);
            named.simulation.start_until(0.0, None, Some(6.0)).expect("a possible scene");
            let (found, t) = named.simulation.growth().expect("a motion that grows");
            println!("{method}: {found} 1/s from {t} s, {:?}", named.simulation.advance(6.0));
            within("growth", (found / growth - 1.0).abs(), 1e-3);
        }
    }
}

#[test]
fn exact_a_stable_rotor_is_not_called_unstable() {
    for (changes, end) in [ORDINARY, DROPPED] {
        let mut named = machine(changes, 1.0, 1e-4);
        named.simulation.start_until(0.0, None, Some(end)).expect("a possible scene");
        for i in 1..=100 {
            named.simulation.advance(end * f64::from(i) / 100.0).expect("a possible motion");
            assert_eq!(named.simulation.growth(), None);
        }
    }
}
