//! The same inputs give the same bits: optimised, and not optimised with wide vectors, over the list of all effects
//! and over that of the scene alone, from the library and (tests/fmu/test_golden_bits.py) from the packaged FMU.
//!
//! A trajectory's hash is FNV-1a, 64 bits, over the little-endian bytes of every Real variable of the scene in the order
//! of value references, at t = 0, 1/64, … 2 s.

mod harness;

use harness::{Instance, reals, scene, scenes};
use split_rotor_model::scene::Scene;
use split_rotor_model::simulation::General;
use split_rotor_model::variable::Place;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::thread;

/// Communication points lie this far apart [s], exact in binary.
const STEP: f64 = 1.0 / 64.0;
const STEPS: u32 = 128;

/// Number and name of the methods.
const METHODS: [(i32, &str); 6] = [AUTO, (2, "dopri5"), (3, "dop853"), (4, "symplectic"), (5, "stiff"), (6, "taylor")];
const AUTO: (i32, &str) = (1, "auto");

/// The methods that a scene is run with: one of effects of its own that leaves the choice to `auto` is one where the others take too long.
fn methods(name: &str) -> Vec<(i32, &'static str)> {
    let scene = Scene::find(name, &scenes()).unwrap_or_else(|error| panic!("{error}"));
    let choice = scene.variables.iter().find(|variable| variable.name == "solver.method").expect("it is always there");
    let is_auto = scene.starts[&choice.place.value_reference()] == f64::from(AUTO.0);
    if is_auto && !scene.general { vec![AUTO] } else { METHODS.to_vec() }
}

const HEADER: &str = "\
# The hash of a trajectory for each scene and method: tests/bits.rs says of what, and computes it.
# After a change that is meant to change the bits: UPDATE_GOLDEN=1 cargo test --test bits
scene,method,hash
";

/// FNV-1a, 64 bits.
struct Hash(u64);

impl Hash {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn add(&mut self, value: u64) {
        for byte in value.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

/// The hash of a scene's trajectory over the list of all effects.
fn hash_over_all_effects(name: &str, method: i32) -> u64 {
    let scene = Scene::find(name, &scenes()).unwrap_or_else(|error| panic!("{error}"));
    let mut simulation = General::from(scene.parameters());
    let choice = scene.variables.iter().find(|variable| variable.name == "solver.method").expect("it is always there");
    assert!(simulation.set_parameter(choice.place, f64::from(method)));
    simulation.start(0.0, None).unwrap_or_else(|invalid| panic!("{invalid}"));
    let (references, mut hash) = (reals(&scene), Hash::new());
    for i in 0..=STEPS {
        if i > 0 {
            simulation.advance(f64::from(i) * STEP).unwrap_or_else(|fault| panic!("{fault}"));
        }
        for reference in &references {
            let value = simulation.get(Place::of(*reference)).expect("the parameters are possible");
            let value = value.expect("the scene has this variable");
            assert!(value.is_finite(), "{reference}");
            hash.add(value.to_bits());
        }
    }
    hash.0
}

/// The hash of the compiled-in scene's trajectory through the exported functions.
fn hash_through_the_exports(method: i32) -> u64 {
    let mut instance = Instance::quiet();
    instance.set_method(method);
    let mut instance = instance.started(&[]);
    let mut hash = Hash::new();
    instance.bits().into_iter().for_each(|bits| hash.add(bits));
    instance.run(0.0, STEP, STEPS).into_iter().flatten().for_each(|bits| hash.add(bits));
    hash.0
}

/// Where nothing is optimised a run takes 80 times as long. With this in the environment each scene is run by one of its methods, those that have
/// several by turns.
const BY_TURNS: &str = "SPLIT_ROTOR_METHODS_BY_TURNS";

/// The lines of a scene, or only that of the method whose turn it is.
fn rows(scene: &str, turn: Option<usize>) -> String {
    let methods = methods(scene);
    let chosen = turn.map_or(&methods[..], |turn| std::slice::from_ref(&methods[turn % methods.len()]));
    chosen.iter().fold(String::new(), |mut rows, (number, method)| {
        let hash = hash_over_all_effects(scene, *number);
        writeln!(rows, "{scene},{method},{hash:016x}").expect("writing to memory does not fail");
        rows
    })
}

fn golden() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/bits.csv")
}

#[test]
fn the_hash_is_fnv_1a() {
    // The empty string, and the bytes "foobar\0\0", by the definition of Fowler, Noll and Vo.
    let mut hash = Hash::new();
    assert_eq!(hash.0, 0xcbf2_9ce4_8422_2325);
    hash.add(u64::from_le_bytes(*b"foobar\0\0"));
    let zero_bytes = 0x8594_4171_f739_67e8_u64.wrapping_mul(0x0000_0100_0000_01b3).wrapping_mul(0x0000_0100_0000_01b3);
    assert_eq!(hash.0, zero_bytes);
}

#[test]
fn golden_trajectories_have_the_same_bits() {
    // Where nothing is optimised, one after another takes minutes.
    let by_turns = std::env::var_os(BY_TURNS).is_some();
    let rows = thread::scope(|scope| {
        let mut turn = 0;
        let scenes = Scene::names(&scenes()).into_iter().map(|scene| {
            turn += usize::from(methods(&scene).len() > 1);
            scope.spawn(move || rows(&scene, by_turns.then_some(turn)))
        });
        let scenes: Vec<_> = scenes.collect();
        scenes.into_iter().map(|rows| rows.join().expect("a scene that runs")).collect::<String>()
    });
    let found = HEADER.to_owned() + &rows;
    if !by_turns && std::env::var_os("UPDATE_GOLDEN").is_some_and(|value| value == "1") {
        std::fs::write(golden(), &found).expect("tests/golden can be written");
    }
    let kept = std::fs::read_to_string(golden()).expect("tests/golden/bits.csv is there");
    let run = |line: &str| {
        line.rsplit_once(',').is_some_and(|(of, _)| rows.lines().any(|row| row.rsplit_once(',').unwrap().0 == of))
    };
    let expected = kept.lines().filter(|line| !by_turns || HEADER.contains(line) || run(line));
    let expected = expected.map(|line| format!("{line}\n")).collect::<String>();
    assert_eq!(found, expected, "the trajectories differ from tests/golden/bits.csv, whose head says what to do");
}

#[test]
fn exact_compiled_list_and_list_of_all_effects_agree_bit_for_bit() {
    for (number, method) in methods(&scene().name) {
        let (exports, all) = (hash_through_the_exports(number), hash_over_all_effects(&scene().name, number));
        assert_eq!(exports, all, "{method}");
    }
}
