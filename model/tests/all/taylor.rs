//! `taylor`: its order, and where it leaves the motion to dop853. That it keeps its tolerance, whatever acts: random_scenes.

use crate::harness::named::Named;
use crate::harness::swinging::{dense_errors, driven, within_order};
use crate::harness::tolerance;
use nalgebra::Vector3;
use split_rotor_model::integrate::taylor::{Scratch, Taylor};
use split_rotor_model::simulation::Integrator;

/// A tolerance, the power of its last term, and steps whose errors tell it \[s].
const ORDERS: [(f64, f64, [f64; 4]); 2] =
    [(1e-2, 14.0, [0.008, 0.01, 0.0125, 0.015]), (1e-4, 22.0, [0.014, 0.016, 0.018, 0.02])];

/// From that power: measured below.
const OFF: f64 = 0.8;

#[test]
fn exact_what_is_left_out_begins_with_the_next_power() {
    let (rotor, y) = driven(20.0, 0.5);
    for (relative, order, sizes) in ORDERS {
        let errors = dense_errors(&rotor, &[(0.0, y)], &sizes, |t, y, h| {
            let (mut method, mut scratch) = (Taylor::start(tolerance(relative), &rotor, t, y), Scratch::default());
            method.limit_step(h);
            assert_eq!(method.step(&rotor, &mut scratch, f64::INFINITY, f64::INFINITY), Ok(true));
            let rotor = &rotor;
            move |t| method.dense(rotor, t)
        });
        println!("{errors:?}");
        within_order(&format!("at {relative:e}"), errors, order, OFF);
    }
}

/// A scene by `taylor`, after a tenth of its run.
fn on_its_way(name: &str) -> Named {
    let mut named = Named::new(name, Integrator::Method);
    named.set("solver.method", 6.0);
    named.set("solver.relative_tolerance", 1e-6);
    named.start();
    named.simulation.advance(0.1 * named.scene.experiment.stop).expect("a possible motion");
    named
}

#[test]
fn what_it_does_and_why() {
    const SERIES: &str = "taylor takes power series: ";
    const NONE: &str =
        "taylor takes dop853: the motion has no power series while the body is unbalanced or not symmetric";
    for (name, words) in
        [("paper", SERIES), ("tumbling", SERIES), ("driven", SERIES), ("jeffcott", NONE), ("dzhanibekov", NONE)]
    {
        let named = on_its_way(name);
        let said = named.simulation.auto().expect("it says what it does");
        println!("{name}: {said}");
        assert!(said.starts_with(words), "{name}: {said}");
        assert_eq!(named.simulation.changes_of_method(), 0, "{name}");
    }
}

#[test]
fn it_comes_back_to_power_series_after_a_contact() {
    let mut named = on_its_way("rubbing");
    assert!(named.simulation.changes_of_method() > 1, "{}", named.simulation.changes_of_method());
    let said = |ms: u32| {
        named.simulation.advance(0.1 + 1e-3 * f64::from(ms)).expect("a possible motion");
        named.simulation.auto().expect("it says what it does")
    };
    let said: Vec<_> = (1..=100).map(said).collect();
    for words in ["no power series while rub[1] presses", "goes on with power series"] {
        assert!(said.iter().any(|said| said.contains(words)), "{words}: {said:?}");
    }
}

/// Communication steps [s], in turn: an input is set in each, so that none is passed.
const STEPS: [f64; 5] = [1e-4, 1e-3, 0.05, 2e-3, 0.02];

/// What is shown at the end, and how many evaluations a step took.
fn in_short_steps(method: f64, tolerance: f64, steps: &[f64], count: u32) -> ([f64; 6], f64) {
    let mut named = Named::new("coupled", Integrator::Method);
    named.set("solver.method", method);
    named.set("solver.relative_tolerance", tolerance);
    named.set("start.omega.y", 1.0);
    named.start();
    let (force, moment) = (named.place("port[1].f.y"), named.place("port[2].m.x"));
    let mut t = 0.0;
    for n in 0..count {
        named.simulation.set_input(force, 20.0 * libm::sin(0.7 * f64::from(n)));
        named.simulation.set_input(moment, 0.5 * libm::cos(0.3 * f64::from(n)));
        t += steps[n as usize % steps.len()];
        named.simulation.advance(t).expect("a possible motion");
    }
    let shown = ["r_c.y", "r_c.z", "axis.y", "axis.z", "phi"].map(|name| named.get(name));
    let residual = named.get("energy.residual") / named.get("energy.kinetic");
    let shown = std::array::from_fn(|n| shown.get(n).copied().unwrap_or(residual));
    (shown, named.get("solver.evaluations") / f64::from(count))
}

