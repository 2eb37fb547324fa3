//! A rotor whose speed is imposed, against Jeffcott's closed form and against bodies of rotor and point masses.

use crate::harness::named::Named;
use crate::harness::uneven::{Case, at};
use crate::harness::within;
use crate::oracles::uneven::Moving;
use nalgebra::{Vector2, Vector3};
use std::f64::consts::PI;

const EXACTLY: &str = "method = \"dop853\"\nrelative_tolerance = 1e-12";

/// Radius and phase of the whirl, and the torque, relative [1]; the ledger [J]: measured 2.6e-12, 1.1e-12, 1.0e-11, 8.2e-13.
const JEFFCOTT: f64 = 3e-11;

/// Jeffcott (1919): with ε the distance of the mass centre from the axis, |r| = εω²/√((ω_n² − ω²)² + (2ζω_nω)²), behind the
/// unbalance by atan2(2ζω_nω, ω_n² − ω²). The torque makes up for what is lost, τω = d₁|r|²ω².
#[test]
fn exact_response_to_unbalance_below_at_and_above_the_critical_speed() {
    for speed in [12.0, 19.5, 20.0, 20.5, 45.0] {
        let mut named = Named::new("jeffcott", model::simulation::Integrator::Method);
        named.set("imposed_speed.w", speed);
        named.set("support.d1", 20.0);
        named.set("solver.relative_tolerance", 1e-13);
        named.start();
        // What is left of the start: e^(−2·16).
        let end = 16.0;
        let reading = at(&mut named, end);
        let motion = &reading.motion;
        let (natural, damping, eccentricity) = (20.0, 20.0 / (2.0 * 20.0 * 5.0), 0.1 * 0.1 / 5.0);
        let (below, lost) = (natural * natural - speed * speed, 2.0 * damping * natural * speed);
        let radius = eccentricity * speed * speed / libm::hypot(below, lost);
        let r = motion.r_c();
        within(&format!("{speed}: radius"), (libm::hypot(r.y, r.z) / radius - 1.0).abs(), JEFFCOTT);
        let unbalance = motion.at.r - r;
        let behind = libm::atan2(r.z * unbalance.y - r.y * unbalance.z, r.y * unbalance.y + r.z * unbalance.z);
        within("phase", (behind + libm::atan2(lost, below)).abs(), JEFFCOTT);
        let torque = 20.0 * radius * radius * speed;
        within("torque", (named.get("imposed_speed.tau") / torque - 1.0).abs(), JEFFCOTT);
        within("speed", (motion.axial_rate() - speed).abs() / speed, JEFFCOTT);
        within("angle", (motion.phi() - speed * end).abs(), JEFFCOTT);
        within("ledger", reading.ledger.residual().abs(), JEFFCOTT);
    }
}

/// A held rotor with masses on it that is run up by an imposed speed.
fn driven(w: f64, a: f64, solver: &str) -> (Case, Moving, Named) {
    let mut case = Case { omega: Vector3::new(3.0, 0.5, -0.4), ..Case::held() };
    let mut named = Named::written(&format!("{}[effects.imposed_speed]\nw = {w:?}\na = {a:?}\n", case.text(solver)));
    named.start();
    let axis = crate::oracles::rotation::axis(&case.gamma);
    case.omega += axis * (w - case.omega.dot(&crate::oracles::rigid_body::joint(&axis)));
    let start = case.start();
    (case, start, named)
}

/// r_c [m], φ [rad], axis [1], torque [N·m], and work [J]: measured 1.4e-14, 1.4e-13, 3.0e-13,
/// 1.3e-10, 1.2e-10, all with `stiff`.
const DRIVEN: [f64; 5] = [5e-14, 5e-13, 1e-12, 5e-10, 1e-9];

fn compare(case: &Case, exact: &Moving, named: &mut Named, t: f64) {
    let reading = at(named, t);
    let motion = &reading.motion;
    let torque = named.get("imposed_speed.tau");
    within("r_c", (motion.r_c() - exact.r).norm(), DRIVEN[0]);
    within("phi", (motion.phi() - exact.phi).abs(), DRIVEN[1]);
    within("axis", (motion.axis() - exact.axis()).norm(), DRIVEN[2]);
    within("torque", (torque - case.body.torque(t, exact)).abs(), DRIVEN[3]);
    within("work", (reading.ledger.supplied - exact.work[0]).abs(), DRIVEN[4]);
    within("ledger", reading.ledger.residual().abs(), DRIVEN[4]);
}

