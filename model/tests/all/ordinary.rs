//! What every visitor brings, of the general rotor: 12 kg on two bearings with an unbalance, run up from rest; and 12 kg on one soft
//! bearing that is dropped and whirls on.

use crate::harness::named::Named;
use crate::harness::{largest, within};
use nalgebra::Vector3;
use oracles::forward_whirl::ForwardWhirl;
pub use oracles::machine::known::ordinary;
use oracles::machine::{Bearing, Machine, Start};
use split_rotor_model::simulation::Integrator;

/// When the ordinary rotor, which goes from rest through its critical speeds, has run up [s].
pub const RUN_UP: f64 = 3.3;

/// When of a drop by 2 mm nothing is left [s].
pub const DROPPED: f64 = 5.0;

/// A rotor that is dropped, and whirls at 3.36 µm in the end.
pub fn dropped() -> Machine {
    let k = [[1e5, 0.0], [0.0, 1e5]];
    Machine {
        gravity: Some(Vector3::z() * -9.81),
        start: Start { omega: Vector3::x() * 1000.0, ..Start::default() },
        bearings: vec![Bearing { k, c: k.map(|row| row.map(|k| 2e-3 * k)), ..Bearing::default() }],
        drive: false,
        inputs: Vec::new(),
        ..ordinary()
    }
}

/// [kg]
const WHOLE: f64 = 12.002;

/// A machine by this method, at this tolerance [1], not yet started.
pub fn by(machine: &Machine, method: f64, tolerance: f64) -> Named {
    let mut named = Named::general(machine);
    named.set("solver.method", method);
    named.set("solver.relative_tolerance", tolerance);
    named
}

/// auto, dopri5, dop853, stiff and taylor.
const ADAPTIVE: [f64; 5] = [1.0, 2.0, 3.0, 5.0, 6.0];
const TOLERANCES: [f64; 8] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10];

