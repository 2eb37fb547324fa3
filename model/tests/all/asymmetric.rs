//! Rotors that are unbalanced or not symmetric, against bodies put together of a rotor and point masses, which know no mass
//! centre of the whole.

use crate::harness::asymmetric::{Case, at};
use crate::harness::named::Named;
use crate::harness::swinging::within_order;
use crate::harness::{Random, Scene, kept, largest, within};
use nalgebra::{Matrix3, Vector2, Vector3};
use oracles::rigid_body::Moving;
use split_rotor_model::body::Shape;
use split_rotor_model::integrate::System;
use split_rotor_model::rotation::chart::crossed_exactly;
use split_rotor_model::rotation::{Angle, Chart, Tilt};
use split_rotor_model::rotor::Rotor;
use split_rotor_model::state::{COORDINATES, Coordinates};
use split_rotor_model::variables::Reading;
use std::f64::consts::{PI, TAU};

fn attitude(reading: &Reading) -> Matrix3<f64> {
    let motion = &reading.motion;
    motion.tilt.attitude(motion.at.phi)
}

const EXACTLY: &str = "method = \"dop853\"\nrelative_tolerance = 1e-13";

/// r_c [m], v_c [m/s], attitude [1], φ [rad], ω_φ [rad/s], energy and work lost [J], of some 200 J, after 2 or 3 s: measured
/// 1.8e-13, 7.9e-12, 3.0e-12, 9.1e-12, 5.8e-11, 8.5e-10, 8.5e-12.
const MOTION: [f64; 7] = [6e-13, 3e-11, 1e-11, 3e-11, 2e-10, 3e-9, 3e-11];
/// So many times as much with `stiff` [1]: measured 32.
const BY_STIFF: f64 = 100.0;

/// How far a motion is from that of the oracle.
fn errors(case: &Case, exact: &Moving, reading: &Reading) -> [f64; 7] {
    let motion = &reading.motion;
    let n = oracles::rigid_body::joint(&exact.axis());
    [
        (motion.r_c() - exact.r).norm(),
        (motion.v_c() - exact.v).norm(),
        (attitude(reading) - exact.attitude()).amax(),
        (motion.phi() - exact.phi).abs(),
        (motion.axial_rate() - exact.omega.dot(&n)).abs(),
        (reading.ledger.total() - case.body.energy(exact)).abs(),
        (reading.ledger.dissipated - exact.work[1]).abs(),
    ]
}

#[test]
fn exact_motion_by_each_method() {
    for (case, name) in [(Case::held(), "damped"), (Case::undamped(), "undamped")] {
        let exact = case.body.run(0.0, &case.start(), 2.0, 800);
        for solver in [
            EXACTLY,
            "method = \"dopri5\"\nrelative_tolerance = 1e-13",
            "method = \"stiff\"\nrelative_tolerance = 1e-12",
            "method = \"symplectic\"\norder = 8\nstep_size = 1e-3",
        ] {
            let more = if solver.contains("stiff") { BY_STIFF } else { 1.0 };
            let mut named = case.started(solver);
            let reading = at(&mut named, 2.0);
            let errors = errors(&case, &exact, &reading);
            println!("{name}, {solver}: {errors:?}, {} evaluations", reading.cost.evaluations);
            for (error, allowed) in errors.into_iter().zip(MOTION) {
                within(solver, error, more * allowed);
            }
            within("residual", reading.ledger.residual().abs(), more * MOTION[5]);
        }
    }
}

#[test]
fn exact_motion_through_both_charts() {
    let mut random = Random(11);
    for _ in 0..6 {
        let mut within_one = || random.within(-1.0, 1.0);
        let omega = Vector3::new(4.0 * within_one(), 9.0 * within_one(), 9.0 * within_one());
        let gamma = Vector2::new(within_one(), within_one());
        let case = Case { gamma, omega, phi: 3.0 * within_one(), ..Case::tumbling() };
        let exact = case.body.run(0.0, &case.start(), 3.0, 600);
        let mut named = case.started(EXACTLY);
        let mut charts = [false; 2];
        for step in 1..=300 {
            let reading = at(&mut named, f64::from(step) / 100.0);
            charts[reading.motion.tilt.chart() as usize - 1] = true;
        }
        let reading = at(&mut named, 3.0);
        let errors = errors(&case, &exact, &reading);
        println!("{errors:?}, charts {charts:?}");
        for (error, allowed) in errors.into_iter().zip(MOTION) {
            within("tumbling", error, allowed);
        }
    }
}

