//! Starts and steps at the edge of what can be done: a rotor at rest, a start at the singular point, absurd forces. Late times and tiny
//! communication steps: the gallery (`xtask/src/hard_cases/times.rs`); impossible parameters: tests/arguments.rs.

use crate::harness::named::Named;
use crate::harness::{Method, Scene, Supported, at, within};
use nalgebra::{Vector2, Vector3};
use split_rotor_model::integrate::{Fault, Refusal};
use split_rotor_model::variables::Reading;

/// Every number that an instant shows is finite.
fn assert_finite(reading: &Reading) {
    let motion = &reading.motion;
    let numbers = motion.at.r.iter().chain(&motion.at.v).chain(&motion.at.k).chain(&motion.at.gamma);
    assert!(numbers.chain(motion.axis()).chain(&motion.omega).all(|x| x.is_finite()), "{motion:?}");
    assert!(reading.motion.phi().is_finite() && reading.ledger.total().is_finite());
}

// --------------------------------------------------------------------------------------------------------- at rest

#[test]
fn exact_resting_rotor_rests() {
    let scene = Scene { omega: Vector3::zeros(), ..Scene::free() };
    for method in Method::PAIRS {
        let mut simulation = Scene { method, ..scene.clone() }.started::<()>();
        let reading = at(&mut simulation, 1e3);
        assert_eq!(reading.motion.at.r, Vector3::zeros());
        assert_eq!((reading.motion.angle().turns, reading.motion.angle().remainder), (0.0, 0.0));
        assert!(reading.cost.steps < 100.0, "{:?}", reading.cost);
    }
}

// -------------------------------------------------------------------------------------------- the singular point

#[test]
fn regress_start_beyond_the_limit() {
    // |γ| ≤ π may be asked for; under a law that ends at 3.1 rad it cannot be moved, but can be read.
    let scene = Scene { gamma: Vector2::new(0.0, 3.12), c2: 1e-300, ..Scene::free() };
    let mut simulation = scene.started::<Supported>();
    assert!(matches!(simulation.advance(0.1), Err(Fault::Refused { t: 0.0, .. })));
    assert_finite(simulation.read().unwrap());
}

// ------------------------------------------------------------------------------------------------- absurd forces

#[test]
fn regress_forces_that_would_take_for_ever_are_faults() {
    let stretched = Scene { r_c: Vector3::new(1.0, 0.5, 0.0), ..Scene::paper() };
    let mut scenes = [1e20, 1e80, 1e140, 1e160, 1e300, f64::MAX].map(|c1| Scene { c1, ..stretched.clone() }).to_vec();
    scenes.push(Scene { c2: 1e300, gamma: Vector2::new(0.0, 0.5), ..stretched });
    for scene in scenes {
        let fault = scene.started::<Supported>().advance(1000.0).expect_err("more than 10¹² steps");
        assert!(matches!(fault, Fault::Spent { .. } | Fault::Underflow { .. } | Fault::NotFinite { .. }), "{fault:?}");
    }
}

#[test]
fn a_law_without_a_limit_is_named() {
    let rotor = "[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.0\n[start]\nomega = { y = 5.0 }\n";
    for (effect, what) in [
        ("[effects.support]\nc2 = 1e-300\n", "the spring support.c2, which follows gamma,"),
        ("[effects.drive]\ntau = 1e-300\n", "drive.tau, which a joint passes on,"),
        (
            "[effects.motor]\nstall_torque = 1.0\nsynchronous_speed = 1.0\ncommand = 1e-300\n",
            "motor.tau, which a joint passes on,",
        ),
        ("[[effects.bearing]]\nposition = 0.0\nkt = 1e-300\n", "the spring kt of a bearing, which follows gamma,"),
        (
            "[[effects.bearing]]\nposition = 0.0\nspeed = [0.0]\nkyy = [1e-300]\n",
            "omega_phi, which the table of a bearing follows,",
        ),
        ("[effects.imposed_speed]\nw = 0.0\n", "the speed that imposed_speed gives a joint"),
    ] {
        for method in ["auto", "dopri5", "dop853", "stiff", "symplectic"] {
            if (effect.contains("imposed"), method) == (true, "symplectic") {
                continue;
            }
            let mut rotor = Named::started(&format!("{rotor}{effect}[solver]\nmethod = \"{method}\"\n"));
            let fault = rotor.simulation.advance(1.0).expect_err("it goes past the antipode");
            let reason = format!("the tilt |gamma| reaches 3.1 rad, and {what} has no limit at pi");
            let Fault::Refused { t, reason: Refusal(said) } = fault else { panic!("{effect} {method}: {fault:?}") };
            assert_eq!(said, reason, "{effect} {method}");
            // 5 t = 3.1, or soon after, for a composition to the shortest part of a step that is tried.
            within(&format!("{effect} {method}"), (t - 0.62).abs(), if method == "symplectic" { 1e-6 } else { 1e-14 });
        }
    }
}
