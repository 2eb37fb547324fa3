//! A tolerance means something: the error of a whole run over its tolerance is nearly the same number at every tolerance.
//!
//! The error is the largest over the communication points, 0 … 10 s every 0.1 s: of r_c in units of l, as the tolerance
//! counts it, and of the axis in units of 1 rad. What it is measured against is the independent rigid body of the oracles.
//!
//! Smooth are `paper`, `free_top` and `driven`: no contact, no jump of an input, one chart. `tumbling` is not: it passes
//! −e at 0.02 rad, and its error over the tolerance varies by a factor of 55 (dop853). In `free_top` the mass centre rests
//! and has no error.
//!
//! The factor for the axis, dopri5 and dop853: 77 and 15 in `paper`, 570 and 117 in `free_top`, 0.1 and 0.6 in `driven`.
//!
//! The damping of `driven` forgets errors, and dop853's steps there are held by stability rather than by the tolerance: its
//! error of r_c is 0.02 to 0.07 of the tolerance with dopri5, 0.005 to 0.025 with dop853. No factor brings these and the
//! undamped scene's between 0.1 and 10 without the axis going astray.

use crate::harness::named::Named;
use crate::harness::{Method, at, largest, times, within};
use crate::oracles::rigid_body::{Moving, RigidBody};
use crate::oracles::{paper, rotation};
use model::simulation::Integrator;
use nalgebra::{Vector2, Vector3};

/// The smooth scenes, and whether the mass centre moves.
const SMOOTH: [(&str, bool); 3] = [("paper", true), ("free_top", false), ("driven", true)];

/// Where errors are read: up to here [s], so often.
const END: f64 = 10.0;
const POINTS: u32 = 100;

/// The rigid body's own steps from one communication point to the next.
const PARTS: u32 = 20;

/// Half decades from 1e-6 to 1e-12.
fn tolerances() -> impl Iterator<Item = f64> {
    (0..=12).map(|n| libm::pow(10.0, -6.0 - 0.5 * f64::from(n)))
}

/// What a variable starts with; zero where the scene has none of this name.
fn value(scene: &mut Named, name: &str) -> f64 {
    if scene.scene.variables.iter().any(|variable| variable.name == name) { scene.get(name) } else { 0.0 }
}

/// The scene's motion at the communication points, without our mathematics.
fn exact(name: &str) -> Vec<Moving> {
    let mut scene = Named::new(name, Integrator::Method);
    let mut get = |name: &str| value(&mut scene, name);
    let mut vector = |name: &str| Vector3::from(["x", "y", "z"].map(|n| get(&format!("{name}.{n}"))));
    let (r_c, v_c, omega, g) = (vector("start.r_c"), vector("start.v_c"), vector("start.omega"), vector("gravity.g"));
    let gamma = Vector2::new(get("start.gamma.y"), get("start.gamma.z"));
    let body = RigidBody {
        m: get("rotor.m"),
        Ja: get("rotor.Ja"),
        Jt: get("rotor.Jt"),
        l: get("rotor.l"),
        g,
        c: [get("support.c1"), get("support.c2")],
        d: [get("support.d1"), get("support.d2")],
        tau: if get("shaft.tau") == 0.5 { |_| 0.5 } else { |_| 0.0 },
        pushed: [Vector3::zeros(); 2],
    };
    assert_eq!(get("shaft.tau"), (body.tau)(0.0));
    let mut moving = body.start(r_c, v_c, get("start.phi"), &gamma, &omega);
    let mut t = 0.0;
    let next = |end: f64| {
        (moving, t) = (body.run(t, &moving, end, PARTS), end);
        moving
    };
    times(END, POINTS).map(next).collect()
}

/// The rigid body beside the paper's reference motion: r_c [m], axis [1]: measured 6.3e-15 and 1.8e-14.
const RIGID_BODY: [f64; 2] = [2e-14, 5e-14];

