//! Machines that more than one test knows.

use super::{Bearing, Input, Machine, Start, Unbalance};
use nalgebra::Vector3;

/// Nothing holds it: `auto` once let it drift whatever acted on it.
pub fn drifting() -> Machine {
    Machine {
        m: 5.0,
        Ja: 0.15625,
        Jt: 0.078125,
        l: 0.75,
        start: Start { r_c: Vector3::x() * 0.75, omega: Vector3::new(50.0, 5.0, 0.0), ..Start::default() },
        ..Machine::default()
    }
}

/// Two bearings and an unbalance, run up through its critical speeds: what every visitor brings.
pub fn ordinary() -> Machine {
    let bearing = |position: f64| Bearing {
        position,
        k: [[2e7, 0.0], [0.0, 1.5e7]],
        c: [[2000.0, 0.0], [0.0, 2000.0]],
        ..Bearing::default()
    };
    Machine {
        m: 12.0,
        Ja: 0.04,
        Jt: 0.12,
        bearings: vec![bearing(-0.12), bearing(0.12)],
        unbalances: vec![Unbalance { mass: 0.002, radius: 0.02, angle: 0.0, position: 0.0 }],
        drive: true,
        inputs: vec![(Input::Torque, 24.0)],
        ..Machine::default()
    }
}
