//! Passages of the antipode −e, where the paper's chart is singular.

use super::case::{Case, Exact, Phi, follow, of_free, times};
use super::method::{at, symplectic};
use nalgebra::{Vector2, Vector3};
use oracles::motion::FreeRotor;
use oracles::rotation;

/// δ \[rad], and the bounds of dop853, dopri5, stiff, symplectic and auto.
const PASSAGES: [(f64, [f64; 5]); 5] = [
    (1.0, [2e-11, 2e-9, 2e-7, 1.5e-12, 8e-14]),
    (1e-2, [1e-11, 1e-9, 2e-5, 2e-11, 1.5e-12]),
    (1e-4, [1e-10, 3e-9, 1.5e-4, 1e-12, 2.5e-13]),
    (1e-8, [9e-13, 6e-11, 3e-7, 2e-13, 5e-14]),
    (0.0, [4e-14, 4e-14, 4e-14, 2e-13, 4e-14]),
];

/// The family.
pub fn cases() -> Vec<Case> {
    PASSAGES.into_iter().map(|(delta, bounds)| passage(delta, bounds)).collect()
}

/// A free rotor thrown end over end at 10 rad/s from e: its axis goes on the cone about K through e, and passes −e at δ once
/// a turn, 16 times.
fn passage(delta: f64, bounds: [f64; 5]) -> Case {
    let (axial, transverse, rate) = (0.15625, 0.078125, 10.0);
    let spin = transverse * rate * libm::tan(0.5 * delta) / axial;
    let rotor = FreeRotor {
        Ja: axial,
        Jt: transverse,
        phi: 0.5,
        gamma: Vector2::zeros(),
        omega: Vector3::new(spin, 0.0, rate),
    };
    let settings = of_free(&rotor);
    let exact = move |t: f64| match delta {
        // Right through −e whole turns of φ are a convention.
        0.0 => Exact { phi: Phi::Part(rotation::phi(&rotor.attitude(t))), ..Exact::of_free(&rotor, t) },
        _ => Exact::of_free(&rotor, t),
    };
    let methods = [at("dop853", 1e-12), at("dopri5", 1e-12), at("stiff", 1e-10), symplectic(6, 0.1), at("auto", 1e-8)];
    Case {
        name: format!("16 passages of −e at δ = {delta:e} rad"),
        hard: "φ gains nearly a turn within δ/Ω, at up to 2Ω/δ",
        oracle: "Poinsot's motion, φ by its ellipse",
        scene: "free_top",
        methods: methods.into_iter().zip(bounds).collect(),
        mutant: ("start.omega.z", 1.0 + 1e-6),
        task: follow(settings, times(10.0, 97), exact),
    }
}