#[test]
fn exact_run_up_of_an_uneven_rotor_by_each_method() {
    for solver in
        [EXACTLY, "method = \"dopri5\"\nrelative_tolerance = 1e-12", "method = \"stiff\"\nrelative_tolerance = 1e-12"]
    {
        let (mut case, start, mut named) = driven(30.0, 20.0, solver);
        case.body.imposed = Some(|_| 20.0);
        let exact = case.body.run(0.0, &start, 1.0, 800);
        println!("{solver}");
        compare(&case, &exact, &mut named, 1.0);
    }
}

#[test]
fn exact_jumps_of_the_speed() {
    let (mut case, mut exact, mut named) = driven(30.0, 0.0, EXACTLY);
    case.body.imposed = Some(|_| 0.0);
    let mut jumped = 0.0;
    for (i, w) in [(1, 33.0), (2, 25.0), (3, 25.0)] {
        let t = 0.1 * f64::from(i);
        exact = case.body.run(t - 0.1, &exact, t, 100);
        exact.work[0] += std::mem::take(&mut jumped);
        compare(&case, &exact, &mut named, t);
        named.set("imposed_speed.w", w);
        let energy = case.body.energy(&exact);
        exact = case.body.jumped(&exact, w);
        jumped = case.body.energy(&exact) - energy;
    }
}

#[test]
fn exact_what_does_not_go_together_is_named() {
    let text = |effects: &str, solver: &str| format!("{}{effects}", Case::held().text(solver));
    let refusal = |effects: &str, solver: &str| {
        let path = std::path::Path::new("test.toml");
        model::scene::Scene::parse(path, &text(effects, solver)).expect_err("not possible").to_string()
    };
    let both = refusal("[effects.shaft]\n[effects.imposed_speed]\n", EXACTLY);
    let message = ": effects.shaft and effects.imposed_speed exclude each other: only one of them can act";
    assert!(both.starts_with("test.toml, line ") && both.ends_with(message), "{both}");
    // The method by its word, as the file has it.
    let symplectic = refusal("[effects.imposed_speed]\n", "method = \"symplectic\"");
    let message = ": solver.method = symplectic is not possible: it must be another method: drifts and kicks do not keep \
                   an imposed speed";
    assert!(symplectic.starts_with("test.toml, line ") && symplectic.ends_with(message), "{symplectic}");
}

/// A constraint that was imposed for long holds still [1].
const HELD: f64 = 1e-13;

#[test]
fn exact_speed_is_kept_to_rounding() {
    let case = Case { gamma: Vector2::new(0.4, -0.2), ..Case::held() };
    let mut named = Named::written(&format!("{}[effects.imposed_speed]\nw = 50.0\n", case.text(EXACTLY)));
    named.start();
    let reading = at(&mut named, 2.0 * PI);
    within("speed", (reading.motion.axial_rate() / 50.0 - 1.0).abs(), HELD);
    within("angle", (reading.motion.phi() - case.phi - 100.0 * PI).abs() / (100.0 * PI), HELD);
}

/// The ledger where a speed jumped at an event of a host, in units of the jump [1]: rounding.
const BOOKED: f64 = 1e-13;

#[test]
fn exact_jump_at_an_event_is_supplied() {
    let mut named = Named::new("jeffcott", model::simulation::Integrator::Host);
    named.start();
    for w in [25.0, -3.0] {
        let (before, supplied) = (named.get("energy.kinetic"), named.get("energy.supplied"));
        named.simulation.open().expect("for a host").enter_event();
        named.set("imposed_speed.w", w);
        let settled = named.simulation.open().expect("for a host").settle();
        assert!(settled.work && !settled.chart, "{settled:?}");
        let open = named.simulation.open().expect("for a host");
        assert!(!open.settle().any(), "once");
        open.leave_event();
        let jump = named.get("energy.kinetic") - before;
        assert!(jump.abs() > 1.0, "nothing jumped");
        within("supplied", ((named.get("energy.supplied") - supplied) / jump - 1.0).abs(), BOOKED);
        within("ledger", (named.get("energy.residual") / jump).abs(), BOOKED);
    }
}