// ------------------------------------------------------------------------------------------- bodies that are the same

/// r_c [m], axis [1], φ [rad], energy [J] of two descriptions of one body after 1 s: measured 1.1e-12.
const SAME: f64 = 4e-12;

fn same(what: &str, one: &Reading, other: &Reading) {
    let (a, b) = (&one.motion, &other.motion);
    within(what, (a.r_c() - b.r_c()).norm(), SAME);
    within(what, (a.axis() - b.axis()).norm(), SAME);
    within(what, (a.phi() - b.phi()).abs(), SAME);
    within(what, (one.ledger.kinetic - other.ledger.kinetic).abs(), SAME);
}

fn balanced() -> Case {
    let mut case = Case::held();
    (case.body.masses, case.body.moments.z) = (Vec::new(), case.body.moments.y);
    case
}

#[test]
fn exact_what_adds_nothing_leaves_a_symmetric_rotor() {
    let text = |case: &Case| case.text(EXACTLY).replace("[effects.asymmetry]\nJt2 = 0.078125\n", "");
    let mut weightless = balanced();
    weightless.body.masses = vec![(0.0, Vector3::new(0.1, 0.2, 0.0))];
    for (what, other) in [("Jt2 = Jt", balanced().text(EXACTLY)), ("masses without mass", text(&weightless))] {
        let [mut plain, mut other] = [text(&balanced()), other].map(|text| Named::started(&text));
        same(what, &at(&mut plain, 1.0), &at(&mut other, 1.0));
    }
}

#[test]
fn exact_masses_are_the_rotor_that_they_make() {
    let (mass, radius) = (0.4, 0.1);
    let place = |angle: f64| Vector3::new(0.0, radius * libm::cos(angle), radius * libm::sin(angle));
    // A symmetric rotor, and an asymmetry; the moments that a mass adds.
    for (what, places, moments) in [
        ("all around", [0.0, 0.5, 1.0, 1.5].map(|part| place(0.2 + PI * part)).to_vec(), Vector3::new(1.0, 0.5, 0.5)),
        ("opposite", [1.0, -1.0].map(|side| Vector3::y() * (side * radius)).to_vec(), Vector3::new(1.0, 0.0, 1.0)),
    ] {
        let (mut parts, mut whole) = (balanced(), balanced());
        let all = mass * places.len() as f64;
        parts.body.masses = places.into_iter().map(|place| (mass, place)).collect();
        whole.body.m += all;
        whole.body.moments += moments * (all * radius * radius);
        same(what, &at(&mut parts.started(EXACTLY), 1.0), &at(&mut whole.started(EXACTLY), 1.0));
    }
}

// ------------------------------------------------------------------------------------------------ the attitude itself

/// The attitude in both charts [1], and φ there and back [rad]: measured 1.3e-15.
const ATTITUDE: f64 = 4e-15;

#[test]
fn exact_attitude_is_that_of_quaternions() {
    let mut random = Random(5);
    let mut worst = 0.0_f64;
    for _ in 0..2000 {
        let (theta, azimuth) = (random.within(0.0, 2.8), random.within(-PI, PI));
        let gamma = Vector2::new(theta * libm::cos(azimuth), theta * libm::sin(azimuth));
        let phi = random.within(-30.0, 30.0);
        let exact = oracles::rotation::attitude(phi, &gamma);
        let (chart, other) = (Chart::FromMinusE, crossed_exactly(gamma));
        let angle = Angle { turns: 0.0, remainder: phi }.wrapped();
        // φ as the chart from −e has it, and back.
        let own = chart.own_angle(angle, other);
        let back = chart.axial_angle(own.turns, own.remainder, other);
        worst = largest([
            worst,
            (Tilt::new(Chart::FromE, gamma).attitude(phi) - exact).amax(),
            (Tilt::new(chart, other).attitude(own.remainder) - exact).amax(),
            (TAU * (back.turns - angle.turns) + back.remainder - angle.remainder).abs(),
        ]);
    }
    within("attitude", worst, ATTITUDE);
}

