//! What a run shows at its communication points, and how far two runs are apart.

/// The rotor at one communication point. What somebody does not tell is NaN.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Position of the mass centre [m].
    pub r_c: [f64; 3],
    /// The rotor axis t, of any length but zero.
    pub axis: [f64; 3],
    /// φ = 2π `turns` + `angle` [rad], kept apart for its last digits.
    pub turns: f64,
    /// See `turns`.
    pub angle: f64,
    /// What the energy ledger leaves over: zero for an exact solution [J].
    pub residual: f64,
    /// Kinetic and potential energy [J].
    pub energy: f64,
    /// Kinetic energy [J].
    pub kinetic: f64,
}

/// How far a motion is off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Distance of the mass centres [m].
    pub r_c: f64,
    /// Angle between the axes [rad].
    pub axis: f64,
    /// Difference of φ [rad].
    pub phi: f64,
    /// Drift of the energy [J], which does not compare with the other motion.
    pub energy: f64,
}

impl Errors {
    /// Of one point against another.
    pub fn between(point: &Point, exact: &Point) -> Self {
        Self {
            r_c: length(difference(point.r_c, exact.r_c)),
            axis: length(cross(point.axis, exact.axis)).atan2(dot(point.axis, exact.axis)),
            phi: (std::f64::consts::TAU * (point.turns - exact.turns) + (point.angle - exact.angle)).abs(),
            energy: point.residual.abs(),
        }
    }

    /// At the last point, and the worst over all points.
    pub fn of(points: &[Point], exact: &[Point]) -> [Self; 2] {
        let all: Vec<_> = points.iter().zip(exact).map(|(point, exact)| Self::between(point, exact)).collect();
        let worst = all.iter().copied().reduce(Self::worse).expect("a run has points");
        [all[all.len() - 1], worst]
    }

    /// The larger of each; what is not a number stays so.
    fn worse(self, other: Self) -> Self {
        let larger = |a: f64, b: f64| if a > b || a.is_nan() { a } else { b };
        Self {
            r_c: larger(self.r_c, other.r_c),
            axis: larger(self.axis, other.axis),
            phi: larger(self.phi, other.phi),
            energy: larger(self.energy, other.energy),
        }
    }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXACT: Point = Point {
        r_c: [1.0, 2.0, 3.0],
        axis: [1.0, 0.0, 0.0],
        turns: 7.0,
        angle: 0.25,
        residual: 0.0,
        energy: 5.0,
        kinetic: 4.0,
    };

    #[test]
    fn exact_errors_of_a_known_difference() {
        let point = Point {
            r_c: [1.0, 2.0 + 3e-6, 3.0 - 4e-6],
            // An axis need not have length 1, and a small angle keeps its digits.
            axis: [2.0, 2e-9, 0.0],
            turns: 6.0,
            angle: 0.25 + std::f64::consts::TAU - 1e-6,
            residual: -2e-7,
            ..EXACT
        };
        let errors = Errors::between(&point, &EXACT);
        assert!((errors.r_c - 5e-6).abs() < 1e-15, "{errors:?}");
        assert!((errors.axis - 1e-9).abs() < 1e-24, "{errors:?}");
        assert!((errors.phi - 1e-6).abs() < 1e-14, "{errors:?}");
        assert_eq!(errors.energy, 2e-7);
    }

    #[test]
    fn exact_the_end_is_last_and_the_worst_is_largest() {
        let moved = |x| Point { r_c: [1.0 + x, 2.0, 3.0], ..EXACT };
        let unknown = Point { angle: f64::NAN, ..EXACT };
        let [end, worst] = Errors::of(&[moved(0.25), moved(0.5), unknown, moved(0.125)], &[EXACT; 4]);
        assert_eq!((end.r_c, worst.r_c), (0.125, 0.5));
        assert_eq!(end.phi, 0.0);
        assert!(worst.phi.is_nan());
    }
}
