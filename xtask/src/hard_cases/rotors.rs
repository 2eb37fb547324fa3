//! Rotors as users bring them: an ordinary one, one that runs down, one held by partners through its ports.

use super::case::{Case, times};
use super::machine::Scene;
use super::method::{Method, at, symplectic};
use anyhow::{Result, ensure};
use nalgebra::Vector3;
use oracles::machine::known::{drifting, ordinary};
use oracles::machine::{Machine, Shown, Start};

/// Who knows the answer.
const ORACLE: &str = "the laws in quaternions, extrapolated to order 22";

/// The family.
pub fn cases() -> Vec<Case> {
    vec![held_by_partners(), run_down(), run_up()]
}

fn with(methods: Vec<Method>, bounds: &[f64]) -> Vec<(Method, f64)> {
    methods.into_iter().zip(bounds.iter().copied()).collect()
}

/// Every method, that of order 8 in steps of this size \[s].
fn tried(step: f64) -> Vec<Method> {
    vec![
        at("dop853", 1e-8),
        at("dopri5", 1e-8),
        at("stiff", 1e-8),
        symplectic(8, step),
        at("auto", 1e-4),
        at("auto", 1e-8),
    ]
}

fn held_by_partners() -> Case {
    let start = Start { r_c: Vector3::new(0.0, 1e-3, -2e-3), omega: Vector3::new(50.0, 5.0, 0.0), ..Start::default() };
    let machine = Machine { ports: vec![-0.2, 0.25], start, ..drifting() };
    let partners = vec![[2e4, 100.0], [3e4, 150.0]];
    Case {
        name: "held by two partner bearings through its ports, 500 exchanges".into(),
        hard: "at the start nothing seems to act; loads jump at each exchange",
        oracle: ORACLE,
        scene: "rotor",
        methods: with(tried(1e-3), &[3e-12, 1e-9, 8e-10, 5e-14, 8e-10, 3e-12]),
        mutant: ("port[1].f.y", 1.001),
        task: Scene { machine, times: times(1.0, 500), partners }.task(|_| Ok(())),
    }
}

fn run_down() -> Case {
    let machine = Machine { drag: Some([0.001, 0.0]), ..drifting() };
    Case {
        name: "run-down by windage, 800 nutations".into(),
        hard: "nothing depends on the place, and yet something acts",
        oracle: ORACLE,
        scene: "rotor",
        methods: with(tried(1e-2), &[6e-6, 4e-5, 4e-5, 2e-11, 0.08, 6e-6]),
        mutant: ("drag.linear", 1.01),
        task: Scene::alone(machine, times(60.0, 300)).task(|shown| {
            // Along t the windage is all that acts: ω_a = 50 exp(−0.001 t/Ja).
            let left = 50.0 * libm::exp(-0.001 * 60.0 / 0.15625);
            let last = shown[shown.len() - 1];
            let off = last.omega.dot(&last.axis) - left;
            ensure!(off.abs() < 1e-11 * left, "the oracle's spin is off by {off:e} rad/s");
            Ok(())
        }),
    }
}

/// Its largest whirl until 3.3 s, looked at each 0.1 ms \[m]: from another simulator.
const WHIRL: f64 = 20.492464e-6;

fn whirl_is_known(shown: &[Shown]) -> Result<()> {
    let largest = shown.iter().map(|now| libm::hypot(now.r_c.y, now.r_c.z)).fold(0.0, f64::max);
    ensure!((largest - WHIRL).abs() < 1e-12, "the oracle whirls by {largest:e} m");
    Ok(())
}

fn run_up() -> Case {
    let methods = vec![
        at("dop853", 1e-4),
        at("dop853", 1e-8),
        at("dopri5", 1e-4),
        at("dopri5", 1e-8),
        at("stiff", 1e-4),
        at("stiff", 1e-6),
        symplectic(4, 1e-4),
        at("auto", 1e-3),
        at("auto", 1e-4),
        at("auto", 1e-8),
    ];
    Case {
        name: "the ordinary rotor run up, its whirl of 20.49 µm".into(),
        hard: "it starts at rest; its whirl is 10⁻⁵ of its size",
        oracle: ORACLE,
        scene: "rotor",
        methods: with(methods, &[3e-4, 2e-8, 5e-4, 3e-8, 6e-4, 4e-6, 3e-5, 3e-3, 3e-4, 2e-8]),
        mutant: ("unbalance[1].mass", 1.1),
        task: Scene::alone(ordinary(), times(3.3, 33_000)).task(whirl_is_known),
    }
}
