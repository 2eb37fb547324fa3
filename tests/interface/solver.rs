//! Which tolerance and which method are in force: what the scene, the experiment and the host say of them, and that the log
//! says which counts.

use crate::harness::{Instance, Record, reference};
use split_rotor::abi::{Real, Status};

/// What the motion is after a second, by which two tolerances or methods can be told from one another.
const MOTION: [&str; 6] = ["r_c.x", "r_c.z", "phi", "gamma.y", "gamma.z", "omega.x"];

const TOLERANCE: &str = "solver.relative_tolerance";
/// That of the scene.
const OF_SCENE: Real = 1e-10;

/// The lines on what the solver chose.
fn choices(instance: &Instance) -> Vec<String> {
    let is_choice = |record: &Record| record.category == "logSolver";
    instance.journal.take().into_iter().filter(is_choice).map(|record| record.message).collect()
}

/// The motion after a second, the evaluations that it took, and what the log says of the tolerance in force.
fn run(instance: Instance) -> ([Real; 6], Real, String) {
    let mut instance = instance.initialized();
    let lines = choices(&instance);
    let [line] = &lines[..] else { panic!("one line, not {lines:?}") };
    // Beside it the log says from which sizes on a motion counts.
    let tolerance = line.split("; it is relative to").next().expect("there is a first part").to_owned();
    assert_eq!(instance.do_step(0.0, 1.0), Status::Ok);
    (instance.get_all(MOTION), instance.get("solver.evaluations"), tolerance)
}

/// A talkative instance of which the host says `own`, if anything, as solver.relative_tolerance, and `experiment` with
/// fmi2SetupExperiment.
fn with(own: Option<Real>, experiment: Option<Real>) -> Instance {
    let mut instance = Instance::talkative();
    instance.set_all(&own.map(|own| (TOLERANCE, own)).into_iter().collect::<Vec<_>>());
    assert_eq!(instance.setup(experiment, 0.0, None), Status::Ok);
    instance
}

#[test]
fn fmi_a_tolerance_of_the_experiment_stands_in_for_the_scene_but_not_for_the_host() {
    let line = |value: &str, source: &str| format!("the relative tolerance in force is {value}, the one {source}");
    let (of_scene, of_experiment, of_host) =
        (run(with(None, None)), run(with(None, Some(1e-5))), run(with(Some(1e-5), None)));
    assert_eq!(of_scene.2, line("1e-10", "of the scene"));
    assert_eq!(of_experiment.2, line("1e-5", "of fmi2SetupExperiment"));
    assert_eq!(of_host.2, line("1e-5", "that the host set as solver.relative_tolerance"));
    // The number is what counts, not where it comes from.
    assert_ne!(of_scene.0, of_experiment.0);
    assert!(of_experiment.1 < 0.75 * of_scene.1, "{} evaluations, and {} of the scene", of_experiment.1, of_scene.1);
    assert_eq!((of_experiment.0, of_experiment.1), (of_host.0, of_host.1));

    // What the host set itself wins, whichever it says first, and where it says what the scene says anyway.
    for (value, alone) in [(1e-5, &of_host), (OF_SCENE, &of_scene)] {
        let mut after = with(None, Some(1e-3));
        after.set_all(&[(TOLERANCE, value)]);
        for instance in [with(Some(value), Some(1e-3)), after] {
            let (motion, evaluations, said) = run(instance);
            assert_eq!((motion, evaluations), (alone.0, alone.1), "{value:e}");
            assert_eq!(said, line(&format!("{value:?}"), "that the host set as solver.relative_tolerance"));
        }
    }

    // Said twice, the last counts; said without a tolerance, there is none.
    let mut instance = with(None, Some(1e-5));
    assert_eq!(instance.setup(None, 0.0, None), Status::Ok);
    assert_eq!(run(instance).0, of_scene.0);
    // The parameter stays what was set.
    assert_eq!(with(None, Some(1e-5)).initialized().get(TOLERANCE), OF_SCENE);
}

#[test]
fn fmi_the_absolute_tolerance_is_in_force() {
    let mut loose = Instance::talkative();
    loose.set_all(&[("solver.absolute_tolerance", 1e-5)]);
    assert!(run(loose).1 < run(Instance::talkative()).1);
}

#[test]
fn fmi_auto_says_what_it_takes_and_why() {
    let mut instance = Instance::talkative();
    instance.set_method(1);
    let said = choices(&instance.started(&[]));
    assert!(
        said.len() == 2 && said[1].starts_with("auto takes taylor: ") && said[1].contains("stiff as long as"),
        "{said:?}"
    );
}

#[test]
fn exact_the_method_is_chosen_by_its_number() {
    /// dopri5 against dop853 at 1e-10, the axis after a second [rad]; measured 7e-10.
    const SAME_MOTION: Real = 1e-8;
    // Number, stages, and the evaluations of a look between two steps.
    let [dopri5, dop853] = [(2, 6.0, 0.0), (3, 12.0, 3.0)].map(|(method, stages, look)| {
        let mut instance = Instance::quiet();
        instance.set_method(method);
        let mut instance = instance.started(&[]);
        assert_eq!(instance.do_step(0.0, 1.0), Status::Ok);
        let [steps, rejected, spent] = instance.get_all(["solver.steps", "solver.rejected", "solver.evaluations"]);
        assert_eq!(instance.get_integer(reference("solver.method")), Ok(method));
        // Two find the first step; a step's last stage is the first of the next.
        assert_eq!(spent, 2.0 + stages * (steps + rejected) + look, "method {method}");
        instance.get_all(["axis.x", "axis.y", "axis.z"])
    });
    for (a, b) in dopri5.into_iter().zip(dop853) {
        assert!((a - b).abs() < SAME_MOTION, "{a:?}, {b:?}");
    }
}

#[test]
fn fmi_the_number_stands_for_the_method() {
    // A host that cannot set an Enumeration sets an Integer: the same bits come of it, whatever solver.method says.
    for number in 1..=6 {
        let [by_name, by_number] = [(number, 0), (number % 5 + 1, number)].map(|(method, method_number)| {
            let mut instance = Instance::quiet();
            instance.set_method(method);
            assert_eq!(instance.set_integer(reference("solver.method_number"), method_number), Status::Ok);
            instance.started(&[]).run(0.0, 0.01, 10)
        });
        assert_eq!(by_name, by_number, "method {number}");
    }
}
