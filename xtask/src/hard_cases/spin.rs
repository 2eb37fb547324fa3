//! Very high spin, at which an explicit method must follow every nutation of the axis.

use super::case::{Case, Exact, follow, of_whirl, times};
use super::method::{at, symplectic};
use oracles::motion::Whirl;
use oracles::numerics::root;

/// Spin [rad/s]; bounds of dop853, stiff, symplectic and auto where the axis precesses, and of dop853 and symplectic where
/// it nutates, and there of auto.
const SPINS: [(f64, [f64; 4], [f64; 3]); 3] = [
    (1e4, [8e-12, 6e-12, 6e-6, 3e-10], [5e-13, 7e-4, 2e-8]),
    (1e5, [6e-11, 5e-11, 8e-8, 6e-11], [8e-12, 3e-4, 5e-7]),
    (1e6, [2e-9, 1e-9, 7e-10, 2e-9], [5e-10, 4e-5, 1.5e-4]),
];

/// The family.
pub fn cases() -> Vec<Case> {
    SPINS.into_iter().flat_map(|(spin, slow, fast)| [precessing(spin, slow), nutating(spin, fast)]).collect()
}

/// The whirl between these rates [rad/s] that goes with the spin [rad/s].
fn whirl_of(spin: f64, theta: f64, slowest: f64, fastest: f64) -> Whirl {
    let rate = root(|rate| Whirl::paper(theta, rate).axial_spin() - spin, slowest, fastest);
    Whirl::paper(theta, rate)
}

/// The tilt spring makes the axis precess, slower as it spins faster: Ω ≈ −c2/(Ja ω).
fn precessing(spin: f64, bounds: [f64; 4]) -> Case {
    let slow = -500.0 / (0.15625 * spin);
    let whirl = whirl_of(spin, 0.1, 2.0 * slow, 0.5 * slow);
    let methods = [at("dop853", 1e-10), at("stiff", 1e-10), symplectic(6, 1e-3), at("auto", 1e-8)];
    Case {
        name: format!("precession at {spin:e} rad/s, 1 s"),
        hard: "the nutation's rate holds explicit steps by stability",
        oracle: "steady whirl in closed form",
        scene: "paper",
        methods: methods.into_iter().zip(bounds).collect(),
        mutant: ("support.c2", 1.01),
        task: follow(of_whirl(&whirl), times(1.0, 50), move |t| Exact::of_whirl(&whirl, t)),
    }
}

/// The axis nutates at Ω ≈ Ja ω/Jt, a hundredth of a radian wide, and the rod swings with it; a tenth of a second.
fn nutating(spin: f64, bounds: [f64; 3]) -> Case {
    let whirl = whirl_of(spin, 0.01, spin, 3.0 * spin);
    let methods = [at("dop853", 1e-13), symplectic(6, 1e-3), at("auto", 1e-8)];
    Case {
        name: format!("nutation at {spin:e} rad/s, 0.1 s"),
        hard: "the fast motion itself is wanted",
        oracle: "steady whirl in closed form",
        scene: "paper",
        methods: methods.into_iter().zip(bounds).collect(),
        mutant: ("rotor.Jt", 1.0 + 1e-4),
        task: follow(of_whirl(&whirl), times(0.1, 50), move |t| Exact::of_whirl(&whirl, t)),
    }
}
