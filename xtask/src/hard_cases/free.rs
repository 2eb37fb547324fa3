//! Free rotors: many turns, shapes at the limit of what can exist, and no springs.

use super::case::{ALL_IT_TAKES, Case, Exact, Phi, body, follow, of_free, start, support, times};
use super::method::{at, symplectic, usual};
use nalgebra::{Vector2, Vector3};
use oracles::motion::FreeRotor;
use oracles::rotation;
use std::f64::consts::TAU;

/// The paper's rotor, nutating: a flattest disk, Ja = 2 Jt.
fn disk() -> FreeRotor {
    FreeRotor { Ja: 0.15625, Jt: 0.078125, phi: 0.0, gamma: Vector2::zeros(), omega: Vector3::new(50.0, 12.0, 5.0) }
}

/// The closed form of all of these.
const POINSOT: &str = "Poinsot's motion, φ by its ellipse";

/// The family; long cases in full, or shortened.
pub fn cases(whole: bool) -> Vec<Case> {
    vec![
        thousand_turns(),
        thousand_turns_of_the_axis(),
        million_turns(whole),
        bare_spin(whole),
        needle(),
        tilted_disk(),
        falling(),
        floating(),
    ]
}

fn thousand_turns() -> Case {
    let rotor = disk();
    Case {
        name: "free symmetric rotor, 1000 turns".into(),
        hard: "phase error grows with every nutation",
        oracle: POINSOT,
        scene: "free_top",
        methods: vec![
            (at("dop853", 1e-12), 3e-9),
            (at("dop853", 1e-14), 2e-10),
            (at("dopri5", 1e-12), 6e-7),
            (at("stiff", 1e-12), 6e-7),
            (symplectic(2, 1.0), 1e-11),
            (at("auto", 1e-8), 1e-11),
        ],
        mutant: ("rotor.Ja", 1.0 - 1e-6),
        task: follow(of_free(&rotor), times(1000.0 * TAU / 50.0, 1000), move |t| Exact::of_free(&rotor, t)),
    }
}

fn thousand_turns_of_the_axis() -> Case {
    let rotor = disk();
    Case {
        name: "free symmetric rotor, 1000 turns, its axis".into(),
        methods: vec![(at("dop853", 1e-12), 2e-10), (at("dopri5", 1e-12), 2e-9), (at("stiff", 1e-12), 2e-9)],
        task: follow(of_free(&rotor), times(1000.0 * TAU / 50.0, 1000), move |t| Exact {
            phi: Phi::Unasked,
            ..Exact::of_free(&rotor, t)
        }),
        ..thousand_turns()
    }
}

fn million_turns(whole: bool) -> Case {
    let turns = if whole { 1e6 } else { 1e4 };
    let methods = [at("dop853", 1e-14), symplectic(2, 1.0), at("auto", 1e-8)];
    let bounds = if whole { [1e-3, 1.5e-6, 1.5e-6] } else { [2e-8, 1.5e-10, 1.5e-10] };
    let rotor = disk();
    Case {
        name: format!("free symmetric rotor, {turns:e} turns"),
        hard: "phase error, digits of φ",
        oracle: POINSOT,
        scene: "free_top",
        methods: methods.into_iter().zip(bounds).collect(),
        mutant: ("rotor.Jt", 1.0 + 1e-5),
        task: follow([of_free(&rotor), vec![ALL_IT_TAKES]].concat(), times(turns * TAU / 50.0, 100), move |t| {
            Exact::of_free(&rotor, t)
        }),
    }
}

/// φ = 64 t to the last digits of its remainder, with 2π in two parts.
fn bare_spin(whole: bool) -> Case {
    let end = if whole { 98_000.0 } else { 980.0 };
    let settings = start(&Vector3::zeros(), &Vector3::zeros(), 0.0, &Vector2::zeros(), &(Vector3::x() * 64.0));
    Case {
        name: format!("bare spin, {:.0} turns", 64.0 * end / TAU),
        hard: "a double of so many turns has lost the digits of the angle",
        oracle: "φ = 64 t, its turns exactly",
        scene: "free_top",
        methods: vec![
            (at("dop853", 1e-12), 6e-10),
            (at("dopri5", 1e-12), 6e-10),
            (symplectic(6, 1.0), 2e-9),
            (at("stiff", 1e-8), 4e-10),
        ],
        mutant: ("start.omega.x", 1.0 + 1e-10),
        task: Box::new(move |bench| {
            let mut rotor = bench.rotor(&settings)?;
            rotor.start(0.0, end)?;
            let mut found = super::case::Found::nothing();
            for t in times(end, 1000) {
                rotor.advance(t)?;
                let shown = rotor.shown()?;
                let high = f64::from_bits(TAU.to_bits() & (u64::MAX << 27));
                let turned = (64.0 * t - shown.turns * high) - shown.turns * (TAU - high);
                found = found.or((shown.angle - turned + shown.turns * 2.449_293_598_294_706_4e-16).abs(), "φ");
            }
            Ok(found)
        }),
    }
}

