//! Supports from next to nothing to harder than anything.

use super::case::{Case, Exact, follow, of_whirl, times};
use super::method::{at, symplectic};
use oracles::motion::Whirl;

/// Stiffness c1 [N/m]; bounds of dop853, stiff and auto.
const STIFFNESSES: [(f64, [f64; 3]); 7] = [
    (1e-6, [2e-12, 4e-9, 2e-8]),
    (1e-3, [2e-12, 4e-9, 2e-8]),
    (1.0, [2e-12, 4e-9, 2e-8]),
    (1e3, [7e-13, 4e-9, 7e-9]),
    (1e6, [2e-11, 2e-9, 9e-9]),
    (1e9, [2e-11, 6e-9, 6e-7]),
    (1e12, [2e-12, 6e-8, 4e-6]),
];

/// The family.
pub fn cases() -> Vec<Case> {
    let mut cases: Vec<_> = STIFFNESSES.into_iter().map(|(c1, bounds)| support(c1, bounds)).collect();
    // Beside the middle one: a step that resolves the springs.
    cases[3].methods.push((symplectic(8, 1e-3), 3e-11));
    cases
}

/// A whirl of half a radian on such a support, 1 s or, where that is 10⁸ evaluations, 0.1 s, at a rate below all of the support's own that are faster.
fn support(c1: f64, bounds: [f64; 3]) -> Case {
    let whirl = Whirl { c1, ..Whirl::paper(0.5, 40.0) };
    let end = if c1 > 1e9 { 0.1 } else { 1.0 };
    let methods = [at("dop853", 1e-12), at("stiff", 1e-10), at("auto", 1e-8)];
    Case {
        name: format!("support of {c1:e} N/m, {end} s"),
        hard: if c1 < 1e3 { "springs next to nothing" } else { "fast motion of the support beside a slow one" },
        oracle: "steady whirl in closed form",
        scene: "paper",
        methods: methods.into_iter().zip(bounds).collect(),
        mutant: ("support.c2", 1.001),
        task: follow(of_whirl(&whirl), times(end, 50), move |t| Exact::of_whirl(&whirl, t)),
    }
}