#[test]
fn exact_a_short_step_takes_the_powers_that_it_needs() {
    const COUNT: u32 = 200;
    /// Of place [m], axis, φ [rad] and the ledger over the kinetic energy, at a tolerance of 1e-8: measured 4e-11 and 9e-10.
    const ERROR: f64 = 1e-8;
    let (exact, _) = in_short_steps(3.0, 1e-12, &STEPS, COUNT);
    let (shown, _) = in_short_steps(6.0, 1e-8, &STEPS, COUNT);
    println!("{:?}", std::array::from_fn::<_, 6, _>(|n| shown[n] - exact[n]));
    assert!(shown.iter().zip(&exact).all(|(a, b)| (a - b).abs() < ERROR), "{shown:?} is not {exact:?}");
    // 24 are a whole series and two rates.
    let (_, taken) = in_short_steps(6.0, 1e-8, &[1e-3], 1000);
    assert!(taken < 17.0, "{taken}");
}

/// The axis after 0.1 s of a rotor that wobbles at 3000 rad/s, far past the equator, while a joint passes on the torque of a drive.
fn wobbling(method: f64, tolerance: f64) -> Vector3<f64> {
    let mut named = Named::new("rotor", Integrator::Method);
    let settings = [
        ("effects.gravity", 0.0),
        ("effects.support", 0.0),
        ("effects.drive", 1.0),
        ("rotor.m", 10.0),
        ("rotor.Ja", 0.2),
        ("rotor.Jt", 0.3),
        ("rotor.l", 0.0),
        ("start.omega.x", 1865.0),
        ("start.omega.y", 2350.0),
        ("solver.method", method),
        ("solver.relative_tolerance", tolerance),
        ("drive.tau", 2.0),
    ];
    settings.iter().for_each(|(name, value)| named.set(name, *value));
    named.start();
    named.simulation.advance(0.1).expect("a possible motion");
    Vector3::from(["axis.x", "axis.y", "axis.z"].map(|name| named.get(name)))
}

#[test]
fn regress_what_is_below_the_tolerance_has_a_series_of_its_own() {
    let exact = wobbling(3.0, 1e-12);
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let off = (wobbling(6.0, tolerance) - exact).norm();
        println!("{tolerance:e}: {off:e}");
        // By eq. 107 alone 5.9e-4 and 1.1e-3 at the first two.
        assert!(off < tolerance, "{tolerance:e}: {off:e}");
    }
}

/// The axis 1 µs after a small tilt in two bearings of 1e10 N/m that damp by `c` \[N·s/m].
fn damped_hard(c: f64, method: f64, tolerance: f64) -> Vector3<f64> {
    let mut named = Named::new("rotor", Integrator::Method);
    let mut settings = vec![
        ("effects.support".to_owned(), 0.0),
        ("rotor.m".to_owned(), 1.0),
        ("rotor.Ja".to_owned(), 0.004),
        ("rotor.Jt".to_owned(), 0.01),
        ("rotor.l".to_owned(), 0.0),
        ("start.omega.x".to_owned(), 0.0),
        ("start.r_c.x".to_owned(), 0.0),
        ("start.gamma.y".to_owned(), 1e-4),
        ("solver.method".to_owned(), method),
        ("solver.relative_tolerance".to_owned(), tolerance),
    ];
    for (number, position) in [(1, -0.1), (2, 0.1)] {
        settings.push((format!("effects.bearing[{number}]"), 1.0));
        let of = [("position", position), ("kyy", 1e10), ("kzz", 1e10), ("cyy", c), ("czz", c)];
        settings.extend(of.map(|(name, value)| (format!("bearing[{number}].{name}"), value)));
    }
    settings.iter().for_each(|(name, value)| named.set(name, *value));
    named.start();
    named.simulation.advance(1e-6).unwrap_or_else(|fault| panic!("{c:e} N·s/m by {method} at {tolerance:e}: {fault}"));
    Vector3::from(["axis.x", "axis.y", "axis.z"].map(|name| named.get(name)))
}

#[test]
fn regress_what_dies_out_too_fast_for_a_series_is_left_to_others() {
    for c in [1e6, 3e6, 1e7, 3e7, 1e8] {
        let exact = damped_hard(c, 3.0, 1e-12);
        for method in [1.0, 6.0] {
            for tolerance in [1e-4, 1e-8, 1e-9, 1e-10] {
                let off = (damped_hard(c, method, tolerance) - exact).norm() / 1e-4;
                // Refused at once where squares of coefficients overflowed: 1e7 N·s/m at 1e-9.
                assert!(off < 300.0 * tolerance, "{c:e} N·s/m by {method} at {tolerance:e}: {off:e}");
            }
        }
    }
}

#[test]
fn exact_at_the_last_digits_the_energy_stays() {
    /// Of the kinetic energy: measured 1.4e-16.
    const DRIFT: f64 = 1e-14;
    let mut named = Named::new("paper", Integrator::Method);
    named.set("solver.method", 6.0);
    named.set("solver.relative_tolerance", 1e-14);
    named.start();
    for second in 1..=10 {
        named.simulation.advance(f64::from(second)).expect("a possible motion");
        let drift = named.get("energy.residual") / named.get("energy.kinetic");
        println!("{second} s: {drift:e}");
        assert!(drift.abs() < DRIFT, "{second} s: {drift:e}");
    }
}