#[test]
fn literature_the_rigid_body_is_exact() {
    let pairs = || paper::instants().into_iter().zip(exact("paper"));
    let r_c = pairs().map(|(reference, body)| (body.r - reference.r_c).norm());
    let axis = pairs().map(|(reference, body)| (body.axis() - rotation::axis(&reference.gamma)).norm());
    within("r_c", largest(r_c), RIGID_BODY[0]);
    within("axis", largest(axis), RIGID_BODY[1]);
}

/// Errors of r_c and of the axis over the tolerance [1].
fn ratios(name: &str, method: Method, tolerance: f64, exact: &[Moving]) -> [f64; 2] {
    let mut scene = Named::new(name, Integrator::Method);
    scene.set("solver.method", f64::from(method as i32));
    scene.set("solver.relative_tolerance", tolerance);
    let l = scene.get("rotor.l");
    scene.start();
    let mut errors = [0.0; 2];
    for (t, exact) in times(END, POINTS).zip(exact) {
        let motion = at(&mut scene.simulation, t).motion;
        let now = [(motion.at.r - exact.r).norm() / l, (motion.axis() - exact.axis()).norm()];
        errors = [0, 1].map(|n| largest([errors[n], now[n]]));
    }
    errors.map(|error| error / tolerance)
}

/// The ratios at each of the tolerances, for each smooth scene and method: those of r_c where it moves, and of the axis.
fn all() -> Vec<(String, Vec<f64>, Vec<f64>)> {
    let mut all = Vec::new();
    for (name, moves) in SMOOTH {
        let exact = exact(name);
        for method in Method::PAIRS {
            let pairs: Vec<_> = tolerances().map(|tolerance| ratios(name, method, tolerance, &exact)).collect();
            let [r_c, axis] = [0, 1].map(|n| pairs.iter().map(|pair| pair[n]).collect::<Vec<_>>());
            all.push((format!("{name}, {method:?}"), if moves { r_c } else { Vec::new() }, axis));
        }
    }
    all
}

/// How far the largest and the smallest lie from the geometric mean, in decades.
fn spread(ratios: &[f64]) -> f64 {
    let decades: Vec<_> = ratios.iter().map(|&ratio| libm::log10(ratio)).collect();
    let mean = decades.iter().sum::<f64>() / decades.len() as f64;
    largest(decades.iter().map(|decade| (decade - mean).abs()))
}

/// Decades: measured 0.44 at most (r_c of `driven`, dop853), 0.07 where nothing damps.
const HALF_A_DECADE: f64 = 0.5;

#[test]
fn exact_error_over_tolerance_hardly_depends_on_the_tolerance() {
    println!("error over tolerance at {:?}", tolerances().collect::<Vec<_>>());
    for (what, r_c, axis) in all() {
        for (name, ratios) in [("r_c", r_c), ("axis", axis)].into_iter().filter(|(_, ratios)| !ratios.is_empty()) {
            println!("{what}, {name}: {ratios:.3?}");
            within(&format!("{what}, {name}: decades from the mean"), spread(&ratios), HALF_A_DECADE);
        }
    }
}

/// What an error of r_c may be over the tolerance [1]; where damping forgets errors, it may be smaller.
const HONEST: [f64; 2] = [0.1, 10.0];
const FORGETFUL: &str = "driven";

#[test]
fn exact_the_error_of_r_c_is_about_the_tolerance() {
    let of_r_c: Vec<_> = all().into_iter().filter(|(_, r_c, _)| !r_c.is_empty()).collect();
    let ranges = of_r_c.iter().map(|(what, r_c, _)| {
        let (least, most) = (r_c.iter().copied().fold(f64::INFINITY, f64::min), largest(r_c.iter().copied()));
        println!("{what}: {least:.4} to {most:.4}");
        (what, least, most)
    });
    let honest = |what: &str, least: f64, most: f64| {
        most <= HONEST[1] && (least >= HONEST[0] || what.starts_with(FORGETFUL) && least > 0.0)
    };
    let wrong: Vec<_> = ranges.filter(|(what, least, most)| !honest(what, *least, *most)).collect();
    assert!(wrong.is_empty(), "error of r_c over tolerance beyond {HONEST:?}: {wrong:?}");
}
