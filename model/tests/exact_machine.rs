//! The oracle of a machine with all effects, and the extrapolation that integrates it, beside closed forms and beside other
//! oracles, each for the effects that it knows.

mod harness;
mod oracles;

use harness::{largest, within};
use nalgebra::Vector3;
use oracles::machine::{Machine, Pace, Run, Start, Support};
use oracles::{paper, rotation};

/// What its steps may err, over how far the motion goes [1].
const STEP: f64 = 1e-13;

/// The steps that it takes to these times [s] by its own choice, halved.
fn halved(machine: &Machine, times: &[f64]) -> Run {
    let mut run = Run::new(machine, Pace::Adaptive(STEP));
    for t in times {
        assert!(run.advance(*t), "a motion");
    }
    Run::new(machine, Pace::Like(run.taken(), 2))
}

/// r_c [m], axis [1] and φ [rad], 0 … 10 s: measured 1.3e-14, 4.9e-14, 6.8e-13.
const PAPER: [f64; 3] = [5e-14, 2e-13, 2e-12];

#[test]
fn literature_it_is_the_papers_rotor() {
    let machine = Machine {
        m: 5.0,
        Ja: 0.15625,
        Jt: 0.078125,
        l: 0.75,
        start: Start { r_c: Vector3::x() * 0.75, omega: Vector3::x() * 50.0, ..Start::default() },
        gravity: Some(Vector3::z() * -9.81),
        support: Some(Support { c: [2000.0, 500.0], d: [0.0; 2] }),
        ..Machine::default()
    };
    let instants = &paper::instants()[1..];
    let times: Vec<_> = instants.iter().map(|instant| instant.t).collect();
    let mut run = halved(&machine, &times);
    let errors: Vec<_> = instants
        .iter()
        .map(|instant| {
            assert!(run.advance(instant.t), "a motion");
            let shown = run.show();
            let axis = rotation::axis(&instant.gamma);
            [(shown.r_c - instant.r_c).norm(), (shown.axis - axis).norm(), (shown.phi - instant.phi).abs()]
        })
        .collect();
    for (n, what) in ["r_c", "axis", "phi"].into_iter().enumerate() {
        within(what, largest(errors.iter().map(|error| error[n])), PAPER[n]);
    }
}
