//! Rotations, derivatives, integrals, roots, trees and words against known values.

use nalgebra::{Vector2, Vector3};
use oracles::bounds::{largest, within};
use oracles::numerics::{derivative, integral, log_slope, root};
use oracles::words::Series;
use oracles::{rotation, trees};

/// Rodrigues' matrix against quaternions [1]: measured 1e-15.
const RODRIGUES: f64 = 3e-15;

#[test]
fn exact_rotations_agree_among_themselves() {
    let mut worst: f64 = 0.0;
    for i in 0..200 {
        let angle = 0.05 * f64::from(i);
        let n = Vector3::new(libm::cos(angle), libm::sin(3.0 * angle), 0.3 * libm::sin(angle)).normalize();
        let a = n * angle;
        worst = worst.max((rotation::rodrigues(&a) - rotation::matrix(rotation::quaternion(&a))).amax());
    }
    within("Rodrigues against quaternions", worst, RODRIGUES);
    // A quarter turn about z carries x to y.
    let quarter = rotation::rodrigues(&(Vector3::z() * std::f64::consts::FRAC_PI_2));
    within("quarter turn", (quarter * Vector3::x() - Vector3::y()).amax(), RODRIGUES);
}

/// φ and γ out of an attitude [rad]: measured 8.9e-16 up to 3 rad.
const SPLIT: f64 = 3e-15;

#[test]
fn exact_split_of_an_attitude_comes_back() {
    let mut worst: f64 = 0.0;
    for i in 1..60 {
        let (theta, azimuth) = (0.05 * f64::from(i), 0.7 * f64::from(i));
        let gamma = Vector2::new(libm::cos(azimuth), libm::sin(azimuth)) * theta;
        let phi = libm::remainder(0.37 * f64::from(i), std::f64::consts::TAU);
        let attitude = rotation::attitude(phi, &gamma);
        let axis = attitude.column(0).into_owned();
        worst = largest([
            worst,
            (rotation::gamma(&axis) - gamma).norm(),
            libm::remainder(rotation::phi(&attitude) - phi, std::f64::consts::TAU).abs(),
            (axis - rotation::axis(&gamma)).norm(),
        ]);
    }
    within("phi and gamma of an attitude", worst, SPLIT);
}

/// Extrapolated derivative of e^x sin 3x [1]: measured 6e-14.
const DERIVATIVE: f64 = 2e-13;
/// Gauss's rule on a known integral [1]: measured 0.
const INTEGRAL: f64 = 1e-15;

#[test]
fn exact_numerics_agree_with_known_values() {
    let slope = derivative(|x| [libm::exp(x) * libm::sin(3.0 * x)], 0.7, 0.1)[0];
    let known = libm::exp(0.7) * (libm::sin(2.1) + 3.0 * libm::cos(2.1));
    within("derivative", (slope - known).abs(), DERIVATIVE);
    within("integral", (integral(libm::exp, 0.0, 1.0, 4) - libm::expm1(1.0)).abs(), INTEGRAL);
    within("root", (root(|x| x * x - 2.0, 0.0, 2.0) - std::f64::consts::SQRT_2).abs(), f64::EPSILON);
    let points: Vec<_> = (1..9).map(|i| (f64::from(i), 3.0 * libm::pow(f64::from(i), 2.5))).collect();
    within("slope", (log_slope(&points) - 2.5).abs(), f64::EPSILON);
}

#[test]
fn literature_trees_are_as_many_as_cayley_counted() {
    let trees = trees::trees(8);
    let counts: Vec<_> = (1..=8).map(|n| trees.iter().filter(|tree| tree.order() == n).count()).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20, 48, 115]);
    let distinct: std::collections::BTreeSet<_> = trees.iter().collect();
    assert_eq!(distinct.len(), trees.len());
    // 1/γ of the classical method of Kutta (1901), which has order 4 and not 5.
    let a = [[0.0; 4], [0.5, 0.0, 0.0, 0.0], [0.0, 0.5, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]].map(Vec::from);
    let b = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];
    let defect = |tree: &trees::Tree| {
        let sum: f64 = tree.weights(&a).iter().zip(&b).map(|(w, b)| w * b).sum();
        (sum - 1.0 / tree.density()).abs()
    };
    assert!(trees.iter().filter(|tree| tree.order() <= 4).all(|tree| defect(tree) < 1e-15));
    assert!(trees.iter().any(|tree| tree.order() == 5 && defect(tree) > 1e-3));
}

#[test]
fn exact_words_of_a_product_of_two() {
    let series = Series::one(4).times(0, 1.0).times(1, 1.0);
    assert_eq!(series.coefficient(&[0, 0, 1, 1]), 0.25);
    assert_eq!(series.coefficient(&[0, 1, 1, 1]), 1.0 / 6.0);
    assert_eq!(series.coefficient(&[0, 1, 0, 1]), 0.0);
}
