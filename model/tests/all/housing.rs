//! Bearings and rings in housings that move: another frame, a free mass, and pedestals as other models.

use crate::harness::named::Named;
use crate::harness::within;
use nalgebra::Vector3;
use split_rotor_model::effects::Effects;
use split_rotor_model::simulation::Integrator;
use split_rotor_model::stored::{from_bytes, to_bytes};

/// A rotor between two unlike bearings, one with a table, in a ring that it touches.
const ROTOR: &str = "[rotor]\nm = 12.0\nJa = 0.04\nJt = 0.12\n\
                     [[effects.unbalance]]\nmass = 1e-3\nradius = 0.04\nposition = 0.03\n[solver]\nrelative_tolerance = 1e-11\n";

/// The same with its method, housings with these lines, and the velocity of the start [m/s].
fn machine(method: &str, housing: &str, [vx, vy, vz]: [f64; 3]) -> String {
    format!(
        "{ROTOR}method = \"{method}\"\n[start]\nomega.x = 300.0\nv_c = {{ x = {vx:?}, y = {vy:?}, z = {vz:?} }}\n\
         [[effects.bearing]]\nposition = -0.12\nkxx = 1e5\ncxx = 50.0\nkyy = 2e6\nkzz = 1e6\nkyz = 3e5\nkzy = -3e5\ncyy = 200.0\nczz = 300.0\n\
         {housing}\
         [[effects.bearing]]\nposition = 0.1\nkzz = 1e6\nspeed = [100.0, 400.0]\nkyy = [1.1e6, 1.3e6]\n{housing}\
         [[effects.rub]]\nposition = 0.05\ngap = 2e-4\nstiffness = 1e6\ndamping = 20.0\nfriction = 0.1\nradius = 0.02\nv0 = 0.1\n{housing}"
    )
}

/// Where housings move steadily, all is as in the frame that moves with them.
#[test]
fn exact_a_housing_that_moves_steadily_is_another_frame() {
    let (steady, kick) = (Vector3::new(0.02, 0.3, -0.2), Vector3::new(0.01, 0.2, 0.15));
    for method in ["dop853", "stiff", "symplectic"] {
        let mut still = Named::started(&machine(method, "", kick.into()));
        let mut moving = Named::started(&machine(method, "housing = {}\n", (kick + steady).into()));
        for block in ["bearing[1]", "bearing[2]", "rub[1]"] {
            ["x", "y", "z"]
                .iter()
                .zip(&steady)
                .for_each(|(axis, v)| moving.set(&format!("{block}.housing.v.{axis}"), *v));
        }
        let mut touched = 0.0;
        for t in [0.003, 0.01, 0.02] {
            [&mut still, &mut moving].into_iter().for_each(|named| named.simulation.advance(t).expect("a motion"));
            touched += still.get("rub[1].contact");
            let place = moving.vector("r_c") - steady * t - still.vector("r_c");
            within(&format!("{method}, {t} s, place"), place.norm(), 1e-11);
            let velocity = moving.vector("v_c") - steady - still.vector("v_c");
            within(&format!("{method}, {t} s, velocity"), velocity.norm(), 1e-8);
            for force in ["bearing[1].F.y", "bearing[2].F.z", "rub[1].F.y"] {
                within(&format!("{method}, {t} s, {force}"), (moving.get(force) - still.get(force)).abs(), 1e-4);
            }
            for axis in ["x", "y", "z"] {
                let [on, by] = ["housing.F", "F"].map(|of| moving.get(&format!("bearing[1].{of}.{axis}")));
                assert_eq!(on, -by, "{axis}");
            }
            within(&format!("{method}, {t} s, balance"), moving.get("energy.residual").abs(), 1e-8);
        }
        assert!(touched > 0.0);
    }
}

