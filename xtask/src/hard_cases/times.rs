//! Late times, tiny and huge communication steps: each counted.

use super::case::{Case, Exact, Found, follow_from, of_whirl, times};
use super::method::{at, symplectic, usual};
use anyhow::ensure;
use oracles::motion::Whirl;

/// Start \[s], communication step \[s], how many, and the bounds of dop853, stiff and auto. The last two steps are of half a
/// microsecond and the least that a double of 10⁹ s can tell.
const STEPS: [(f64, f64, u32, [f64; 3]); 7] = [
    (0.0, 1e-9, 100_000, [2.5e-15, 2.5e-15, 5e-15]),
    (0.0, 1e-6, 100_000, [7e-14, 2e-11, 7e-10]),
    (0.0, 1e-3, 10_000, [5e-12, 6e-8, 2e-7]),
    (0.0, 0.1, 100, [5e-12, 6e-8, 2e-7]),
    (0.0, 10.0, 3, [5e-11, 6e-7, 2e-6]),
    (1e9, 1.0 / 2_097_152.0, 100_000, [7e-14, 1e-11, 6e-10]),
    (1e9, 1.0 / 8_388_608.0, 100_000, [5e-14, 2e-12, 2e-11]),
];

/// The family.
pub fn cases() -> Vec<Case> {
    let mut cases = vec![late()];
    cases.extend(STEPS.into_iter().map(|(from, h, count, bounds)| steps(from, h, count, bounds)));
    cases
}

/// From t = 10⁹ s, where a double knows the time to 1.2e-7 s, in quarters of a second.
fn late() -> Case {
    let whirl = Whirl::paper(0.1, 100.0);
    Case {
        name: "start at t = 10⁹ s, 10 s in quarters".into(),
        hard: "a double knows that time to 1.2e-7 s",
        oracle: "steady whirl in closed form",
        scene: "paper",
        methods: usual([7e-12, 8e-10, 6e-8], [(symplectic(8, 1.0 / 1024.0), 1.5e-10), (at("auto", 1e-8), 2e-7)]),
        mutant: ("support.c2", 1.0 + 1e-5),
        task: follow_from(1e9, 1.0, of_whirl(&whirl), times(10.0, 40), move |t| Exact::of_whirl(&whirl, t)),
    }
}

/// So many communication steps of `h` \[s] from time `from` \[s]; each must be done.
fn steps(from: f64, h: f64, count: u32, bounds: [f64; 3]) -> Case {
    let methods = [at("dop853", 1e-12), at("stiff", 1e-10), at("auto", 1e-8)];
    let whirl = Whirl::paper(0.1, 100.0);
    let settings = of_whirl(&whirl);
    Case {
        name: format!("{count} communication steps of {h:.3e} s from t = {from:e} s"),
        hard: "solver and communication steps of different sizes",
        oracle: "steady whirl in closed form; steps counted",
        scene: "paper",
        methods: methods.into_iter().zip(bounds).collect(),
        mutant: ("start.omega.y", 1.001),
        task: Box::new(move |bench| {
            let mut rotor = bench.rotor(&settings)?;
            rotor.start(from, from + h * f64::from(count))?;
            let (mut found, mut done) = (Found::nothing(), 0);
            for n in 1..=count {
                let t = h * f64::from(n);
                if from == 0.0 {
                    rotor.advance(t)?
                } else {
                    rotor.step(h)?
                }
                done += 1;
                if n % (count / count.min(100)) == 0 {
                    found = Exact::of_whirl(&whirl, t).error(&rotor.shown()?, 1.0, found);
                }
            }
            ensure!(done == count && rotor.last_successful_time()? == rotor.time(), "{done} steps were done");
            Ok(found)
        }),
    }
}