fn needle() -> Case {
    let (gamma, across) = (Vector2::new(0.4, -0.2), Vector3::new(0.0, 3.0, -2.0));
    let axis = rotation::axis(&gamma);
    let omega = axis * 2000.0 + axis.cross(&across);
    let rotor = FreeRotor { Ja: 4e-7, Jt: 0.4, phi: 1.0, gamma, omega };
    Case {
        name: "needle, Jt/Ja = 10⁶".into(),
        hard: "spin and tumble are a million apart in inertia",
        oracle: POINSOT,
        scene: "free_top",
        methods: usual([2e-6, 2e-6, 6e-4], [(symplectic(6, 0.1), 3e-6)]),
        mutant: ("start.omega.x", 1.0 + 1e-6),
        task: follow(of_free(&rotor), times(2.0, 50), move |t| Exact::of_free(&rotor, t)),
    }
}

fn tilted_disk() -> Case {
    let rotor = FreeRotor { gamma: Vector2::new(-0.6, 1.1), omega: Vector3::new(12.0, 10.0, 15.0), phi: 2.0, ..disk() };
    Case {
        name: "flattest disk, Ja = 2 Jt".into(),
        hard: "no body is flatter; it tilts widely",
        oracle: POINSOT,
        scene: "free_top",
        methods: usual([1e-11, 3e-9, 3e-7], [(symplectic(6, 0.1), 2e-12)]),
        mutant: ("rotor.Jt", 1.0 + 1e-6),
        task: follow(of_free(&rotor), times(10.0, 50), move |t| Exact::of_free(&rotor, t)),
    }
}

/// No stiffness: it falls and turns as a free one.
fn falling() -> Case {
    let (rotor, g, v) = (disk(), Vector3::new(1.0, -2.0, -9.81), Vector3::new(3.0, 1.0, 20.0));
    let mut settings = body(5.0, rotor.Ja, rotor.Jt, 0.75);
    settings.extend(support(0.0, 0.0, g));
    settings.extend(start(&Vector3::zeros(), &v, rotor.phi, &rotor.gamma, &rotor.omega));
    Case {
        name: "no stiffness: thrown and falling".into(),
        hard: "springs of zero must do nothing",
        oracle: "parabola and Poinsot's motion",
        scene: "paper",
        methods: usual([3e-11, 4e-9, 4e-7], [(symplectic(6, 0.1), 5e-12), (at("auto", 1e-8), 8e-7)]),
        mutant: ("gravity.g.z", 1.0 + 1e-7),
        task: follow(settings, times(10.0, 50), move |t| Exact {
            r_c: Some(v * t + g * (0.5 * t * t)),
            ..Exact::of_free(&rotor, t)
        }),
    }
}

/// No stiffness and no gravity: nothing moves but φ.
fn floating() -> Case {
    let (gamma, place) = (Vector2::new(0.3, -0.5), Vector3::new(0.1, 2.0, -3.0));
    let axis = rotation::axis(&gamma);
    let mut settings = support(0.0, 0.0, Vector3::zeros());
    settings.extend(start(&place, &Vector3::zeros(), 0.0, &gamma, &(axis * 50.0)));
    Case {
        name: "no gravity, no stiffness: spinning in place".into(),
        hard: "nothing to measure an error by",
        oracle: "stays, φ = 50 t",
        scene: "paper",
        methods: usual([4e-12, 6e-14, 1.5e-12], [(symplectic(6, 0.1), 5e-12), (at("auto", 1e-8), 3e-12)]),
        mutant: ("start.omega.y", 1.0 + 1e-6),
        task: follow(settings, times(100.0, 50), move |t| Exact { r_c: Some(place), axis, phi: Phi::Whole(50.0 * t) }),
    }
}