// ------------------------------------------------------------------------------------------------- the observed order

/// The order that is observed is that of the composition within this [1].
const ORDER: f64 = 0.1;

#[test]
fn exact_order_of_compositions() {
    let case = Case::undamped();
    let end = 0.4;
    let exact = case.body.run(0.0, &case.start(), end, 400);
    for (order, parts) in [(2, [200, 280, 400]), (4, [100, 140, 200]), (6, [60, 84, 120]), (8, [60, 84, 120])] {
        let errors = parts.map(|parts| {
            let h = end / f64::from(parts);
            let mut named = case.started(&format!(
                "method = \"symplectic\"\norder = {order}\nstep_size = {h:?}\nrelative_tolerance = 0.1"
            ));
            let [r, _, attitude, ..] = errors(&case, &exact, &at(&mut named, end));
            (h, r + attitude)
        });
        within_order(&format!("{errors:?}"), errors, f64::from(order), ORDER);
    }
}

// ---------------------------------------------------------------------------------------------------- what is refused

#[test]
fn bodies_that_cannot_be() {
    let refusal = |change: fn(&mut Case)| {
        let mut case = balanced();
        change(&mut case);
        let mut named = Named::written(&balanced().text(EXACTLY));
        for (name, value) in [
            ("rotor.Ja", case.body.moments.x),
            ("rotor.Jt", case.body.moments.y),
            ("asymmetry.Jt2", case.body.moments.z),
        ] {
            named.set(name, value);
        }
        named.simulation.start(0.0, None).map_err(|invalid| invalid.to_string())
    };
    let bound = "is not possible: it must be from |rotor.Ja - rotor.Jt| = 0.078125 to rotor.Ja + rotor.Jt = 0.234375";
    assert_eq!(refusal(|case| case.body.moments.z = 0.07), Err(format!("asymmetry.Jt2 = 0.07 {bound}")));
    assert_eq!(refusal(|case| case.body.moments.z = 0.24), Err(format!("asymmetry.Jt2 = 0.24 {bound}")));
    assert_eq!(refusal(|case| case.body.moments.z = 0.2), Ok(()));
    // What would be no body with Jt2 = Jt is one with a larger Jt2.
    assert_eq!(refusal(|case| case.body.moments = Vector3::new(0.15, 0.07, 0.1)), Ok(()));
    assert!(refusal(|case| case.body.moments.z = -0.1).is_err_and(|text| text.starts_with("asymmetry.Jt2 = -0.1")));
}

#[test]
fn exact_a_mass_centre_that_goes_round_is_no_excursion_of_the_rotor() {
    let mut shape = Shape::of(Scene::paper().body);
    shape.add(0.5, &Vector3::new(0.1, 0.2, -0.1));
    let (rotor, centre, spin) = (Rotor::new(shape.inertia(), kept(()), Chart::FromE, 0.0), shape.centre(), 50.0);
    // c rests in the origin, and the body turns upright about its axis.
    let [then, now] = [0.0, 1.0].map(|phi: f64| {
        let (sin, cos) = (libm::sin(phi), libm::cos(phi));
        let r = Vector3::new(centre.x, cos * centre.y - sin * centre.z, sin * centre.y + cos * centre.z);
        let v = Vector3::x().cross(&r) * spin;
        let mut y = [0.0; COORDINATES];
        Coordinates { r, v, k: Vector3::x(), gamma: Vector2::zeros(), phi }.write(&mut y);
        y
    });
    let mut rate = [0.0; COORDINATES];
    rate[COORDINATES - 1] = spin;
    let sizes = rotor.sizes(&now, &rate, &then);
    // The place along e and across it, and the velocity.
    within("the way of c", largest(sizes[..4].iter().map(|square| square.sqrt())), 1e-14);
}
