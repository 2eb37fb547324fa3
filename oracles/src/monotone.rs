//! A curve through points that is monotone between them: cubics of Bézier's, whose slopes at inner points are harmonic means of the
//! secants beside them, weighted by how near these are (Fritsch and Butland 1984), and none at both ends; level beyond.
//!
//! Checks: `tests/exact/monotone.rs`.

/// The curve through points (x, y), x ascending, at `x`.
pub fn curve(points: &[(f64, f64)], x: f64) -> f64 {
    piece(points, points.partition_point(|point| point.0 <= x), x)
}

/// At `x`, within it or not, the piece of the curve that so many points are below or at the lower end of.
pub fn piece(points: &[(f64, f64)], above: usize, x: f64) -> f64 {
    let (first, last) = (points[0], points[points.len() - 1]);
    if above == 0 {
        return first.1;
    }
    if above == points.len() {
        return last.1;
    }
    let ((x0, y0), (x1, y1)) = (points[above - 1], points[above]);
    let third = (x1 - x0) / 3.0;
    let inner = [y0 + third * slope(points, above - 1), y1 - third * slope(points, above)];
    let s = (x - x0) / (x1 - x0);
    let mut control = [y0, inner[0], inner[1], y1];
    // De Casteljau.
    for left in (1..4).rev() {
        for n in 0..left {
            control[n] = (1.0 - s) * control[n] + s * control[n + 1];
        }
    }
    control[0]
}

fn slope(points: &[(f64, f64)], n: usize) -> f64 {
    if n == 0 || n == points.len() - 1 {
        return 0.0;
    }
    let [(x0, y0), (x1, y1), (x2, y2)] = [points[n - 1], points[n], points[n + 1]];
    let (secants, spans) = ([(y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1)], [x1 - x0, x2 - x1]);
    if secants[0].signum() != secants[1].signum() || secants.contains(&0.0) {
        return 0.0;
    }
    let whole = spans[0] + spans[1];
    // The nearer secant counts with up to two thirds.
    let part = (spans[0] + 2.0 * spans[1]) / (3.0 * whole);
    1.0 / (part / secants[0] + (1.0 - part) / secants[1])
}
