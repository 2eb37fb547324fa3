//! The eigenvalues of a rotor in bearings against closed forms, and in the equations that they solve.

use nalgebra::{Complex, ComplexField};
use oracles::bounds::{largest, within};
use oracles::whirl::{Bearing, Whirl};

/// Of the size of each eigenvalue that no other one equals, and of equal ones [1]: measured 2e-16 and
/// 4e-13.
const CLOSED: [f64; 2] = [1e-13, 1e-6];

/// How nearly they solve the equations [1]: measured 2e-16, and 4e-13 of equal ones.
const RESIDUAL: [f64; 2] = [1e-14, 1e-11];

fn roots(a: f64, b: Complex<f64>, c: f64) -> [Complex<f64>; 2] {
    let root = (b * b - Complex::from(4.0 * a * c)).sqrt();
    [(-b + root) / (2.0 * a), (-b - root) / (2.0 * a)]
}

/// Two equal bearings at ±0.2 m, across y and z.
fn whirl([ky, kz]: [f64; 2], speed: f64) -> Whirl {
    let bearing = |position: f64| Bearing { position, k: [[ky, 0.0], [0.0, kz]], c: [[30.0, 0.0], [0.0, 30.0]] };
    Whirl { m: 6.0, Ja: 0.01, Jt: 0.06, speed, bearings: vec![bearing(-0.2), bearing(0.2)] }
}

fn compare(whirl: &Whirl, exact: &[Complex<f64>], kind: usize) {
    let found = whirl.eigenvalues();
    let apart = |exact: &Complex<f64>| {
        let near = found.iter().map(|one| (one - exact).modulus()).fold(f64::INFINITY, f64::min);
        near / exact.modulus()
    };
    within("eigenvalues", largest(exact.iter().map(apart)), CLOSED[kind]);
    within("residual", largest(found.iter().map(|one| whirl.residual(*one))), RESIDUAL[kind]);
}

#[test]
fn exact_eigenvalues_of_a_rotor_in_equal_bearings() {
    let of_place = |k: f64| roots(6.0, Complex::from(60.0), 2.0 * k);
    let of_tilt = |k: f64, turns: f64| roots(0.06, Complex::new(60.0 * 0.04, turns), 0.08 * k);
    for [ky, kz] in [[4e4, -3e4], [-4e4, 1e4], [-4e4, -7e3]] {
        let exact = [of_place(ky), of_place(kz), of_tilt(ky, 0.0), of_tilt(kz, 0.0)];
        compare(&whirl([ky, kz], 0.0), exact.as_flattened(), 0);
    }
    for k in [4e4, -4e4] {
        let turns = 0.01 * 700.0;
        let exact = [of_place(k), of_tilt(k, turns), of_tilt(k, -turns)];
        compare(&whirl([k, k], 700.0), exact.as_flattened(), 1);
    }
}
