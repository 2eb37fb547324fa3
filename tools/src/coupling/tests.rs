//! Partners beside the effects whose laws they have, limits beside closed forms and the FMU's own, and what cannot be coupled.

use super::pair::place;
use super::partner::Shown;
use super::*;
use split_rotor_model::simulation::General;
use split_rotor_model::variables::Parameters;
use std::path::Path;

const BODY: &str = "[rotor]\nm = 12.0\nJa = 0.04\nJt = 0.12\nl = 0.0\n";
const GRAVITY: &str = "[effects.gravity]\n";

fn scene(text: &str) -> Scene {
    Scene::parse(Path::new("coupled.toml"), text).unwrap_or_else(|error| panic!("{error}"))
}

fn found(scene: &Scene, speed: f64, step: f64) -> Found<'_> {
    Found::of(scene, Some(speed), Some(vec![step]), |_, _| ()).unwrap_or_else(|error| panic!("{error:#}"))
}

fn refused(text: &str, steps: Option<Vec<f64>>) -> String {
    let scene = scene(text);
    format!("{:#}", Found::of(&scene, Some(100.0), steps, |_, _| ()).err().expect("an error"))
}

/// Loads of the effect `name` and of its partner, while the machine moves, relative to the largest load: the largest difference.
fn differ(scene: &Scene, speed: f64, loads: [&str; 2]) -> f64 {
    let pair = Pair::of(scene, speed).expect("a pair");
    let mut simulation = General::from(pair.whole.clone());
    simulation.start(0.0, None).expect("a start");
    let (mut most, mut off) = (0.0_f64, 0.0_f64);
    for n in 0..50 {
        simulation.advance(f64::from(n) * 1e-3).expect("a motion");
        for (partner, port) in pair.partners.iter().zip(&pair.ports) {
            let mut at = |place| simulation.get(place).expect("possible").expect("a variable");
            let mut of_port = |name: &str| at(place("port", *port, name));
            let [r, v, omega] = ["r", "v", "omega"].map(|name| {
                let parts = ["x", "y", "z"].map(|axis| of_port(&format!("{name}.{axis}")));
                parts.into()
            });
            let theta = ["theta.y", "theta.z"].map(&mut of_port).into();
            let answer = partner.answer(&Shown { r, v, theta, omega });
            for (name, answer) in loads.into_iter().zip(answer).filter(|(name, _)| !name.is_empty()) {
                for (axis, answer) in ["x", "y", "z"].into_iter().zip(answer.iter()) {
                    let named = format!("{}.{name}.{axis}", partner.name);
                    let load = at(Parameters::<split_rotor_model::effects::All>::place(&named).expect("a load"));
                    (most, off) = (most.max(load.abs()), off.max((load - answer).abs()));
                }
            }
        }
    }
    assert!(most > 0.0, "nothing moves");
    off / most
}

#[test]
fn exact_a_partner_answers_as_its_effect_does() {
    // Measured: 9.1e-14 at most.
    const BOUND: f64 = 5e-13;
    let cross = "[start]\nr_c = { x = 0.01, y = 1e-5 }\ngamma = { y = 0.02 }\n[[effects.bearing]]\nposition = -0.1\nkxx = 1e6\ncxx = 50.0\nkyy = 2e6\n\
                 kyz = 3e5\nkzy = -4e5\nkzz = 1e6\ncyy = 300.0\ncyz = 20.0\nczy = 50.0\nczz = 500.0\n[[effects.bearing]]\nposition = 0.2\nkyy = 1e6\nkzz = 1e6\n";
    for scene in [scene(&format!("{BODY}{GRAVITY}{cross}")), scenes::find("film_bearings")] {
        for speed in [300.0, -300.0] {
            let off = differ(&scene, speed, ["F", ""]);
            assert!(off <= BOUND, "bearings of {} at {speed} rad/s: {off:e}", scene.name);
        }
    }
    let support = "[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.75\n[start]\nr_c = { x = 0.75 }\ngamma = { y = 0.3 }\n[effects.gravity]\n\
                   [effects.support]\nc1 = 2000.0\nc2 = 500.0\nd1 = 3.0\nd2 = 2.0\n";
    let off = differ(&scene(support), 50.0, ["F", "M"]);
    assert!(off <= BOUND, "support: {off:e}");
}

