//! Steady whirl of the paper's rotor on its springs, at any tilt.

use super::case::{ALL_IT_TAKES, Case, Exact, Phi, follow, follow_from, of_whirl, start, support, times};
use super::method::{at, symplectic, usual};
use nalgebra::{Vector2, Vector3};
use oracles::motion::{Whirl, small_whirl};
use std::f64::consts::TAU;

/// The closed form of all of these.
const STEADY: &str = "steady whirl in closed form";

/// Tilt \[rad] of a whirl at 100 rad/s, and the bounds of dop853, dopri5, stiff and symplectic.
const TILTS: [(f64, [f64; 4]); 9] = [
    (0.1, [2e-13, 3e-11, 3e-8, 1.5e-11]),
    (0.5, [6e-12, 1e-9, 2e-6, 8e-10]),
    (1.0, [6e-11, 2.5e-9, 7e-6, 1.5e-9]),
    (1.25, [9e-11, 3e-9, 2e-5, 4e-9]),
    (1.5, [8e-11, 1.5e-9, 2e-5, 2e-8]),
    (1.75, [4e-12, 3e-9, 6e-6, 1.5e-8]),
    (2.0, [8e-11, 3e-9, 6e-6, 1.5e-8]),
    (2.5, [3e-11, 8e-9, 4e-6, 1e-9]),
    (3.0, [1.2e-11, 4.5e-11, 2e-6, 6e-9]),
];

/// The family; long cases in full, or shortened.
pub fn cases(whole: bool) -> Vec<Case> {
    let tilts = TILTS.into_iter().map(|(theta, bounds)| tilted(theta, bounds));
    tilts.chain([upright(), vanishing(f64::from_bits(1)), vanishing(1e-160), small(), long(whole)]).collect()
}

fn tilted(theta: f64, bounds: [f64; 4]) -> Case {
    let whirl = Whirl::paper(theta, 100.0);
    let methods = [at("dop853", 1e-14), at("dopri5", 1e-13), at("stiff", 1e-10), symplectic(8, 5e-4)];
    // Whole periods and a third: a phase error must show in every component.
    let times = (1..=100).map(|n| (f64::from(n) - 2.0 / 3.0) * TAU / 100.0).collect();
    Case {
        name: format!("steady whirl at θ = {theta} rad, 100 periods"),
        hard: if theta < 2.0 { "large tilt, all forces at work" } else { "beyond the chart from e" },
        oracle: STEADY,
        scene: "paper",
        methods: methods.into_iter().zip(bounds).collect(),
        mutant: ("support.c2", 1.0 + 1e-5),
        task: follow(of_whirl(&whirl), times, move |t| Exact::of_whirl(&whirl, t)),
    }
}

/// What spins upright at 50 rad/s and stays in its place \[m].
fn spinning(place: Vector3<f64>) -> impl Fn(f64) -> Exact {
    move |t| Exact { r_c: Some(place), axis: Vector3::x(), phi: Phi::Whole(50.0 * t) }
}

/// γ = 0 to the last bit, under gravity along the axis.
fn upright() -> Case {
    let (m, l, c1, g) = (5.0, 0.75, 2000.0, -9.81);
    let rest = Vector3::new(l + m * g / c1, 0.0, 0.0);
    let mut settings = support(c1, 500.0, Vector3::x() * g);
    settings.extend(start(&rest, &Vector3::zeros(), 0.0, &Vector2::zeros(), &(Vector3::x() * 50.0)));
    Case {
        name: "θ = 0 exactly".into(),
        hard: "0/0 in every formula of the rotation",
        oracle: "stays upright, φ = 50 t",
        scene: "paper",
        methods: usual([3e-13, 3e-13, 4e-13], [(symplectic(6, 1e-2), 5e-13), (at("auto", 1e-8), 3e-13)]),
        mutant: ("gravity.g.x", -1.0),
        task: follow(settings, times(10.0, 50), spinning(rest)),
    }
}

/// A tilt of which nothing may be seen, but no number be lost.
fn vanishing(theta: f64) -> Case {
    let mut settings = support(2000.0, 500.0, Vector3::zeros());
    let place = Vector3::new(0.75, 0.0, 0.0);
    settings.extend(start(&place, &Vector3::zeros(), 0.0, &Vector2::new(theta, -theta), &(Vector3::x() * 50.0)));
    Case {
        name: format!("θ = {theta:.0e} rad, whose square is 0"),
        hard: "underflow",
        oracle: "stays upright, φ = 50 t",
        scene: "paper",
        methods: usual([2e-13, 2e-13, 4e-13], [(symplectic(6, 1e-2), 5e-13), (at("auto", 1e-8), 2e-13)]),
        mutant: ("start.omega.x", 1.0 + 1e-9),
        // Of so small a tilt the closed form of a whirl has no digits.
        task: follow(settings, times(10.0, 50), spinning(place)),
    }
}

/// The slow whirl of the paper's rotor at 50 rad/s, with this tilt \[rad].
fn slow(theta: f64) -> Whirl {
    Whirl::paper(theta, small_whirl(&Whirl::paper(0.0, 0.0), 50.0)[2])
}

/// A small tilt to its own digits: errors in units of it.
fn small() -> Case {
    let whirl = slow(1e-8);
    let mut settings = of_whirl(&whirl);
    // Else nobody asks for digits of what is smaller than the tolerance.
    settings.push(("solver.absolute_tolerance", 1e-20));
    Case {
        name: "θ = 10⁻⁸ rad, errors in units of it".into(),
        hard: "digits of what is next to nothing",
        oracle: STEADY,
        scene: "paper",
        methods: usual([8e-12, 6e-11, 8e-9], []),
        mutant: ("support.c1", 1.0 + 1e-6),
        task: follow_from(0.0, 1e-8, settings, times(10.0, 50), move |t| Exact::of_whirl(&whirl, t)),
    }
}

fn long(whole: bool) -> Case {
    let whirl = Whirl::paper(0.1, 100.0);
    let turns = if whole { 1e6 } else { 1e4 };
    // In full, a tolerance of 1e-8 loses the phase of the whirl altogether, so `auto` is judged by the shortened case.
    let methods = if whole {
        vec![(at("dop853", 1e-14), 3e-5), (symplectic(8, 2e-3), 2e-4)]
    } else {
        vec![(at("dop853", 1e-14), 3e-9), (symplectic(8, 2e-3), 2e-6), (at("auto", 1e-8), 5e-4)]
    };
    Case {
        name: format!("steady whirl, {turns:e} revolutions"),
        hard: "errors of energy and phase add up",
        oracle: STEADY,
        scene: "paper",
        methods,
        mutant: ("support.c2", 1.0 + 1e-3),
        task: follow([of_whirl(&whirl), vec![ALL_IT_TAKES]].concat(), times(turns * TAU / 100.0, 97), move |t| {
            Exact::of_whirl(&whirl, t)
        }),
    }
}
