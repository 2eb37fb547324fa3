//! How `symplectic` counts the turns of φ of an asymmetric body that stays near −e, or comes back to it: against the quaternion,
//! integrated in small steps, and in how many parts.

use crate::harness::asymmetric::{Case, at};
use crate::harness::named::Named;
use crate::harness::within;
use nalgebra::{Vector2, Vector3};
use oracles::extrapolation;
use oracles::rotation;
use split_rotor_model::rotation::{Chart, Tilt};
use split_rotor_model::splitting::Tumbling;
use std::f64::consts::PI;

/// φ [rad] after `h` [s]: w + ix of the quaternion is cos(θ/2) e^(iφ/2), and near −e it keeps its digits.
fn phi(case: &Case, h: f64) -> f64 {
    let tensor = case.shape().tensor();
    let inverse = tensor.try_inverse().unwrap();
    let rates = |_: f64, y: &[f64; 8]| {
        let (omega, q) = (Vector3::new(y[0], y[1], y[2]), (y[3], Vector3::new(y[4], y[5], y[6])));
        let growth = inverse * (tensor * omega).cross(&omega);
        let (w, v) = rotation::product(q, (0.0, omega * 0.5));
        let phi = 2.0 * (y[3] * v.x - y[4] * w) / (y[3] * y[3] + y[4] * y[4]);
        [growth.x, growth.y, growth.z, w, v.x, v.y, v.z, phi]
    };
    let (w, v) = rotation::split(case.phi, &case.gamma);
    let omega = rotation::matrix((w, v)).tr_mul(&case.omega);
    let start = [omega.x, omega.y, omega.z, w, v.x, v.y, v.z, case.phi];
    let count = (40.0 * case.omega.norm() * h) as u32;
    extrapolation::steps(rates, 0.0, &start, h, count)[7]
}

/// Parts in which a drift of `h` [s] is walked, a radian of |ω| h [1/rad]: work that can be counted, where time cannot.
fn parts(case: &Case, h: f64) -> f64 {
    let (body, tilt) = (case.shape().inertia(), Tilt::new(Chart::FromE, case.gamma));
    let (asymmetric, attitude) = (body.asymmetric.unwrap(), tilt.attitude(case.phi));
    let k = attitude * case.shape().tensor() * attitude.tr_mul(&case.omega);
    let axes = attitude * asymmetric.principal();
    let tumbling = Tumbling::new(&body, &asymmetric, axes, axes.tr_mul(&k)).unwrap();
    f64::from(tumbling.beside(tilt, h, 0.0).parts) / (case.omega.norm() * h.abs())
}

/// Spinning about −e on the least and on the largest moment, turning over, and unbalanced, with a nutation of `w` [rad/s].
fn cases(w: f64) -> [Case; 5] {
    // Beside −e by about as much as the axis goes round.
    let (beside, back) = (Vector2::new(PI - 0.03 * w, 0.005 * w), Vector3::new(-50.0, w, 0.0));
    let mut unbalanced = Case::free([0.15, 0.08, 0.11], beside, back);
    unbalanced.body.masses = vec![(0.01, Vector3::new(0.1, 0.02 * w, 0.03))];
    [
        Case::free([0.08, 0.15, 0.11], beside, back),
        Case::free([0.15, 0.08, 0.11], beside, back),
        Case::free([0.11, 0.15, 0.08], beside, back),
        Case::free([0.11, 0.15, 0.08], Vector2::zeros(), Vector3::new(50.0, w, 0.0)),
        unbalanced,
    ]
}

/// φ [rad] with all turns after 2 s, times the nutation w [rad/s], since an error of the axis counts by its distance to −e:
/// measured 2.0e-10, of the one that turns over, whose errors grow with it.
const PHI: f64 = 6e-10;

#[test]
fn exact_phi_beside_minus_e_has_all_its_turns() {
    for w in [1e-1, 1e-3, 1e-6] {
        for case in cases(w) {
            let exact = phi(&case, 2.0);
            for solver in ["order = 2\nstep_size = 10.0", "order = 6\nstep_size = 0.05"] {
                let reading = at(&mut case.started(&format!("method = \"symplectic\"\n{solver}")), 2.0);
                within(
                    &format!("{w:e}, {:?}, {solver}", case.body.moments),
                    w * (reading.motion.phi() - exact).abs(),
                    PHI,
                );
            }
        }
    }
}

/// Parts of a walk, a radian [1/rad]: measured 2.9, and 3.7 where the axis starts at −e and comes back.
const PARTS: f64 = 5.0;
/// The same where it goes through −e at every turn: measured 14.
const THROUGH: f64 = 25.0;

#[test]
fn regress_parts_do_not_grow_near_minus_e() {
    for w in [1e-1, 1e-2, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        let through = Case::free([0.15, 0.08, 0.11], Vector2::new(PI, 0.0), Vector3::new(-50.0, w, 0.0));
        for case in cases(w).iter().chain([&through]) {
            for h in [1.0, 10.0, -1.0] {
                within(&format!("{w:e}, {:?}, {h} s", case.body.moments), parts(case, h), PARTS);
            }
        }
    }
    // Through −e at every turn, where the time is long and its last digit a long way.
    let even = Case::free([0.15, 0.08, 0.08 * (1.0 + 1e-14)], Vector2::new(PI, 0.0), Vector3::new(-50.0, 10.0, 0.0));
    within("through −e", parts(&even, 3e3), THROUGH);
}

#[test]
fn regress_a_step_is_no_longer_than_the_run() {
    let case = Case::free([0.11, 0.15, 0.08], Vector2::zeros(), Vector3::new(10.0, 0.1, 0.0));
    let [mut long, mut whole] = ["1e5", "0.5"].map(|size| {
        let text = case.text(&format!("method = \"symplectic\"\norder = 2\nstep_size = {size}"));
        let mut named = Named::written(&text);
        named.simulation.start_until(0.0, None, Some(0.5)).expect("a possible start");
        named
    });
    let [long, whole] = [&mut long, &mut whole].map(|named| {
        let reading = at(named, 0.5);
        (*reading.motion.axis(), reading.motion.phi(), reading.cost.steps)
    });
    assert_eq!(long, whole);
}
