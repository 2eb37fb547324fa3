//! Where a path comes closest to the origin.

use nalgebra::Vector2;

/// A time and where the path is then.
pub(super) type Place = (f64, Vector2<f64>);

/// So many places are looked at beside the ends and the middle: for a place to 1e-9 of the way, and on a straight one to rounding.
const LOOKS: u32 = 16;

/// Every so many looks the longer part is cut, so that what is no parabola is closed in on as well.
const CUT: u32 = 3;

/// The shorter part of a golden section \[1].
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// The place closest to the origin between these times, by parabolas through the squares of three distances (Brent, Algorithms for
/// Minimization without Derivatives, 1973, chapter 5).
pub(super) fn closest_to_origin(from: f64, to: f64, mut at: impl FnMut(f64) -> Vector2<f64>) -> Place {
    let mut look = |t: f64| (t, at(t));
    let square = |place: Place| place.1.norm_squared();
    let mut three = [look(from), look(0.5 * (from + to)), look(to)];
    for n in 1..=LOOKS {
        let [a, b, c] = three;
        // Where an end is the closest, it is between that and the middle.
        if square(a) < square(b) {
            three = [a, look(a.0 + GOLDEN * (b.0 - a.0)), b];
            continue;
        }
        if square(c) < square(b) {
            three = [b, look(c.0 - GOLDEN * (c.0 - b.0)), c];
            continue;
        }
        let [before, after] = [b.0 - a.0, c.0 - b.0];
        // The lowest place of the parabola through a, b and c
        let [left, right] = [before * (square(b) - square(c)), after * (square(b) - square(a))];
        let lowest = b.0 - 0.5 * (before * left - after * right) / (left + right);
        let is_within = a.0 < lowest && lowest < c.0 && lowest != b.0;
        let cut = if before > after { b.0 - GOLDEN * before } else { b.0 + GOLDEN * after };
        let next = look(if is_within && n % CUT != 0 { lowest } else { cut });
        three = match (next.0 < b.0, square(next) < square(b)) {
            (true, true) => [a, next, b],
            (true, false) => [next, b, c],
            (false, true) => [b, next, c],
            (false, false) => [a, b, next],
        };
    }
    three.into_iter().fold(three[1], |best, place| if square(place) < square(best) { place } else { best })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_the_closest_place_of_straight_and_curved_paths() {
        for (bend, off) in [(0.0, 0.3), (0.0, 1e-9), (0.4, 1e-3), (-0.8, 1e-6), (3.0, 0.05)] {
            for middle in [0.02, 0.3, 0.5, 0.77, 0.999] {
                let path = |t: f64| Vector2::new(2.0 * (t - middle), off + bend * (t - middle) * (t - middle));
                let (t, place) = closest_to_origin(0.0, 1.0, path);
                // Beside the closest place, by a second way: thirds.
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..200 {
                    let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
                    if path(a).norm_squared() < path(b).norm_squared() { high = b } else { low = a }
                }
                let least = path(low).norm();
                assert!(
                    (place.norm() - least).abs() <= 1e-9 + 1e-12,
                    "{bend} {off} {middle}: {t}, {} {least}",
                    place.norm()
                );
            }
        }
    }
}