/// The bearings of the README's rotor at its ports: limits as the FMU's own warning has them, and as runs have them by trial.
#[test]
fn exact_limits_of_the_turbo_rotor() {
    let scene = scenes::find("turbo");
    let found = found(&scene, 1500.0, 1e-4);
    // By the FMU; by trial 0.20, 0.43, 0.53 and 0.066, 0.205, 0.27 (docs/cosimulation.md).
    for (limits, known) in found.longest.iter().zip([[2.01e-4, 4.22e-4, 5.12e-4], [6.7e-5, 2.02e-4, 2.63e-4]]) {
        for (order, known) in known.into_iter().enumerate() {
            let limit = limits[order].expect("a limit");
            assert!((limit / known - 1.0).abs() < 0.01, "order {order}: {limit:e} s, known {known:e} s");
        }
    }
    let error = |scheme, n: usize| {
        let tried = found.series(scheme, &SETTINGS[n]).next().expect("a run");
        tried.outcome.error.expect("a run to the end")
    };
    // Held, fresh: 0.34 by trial in the model's tests.
    let held = error(Scheme::Fresh, 0);
    assert!((held - 0.34).abs() < 0.02, "{held}");
    // Measured: 3.1e-6, 1.1e-5; coefficients given 1.8e-11.
    assert!(error(Scheme::Fresh, 4) < 2e-5 && error(Scheme::Late, 4) < 5e-5);
    assert!(error(Scheme::Fresh, 5) < 1e-9 && error(Scheme::Late, 5) < 1e-9);
    // Measured: 1.7e-4, 1.4e-3; order 2 alone 4.2e-3, 2.5e-2.
    assert!(error(Scheme::Fresh, 3) < 0.2 * error(Scheme::Fresh, 2) && error(Scheme::Late, 3) < error(Scheme::Late, 2));
    // A late, held spring beyond its limit drives the machine, and the FMU warns.
    let late = found.series(Scheme::Late, &SETTINGS[0]).next().expect("a run");
    assert!(error(Scheme::Late, 0) > 1.0 && late.outcome.warned.is_some());
    assert_eq!(found.within(Scheme::Late, &SETTINGS[0], &Bound { name: "", most: 1e9, read: |one| one.error }), None);
    let text = found.table();
    assert!(text.contains("held 0.201 ms") && text.contains("`drive.k`") && text.contains("half the step"), "{text}");
    // What the recipe tells to write is a scene's.
    let (_, ports) = text.split_once("```toml\n").expect("lines of a scene");
    let (ports, _) = ports.split_once("```").expect("their end");
    let ports = self::scene(&format!("{BODY}{ports}"));
    let value = scenes::values(&ports);
    assert_eq!([value("port[1].kxx"), value("port[2].kyy"), value("port[2].cxx")], [Some(1e6), Some(2e7), Some(0.0)]);
}

/// Beside an imposed speed, or a drive whose spring is given, no step is done again: the others are tried.
#[test]
fn what_does_not_go_with_a_scene_is_left_out() {
    let bearing = "[start]\nr_c.y = 1e-5\n[[effects.bearing]]\nposition = 0.1\nkyy = 1e6\nkzz = 1e6\n";
    for (lines, count) in [("", 6), ("[effects.imposed_speed]\nw = 10.0\n", 5), ("[effects.drive]\nk = 1.0\n", 5)] {
        let scene = scene(&format!("{BODY}{bearing}{lines}"));
        let found = found(&scene, 10.0, 1e-4);
        let names = SETTINGS.iter().filter(|setting| found.series(Scheme::Late, setting).count() > 0);
        assert_eq!(names.count(), count, "{lines}");
        assert_eq!(found.table().contains("redo = true"), count == 6, "{lines}");
    }
}

