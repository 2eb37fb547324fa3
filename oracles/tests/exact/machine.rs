//! The machine's motors, rings and tables against closed forms.

use nalgebra::Vector3;
use oracles::bounds::{largest, within};
use oracles::limited_power::{self, Turning};
use oracles::machine::{Bearing, Input, Machine, Motor, Node, Pace, Rub, Run, Shown, Start};
use oracles::monotone::curve;
use std::f64::consts::{PI, TAU};

/// What steps may err, over how far the motion goes \[1].
const STEP: f64 = 1e-13;

/// A rotor of 5 kg that nothing holds.
fn rotor() -> Machine {
    Machine { m: 5.0, Ja: 0.15625, Jt: 0.078125, ..Machine::default() }
}

/// What it shows at so many times up to `end` \[s].
fn shown(machine: &Machine, end: f64, count: u32) -> Vec<(f64, Shown)> {
    let mut run = Run::new(machine, Pace::Adaptive(STEP));
    let at = |n: u32| {
        let t = end * f64::from(n) / f64::from(count);
        assert!(run.advance(t), "a motion");
        (t, run.show())
    };
    (1..=count).map(at).collect()
}

#[test]
fn exact_motor_runs_an_upright_rotor_up() {
    for lag in [0.0, 0.1, 2.0] {
        let known = limited_power::Motor { inertia: 0.15625, stall: 4.0, synchronous: 100.0, lag };
        let machine = Machine {
            motor: Some(Motor { stall_torque: 4.0, synchronous_speed: 100.0, time_constant: lag }),
            inputs: vec![(Input::Command, 0.8)],
            start: Start { omega: Vector3::x() * 10.0, ..Start::default() },
            ..rotor()
        };
        let from = Turning { phi: 0.0, speed: 10.0, torque: known.steady(0.8, 10.0) };
        let errors = shown(&machine, 10.0, 20).into_iter().map(|(t, now)| {
            let exact = known.run(0.8, &from, t);
            (now.phi - exact.phi).abs() / exact.phi + (now.omega.x / exact.speed - 1.0).abs()
        });
        within(&format!("a lag of {lag} s"), largest(errors), 2e-12);
    }
}

/// A ring of 2e6 N/m, 10 mm wide.
fn ring(damping: f64) -> Rub {
    let [position, friction] = [0.0; 2];
    Rub { position, gap: 0.01, stiffness: 2e6, damping, friction, radius: 0.05, v0: 0.01 }
}

#[test]
fn exact_twenty_bounces_come_back() {
    let machine = Machine { gravity: Some(Vector3::z() * -9.81), rubs: vec![ring(0.0)], ..rotor() };
    let rate = (2e6_f64 / 5.0).sqrt();
    let (fall, speed) = ((2.0_f64 * 0.01 / 9.81).sqrt(), (2.0_f64 * 9.81 * 0.01).sqrt());
    // From δ = 0 at this speed, back to δ = 0: δ = (1 − cos ωt) g/ω² + sin ωt v/ω.
    let period = 2.0 * fall + 2.0 * (PI - libm::atan(speed * rate / 9.81)) / rate;
    let errors = shown(&machine, 20.0 * period, 20).into_iter().map(|(_, now)| now.r_c.z.abs() / 0.01);
    within("height", largest(errors), 1e-10);
}

#[test]
fn exact_damped_contact_lets_go_where_it_would_pull() {
    // m δ̈ = −kδ − cδ̇ from δ = 0 at 1 m/s: N = 0 where tan ωt = −2ζ√(1 − ζ²)/(1 − 2ζ²).
    let (mass, k, c) = (5.0, 2e6_f64, 1000.0);
    let (sigma, natural) = (c / (2.0 * mass), (k / mass).sqrt());
    let (zeta, rate) = (sigma / natural, (natural * natural - sigma * sigma).sqrt());
    let contact = (PI - libm::atan2(2.0 * zeta * (1.0 - zeta * zeta).sqrt(), 1.0 - 2.0 * zeta * zeta)) / rate;
    // The speed there is e^(−σt).
    let (back, start) = (libm::exp(-sigma * contact), Start { v_c: Vector3::y(), ..Start::default() });
    let machine = Machine { rubs: vec![ring(c)], start, ..rotor() };
    for (_, now) in shown(&machine, 0.015, 1) {
        within("speed", (now.v_c.y / -back - 1.0).abs(), 1e-11);
    }
}