/// Derivatives of the place alone tell the velocity too.
#[test]
fn exact_derivatives_of_the_place_are_its_velocity() {
    let text = machine("dop853", "housing = {}\n", [0.0, 0.2, 0.0]);
    let [mut both, mut alone] = [(); 2].map(|()| Named::started(&text));
    for n in 0..20 {
        let t = f64::from(n) * 1e-3;
        let [place, velocity] = [1e-3 * libm::sin(300.0 * t), 0.3 * libm::cos(300.0 * t)];
        for block in ["bearing[1]", "rub[1]"] {
            for named in [&mut both, &mut alone] {
                named.set(&format!("{block}.housing.r.y"), place);
            }
            both.set(&format!("{block}.housing.v.y"), velocity);
            let at = alone.place(&format!("{block}.housing.r.y"));
            assert!(alone.simulation.set_input_derivative(at, 1, velocity));
        }
        [&mut both, &mut alone].into_iter().for_each(|named| named.simulation.advance(t + 1e-3).expect("a motion"));
        for name in ["r_c.x", "r_c.y", "v_c.z", "bearing[1].F.y", "energy.supplied"] {
            assert_eq!(both.get(name).to_bits(), alone.get(name).to_bits(), "{name} at {t} s");
        }
    }
}

/// Sent once, they stay in force; zeros withdraw them, and the velocity counts.
#[test]
fn exact_derivatives_stay_in_force() {
    let text = machine("dop853", "housing = {}\n", [0.0, 0.2, 0.0]);
    let [mut once, mut velocity, mut zeros] = [(); 3].map(|()| Named::started(&text));
    let at = once.place("bearing[1].housing.r.y");
    assert!(once.simulation.set_input_derivative(at, 1, 0.1));
    velocity.set("bearing[1].housing.v.y", 0.1);
    for n in 1..=20 {
        zeros.set("bearing[1].housing.v.y", 0.1);
        assert!(zeros.simulation.set_input_derivative(at, 1, 0.0));
        for named in [&mut once, &mut velocity, &mut zeros] {
            named.simulation.advance(f64::from(n) * 1e-3).expect("a motion");
        }
        for name in ["r_c.y", "bearing[1].F.y"] {
            let size = velocity.get(name).abs();
            within(name, (once.get(name) - velocity.get(name)).abs() / size, 1e-12);
            within(name, (zeros.get(name) - velocity.get(name)).abs() / size, 1e-9);
        }
    }
}

/// A host that integrates says at each time where the housing is, in any order.
#[test]
fn exact_a_host_that_integrates_holds_the_place() {
    let text = machine("dop853", "housing = {}\n", [0.0; 3]);
    let mut named = Named::written_for(&text, Integrator::Host);
    named.start();
    named.set("bearing[1].housing.v.y", 0.1);
    let state = named.simulation.state().expect("possible parameters");
    let before = named.get("bearing[1].F.y");
    named.go_to(1e-3, &state);
    assert_eq!(named.get("bearing[1].F.y"), before);
    assert_eq!(named.get("bearing[1].housing.r.y"), 0.0);
}

/// Where it stands at the start counts along all axes.
#[test]
fn exact_the_place_at_the_start_counts() {
    let mut named = Named::written(&machine("dop853", "housing = { r = { x = 1e-4, y = 1e-4 } }\n", [0.0; 3]));
    named.start();
    within("x", (named.get("bearing[1].F.x") - 10.0).abs(), 1e-9);
    within("y", (named.get("bearing[1].F.y") - 200.0).abs(), 1e-9);
    within("z", (named.get("bearing[1].F.z") + 30.0).abs(), 1e-9);
}

/// A rotor on a spring whose other end is a free mass, as a master steps both that sets each from what the other showed before: by how much
/// the energy grows in a second [1/s].
fn growth_of_a_free_pair(h: f64, ahead: f64, damping: f64) -> f64 {
    const SPAN: f64 = 0.5;
    let (m, mass, k) = (10.0, 40.0, 1e7);
    let mut named = Named::started(&format!(
        "[rotor]\nm = {m:?}\nJa = 0.1\nJt = 0.1\n[start]\nv_c.y = 0.1\n[solver]\nrelative_tolerance = 1e-9\n\
         [[effects.bearing]]\nposition = 0.0\nkyy = {k:?}\ncyy = {damping:?}\nhousing = {{ ahead = {ahead:?} }}\n"
    ));
    let [mut r, mut v] = [0.0, 0.0];
    let energy = |named: &mut Named, r: f64, v: f64| {
        let [y, vy] = ["r_c.y", "v_c.y"].map(|name| named.get(name));
        let along = (m * vy + mass * v) / (m + mass);
        0.5 * (m * (vy - along) * (vy - along) + mass * (v - along) * (v - along) + k * (y - r) * (y - r))
    };
    let steps = (SPAN / h).round() as usize;
    let first = energy(&mut named, r, v);
    for n in 1..=steps {
        let force = named.get("bearing[1].housing.F.y");
        named.set("bearing[1].housing.r.y", r);
        named.set("bearing[1].housing.v.y", v);
        named.simulation.advance(n as f64 * h).expect("a motion");
        r += (v + 0.5 * force / mass * h) * h;
        v += force / mass * h;
    }
    libm::log(energy(&mut named, r, v) / first) / SPAN
}