/// A mass on a spring without damping gains energy at ω²H/2, and at 3ω²H/2 where the force is late: amplitudes by half of that a step.
#[test]
fn exact_limits_of_a_mass_on_a_spring() {
    let text = "[rotor]\nm = 10.0\nJa = 0.1\nJt = 0.1\n[start]\nr_c.y = 1e-3\n[[effects.bearing]]\nposition = 0.0\nkxx = 1e7\nkyy = 1e7\nkzz = 1e7\n";
    let scene = scene(text);
    let found = found(&scene, 100.0, 1e-5);
    for (limits, part) in found.longest.iter().zip([1.0, 3.0]) {
        // part (ω H)²/4 = ln(1 + 1e-4)
        let known = libm::sqrt(4.0 * 1e-4 / part) / 1e3;
        let limit = limits[0].expect("a limit");
        assert!((limit / known - 1.0).abs() < 0.01, "{limit:e} s, known {known:e} s");
    }
}

#[test]
fn what_cannot_be_coupled_is_told() {
    let bearing = "[[effects.bearing]]\nposition = 0.1\nkyy = 1e6\nkzz = 1e6\n";
    let none = refused(BODY, None);
    assert!(
        none.starts_with("coupled.toml: the scene has no bearing and no support") && none.contains("kyy"),
        "{none}"
    );
    let idle = refused(&format!("{BODY}[[effects.bearing]]\nposition = 0.1\n"), None);
    assert!(idle.contains("all coefficients of bearing[1] are 0"), "{idle}");
    let port = "[[effects.port]]\nposition = 0.0\n";
    let many = refused(&format!("{BODY}{}{}", bearing.repeat(2), port.repeat(3)), None);
    assert!(many.contains("2 bearings and 3 ports"), "{many}");
    let held = format!("{BODY}{}{}", bearing, bearing.replace("0.1", "-0.1"));
    let still = refused(&held, None);
    assert!(still.contains("does not change the loads of bearing[1] and bearing[2]"), "{still}");
    let moved = format!("{held}[start]\nr_c.y = 1e-5\n");
    let zero = refused(&moved, Some(vec![0.0, 1e-4]));
    assert!(zero.contains("--steps 0: a communication step must be more than 0 s"), "{zero}");
    let long = refused(&moved, Some(vec![1e-9, 1.0]));
    assert!(long.contains("are the most"), "{long}");
}

/// A ring and gravity leave the one no steady state, and the other nutates faster than its support swings by far: limits as measured.
#[test]
fn steps_suit_the_partners() {
    for (name, known) in [("rubbing", 4.06e-3), ("high_spin", 5.48e-4)] {
        let scene = scenes::find(name);
        let pair = Pair::of(&scene, usual(&scene)).expect("a pair");
        let limit = Linear::of(&pair).expect("linear equations").longest(Scheme::Late, 0).expect("a limit");
        assert!((limit / known - 1.0).abs() < 0.01, "{name}: {limit:e} s");
    }
    let longest = [[Some(1e-4), Some(0.0), None], [Some(5e-5), None, Some(3e-4)]];
    assert_eq!(ends(&longest, 1.0), [0.2 * 5e-5, 2.5 * 3e-4]);
    assert_eq!(ends(&[[None; ORDERS]; 2], 1.0), OF_PERIOD);
}

#[test]
fn steps_are_round_numbers() {
    assert_eq!(round([1e-5, 1.5e-4]), [1e-5, 1.5e-5, 2e-5, 3e-5, 5e-5, 7e-5, 1e-4, 1.5e-4]);
    assert_eq!(table::milliseconds(1.5e-4), "0.15");
}