#[test]
fn exact_friction_brakes_and_pushes_as_the_joint_has_it() {
    // Pressed on the ring by gravity and held upright, where tanh is 1: F = μ m g along y, J dω/dt = −μ m g R.
    let rub = Rub { friction: 0.1, v0: 1e-3, ..ring(0.0) };
    let sag = 0.01 + 5.0 * 9.81 / 2e6;
    let start = Start { r_c: Vector3::z() * -sag, omega: Vector3::x() * 100.0, ..Start::default() };
    let machine = Machine { gravity: Some(Vector3::z() * -9.81), rubs: vec![rub], start, ..rotor() };
    let t = 1e-7;
    for (_, now) in shown(&machine, t, 1) {
        // It slides forward below, so it is pushed back: along −t̂ = −e×r̂, r̂ = −z.
        within("push", (now.v_c.y / (-0.1 * 9.81 * t) - 1.0).abs(), 1e-6);
        let braking = 0.1 * 5.0 * 9.81 * 0.05 / 0.15625;
        within("brake", ((100.0 - now.omega.x) / (braking * t) - 1.0).abs(), 1e-6);
    }
}

#[test]
fn exact_table_is_its_curve_at_a_speed_that_stays() {
    let node = |speed: f64, k: f64| Node { speed, k: [[k, 0.0], [0.0, k]], ..Node::default() };
    let table = vec![node(10.0, 1e4), node(40.0, 5e4), node(60.0, 6e4), node(100.0, 2e4)];
    let points: Vec<_> = table.iter().map(|node| (node.speed, node.k[0][0])).collect();
    for speed in [0.0, 25.0, -50.0, 90.0, 200.0] {
        let bearing = Bearing { table: table.clone(), k: [[1e4, 0.0], [0.0, 1e4]], ..Bearing::default() };
        let start = Start { r_c: Vector3::y() * 1e-3, omega: Vector3::x() * speed, ..Start::default() };
        let machine = Machine { bearings: vec![bearing], start, ..rotor() };
        let rate = ((1e4 + curve(&points, speed.abs())) / 5.0).sqrt();
        let errors = shown(&machine, TAU / rate * 3.3, 7).into_iter();
        let errors = errors.map(|(t, now)| (now.r_c.y / 1e-3 - libm::cos(rate * t)).abs());
        within(&format!("{speed} rad/s"), largest(errors), 1e-11);
    }
}

#[test]
fn exact_table_is_followed_through_its_nodes() {
    // Damping alone, C(|ω|) along y, at a speed that grows evenly: v = v₀ e^(−∫C dt/m); ∫C dω by Gauss's rule piece by piece.
    let node = |speed: f64, c: f64| Node { speed, c: [[c, 0.0], [0.0, c]], ..Node::default() };
    let table = vec![node(0.0, 10.0), node(10.0, 30.0), node(25.0, 35.0), node(40.0, 5.0)];
    let points: Vec<_> = table.iter().map(|node| (node.speed, node.c[0][0])).collect();
    let machine = Machine {
        bearings: vec![Bearing { table, ..Bearing::default() }],
        imposed_speed: true,
        inputs: vec![(Input::Speed, -50.0), (Input::Acceleration, 100.0)],
        start: Start { v_c: Vector3::y(), ..Start::default() },
        ..rotor()
    };
    let ends = [-50.0, -40.0, -25.0, -10.0, 0.0, 10.0, 25.0, 40.0, 50.0];
    let damped = |w: f64| curve(&points, w.abs());
    let whole = ends.windows(2).map(|of| oracles::numerics::integral(damped, of[0], of[1], 1)).sum::<f64>();
    for (_, now) in shown(&machine, 1.0, 1) {
        within("speed", (now.v_c.y / libm::exp(-whole / 100.0 / 5.0) - 1.0).abs(), 1e-11);
    }
}
