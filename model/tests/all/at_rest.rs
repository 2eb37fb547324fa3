//! A start at rest: where loads balance, in closed form, and that nothing moves from there but what is meant to.

use crate::harness::named::Named;
use crate::harness::{at, within};
use split_rotor_model::scene::Scene;
use split_rotor_model::simulation::Integrator;
use std::path::Path;

/// A rotor that two unlike bearings hold [N/m] against its weight, the first one along its axis too.
const ROTOR: &str = "[rotor]\nm = 12.0\nJa = 0.05\nJt = 0.4\n[effects.gravity]\ng = { z = -9.81 }\n\
    [[effects.bearing]]\nposition = -0.2\nkyy = 2e4\nkzz = 1e4\ncyy = 50.0\nczz = 50.0\nkxx = 1e5\ncxx = 100.0\n\
    [[effects.bearing]]\nposition = 0.3\nkyy = 2e4\nkzz = 1.7e4\ncyy = 50.0\nczz = 50.0\n";

fn start(rest: &str) -> String {
    format!("{ROTOR}[start]\nat_rest = true\n{rest}\n")
}

/// z of c \[m] and t_z \[1] there: both equations are linear in them, however large the tilt.
fn sag() -> [f64; 2] {
    let (springs, weight) = ([(-0.2, 1e4), (0.3, 1.7e4)], 12.0 * 9.81);
    let sum = |of: fn(f64, f64) -> f64| springs.iter().map(|(p, k)| of(*p, *k)).sum::<f64>();
    // Σ k (z + p t_z) = −m g, Σ p k (z + p t_z) = 0
    let [k, kp, kpp] = [sum(|_, k| k), sum(|p, k| p * k), sum(|p, k| p * p * k)];
    let determinant = k * kpp - kp * kp;
    [-weight * kpp / determinant, weight * kp / determinant]
}

#[test]
fn exact_it_starts_where_two_bearings_carry_its_weight() {
    let [z, t_z] = sag();
    for (spin, phi) in [(0.0, 0.0), (300.0, 1.0), (-1e4, 0.0)] {
        let mut rotor = Named::started(&start(&format!("omega.x = {spin:?}\nphi = {phi:?}")));
        for t in [0.0, 3.0] {
            at(&mut rotor.simulation, t);
            within("z", (rotor.get("r_c.z") - z).abs(), 1e-15);
            within("t_z", (rotor.get("axis.z") - t_z).abs(), 1e-15);
            within("y", rotor.get("r_c.y").abs(), 1e-15);
            // The axial spring is as long as at the start that was given: x = p (1 − t_x).
            let along = rotor.get("r_c.x") + 0.2 * (1.0 - rotor.get("axis.x"));
            within("x", along.abs(), 1e-15);
            within(
                "the spin",
                (rotor.get("omega_phi") / spin - 1.0).abs().min((rotor.get("omega_phi") - spin).abs()),
                1e-14,
            );
            let [steps, turned] = [rotor.get("solver.steps"), rotor.get("phi") - phi - spin * t];
            within("φ", turned.abs() / (1.0 + (spin * t).abs()), 1e-14);
            // Stability holds them at the nutation of the fastest spin.
            assert!(steps < 1000.0, "{steps} steps for a motion that rests");
        }
    }
}

#[test]
fn exact_only_the_unbalance_moves_it() {
    let unbalance = "[[effects.unbalance]]\nmass = 1e-3\nradius = 0.02\nposition = 0.05\n";
    let mut rotor = Named::started(&format!("{}{unbalance}", start("omega.x = 50.0")));
    // The mass on the axis, beside the rotor's own, pulls the rotor down by less than a µm more.
    within("z", (rotor.get("r_c.z") - sag()[0]).abs(), 1e-6);
    let mut farthest: f64 = 0.0;
    for n in 1..=200 {
        at(&mut rotor.simulation, f64::from(n) * 1e-2);
        farthest = farthest.max(rotor.get("r_c.y").abs());
    }
    // A whirl of the order of m_u r/m = 1.7 µm, beside a sag of millimetres.
    assert!((1e-7..1e-5).contains(&farthest), "{farthest:e} m");
}

