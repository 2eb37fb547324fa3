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
    named.simulation.advance(t).expect("a possible motion");
    show(case, exact, named, t, &DRIVEN);
}

fn show(case: &Case, exact: &Moving, named: &mut Named, t: f64, bounds: &[f64; 5]) {
    let reading = *named.simulation.read().expect("possible parameters");
    let motion = &reading.motion;
    let torque = named.get("imposed_speed.tau");
    within("r_c", (motion.r_c() - exact.r).norm(), bounds[0]);
    within("phi", (motion.phi() - exact.phi).abs(), bounds[1]);
    within("axis", (motion.axis() - exact.axis()).norm(), bounds[2]);
    within("torque", (torque - case.body.torque(t, exact)).abs(), bounds[3]);
    within("work", (reading.ledger.supplied - exact.work[0]).abs(), bounds[4]);
    within("ledger", reading.ledger.residual().abs(), bounds[4]);
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

/// The same after 1.5 s: measured 3.5e-14, 1.3e-13, 1.2e-12, 3.8e-10, 6.4e-11, all with `stiff`.
const FOLLOWED: [f64; 5] = [1e-13, 5e-13, 3e-12, 1e-9, 1e-9];

/// ω_φ relative to what it was told [1]: measured 2.3e-16, rounding.
const TOLD: f64 = 1e-15;

/// What is sent at a communication point: an input, the order of its derivative, and its value.
type Sent = (&'static str, u32, f64);

/// From a time [s] on: what is sent there, the speed there [rad/s], its rate over time [rad/s²], and the speed at the end of the
/// piece, by hand.
type Piece = (f64, &'static [Sent], f64, fn(f64) -> f64, f64);

/// Runs the pieces, each for half a second, and compares at the end of each.
fn follow(pieces: &[Piece], [w, a]: [f64; 2]) {
    for solver in [EXACTLY, "method = \"stiff\"\nrelative_tolerance = 1e-12"] {
        println!("{solver}");
        let (mut case, mut exact, mut named) = driven(w, a, solver);
        let mut jumped = 0.0;
        for (t, sent, speed, rate, end) in pieces {
            let energy = case.body.energy(&exact);
            exact = case.body.jumped(&exact, *speed);
            exact.work[0] += case.body.energy(&exact) - energy;
            jumped += (case.body.energy(&exact) - energy).abs();
            for (name, order, value) in *sent {
                let place = named.place(name);
                match order {
                    0 => named.simulation.set_input(place, *value),
                    order => named.simulation.set_input_derivative(place, *order, *value),
                };
            }
            case.body.imposed = Some(*rate);
            exact = case.body.run(*t, &exact, t + 0.5, 400);
            named.simulation.advance(t + 0.5).expect("a possible motion");
            show(&case, &exact, &mut named, t + 0.5, &FOLLOWED);
            within("speed", (named.get("omega_phi") / end - 1.0).abs(), TOLD);
        }
        assert!(jumped > 1.0, "nothing jumped");
    }
}

#[test]
fn exact_run_up_by_derivatives_of_the_rate() {
    let pieces: &[Piece] = &[
        // 30 + ∫(20 − 30 t + 40 t²) dt
        (
            0.0,
            &[("imposed_speed.a", 1, -30.0), ("imposed_speed.a", 2, 80.0)],
            30.0,
            |t| 20.0 - 30.0 * t + 40.0 * t * t,
            30.0 + 10.0 - 3.75 + 5.0 / 3.0,
        ),
        // The rate goes on as it was sent: 33 + 10 − 30·(1 − ¼)/2 + 40·(1 − ⅛)/3.
        (
            0.5,
            &[("imposed_speed.w", 0, 33.0)],
            33.0,
            |t| 20.0 - 30.0 * t + 40.0 * t * t,
            33.0 + 10.0 - 11.25 + 35.0 / 3.0,
        ),
        // A rate that is set anew counts from the w that was set last.
        (1.0, &[("imposed_speed.a", 0, 8.0)], 33.0, |_| 8.0, 37.0),
    ];
    follow(pieces, [30.0, 20.0]);
}

#[test]
fn exact_run_up_by_derivatives_of_the_speed() {
    let pieces: &[Piece] = &[
        // 30 − 20 t + 25 t²: what a says does not count.
        (
            0.0,
            &[("imposed_speed.w", 1, -20.0), ("imposed_speed.w", 2, 50.0)],
            30.0,
            |t| -20.0 + 50.0 * t,
            30.0 - 10.0 + 6.25,
        ),
        // A derivative sent alone goes on from the value there.
        (0.5, &[("imposed_speed.w", 1, 10.0), ("imposed_speed.a", 0, 50.0)], 26.25, |_| 10.0, 31.25),
        // A value alone: a counts again, from there on.
        (1.0, &[("imposed_speed.w", 0, 25.0)], 25.0, |_| 50.0, 50.0),
    ];
    follow(pieces, [30.0, 7.0]);
}

/// In model exchange a host has no derivatives to send, but sets both inputs whenever it likes.
#[test]
fn exact_run_up_by_a_host_that_sets_both_inputs_at_every_time() {
    fn rate(t: f64) -> f64 {
        20.0 - 30.0 * t + 40.0 * t * t
    }
    let mut case = Case { omega: Vector3::new(3.0, 0.5, -0.4), ..Case::held() };
    let text = format!("{}[effects.imposed_speed]\nw = 30.0\na = 20.0\n", case.text(EXACTLY));
    let mut named = Named::written_for(&text, model::simulation::Integrator::Host);
    named.start();
    let axis = crate::oracles::rotation::axis(&case.gamma);
    case.omega += axis * (30.0 - case.omega.dot(&crate::oracles::rigid_body::joint(&axis)));
    case.body.imposed = Some(rate);
    let exact = case.body.run(0.0, &case.start(), 1.0, 800);
    named.simulation.open().expect("for a host").leave_event();
    let tell = |named: &mut Named, t: f64, state: &[f64]| {
        let open = named.simulation.open().expect("for a host");
        open.set_time(t);
        open.set_state(state);
        named.set("imposed_speed.w", 30.0 + t * (20.0 + t * (-15.0 + t * 40.0 / 3.0)));
        named.set("imposed_speed.a", rate(t));
    };
    let state = named.simulation.state().expect("a state");
    let end = {
        let named = std::cell::RefCell::new(&mut named);
        let rates = |t: f64, y: &model::state::Whole<f64>| {
            let named = &mut *named.borrow_mut();
            tell(named, t, y);
            named.simulation.rates().expect("possible parameters")
        };
        crate::oracles::extrapolation::steps(rates, 0.0, &state, 1.0, 800)
    };
    tell(&mut named, 1.0, &end);
    show(&case, &exact, &mut named, 1.0, &DRIVEN);
}

#[test]
fn exact_what_is_read_follows_inputs_at_once() {
    const SHOWN: [&str; 7] = [
        "omega_phi",
        "omega.y",
        "K_c.x",
        "imposed_speed.tau",
        "energy.kinetic",
        "energy.supplied",
        "der(state.supplied)",
    ];
    for method in [3.0, 5.0] {
        let [mut curious, mut other] = [(); 2].map(|()| {
            let mut named = Named::new("jeffcott", model::simulation::Integrator::Method);
            named.set("solver.method", method);
            named.start();
            at(&mut named, 1.0);
            named
        });
        let [kinetic, supplied] = ["energy.kinetic", "energy.supplied"].map(|name| curious.get(name));
        for (name, value) in [("imposed_speed.w", 35.0), ("imposed_speed.a", 4.0)] {
            curious.set(name, value);
            within("speed", (curious.get("omega_phi") / 35.0 - 1.0).abs(), TOLD);
            other.set(name, value);
        }
        let jump = curious.get("energy.kinetic") - kinetic;
        assert!(jump > 1.0, "nothing jumped");
        within("supplied", ((curious.get("energy.supplied") - supplied) / jump - 1.0).abs(), BOOKED);
        // The run itself shows the same when it heard, and does not notice who reads.
        let before = SHOWN.map(|name| curious.get(name));
        for t in [1.0, 1.3] {
            let [read, unread] = [&mut curious, &mut other].map(|named| {
                at(named, t);
                SHOWN.map(|name| named.get(name))
            });
            assert_eq!(read, unread);
            assert_eq!(read == before, t == 1.0);
        }
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