/// 80 steps a period.
#[test]
fn exact_an_undamped_pair_keeps_its_energy_where_the_load_is_shown_ahead() {
    let [at_once, ahead] = [0.0, 0.5].map(|ahead| growth_of_a_free_pair(7.02e-5, ahead, 0.0));
    println!("growth of the energy: {at_once:.3e}/s held, {ahead:.3e}/s half a step ahead");
    within("half a step ahead", ahead.abs(), 0.1);
    within("by half the step", growth_of_a_free_pair(3.51e-5, 0.5, 0.0).abs(), 0.1 / 6.0);
    assert!(at_once > 5.0, "{at_once}");
}

/// What is set again changes nothing, and a rollback takes all back.
#[test]
fn exact_rollback_and_repeats() {
    let text = machine("auto", "housing = { ahead = 0.5 }\n", [0.0, 0.2, 0.0]);
    let set = |named: &mut Named, n: usize, again: bool| {
        let swing = |phase: f64| 1e-5 * libm::sin(0.3 * n as f64 + phase);
        for block in ["bearing[1]", "bearing[2]", "rub[1]"] {
            for axis in ["y", "z"] {
                named.set(&format!("{block}.housing.r.{axis}"), swing(0.0));
                named.set(&format!("{block}.housing.v.{axis}"), 3e3 * swing(1.5));
                if again {
                    named.set(&format!("{block}.housing.r.{axis}"), swing(0.0));
                }
            }
        }
        named.simulation.advance((n + 1) as f64 * 1e-4).expect("a motion");
    };
    let mut named = Named::started(&text);
    let mut again = Named::started(&text);
    (0..20).for_each(|n| set(&mut named, n, false));
    (0..20).for_each(|n| set(&mut again, n, true));
    assert_eq!(named.bits(), again.bits());
    let saved = to_bytes(&mut *named.simulation);
    (20..40).for_each(|n| set(&mut named, n, false));
    let bits = named.bits();
    from_bytes(&mut *again.simulation, &saved).expect("what was saved");
    (20..40).for_each(|n| set(&mut again, n, true));
    assert_eq!(again.bits(), bits);
}

/// A housing that stands still is the stator, to the bit; the scene calls for it, or it is not there.
#[test]
fn a_housing_stands_in_the_scene_or_is_not_there() {
    let [fixed, still, moving] = ["", "housing.moves = false\n", "housing = {}\n"]
        .map(|housing| Named::started(&machine("dop853", housing, [0.0, 0.2, 0.0])));
    assert!(!fixed.scene.variables.iter().any(|variable| variable.name.contains("housing")));
    assert!(
        !fixed.scene.list().contains("Moving")
            && moving.scene.list().contains("Bearing<split_rotor_model::effects::housing::Moving, 2>")
    );
    let [mut fixed, mut still, mut moving] = [fixed, still, moving];
    let names: Vec<_> = fixed.scene.variables.iter().map(|variable| variable.name.clone()).collect();
    for named in [&mut fixed, &mut still, &mut moving] {
        named.simulation.advance(0.02).expect("a motion");
    }
    for name in names.iter().filter(|name| !name.starts_with("solver.")) {
        assert_eq!(fixed.get(name).to_bits(), still.get(name).to_bits(), "{name}");
        assert_eq!(fixed.get(name), moving.get(name), "{name}");
    }
    assert_eq!(moving.get("bearing[1].housing.moves"), 1.0);
    assert!(moving.simulation.parameters().effects.active().count() == 4);
}