#[test]
fn it_rests_on_a_ring_where_the_bearings_give_way_so_far() {
    let ring = "[[effects.rub]]\nposition = 0.0\ngap = 1e-3\nstiffness = 1e5\nradius = 0.05\nv0 = 0.01\n";
    let mut rotor = Named::started(&format!("{}{ring}", start("")));
    let z = rotor.get("r_c.z");
    assert!(z < -1e-3 && z > sag()[0], "{z:e} m");
    assert_eq!(rotor.get("rub[1].contact"), 1.0);
    at(&mut rotor.simulation, 1.0);
    within("it stays", (rotor.get("r_c.z") - z).abs(), 1e-15);
}

#[test]
fn it_rests_under_an_imposed_speed_and_for_a_host_that_integrates() {
    let imposed = "[effects.imposed_speed]\nw = 200.0\n";
    let mut rotor = Named::started(&format!("{}{imposed}", start("")));
    within("z", (rotor.get("r_c.z") - sag()[0]).abs(), 1e-15);
    within("the spin", (rotor.get("omega_phi") / 200.0 - 1.0).abs(), 1e-15);
    let mut hosted = Named::written_for(&start("omega.x = 30.0"), Integrator::Host);
    hosted.start();
    for rate in ["der(state.v.z)", "der(state.gamma.y)", "der(state.gamma.z)", "der(state.K.y)"] {
        within(rate, hosted.get(rate).abs(), 1e-12);
    }
}

/// Rings far from the axis, reached on the way: what stands without them lies far off.
#[test]
fn exact_it_comes_to_rest_on_a_ring_and_not_beyond() {
    for (k, stiffness, gap, place, tilt) in [
        (1e3, 1e5, 1e-4, 0.2, -0.20147),
        (1e3, 1e5, 1e-4, 0.05, -0.19409),
        (1e3, 1e5, 5e-4, 0.1, -0.23812),
        (1e3, 1e6, 1e-4, 0.1, -0.24282),
        (5e3, 1e7, 1e-4, 0.1, -0.04774),
        (5e3, 1e7, 5e-4, 0.2, -0.03843),
    ] {
        let held = format!("kyy = {k:?}, kzz = {k:?}, cyy = 300.0, czz = 300.0");
        let mut rotor = Named::started(&format!(
            "rotor = {{ m = 12.0, Ja = 0.04, Jt = 0.12 }}\nstart = {{ at_rest = true, omega.x = 100.0 }}\n[effects]\n\
             gravity = {{}}\nbearing = [{{ position = -0.12, {held} }}, {{ position = 0.08, {held} }}]\n\
             rub = [{{ position = {place:?}, gap = {gap:?}, stiffness = {stiffness:e}, radius = 0.0, v0 = 0.01 }}]"
        ));
        within("tilt", (rotor.get("gamma.y") - tilt).abs(), 6e-6);
        let [z, y] = ["r_c.z", "gamma.y"].map(|name| rotor.get(name));
        at(&mut rotor.simulation, 1.0);
        within("it stays", (rotor.get("r_c.z") - z).abs() + (rotor.get("gamma.y") - y).abs(), 1e-12);
    }
}

/// What drives a tilted rotor presses it sideways, and does so from the start.
#[test]
fn it_rests_under_what_drives_it() {
    let tilts = "[effects.support]\nc1 = 2000.0\nc2 = 500.0\n";
    let rotor = "[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.75\n[effects.gravity]\n[start]\nat_rest = true\nr_c.x = 0.75\n";
    for drive in [
        "omega.x = 50.0\n[effects.drive]\ntau = 20.0\n",
        "omega.x = 50.0\n[effects.motor]\nstall_torque = 20.0\nsynchronous_speed = 1e9\ntime_constant = 1e6\ncommand = 1.0\n",
        "[effects.imposed_speed]\nw = 50.0\na = 128.0\n",
    ] {
        let mut rotor = Named::started(&format!("{rotor}{drive}{tilts}"));
        let before = rotor.vector("axis");
        at(&mut rotor.simulation, 1e-3);
        within(drive, (rotor.vector("axis") - before).norm(), 1e-9);
    }
}

#[test]
fn regress_a_load_that_grows_is_that_of_the_start() {
    let mut rotor = Named::written(&format!("{}[[effects.port]]\nposition = 0.1\n", start("")));
    let force = rotor.place("port[1].f.y");
    rotor.simulation.set_input(force, 5.0);
    rotor.simulation.set_input_derivative(force, 1, 1e3);
    rotor.simulation.start(3.0, None).expect("it is held");
    for rate in ["der(state.v.y)", "der(state.K.z)"] {
        within(rate, rotor.get(rate).abs(), 1e-12);
    }
}

