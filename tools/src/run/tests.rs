//! Runs with largest deflections in closed form, and runs that diverge or only seem to.

use super::{Run, outputs};
use split_rotor_model::scene::Scene;
use split_rotor_model::simulation::{Deflection, General};
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// What is left of the amplitudes below after the solver's own error, at a relative tolerance of 1e-9; measured 4e-10 \[1].
const CLOSE: f64 = 1e-8;

/// The rate of the whirl [rad/s], √(k/m).
const RATE: f64 = 200.0;

const METHODS: [&str; 6] = ["auto", "dopri5", "dop853", "symplectic", "stiff", "taylor"];

/// A rotor of 2 kg that a spring holds at c, sampled 2.2 times in each of so many periods.
fn whirl(method: &str, periods: f64, rest: &str) -> Scene {
    let (stop, step) = (periods * TAU / RATE, TAU / RATE / 2.2);
    parsed(&format!(
        "[rotor]\nm = 2.0\nJa = 0.02\nJt = 0.03\n[[effects.bearing]]\nposition = 0.0\nkyy = 8e4\nkzz = 8e4\nkt = 1e3\n\
         [[effects.probe]]\nposition = 0.3\n[solver]\nmethod = \"{method}\"\nrelative_tolerance = 1e-9\n\
         [experiment]\ntolerance = 1e-9\nstop = {stop:?}\nstep = {step:?}\n{rest}"
    ))
}

fn parsed(text: &str) -> Scene {
    Scene::parse(Path::new("whirl.toml"), text).unwrap_or_else(|error| panic!("{error}"))
}