/// The largest distance of r_c [m] from this z [m] that is shown from time `from` to the end [s], each 0.1 ms.
fn largest_whirl((machine, end): (&Machine, f64), z: f64, from: f64, method: f64, tolerance: f64) -> f64 {
    let mut named = by(machine, method, tolerance);
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
fn whirls_as_it_should(machine: (&Machine, f64), z: f64, from: f64, known: f64, digit: f64) {
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
fn an_ordinary_rotor_whirls_as_it_should_at_any_tolerance() {
    whirls_as_it_should((&ordinary(), RUN_UP), 0.0, 0.0, 20.492_464e-6, 1e-12);
}

#[test]
fn a_dropped_rotor_whirls_on_as_it_should_at_any_tolerance() {
    let sag = -WHOLE * 9.81 / 1e5;
    whirls_as_it_should((&dropped(), DROPPED), sag, 4.9, 3.36e-6, 1e-8);
}

/// What is coupled across drives the ordinary rotor's whirl.
pub fn unstable(cross: f64) -> Machine {
    let mut machine = ordinary();
    (machine.bearings[0].k[0][1], machine.bearings[0].k[1][0]) = (cross, -cross);
    machine
}

/// How fast the unstable whirl grows [1/s], by the eigenvalues of the rotor at rest, which another program found.
const GROWTH: [(f64, f64); 2] = [(1e7, 245.481_702_9), (1e8, 2_705.799_231)];

#[test]
fn regress_an_unstable_rotor_is_told_of_and_ends() {
    for (cross, growth) in GROWTH {
        for method in ADAPTIVE {
            let mut named = by(&unstable(cross), method, 1e-4);
            named.set("solver.max_evaluations", 1e6);
            named.simulation.start_until(0.0, None, Some(6.0)).expect("a possible scene");
            let found = named.simulation.growth().expect("a motion that grows");
            println!("{method}: {found:?}, {:?}", named.simulation.advance(6.0));
            within("growth", (found.rate / growth - 1.0).abs(), 1e-3);
        }
    }
}

#[test]
fn a_stable_rotor_is_not_called_unstable() {
    for (machine, end) in [(ordinary(), RUN_UP), (dropped(), DROPPED)] {
        let mut named = by(&machine, 1.0, 1e-4);
        named.simulation.start_until(0.0, None, Some(end)).expect("a possible scene");
        for i in 1..=100 {
            named.simulation.advance(end * f64::from(i) / 100.0).expect("a possible motion");
            assert_eq!(named.simulation.growth(), None);
        }
    }
}

/// A rotor on these effects, from a small one to a large one.
fn sized(size: f64, rest: &str) -> String {
    format!("[rotor]\nm = {:?}\nJa = {size:?}\nJt = {:?}\nl = 0.1\n{rest}", 50.0 * size, 0.7 * size)
}

#[test]
fn regress_rounding_is_not_called_growth() {
    for size in [1e-9, 0.1, 1e4] {
        for rest in [
            "",
            "[start]\ngamma = { y = 0.3, z = 0.2 }\n",
            "[start]\nv_c = { x = 3.0, y = -2.0 }\n",
            "[start]\nomega = { x = 1e-9 }\n",
            "[start]\nomega = { x = 1e-9, y = 1e-12 }\ngamma = { z = 0.4 }\n",
            "[start]\nomega = { x = 300.0 }\n",
            "[effects.gravity]\ng = { z = -9.81 }\n",
            "[start]\nr_c = { x = 0.1 }\n[effects.support]\nc1 = 1e-12\nd2 = 1e-9\n",
            "[effects.drag]\nlinear = 1e-6\n",
        ] {
            for integrator in [Integrator::Method, Integrator::Host] {
                let mut named = Named::written_for(&sized(size, rest), integrator);
                named.start();
                assert_eq!(named.simulation.growth(), None, "{size} {rest}");
            }
        }
    }
}

/// Of the rate of growth \[1]: measured 3.5e-5, where the whirl is slow beside the nutation.
const RATE: f64 = 2e-4;

/// Coupled across by κ, the place of c goes as z̈ = −(k − iκ) z/m, and grows by the real part of a root of that.
#[test]
fn exact_growth_of_what_turns_slowly_or_fast() {
    let mut worst: f64 = 0.0;
    for size in [1e-9, 0.1, 1e4] {
        for speed in [0.0, 1e-6, 1.0, 1e3] {
            for stiffness in [1e-9, 1.0, 1e6] {
                let (mass, cross) = (50.0 * size, 0.3 * stiffness);
                let text = format!(
                    "[start]\nomega = {{ x = {speed:?} }}\n[[effects.bearing]]\nposition = 0.0\nkyy = {stiffness:?}\n\
                     kzz = {stiffness:?}\nkyz = {cross:?}\nkzy = {:?}\n",
                    -cross
                );
                let named = Named::started(&sized(size, &text));
                let whirls = (0.5 * (libm::hypot(stiffness, cross) + stiffness) / mass).sqrt();
                let exact = 0.5 * cross / mass / whirls;
                // What is so slow beside the nutation may be rounding.
                let nutates = speed / 0.7;
                let seen = exact > 1e-6 * nutates;
                match named.simulation.growth() {
                    Some(found) => worst = worst.max((found.rate / exact - 1.0).abs()),
                    None => assert!(!seen, "{size} {speed} {stiffness}"),
                }
            }
        }
    }
    within("growth", worst, RATE);
}

/// As above, in a thousand radians and more: told while the rotor whirls, and only where damping does not outweigh it.
#[test]
fn regress_slow_growth_is_told_of_a_rotor_that_whirls() {
    let (stiffness, mass) = (1e6, 5.0_f64);
    for tilt in [0.0, 1e-3] {
        for (cross, outweighs, grows) in [(1e3, 0.5, true), (1e3, 2.0, false), (0.0, 0.0, false)] {
            // z̈ = −(2k − 2iκ) z/m − 2c ż/m grows where c √(2k/m) < κ.
            let damping = outweighs * cross / (2.0 * stiffness / mass).sqrt();
            let bearing = format!(
                "kyy = {stiffness:?}\nkzz = {stiffness:?}\nkyz = {cross:?}\nkzy = {:?}\ncyy = {damping:?}\nczz = {damping:?}\n",
                -cross
            );
            let text = format!(
                "[start]\nomega = {{ x = 700.0 }}\ngamma = {{ z = {tilt:?} }}\nr_c = {{ y = {tilt:?} }}\n\
                 [[effects.bearing]]\nposition = -0.2\n{bearing}[[effects.bearing]]\nposition = 0.2\n{bearing}"
            );
            let mut named = Named::started(&sized(0.1, &text));
            named.simulation.advance(0.1).expect("a possible motion");
            let found = named.simulation.growth();
            assert_eq!(found.is_some(), grows, "{tilt} rad, {cross} N/m: {found:?}");
        }
    }
}

/// A rotor that is let go with a large tilt, of which damping leaves nothing, while its whirl grows.
#[test]
fn regress_slow_growth_is_told_when_the_tilt_has_died_out() {
    for lean in [0.02, 0.1] {
        let mut named = Named::started(&format!(
            "[rotor]\nm = 10.0\nJa = 0.05\nJt = 0.08\n[start]\nomega = {{ x = 300.0 }}\ngamma = {{ y = {lean:?} }}\nr_c = {{ y = 1e-4 }}\n\
             [[effects.bearing]]\nposition = 0.0\nkyy = 1e6\nkzz = 1e6\nkyz = 3e3\nkzy = -3e3\ncyy = 1.0\nczz = 1.0\nkt = 2e4\nct = 30.0\n"
        ));
        named.simulation.advance(1.0).expect("a possible motion");
        let found = named.simulation.growth().expect("a whirl that grows");
        // z̈ = −(k − iκ) z/m − c ż/m
        within("growth", (found.rate / 0.424_3 - 1.0).abs(), 1e-3);
    }
}

/// A turbine that runs up until its bearings make it whirl, and bursts: it was called unstable anew whenever it tumbled past another state.
#[test]
fn regress_what_has_burst_is_told_once() {
    let bearing = |rest: &str| {
        format!(
            "[[effects.bearing]]\nspeed = [\"0 rpm\", \"2000 rpm\", \"4000 rpm\", \"8000 rpm\"]\nkyy = 3e8\nkzz = 4e8\n\
             kyz = [0, 2e7, 9e7, 3e8]\nkzy = [0, -2e7, -9e7, -3e8]\ncyy = 3e5\nczz = 3e5\n{rest}"
        )
    };
    let bearings = bearing("position = -0.8\nkxx = 1e8\ncxx = 1e5\n") + &bearing("position = 0.8\n");
    let rotor = "[rotor]\nm = 1200\nJa = 60\nJt = 320\n[start]\nat_rest = true\n[effects.gravity]\n[effects.drive]\n";
    let unbalance = "[[effects.unbalance]]\nmoment = \"6 kg mm\"\nposition = 0.1\n";
    let mut named = Named::started(&format!("{rotor}{bearings}{unbalance}"));
    named.set("drive.tau", 5000.0);
    let (mut told, mut t) = (Vec::new(), 0.0);
    while t < 10.5 && named.simulation.advance(t + 5e-4).is_ok() {
        t += 5e-4;
        told.extend(named.simulation.growth().filter(|growth| told.last() != Some(growth)));
    }
    assert_eq!(told.len(), 1, "{told:?}");
}

/// A torque that speeds a rotor up, or slows it down, drives no whirl, damped or not.
#[test]
fn regress_a_torque_is_not_called_growth() {
    for torque in [60.0, -60.0] {
        for damping in [0.0, 12.0] {
            let bearing = format!("kyy = 2e5\nkzz = 2e5\ncyy = {damping:?}\nczz = {damping:?}\n");
            let text = format!(
                "[rotor]\nm = 40.0\nJa = 1.2\nJt = 0.8\n[start]\ngamma = {{ y = 1e-5 }}\n[effects.drive]\ntau = {torque:?}\n\
                 [[effects.bearing]]\nposition = -0.1\n{bearing}[[effects.bearing]]\nposition = 0.1\n{bearing}"
            );
            let mut named = Named::started(&text);
            for i in 1..=20 {
                named.simulation.advance(0.1 * f64::from(i)).expect("a possible motion");
                assert_eq!(named.simulation.growth(), None, "{torque} N·m, {damping} N·s/m");
            }
            let tilt = libm::hypot(named.get("gamma.y"), named.get("gamma.z"));
            assert!(tilt < 1e-5, "{tilt} rad");
        }
    }
}

/// A shaft of 1 m, whose friction inside drives its whirl above this spin [rad/s], by the roots of the whirl: far below what its tilt
/// would feel.
const SLIM: f64 = 1018.0;

#[test]
fn regress_growth_of_a_slim_shaft_is_told_on_its_way_up() {
    let bearing = "kyy = 2e6\nkzz = 2e6\ncyy = 200.0\nczz = 200.0\nkxx = 2e7\n";
    let mut named = Named::started(&format!(
        "[rotor]\nm = 15.4\nJa = 0.00481\nJt = 1.286\n[effects.rotating_damping]\nd = 400.0\n[effects.drive]\ntau = 0.77\n\
         [[effects.bearing]]\nposition = -0.45\n{bearing}[[effects.bearing]]\nposition = 0.45\n{bearing}"
    ));
    for i in 1..=100 {
        named.simulation.advance(0.1 * f64::from(i)).expect("a possible motion");
    }
    let Some(found) = named.simulation.growth() else { panic!("nothing is told") };
    assert!((0.0..LATE).contains(&(found.speed / SLIM - 1.0)), "{found:?}");
}

/// Friction inside as large as the damping outside drives a whirl above twice its own 20 rad/s.
const INNER: &str = "[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\n[[effects.bearing]]\nposition = 0.0\nkyy = 2000.0\nkzz = 2000.0\n\
    cyy = 40.0\nczz = 40.0\nkt = 500.0\nct = 1.0\n[effects.rotating_damping]\nd = 40.0\n[effects.imposed_speed]\n";
const THRESHOLD: f64 = 40.0;

/// Of the speed at which it is told, above the threshold: the spin changes by so much between two looks, by the rate of the nutation \[1].
const LATE: f64 = 0.2;

#[test]
fn exact_growth_along_a_run_is_told_at_each_onset() {
    let mut named = Named::started(INNER);
    assert_eq!(named.simulation.growth(), None, "at rest");
    // Up through the threshold and down again, twice, by 1 rad/s in 0.1 s.
    let mut onsets = Vec::new();
    for i in 1..=240 {
        let speed = f64::from(60 - (i % 120 - 60_i32).abs());
        named.set("imposed_speed.w", speed);
        named.simulation.advance(f64::from(i) * 0.1).expect("a possible motion");
        match named.simulation.growth() {
            None => assert!(speed < THRESHOLD * (1.0 + LATE), "{speed} rad/s"),
            Some(growth) => {
                assert!(speed > THRESHOLD * (1.0 - LATE), "{speed} rad/s");
                if onsets.last() != Some(&growth) {
                    onsets.push(growth);
                }
            }
        }
    }
    assert_eq!(onsets.len(), 2, "{onsets:?}");
    for growth in onsets {
        assert!((0.0..LATE).contains(&(growth.speed / THRESHOLD - 1.0)), "{growth:?}");
        let whirl = ForwardWhirl { m: 5.0, c: 40.0, d: 40.0, k: 2000.0, s: 0.0 };
        let exact = whirl.rates(growth.speed).map(|rate| rate.re).into_iter().fold(f64::MIN, f64::max);
        within("growth", (growth.rate / exact - 1.0).abs(), RATE);
    }
}
