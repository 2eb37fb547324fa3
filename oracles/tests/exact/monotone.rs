//! The monotone curve against another program's, which has the same slopes but at the ends.

use oracles::monotone::curve;

const POINTS: [(f64, f64); 6] =
    [(0.0, 1e5), (50.0, 1.5e5), (150.0, 2e5), (300.0, 2.2e5), (420.0, 2.1e5), (1000.0, 3e5)];

/// SciPy 1.17.1, `PchipInterpolator`, away from the ends: their slopes are ours alone.
const FOUND: [(f64, f64); 6] = [
    (60.0, 156810.61201572153),
    (140.0, 197449.3542953397),
    (200.0, 210051.365233847),
    (299.0, 219998.79530683966),
    (333.0, 218147.1875),
    (400.0, 210740.74074074073),
];

#[test]
fn monotone_curve_is_that_of_another_program() {
    for (x, y) in FOUND {
        let found = curve(&POINTS, x);
        assert!((found / y - 1.0).abs() < 1e-15, "{x}: {found:?}, not {y:?}");
    }
}

#[test]
fn monotone_curve_is_level_at_both_ends_and_beyond() {
    let slope = |x: f64, h: f64| (curve(&POINTS, x + h) - curve(&POINTS, x)) / h;
    assert!(slope(0.0, 1e-4).abs() < 1e-2 && slope(1000.0, -1e-4).abs() < 1e-2);
    assert_eq!([-7.0, 0.0, 1000.0, 1e9].map(|x| curve(&POINTS, x)), [1e5, 1e5, 3e5, 3e5]);
    // Halfway between two points with level ends, the middle.
    assert_eq!(curve(&[(2.0, 1.0), (4.0, 5.0)], 3.0), 3.0);
}
