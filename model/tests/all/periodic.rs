//! Motions that repeat with each revolution: against closed forms, against runs that settle, and through folds.

use crate::harness::named::Named;
use nalgebra::{Complex, ComplexField};
use split_rotor_model::linear::Machine;
use split_rotor_model::periodic::Rotating;

fn rotating(text: &str) -> Rotating {
    Rotating::of(Named::written(text).simulation.parameters()).unwrap_or_else(|obstacle| panic!("{obstacle}"))
}

#[test]
fn try_it() {
    let text = "[rotor]\nm = 5.0\nJa = 0.05\nJt = 0.08\n[effects.gravity]\ng = { x = -3.0, z = -9.81 }\n\
                [[effects.bearing]]\nposition = -0.2\nkyy = 2e5\nkzz = 1e5\nkyz = 1e4\nkzy = 1e4\ncyy = 400.0\nczz = 300.0\nkxx = 1e5\ncxx = 300.0\n\
                [[effects.bearing]]\nposition = 0.3\nkyy = 1e5\nkzz = 2e5\ncyy = 300.0\nczz = 400.0\n\
                [[effects.unbalance]]\nmass = 1e-3\nradius = 1e-3\nangle = 0.4\nposition = 0.1\n";
    let machine = Machine::of(Named::written(text).simulation.parameters()).unwrap();
    let all = rotating(text);
    let start = std::time::Instant::now();
    for speed in [20.0, 120.0, 250.0, -300.0] {
        let linear = machine.response(speed, None).unwrap();
        let orbit = all.orbit(speed, None).unwrap();
        let path = orbit.path(0.25);
        println!(
            "{speed} {:e} {:e} size {:e}",
            (path.once.y - linear.orbit(0.25).y).modulus() / path.once.major(),
            path.reach,
            orbit.size
        );
        let modes = machine.modes(speed, None).unwrap().1;
        for mode in &modes {
            let mu = (mode.eigenvalue * std::f64::consts::TAU / speed.abs()).exp();
            let near = orbit.multipliers.iter().map(|m| (m - mu).modulus()).fold(f64::INFINITY, f64::min);
            print!(" {near:.1e}");
        }
        println!(" {:?}", orbit.loss());
    }
    println!("{:?}", start.elapsed());
    let start = std::time::Instant::now();
    let branch = all.branch([10.0, 600.0], 100).unwrap();
    println!("{} {:?} {:?}", branch.orbits.len(), branch.end, start.elapsed());
    let ring = "[rotor]\nm = 5.0\nJa = 0.05\nJt = 0.08\n\
                [[effects.bearing]]\nposition = -0.2\nkyy = 1e5\nkzz = 1e5\ncyy = 60.0\nczz = 60.0\nkxx = 1e5\ncxx = 300.0\n\
                [[effects.bearing]]\nposition = 0.2\nkyy = 1e5\nkzz = 1e5\ncyy = 60.0\nczz = 60.0\n\
                [[effects.unbalance]]\nmass = 1e-2\nradius = 5e-2\nposition = 0.0\n\
                [[effects.rub]]\nposition = 0.0\ngap = 3e-4\nstiffness = 4e5\nradius = 0.05\nv0 = 0.01\n";
    let all = rotating(ring);
    let start = std::time::Instant::now();
    let branch = all.branch([100.0, 600.0], 100).unwrap();
    println!("{} {:?} {:?}", branch.orbits.len(), branch.end, start.elapsed());
    for orbit in &branch.orbits {
        let path = orbit.path(0.0);
        let worst = orbit.multipliers.iter().map(|m| m.modulus()).fold(0.0, f64::max);
        println!("{:8.2} {:9.3e} {:9.3e} {worst:.6} {:?}", orbit.speed, path.once.major(), path.farthest, orbit.loss());
    }
    println!("folds {:?}", branch.folds().map(|n| branch.orbits[n].speed).collect::<Vec<_>>());
}
