//! The drive: a tilted rotor beside an independent rigid body, and where its law ends. Its power: `power.rs`; its input, and an
//! upright rotor in closed form: `tests/interface/inputs.rs`; its ledger: `ledger.rs`.

use crate::harness::{DRIVEN, DRIVEN_FREE, Method, SUPPORTED, Scene, TORQUE, at, largest, times, within};
use nalgebra::{Vector2, Vector3};
use oracles::numerics::derivative;
use oracles::rigid_body::RigidBody;
use split_rotor_model::body::Body;
use split_rotor_model::integrate::Fault;
use split_rotor_model::rotation::Chart;
use split_rotor_model::simulation::General;
use split_rotor_model::state::Kinematics;
use split_rotor_model::variable::Place;
use std::f64::consts::PI;

const PHI: Place = Place { row: 1, ..TORQUE };
const ACCELERATION: Place = Place { row: 3, ..TORQUE };

fn read(simulation: &mut General, place: Place) -> f64 {
    simulation.get(place).expect("possible parameters").expect("an output")
}

/// With an input to come, the solver does not run ahead: other steps at 1e-10, the same motion. r_c [m] and axis [1] after
/// 1 s: measured 9.9e-13 and 1.1e-10.
const OTHER_STEPS: [f64; 2] = [3e-12, 3e-10];

#[test]
fn without_torque_the_shaft_is_not_there() {
    let scene = Scene { gamma: Vector2::new(0.4, -0.2), d1: 10.0, ..Scene::paper() };
    let [with, without] = [scene.run(DRIVEN, times(1.0, 10)), scene.run(SUPPORTED, times(1.0, 10))];
    for (with, without) in with.iter().zip(&without) {
        within("r_c", (with.motion.at.r - without.motion.at.r).norm(), OTHER_STEPS[0]);
        within("axis", (with.motion.axis() - without.motion.axis()).norm(), OTHER_STEPS[1]);
        assert_eq!(with.ledger.supplied, 0.0);
    }
}

// ------------------------------------------------------------------------------------------------- a tilted rotor

/// A driven scene: the paper's rotor on a damped support, tilted and swinging.
fn driven() -> Scene {
    Scene {
        gamma: Vector2::new(0.5, -0.3),
        omega: Vector3::new(50.0, 3.0, -2.0),
        v_c: Vector3::new(0.1, 0.4, -0.2),
        phi: 1.0,
        d1: 20.0,
        d2: 0.5,
        ..Scene::paper()
    }
}

/// A rotor that nothing keeps upright: it passes from chart to chart, at a distance from −e.
fn tumbling() -> Scene {
    Scene {
        gamma: Vector2::new(1.0, 1.6),
        omega: Vector3::new(6.0, -15.0, 20.0),
        c1: 30.0,
        c2: 0.0,
        d1: 2.0,
        d2: 0.05,
        ..driven()
    }
}

/// The torque [N·m] and its derivatives at the start.
const TORQUES: [f64; 3] = [1.5, -2.0, 3.0];

fn body_of(scene: &Scene) -> RigidBody {
    let Body { m, Ja, Jt, l } = scene.body;
    RigidBody {
        g: scene.g,
        c: [scene.c1, scene.c2],
        d: [scene.d1, scene.d2],
        tau: TORQUES,
        ..RigidBody::free(m, [Ja, Jt, Jt], l)
    }
}

/// Starts the scene with [`TORQUES`].
fn under_torque(scene: &Scene) -> General {
    let mut simulation = scene.started(DRIVEN);
    simulation.set_input(TORQUE, TORQUES[0]);
    simulation.set_input_derivative(TORQUE, 1, TORQUES[1]);
    simulation.set_input_derivative(TORQUE, 2, TORQUES[2]);
    simulation
}

/// r_c [m], axis [1], φ [rad], work supplied and lost [J] over 2 s at a tolerance of 1e-13: measured 1.1e-14, 3.7e-13,
/// 2.0e-13, 4.3e-13, 1.4e-12.
const BESIDE: [f64; 5] = [3e-14, 1.1e-12, 6e-13, 1.3e-12, 4e-12];
/// `drive.a` against extrapolated differences of the rigid body's speed, relative to the largest [1]: measured 3.0e-12.
const ACCELERATION_OF_SPEED: f64 = 1e-11;