#[test]
fn what_cannot_rest_is_told() {
    let refused = |text: &str| {
        let mut rotor = Named::written(text);
        rotor.simulation.start(0.0, None).expect_err("it cannot").to_string()
    };
    let falls = "[rotor]\nm = 1.0\nJa = 0.1\nJt = 0.1\n[effects.gravity]\ng = { z = -9.81 }\n[start]\nat_rest = true\n";
    assert_eq!(
        refused(falls),
        "start.at_rest = true: no place where loads balance at 0.000 rad/s was found from start.r_c and start.gamma, a force of \
         -9.810 N along z remains: a support or bearings must hold the rotor where a load acts; give it a start nearer to its rest"
    );
    let moving = Scene::parse(Path::new("moving.toml"), &start("v_c.y = 1.0")).expect_err("it moves").to_string();
    assert!(moving.contains("start.v_c, start.omega.y and start.omega.z must be 0"), "{moving}");
}

/// An upright top on a stiff pivot, l above it, with a spring against tilt of this part of its weight's moment; m g l = 0.1962 N·m.
fn top(part: f64, spin: f64) -> String {
    let spring = part * 0.5 * 9.81 * 0.04;
    format!(
        "[rotor]\nm = 0.5\nJa = 2.5e-4\nJt = 2.0e-4\nl = 0.04\n[start]\nat_rest = true\nomega.x = {spin:?}\nr_c.x = 0.04\ngamma.z = 1e-4\n\
         [effects.gravity]\ng = {{ x = -9.81 }}\n[effects.support]\nc1 = 1e5\nc2 = {spring:?}\n"
    )
}

#[test]
fn exact_a_top_on_a_weak_spring_leans_where_its_loads_balance_and_it_is_stable() {
    for part in [0.5, 0.8, 0.95] {
        let mut leaning = Named::started(&top(part, 0.0));
        let tilt = libm::hypot(leaning.get("gamma.y"), leaning.get("gamma.z"));
        // c2 θ = m g l sin θ, θ ≠ 0
        let exact = oracles::numerics::root(|angle| part * angle - libm::sin(angle), 0.1, 3.0);
        within("tilt", (tilt / exact - 1.0).abs(), 1e-9);
        assert_eq!(leaning.simulation.growth(), None);
    }
    // A spring that is strong enough, or a spin that is fast enough, holds it upright.
    for (part, spin) in [(1.2, 0.0), (0.5, 400.0)] {
        let mut upright = Named::started(&top(part, spin));
        within("upright", libm::hypot(upright.get("gamma.y"), upright.get("gamma.z")), 1e-9);
    }
}

/// From many a tilt, which bends the stiff pivot far at first. From some of these the way there was longer than the steps that it had.
#[test]
fn regress_exact_a_top_leans_there_from_any_tilt_of_its_start() {
    let exact = |part: f64| oracles::numerics::root(|angle| part * angle - libm::sin(angle), 0.1, 3.0);
    let from = |part: f64, tilt: &str| top(part, 5.0).replace("gamma.z = 1e-4", tilt);
    for part in [0.1, 0.25, 0.51, 0.76, 0.97] {
        for tilt in ["gamma.z = 0.01", "gamma.y = 0.3", "gamma.z = 1.0", "gamma.y = -2.5"] {
            let mut leaning = Named::started(&from(part, tilt));
            let axis = ["axis.y", "axis.z"].map(|name| leaning.get(name));
            let found = libm::atan2(libm::hypot(axis[0], axis[1]), leaning.get("axis.x"));
            within("tilt", (found / exact(part) - 1.0).abs(), 1e-9);
        }
    }
}

#[test]
fn regress_at_rest_without_a_stable_place_is_the_balance_that_is_there() {
    let text = "[rotor]\nm = 6.0\nJa = 0.01\nJt = 0.06\n[start]\nat_rest = true\nomega.x = 100.0\nr_c.y = 20e-6\n\
        [[effects.bearing]]\nposition = 0.15\nkyy = -2e5\nkzz = -2e5\n";
    let mut rotor = Named::started(text);
    within("its place", (rotor.get("r_c.y") + 0.15 * rotor.get("axis.y")).abs(), 1e-12);
    assert!(rotor.simulation.growth().is_some(), "and its growth is reported");
}
