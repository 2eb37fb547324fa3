//! `auto`: what it takes, why, and that no other adaptive method reaches the same error for much less work.

use crate::harness::named::{Named, names};
use crate::harness::{largest, within};
use crate::ordinary::{DROPPED, RUN_UP, dropped, ordinary};
use nalgebra::Vector3;
use split_rotor_model::effects::Effects;
use split_rotor_model::simulation::Integrator;

/// What is changed in a scene.
type Changes<'c> = &'c [(&'c str, f64)];

/// A scene, what is changed in it, and its stop [s].
type Case<'c> = (&'c str, Changes<'c>, f64);

const AUTO: f64 = 1.0;
const DOPRI5: f64 = 2.0;
const DOP853: f64 = 3.0;
const STIFF: f64 = 5.0;
const TAYLOR: f64 = 6.0;

const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];

const FASTER: Changes = &[("start.omega.x", 1e3)];
const DAMPED: Changes = &[("support.d1", 20.0), ("support.d2", 1.0)];
const RINGING: Changes = &[("support.d1", 1_414.213_562_373_095)];
const STIFFISH: Changes = &[("support.c1", 1e6), ("support.d1", 4_472.135_954_999_579)];
const HARDER: Changes = &[("support.c1", 1e8), ("support.d1", 0.0)];

fn scene((name, changes, _): Case, method: f64, tolerance: f64) -> Named {
    let mut named = match name {
        "ordinary" => Named::general(&ordinary()),
        "dropped" => Named::general(&dropped()),
        _ => Named::new(name, Integrator::Method),
    };
    let solver = [("solver.method", method), ("solver.relative_tolerance", tolerance)];
    changes.iter().chain(&solver).for_each(|(name, value)| named.set(name, *value));
    named
}

// ------------------------------------------------------------------------------------------------------ what and why

/// What it does after so long [s].
const AFTER: f64 = 0.3;

#[test]
fn what_it_takes_in_each_scene_and_why() {
    const EXACT: &str = "auto takes symplectic: nothing acts on the rotor";
    const SERIES: &str =
        "auto takes taylor: the motion has a power series; and it takes stiff as long as stability alone";
    const PAIR: &str = "auto takes dop853: the motion has no power series while";
    const COLLOCATION: &str = "auto goes on with stiff from t = ";
    const TAKEN: [(&str, &str); 23] = [
        ("centrifuge", PAIR),
        ("coupled", SERIES),
        ("driven", SERIES),
        ("dzhanibekov", EXACT),
        ("film_bearings", PAIR),
        ("flywheel", PAIR),
        ("free_top", EXACT),
        ("heavy_top", SERIES),
        ("high_spin", COLLOCATION),
        ("jeffcott", PAIR),
        ("long_run", SERIES),
        ("overhung", "auto goes on with "),
        ("paper", SERIES),
        ("reaction_wheel", PAIR),
        ("rotor", SERIES),
        ("rubbing", "auto "),
        ("run_up", PAIR),
        ("spindle", PAIR),
        ("stiff_support", COLLOCATION),
        ("tumbling", EXACT),
        ("turbo", PAIR),
        ("unstable_whirl", SERIES),
        ("washing_machine", PAIR),
    ];
    assert_eq!(TAKEN.map(|(name, _)| name).to_vec(), names());
    for (name, what) in TAKEN {
        let mut named = scene((name, &[], AFTER), AUTO, 1e-6);
        assert_eq!(named.simulation.auto(), None, "before the start");
        named.start();
        named.simulation.advance(AFTER).expect("a possible motion");
        let said = named.simulation.auto().expect("auto");
        println!("{name}: {said}");
        assert!(said.starts_with(what), "{name}: {said}");
    }
}

/// A body that turns over about its middle axis, where errors grow tenfold in a second.
const TOSSED: &str = r#"
    [rotor]
    m = 2.0
    Ja = 0.02
    Jt = 0.01
    l = 0.1

    [start]
    v_c = { z = 12.0 }
    omega = { x = 20.0, y = 0.001, z = 0.001 }

    [effects.asymmetry]
    Jt2 = 0.03

    [[effects.unbalance]]
    mass = 0.02
    position = 0.03
    radius = 0.05

    [solver]
    method = "auto"
    relative_tolerance = 1e-4

    [experiment]
    stop = 10.0
    step = 0.05
"#;

#[test]
fn exact_what_only_falls_turns_as_it_does_without_weight() {
    let g = Vector3::new(0.0, 1.5, -9.81);
    let weight = format!("{TOSSED}\n[effects.gravity]\ng = {{ y = {:?}, z = {:?} }}\n", g.y, g.z);
    let [mut free, mut falling] = [TOSSED, &weight].map(Named::started);
    let mut worst = 0.0_f64;
    for n in 1..=200 {
        let t = f64::from(n) * 0.05;
        for named in [&mut free, &mut falling] {
            named.simulation.advance(t).expect("a possible motion");
        }
        for name in ["axis.x", "axis.y", "axis.z", "turns", "angle"] {
            assert_eq!(free.get(name).to_bits(), falling.get(name).to_bits(), "{name} at {t} s");
        }
        let fallen = falling.vector("r_c") - free.vector("r_c");
        worst = worst.max((fallen - g * (0.5 * t * t)).norm() / (0.5 * g.norm() * t * t));
    }
    println!("measured {worst:.1e}, allowed 1e-14");
    assert!(worst <= 1e-14, "{worst:e}");
}

#[test]
fn a_method_that_is_named_is_taken() {
    for method in [DOPRI5, DOP853, 4.0, STIFF] {
        let mut named = scene(("paper", &[], 1.0), method, 1e-8);
        named.start();
        assert_eq!((named.simulation.auto(), named.simulation.changes_of_method()), (None, 0));
    }
}

// ------------------------------------------------------------------------------------------------- never much dearer

/// What an evaluation costs [ns], measured in the scenes: of dop853, dopri5 and taylor, and of stiff with all that it solves.
const PAIR: f64 = 42.0;
const COLLOCATION: f64 = 240.0;

/// A run's points: place across e [m] and the axis. What it cost [ns].
struct Run {
    points: Vec<[f64; 5]>,
    work: f64,
}

const POINTS: u32 = 100;

fn run(case: Case, method: f64, tolerance: f64) -> Option<Run> {
    let mut named = scene(case, method, tolerance);
    named.simulation.start_until(0.0, None, Some(case.2)).expect("a possible scene");
    assert!(named.simulation.parameters().effects.push(), "a motion that needs a method");
    let (mut points, mut work, mut before) = (Vec::new(), 0.0, 0.0);
    for i in 0..=POINTS {
        named.simulation.advance(case.2 * f64::from(i) / f64::from(POINTS)).ok()?;
        points.push(["r_c.y", "r_c.z", "axis.x", "axis.y", "axis.z"].map(|name| named.get(name)));
        let evaluations = named.get("solver.evaluations");
        let is_stiff = method == STIFF || named.simulation.auto().is_some_and(|what| what.contains("with stiff"));
        work += (evaluations - before) * if is_stiff { COLLOCATION } else { PAIR };
        before = evaluations;
    }
    Some(Run { points, work })
}

/// The worst of all points, of the place and of the axis, each over how far it gets from its start.
fn error(run: &Run, exact: &Run) -> f64 {
    let apart = |a: &[f64; 5], b: &[f64; 5], part: std::ops::Range<usize>| {
        part.map(|n| (a[n] - b[n]) * (a[n] - b[n])).sum::<f64>().sqrt()
    };
    let worst = |part: std::ops::Range<usize>| {
        let error = largest(run.points.iter().zip(&exact.points).map(|(a, b)| apart(a, b, part.clone())));
        let size = largest(exact.points.iter().map(|at| apart(at, &exact.points[0], part.clone())));
        if size > 1e-12 { error / size } else { 0.0 }
    };
    worst(0..2).max(worst(2..5))
}

/// Work of auto over that of the cheapest setting that errs no more [1].
const DEARER: f64 = 2.0;

fn never_much_dearer(case: Case, exact: f64, methods: &[f64]) {
    let exact = run(case, exact, 1e-13).expect("a possible motion");
    let autos = TOLERANCES.map(|tolerance| (tolerance, run(case, AUTO, tolerance).expect("a possible motion")));
    let most = autos.iter().map(|(_, auto)| auto.work).fold(0.0, f64::max);
    let mut runs = Vec::new();
    for method in methods {
        // Half decades of tolerance, until it takes twice what `auto` ever took.
        for tolerance in (6..=24).map(|n| libm::pow(10.0, -0.5 * f64::from(n))) {
            let Some(run) = run(case, *method, tolerance) else { continue };
            if run.work > 2.0 * most {
                break;
            }
            runs.push(((*method, tolerance), run));
        }
    }
    for (tolerance, auto) in autos {
        let reached = error(&auto, &exact);
        let as_good = runs.iter().filter(|(_, run)| error(run, &exact) <= reached);
        let best = as_good.min_by(|a, b| a.1.work.total_cmp(&b.1.work));
        let (setting, least) = best.map_or(((AUTO, tolerance), auto.work), |(setting, run)| (*setting, run.work));
        println!("{} at {tolerance:e}: error {reached:.1e}, work {:.1e} ns, best {setting:?}", case.0, auto.work);
        within("auto over the best", auto.work / least, DEARER);
    }
}

#[test]
fn no_method_does_much_better_with_ordinary_rotors() {
    for (name, stop) in [("ordinary", RUN_UP), ("dropped", DROPPED)] {
        never_much_dearer((name, &[], stop), DOP853, &[DOPRI5, DOP853, STIFF, TAYLOR]);
    }
}

#[test]
fn no_method_does_much_better_in_gentle_scenes() {
    for (name, changes, stop) in [("paper", &[] as Changes, 10.0), ("paper", FASTER, 2.0), ("driven", &[], 10.0)] {
        never_much_dearer((name, changes, stop), DOP853, &[DOPRI5, DOP853, STIFF, TAYLOR]);
    }
}

#[test]
fn no_method_does_much_better_where_all_dies_out() {
    never_much_dearer(("paper", DAMPED, 1000.0), DOP853, &[DOP853, STIFF, TAYLOR]);
}

#[test]
fn no_method_does_much_better_on_stiff_supports() {
    never_much_dearer(("stiff_support", HARDER, 1.0), DOP853, &[DOP853, STIFF, TAYLOR]);
    for changes in [&[], RINGING, STIFFISH] {
        never_much_dearer(("stiff_support", changes, 1.0), STIFF, &[DOP853, STIFF, TAYLOR]);
    }
}