#[test]
fn exact_tilted_rotor_beside_a_rigid_body() {
    for scene in [driven(), tumbling()] {
        let scene = Scene { tolerance: 1e-13, ..scene };
        let (body, mut simulation) = (body_of(&scene), under_torque(&scene));
        let mut exact = body.start(scene.r_c, scene.v_c, scene.phi, scene.gamma, scene.omega);
        let (mut worst, mut t, mut charts) = ([0.0; 5], 0.0, [false; 2]);
        let (mut off, mut size) = (0.0, 0.0);
        for end in times(2.0, 40).skip(1) {
            (exact, t) = (body.run(t, &exact, end, 20), end);
            let reading = at(&mut simulation, end);
            charts[usize::from(reading.motion.tilt.chart() == Chart::FromMinusE)] = true;
            let errors = [
                (reading.motion.at.r - exact.r).norm(),
                (reading.motion.axis() - exact.axis()).norm(),
                (read(&mut simulation, PHI) - exact.phi).abs(),
                (reading.ledger.supplied - exact.work[0]).abs(),
                (reading.ledger.dissipated - exact.work[1]).abs(),
            ];
            worst = std::array::from_fn(|n| largest([worst[n], errors[n]]));
            let [rate] = derivative(|time| [body.axial_rate(&body.run(end, &exact, time, 1))], end, 0.01);
            let acceleration = read(&mut simulation, ACCELERATION);
            (off, size) = (largest([off, (acceleration - rate).abs()]), largest([size, rate.abs()]));
        }
        assert!(size > 1.0);
        within("a", off / size, ACCELERATION_OF_SPEED);
        let names = ["r_c", "axis", "phi", "supplied", "dissipated"];
        for ((name, worst), allowed) in names.iter().zip(worst).zip(BESIDE) {
            within(name, worst, allowed);
        }
        assert_eq!(charts, [true, scene.c2 == 0.0], "the charts that the motion is meant to pass");
    }
}

// ---------------------------------------------------------------------------------------------------------- limit

/// A free rotor that turns end over end at 10 rad/s, straight through −e.
fn end_over_end(method: Method) -> General {
    Scene { method, omega: Vector3::new(0.0, 0.0, 10.0), ..Scene::free() }.started(DRIVEN_FREE)
}

/// Where the tilt 10 t reaches 3.1 rad [s].
const LIMIT: f64 = 0.31;
/// When it is refused there [s]: measured 2.3e-16.
const REFUSED_AT: f64 = 1e-15;
/// The axis of the rotor that turns end over end [1]: measured 2.6e-15.
const END_OVER_END: f64 = 1e-14;

fn assert_refused(simulation: &mut General, to: f64, expected: f64) {
    let fault = simulation.advance(to).expect_err("a torque acts where it has no limit");
    let Fault::Refused { t, reason } = fault else { panic!("{fault:?}") };
    assert!(reason.0.contains("3.1 rad") && reason.0.contains("tau"), "{fault}");
    assert_eq!(simulation.time(), Some(t));
    within("refused at", (t - expected).abs(), REFUSED_AT);
    assert!(simulation.read().unwrap().motion.tilt.gamma().norm() <= 3.1 + 1e-15 || t == expected);
    assert_eq!(simulation.advance(to), Err(fault), "again");
}

#[test]
fn exact_without_torque_nothing_is_refused() {
    for method in Method::PAIRS {
        for steps in [1, 100] {
            let mut simulation = end_over_end(method);
            times(2.0, steps)
                .for_each(|t| within("end over end", tilt_error(at(&mut simulation, t).motion, t), END_OVER_END));
            assert!(!simulation.has_tilted(), "nothing to warn of");
        }
    }
}

/// Of the axis [1].
fn tilt_error(motion: Kinematics<f64>, t: f64) -> f64 {
    (motion.axis() - Vector3::new(libm::cos(10.0 * t), libm::sin(10.0 * t), 0.0)).norm()
}

#[test]
fn exact_a_torque_ends_at_the_limit() {
    for method in Method::PAIRS {
        for derivative in 0..3 {
            for steps in [1, 100] {
                let mut simulation = end_over_end(method);
                // However small, and if only later: a slope or a curvature makes the torque act.
                match derivative {
                    0 => simulation.set_input(TORQUE, 1e-300),
                    order => simulation.set_input_derivative(TORQUE, order, 1e-300),
                };
                let last = times(1.0, steps).take_while(|t| *t < LIMIT).last().expect("0");
                at(&mut simulation, last);
                assert_eq!(simulation.has_tilted(), last > 0.5 * PI / 10.0, "warned from a right angle on");
                assert_refused(&mut simulation, 1.0, LIMIT);
                assert!(simulation.has_tilted());
            }
        }
    }
}

#[test]
fn exact_a_torque_that_comes_beyond_the_limit_is_refused_and_may_go_again() {
    for method in Method::PAIRS {
        let mut simulation = end_over_end(method);
        at(&mut simulation, 0.312);
        simulation.set_input(TORQUE, 1.0);
        assert!(!simulation.has_tilted(), "nothing to warn of yet");
        assert_refused(&mut simulation, 0.4, 0.312);
        assert!(simulation.has_tilted());
        // Where it goes again, so does the rotor.
        simulation.set_input(TORQUE, 0.0);
        within("goes on", tilt_error(at(&mut simulation, 0.4).motion, 0.4), END_OVER_END);
        // Past the limit on the other side it may come back.
        simulation.set_input(TORQUE, 1.0);
        simulation.advance(0.401).expect("short of the limit");
    }
}
