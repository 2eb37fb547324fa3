//! Starts and steps at the edge of what can be done: a rotor at rest, a start at the singular point, absurd forces. Late times and tiny
//! communication steps: the gallery (`xtask/src/hard_cases/times.rs`); impossible parameters: tests/interface/arguments.rs.

use crate::harness::named::{Named, ascending};
use crate::harness::{FREE, Method, SUPPORTED, Scene, at, within};
use nalgebra::{Vector2, Vector3};
use split_rotor_model::effects::CATALOGUE;
use split_rotor_model::integrate::{Fault, Refusal};
use split_rotor_model::simulation::Integrator;
use split_rotor_model::variable::{Bound, Kind, Role};
use split_rotor_model::variables::{Reading, Variable};

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
        let mut simulation = Scene { method, ..scene.clone() }.started(FREE);
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
    let mut simulation = scene.started(SUPPORTED);
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
        let fault = scene.started(SUPPORTED).advance(1000.0).expect_err("more than 10¹² steps");
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
        for method in ["auto", "dopri5", "dop853", "stiff", "symplectic", "taylor"] {
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

// ------------------------------------------------------------------------------------------------- tiny parameters

/// With these at 1e-160, the rotor is not refused at the start, and does not get far: their reciprocals are finite, and the squares of
/// these, in which errors are counted, are not; and of a needle so thin the energy is lost in rounding.
const KNOWN: [&str; 3] = ["motor.synchronous_speed", "motor.time_constant", "rotor.Ja"];

/// The general rotor with this effect alone, all that it has being of size 1.
fn alone(effect: &str) -> Named {
    let mut named = Named::new("rotor", Integrator::Method);
    for name in ["gravity", "support"] {
        named.set(&format!("effects.{name}"), 0.0);
    }
    for name in ["rotor.Ja", "rotor.Jt"] {
        named.set(name, 1.0);
    }
    named.set("solver.max_evaluations", 1e4);
    named.set("solver.method_number", 1.0);
    if !effect.is_empty() {
        named.set(&format!("effects.{effect}"), 1.0);
    }
    for Variable { name, meta, .. } in reals(&named, effect) {
        // What damps across is bounded by what damps along.
        let is_across = ["cyz", "czy"].iter().any(|column| name.contains(column));
        named.set(&name, if is_across { 0.0 } else { 1.0 + ascending(&meta) });
    }
    named
}

/// The Real parameters of an effect; without one, those that are always there.
fn reals(named: &Named, effect: &str) -> Vec<Variable> {
    let is_of = |name: &str| match name.split_once('.') {
        Some((block, _)) if effect.is_empty() => ["rotor", "start", "solver"].contains(&block),
        of => of.is_some_and(|(block, _)| block == effect),
    };
    let is_real = |variable: &&Variable| {
        let bound_by_size = matches!(
            variable.meta.role,
            Role::Parameter { bound: Bound::Finite | Bound::NotNegative | Bound::Positive, .. }
        );
        variable.meta.kind == Kind::Real && bound_by_size && is_of(&variable.name)
    };
    named.scene.variables.iter().filter(is_real).cloned().collect()
}

/// What is said of a rotor with such a value of a parameter where it does not move for a while, unless that names the parameter.
fn unnamed(named: &Named, start: [f64; 2], (name, value): (&str, f64)) -> Option<String> {
    let mut simulation = named.simulation.clone();
    let [place, speed] = start;
    for (start, value) in [("r_c.x", 0.0), ("r_c.y", place), ("v_c.z", speed), ("omega.x", speed), ("gamma.z", place)] {
        simulation.set_parameter(named.place(&format!("start.{start}")), value);
    }
    simulation.set_parameter(named.place(name), value);
    let said = match simulation.start(0.0, None) {
        Err(invalid) => invalid.to_string(),
        Ok(()) => match simulation.advance(1e-3) {
            Ok(()) | Err(Fault::Spent { .. }) => return None,
            Err(fault) => fault.to_string(),
        },
    };
    (!said.contains(name)).then(|| format!("{name} = {value:e}: {said}"))
}

#[test]
fn regress_a_tiny_parameter_does_no_harm_or_is_named() {
    let effects = CATALOGUE.iter().map(|info| info.block_name(1)).chain([String::new()]);
    let mut said = Vec::new();
    for effect in effects {
        let named = alone(&effect);
        for variable in reals(&named, &effect) {
            let is_known = KNOWN.contains(&variable.name.as_str());
            let values = [f64::from_bits(1), 1e-310, 1e-300, 1e-160];
            for value in values.into_iter().take(if is_known { 2 } else { 4 }) {
                for start in [[0.0, 0.0], [2.5, 0.3]] {
                    said.extend(unnamed(&named, start, (&variable.name, value)));
                }
            }
        }
    }
    assert!(said.is_empty(), "{}", said.join("\n"));
}
