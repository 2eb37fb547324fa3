//! What a run shows at its communication points, and how far two runs are apart.

use nalgebra::Vector3;

/// The rotor at one communication point. What somebody does not tell is NaN.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Position of the mass centre \[m].
    pub r_c: Vector3<f64>,
    /// The rotor axis t, of any length but zero.
    pub axis: Vector3<f64>,
    /// φ = 2π `turns` + `angle` \[rad], kept apart for its last digits.
    pub turns: f64,
    /// See `turns`.
    pub angle: f64,
    /// What the energy ledger leaves over: zero for an exact solution \[J].
    pub residual: f64,
    /// Kinetic and potential energy \[J].
    pub energy: f64,
    /// Kinetic energy \[J].
    pub kinetic: f64,
}

impl Point {
    /// Whether it shows numbers.
    pub fn is_finite(&self) -> bool {
        let others = [self.turns, self.angle, self.residual];
        self.r_c.iter().chain(&self.axis).chain(&others).all(|x| x.is_finite())
    }

    /// How far the place is from that of another, across e \[m].
    fn across(&self, other: &Self) -> f64 {
        (self.r_c - other.r_c).yz().norm()
    }

    /// The angle between the axes \[rad].
    fn tilt(&self, other: &Self) -> f64 {
        self.axis.cross(&other.axis).norm().atan2(self.axis.dot(&other.axis))
    }

    /// By what φ differs \[rad].
    fn turn(&self, other: &Self) -> f64 {
        (std::f64::consts::TAU * (self.turns - other.turns) + (self.angle - other.angle)).abs()
    }
}

/// The least size of a motion, of place \[m] and axis \[rad]: smaller ones are rounding.
const LEAST: [f64; 2] = [1e-12, 1e-9];

/// How large a motion is, which its errors are relative to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// How far the place goes from where it starts, across e \[m].
    pub place: f64,
    /// How far the axis goes from where it starts \[rad].
    pub axis: f64,
    /// How far φ goes from where it starts \[rad].
    pub phi: f64,
}

impl Sizes {
    /// Of these points after a start.
    pub fn of(start: &Point, points: &[Point]) -> Self {
        let largest = |of: fn(&Point, &Point) -> f64| points.iter().map(|point| of(point, start)).fold(0.0, f64::max);
        Self { place: largest(Point::across), axis: largest(Point::tilt), phi: largest(Point::turn) }
    }
}

/// The worst errors of a run, each over the motion's own size \[1]. What nobody tells is NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relative {
    /// Of the place across e, over how far it goes.
    pub place: f64,
    /// Of the axis, over how far it goes.
    pub axis: f64,
    /// Of φ, over how far it has come by then, but 1 rad at least.
    pub phi: f64,
}

impl Relative {
    /// Of these points against the exact ones after a start, of a motion of these sizes; points that do not tell are passed over.
    pub fn of(points: &[Point], start: &Point, exact: &[Point], sizes: &Sizes) -> Self {
        let worst = |off: fn(&Point, &Point) -> f64, size: &dyn Fn(&Point) -> f64| {
            let all = points.iter().zip(exact).map(|(point, exact)| off(point, exact) / size(exact));
            all.fold(f64::NAN, f64::max)
        };
        Self {
            place: worst(Point::across, &|_| sizes.place.max(LEAST[0])),
            axis: worst(Point::tilt, &|_| sizes.axis.max(LEAST[1])),
            phi: worst(Point::turn, &|exact| exact.turn(start).max(1.0)),
        }
    }

    /// The worst of the three, of those that are told: the error of the run.
    pub fn worst(&self) -> f64 {
        self.place.max(self.axis).max(self.phi)
    }
}

/// How far a motion is off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Distance of the mass centres \[m].
    pub r_c: f64,
    /// Angle between the axes \[rad].
    pub axis: f64,
    /// Difference of φ \[rad].
    pub phi: f64,
    /// Drift of the energy \[J], which does not compare with the other motion.
    pub energy: f64,
}