/// A run to its end: the largest deflections of c and of the probe, the largest samples, and how many evaluations it took.
fn ran(scene: &Scene) -> ([Deflection; 2], [f64; 2], f64) {
    let mut run = Run::of(scene, outputs(scene).collect()).with_deflections();
    let names = [["r_c.y", "r_c.z"], ["probe[1].r.y", "probe[1].r.z"]];
    let column = |name| outputs(scene).position(|output| output.name == name).expect("an output");
    let (columns, mut samples) = (names.map(|names| names.map(column)), [0.0_f64; 2]);
    let outcome = run.follow(&scene.experiment, |run, _| {
        let values = run.values()?;
        for (sample, [y, z]) in samples.iter_mut().zip(columns) {
            *sample = sample.max(values[y].hypot(values[z]));
        }
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    let found: Vec<_> = run.largest().map(|(name, found)| (name.to_owned(), found)).collect();
    let [(c, of_c), (probe, of_probe)] = &found[..] else { panic!("{found:?}") };
    assert_eq!([&**c, &**probe], ["r_c", "probe[1]"]);
    ([*of_c, *of_probe], samples, run.simulation.read().expect("a run").cost.evaluations)
}

#[track_caller]
fn close(what: &str, found: f64, exact: f64) {
    assert!((found / exact - 1.0).abs() < CLOSE, "{what}: {found:e} is not {exact:e}");
}

#[test]
fn exact_the_largest_deflection_of_a_whirl_that_is_sampled_coarsely() {
    // y = a cos(s − 1), z = b sin(s − 1), s = RATE t: on the long axis after 1 rad, and then each half turn.
    let (a, b) = (20e-6, 4e-6);
    let (sine, cosine) = 1.0_f64.sin_cos();
    let start = format!(
        "[start]\nr_c = {{ y = {:e}, z = {:e} }}\nv_c = {{ y = {:e}, z = {:e} }}\n",
        a * cosine,
        -b * sine,
        a * RATE * sine,
        b * RATE * cosine
    );
    for method in METHODS {
        let ([c, probe], [sample, _], _) = ran(&whirl(method, 2.0, &start));
        close(method, c.largest, a);
        close(method, probe.largest, a);
        let turns = (c.at * RATE - 1.0) / PI;
        assert!((turns - turns.round()).abs() < 1e-4, "{method}: at {} s", c.at);
        assert!(sample < 0.99 * a, "{method}: the samples alone tell {sample:e}");
    }
}

#[test]
fn exact_static_deflection_is_part_of_the_largest_one() {
    // It falls from the middle: z = −s (1 − cos(RATE t)), lowest at half a period.
    let sag = 2.0 * 9.81 / 8e4;
    for method in METHODS {
        let ([c, _], [sample, _], _) = ran(&whirl(method, 2.8, "[effects.gravity]\n"));
        close(method, c.largest, 2.0 * sag);
        assert!(sample < c.largest, "{method}");
    }
}

#[test]
fn exact_the_largest_deflection_after_an_input_that_was_there_for_a_while() {
    // A force for a quarter of a period, from the middle of a solver's step to another: it leaves a whirl of √2 F/k about the middle.
    let (force, start) = (5.0, 0.3 * TAU / RATE);
    let end = start + 0.25 * TAU / RATE;
    let input = format!(
        "[[effects.port]]\nposition = 0.0\n[[input]]\nname = \"port[1].f.y\"\n\
         time = [0.0, {start:?}, {start:?}, {end:?}, {end:?}]\nvalue = [0.0, 0.0, {force:?}, {force:?}, 0.0]\n"
    );
    for method in METHODS {
        let ([c, _], _, _) = ran(&whirl(method, 2.7, &input));
        close(method, c.largest, 2.0_f64.sqrt() * force / 8e4);
    }
}

#[test]
fn exact_a_probe_far_from_c_moves_more() {
    // It tilts with √(kt/Jt) about c, to γ at the start and then each half period.
    for method in METHODS {
        let ([c, probe], _, _) = ran(&whirl(method, 2.0, "[start]\ngamma = { y = 1e-4 }\n"));
        close(method, probe.largest, 0.3 * 1e-4_f64.sin());
        assert!(c.largest < 1e-12, "{method}: c moves by {:e}", c.largest);
    }
}

#[test]
fn exact_what_turns_many_times_within_one_exact_step_is_followed() {
    // The axis of a free rotor nutates about K, by |K|/Jt = 200 rad/s.
    let tilted = "[rotor]\nm = 2.0\nJa = 0.02\nJt = 0.03\n[start]\ngamma = { y = 0.01 }\nomega = { x = 300.0 }\n\
                  [[effects.probe]]\nposition = 0.1\n[experiment]\nstop = 1.0\nstep = 0.1\n";
    let ([_, probe], [_, sample], _) = ran(&parsed(tilted));
    // K = Jt ω + (Ja − Jt) (ω·t) t: t goes round K in a cone, and is furthest from e on the other side of it.
    let (sine, cosine) = 0.01_f64.sin_cos();
    // γ about y carries e to cos e − sin z.
    let t = [cosine, -sine];
    let along = 300.0 * t[0];
    let k = [0.02 * along * t[0] + 0.03 * (300.0 - along * t[0]), 0.02 * along * t[1] - 0.03 * along * t[1]];
    let (of_k, of_t) = (k[1].atan2(k[0]), t[1].atan2(t[0]));
    let furthest = 2.0 * of_k - of_t;
    close("probe", probe.largest, 0.1 * furthest.sin());
    assert!(sample < probe.largest * (1.0 - 1e-6), "the samples alone tell {sample:e}");
}

#[test]
fn regress_who_looks_for_the_largest_deflection_changes_no_bit_of_the_run() {
    for method in METHODS {
        let scene = whirl(method, 5.0, "[start]\nr_c = { y = 1e-5 }\n[effects.gravity]\n");
        let (_, _, evaluations) = ran(&scene);
        let mut other = General::from(scene.parameters());
        let experiment = &scene.experiment;
        other.start_until(0.0, Some(experiment.tolerance), Some(experiment.stop)).expect("a possible scene");
        for point in 1..=super::points(experiment) {
            other.advance((point as f64 * experiment.step).min(experiment.stop)).expect("a possible motion");
            // As the run does.
            other.read().expect("a possible motion");
        }
        assert_eq!(other.read().expect("a possible motion").cost.evaluations, evaluations, "{method}");
    }
}

/// How a run of a scene ends, and its last time \[s].
fn end_of(text: &str) -> (Result<(), String>, f64) {
    let scene = parsed(text);
    let (mut run, mut last) = (Run::of(&scene, Vec::new()), 0.0);
    let outcome = run.follow(&scene.experiment, |_, t| {
        last = t;
        Ok(())
    });
    (outcome.map_err(|error| error.to_string()), last)
}

/// Magnets without their controller: negative springs in both lateral directions (after ROSS, issue 1238), sampled at this step \[s].
fn without_controller(step: f64) -> String {
    format!(
        "[rotor]\nm = 6.0\nJa = 0.01\nJt = 0.06\n[start]\nomega.x = 500.0\nr_c.y = 20e-6\n\
         [[effects.bearing]]\nposition = -0.15\nkyy = -2e5\nkzz = -2e5\nkxx = 1e6\ncxx = 100.0\n\
         [[effects.bearing]]\nposition = 0.15\nkyy = -2e5\nkzz = -2e5\n\
         [[effects.port]]\nposition = -0.15\n[[effects.port]]\nposition = 0.15\n\
         [[effects.unbalance]]\nmoment = \"20 g mm\"\nposition = 0.05\n[experiment]\nstop = 0.5\nstep = {step:?}\n"
    )
}

#[test]
fn regress_a_held_rotor_that_diverges_ends_its_run() {
    for step in [1e-4, 0.5] {
        let (outcome, last) = end_of(&without_controller(step));
        let words = outcome.expect_err("it diverges");
        assert!(words.starts_with("the motion diverges: at t = "), "{words}");
        assert!(words.contains("times its size of 1.50e-1 m"), "{words}");
        // 20 µm cosh(κ t), κ = √(4e5/6) = 258.2 1/s, is 0.15 m · 1e6 at 0.0915 s; the axis tilts as well.
        assert!((0.05..0.13).contains(&last), "it ends at {last} s");
    }
}

#[test]
fn regress_what_nothing_holds_may_fly_away() {
    let body = "[rotor]\nm = 1.0\nJa = 0.02\nJt = 0.03\n";
    let experiment = "[experiment]\nstop = 100.0\nstep = 1.0\n";
    let spring = "[[effects.bearing]]\nposition = 0.1\nkyy = 1e5\nkzz = 1e5\nkt = 1e3\n";
    let fast = "[start]\nv_c = { x = 1e5, y = 0.0 }\n";
    for text in [
        // Free in all directions, and axially; where it falls, and where a torque turns it.
        format!("{body}[start]\nv_c = {{ y = 1e5, z = 2e4 }}\nomega = {{ x = 10.0 }}\n{experiment}"),
        format!("{body}{fast}{spring}{experiment}"),
        format!("{body}[effects.gravity]\ng = {{ z = -1e3 }}\n{experiment}"),
        format!("{body}{fast}[effects.drag]\nlinear = 1e-3\n{experiment}"),
    ] {
        let (outcome, last) = end_of(&text);
        assert_eq!(outcome, Ok(()), "{text}");
        assert!(last == 100.0, "{text}");
    }
}