impl Errors {
    /// Of one point against another.
    pub fn between(point: &Point, exact: &Point) -> Self {
        Self {
            r_c: (point.r_c - exact.r_c).norm(),
            axis: point.tilt(exact),
            phi: point.turn(exact),
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

#[cfg(test)]
mod tests {
    use super::*;

    const EXACT: Point = Point {
        r_c: Vector3::new(1.0, 2.0, 3.0),
        axis: Vector3::new(1.0, 0.0, 0.0),
        turns: 7.0,
        angle: 0.25,
        residual: 0.0,
        energy: 5.0,
        kinetic: 4.0,
    };

    #[test]
    fn errors_of_a_known_difference() {
        let point = Point {
            r_c: Vector3::new(1.0, 2.0 + 3e-6, 3.0 - 4e-6),
            // An axis need not have length 1, and a small angle keeps its digits.
            axis: Vector3::new(2.0, 2e-9, 0.0),
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

    /// A whirl of 20 µm that an upright axis goes with: only the place tells that it is wrong.
    #[test]
    fn an_error_of_the_place_counts_where_the_axis_does_not_tilt() {
        let at = |y: f64, z: f64, angle: f64| Point { r_c: Vector3::new(1.0, y, z), angle, turns: 0.0, ..EXACT };
        let start = at(1e-3, 0.0, 0.0);
        let exact = [at(1e-3, 2e-5, 3.0), at(1e-3 - 1e-5, 0.0, 100.0)];
        let wrong = [at(1e-3, 0.8e-5, 3.0), at(1e-3 - 1e-5, 0.0, 100.5)];
        assert_eq!(Sizes::of(&start, &exact), Sizes { place: 2e-5, axis: 0.0, phi: 100.0 });
        let sizes = Sizes::of(&start, &exact);
        let off = Relative::of(&wrong, &start, &exact, &sizes);
        assert!((off.place - 0.6).abs() < 1e-12, "{off:?}");
        assert_eq!((off.axis, off.phi), (0.0, 5e-3));
        assert_eq!(off.worst(), off.place);
        // Along e there is no size to compare with.
        let along = [Point { r_c: Vector3::new(2.0, 1e-3, 2e-5), ..exact[0] }, exact[1]];
        assert_eq!(Relative::of(&along, &start, &exact, &sizes).worst(), 0.0);
    }

    #[test]
    fn each_error_is_relative_to_its_own_size() {
        let tilted = |tilt: f64, y: f64| Point {
            r_c: Vector3::y() * y,
            axis: Vector3::new(tilt.cos(), 0.0, tilt.sin()),
            ..EXACT
        };
        let (start, exact) = (tilted(0.5, 0.0), [tilted(0.5 + 1e-4, 0.0), tilted(0.5, 0.0)]);
        let sizes = Sizes::of(&start, &exact);
        let off = Relative::of(&[exact[0], tilted(0.5 - 1e-6, 0.0)], &start, &exact, &sizes);
        assert!((off.axis - 1e-2).abs() < 1e-9, "{off:?}");
        // What does not move counts with the least size: that it moves is an error, and nothing off is none.
        assert_eq!(off.place, 0.0);
        assert_eq!(Relative::of(&[tilted(0.5, 1e-3), exact[1]], &start, &exact, &sizes).place, 1e9);
    }

    #[test]
    fn what_is_not_told_is_passed_over() {
        let nan = Point { r_c: Vector3::repeat(f64::NAN), axis: Vector3::repeat(f64::NAN), angle: f64::NAN, ..EXACT };
        let moved = Point { r_c: Vector3::new(1.0, 2.0, 3.5), ..EXACT };
        let sizes = Sizes::of(&EXACT, &[moved]);
        let off = Relative::of(&[nan, Point { angle: f64::NAN, ..EXACT }], &EXACT, &[moved, moved], &sizes);
        assert_eq!((off.place, off.axis), (1.0, 0.0));
        assert!(off.phi.is_nan() && off.worst() == 1.0);
        assert!(!nan.is_finite() && moved.is_finite());
        assert!(Relative::of(&[nan], &EXACT, &[moved], &sizes).worst().is_nan());
    }

    #[test]
    fn the_end_is_last_and_the_worst_is_largest() {
        let moved = |x| Point { r_c: Vector3::new(1.0 + x, 2.0, 3.0), ..EXACT };
        let unknown = Point { angle: f64::NAN, ..EXACT };
        let [end, worst] = Errors::of(&[moved(0.25), moved(0.5), unknown, moved(0.125)], &[EXACT; 4]);
        assert_eq!((end.r_c, worst.r_c), (0.125, 0.5));
        assert_eq!(end.phi, 0.0);
        assert!(worst.phi.is_nan());
    }
}
