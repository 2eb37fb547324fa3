//! Derivatives, integrals, roots and slopes of what is known in closed form.

use nalgebra::Complex;

/// The derivative of f at x by central differences of the steps h, h/2, h/4, …, extrapolated to zero step.
///
/// Source: Richardson (1911), Neville's scheme in h². Truncation O(h^(2·levels)); rounding about ε|f|/(h/2^(levels−1)).
pub fn derivative<const N: usize>(f: impl Fn(f64) -> [f64; N], x: f64, h: f64) -> [f64; N] {
    const LEVELS: usize = 6;
    let mut table: Vec<[f64; N]> = Vec::new();
    for level in 0..LEVELS {
        let step = h / f64::from(1 << level);
        let (ahead, behind) = (f(x + step), f(x - step));
        let mut value: [f64; N] = std::array::from_fn(|n| (ahead[n] - behind[n]) / (2.0 * step));
        let mut power = 1.0;
        for previous in table.iter_mut() {
            power *= 4.0;
            let better = std::array::from_fn(|n| value[n] + (value[n] - previous[n]) / (power - 1.0));
            *previous = std::mem::replace(&mut value, better);
        }
        table.push(value);
    }
    // The diagonal of Neville's scheme: the last entry is the one with all levels.
    table[LEVELS - 1]
}

/// ∫ f from a to b by Gauss's rule of five points (order 10) on `panels` equal parts.
pub fn integral(f: impl Fn(f64) -> f64, a: f64, b: f64, panels: usize) -> f64 {
    const NODES: [f64; 3] = [0.0, 0.538_469_310_105_683_1, 0.906_179_845_938_664];
    const WEIGHTS: [f64; 3] = [0.568_888_888_888_888_9, 0.478_628_670_499_366_5, 0.236_926_885_056_189_1];
    let half = 0.5 * (b - a) / panels as f64;
    let mut sum = 0.0;
    for panel in 0..panels {
        let middle = a + (2 * panel + 1) as f64 * half;
        sum += WEIGHTS[0] * f(middle);
        for i in 1..3 {
            sum += WEIGHTS[i] * (f(middle - NODES[i] * half) + f(middle + NODES[i] * half));
        }
    }
    sum * half
}

/// The root of f between a and b, where its sign changes, by bisection to the last bit.
pub fn root(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    assert!(f(a) * f(b) < 0.0, "no change of sign between {a} and {b}");
    loop {
        let middle = 0.5 * (a + b);
        if middle == a || middle == b {
            return middle;
        }
        if f(a) * f(middle) <= 0.0 {
            b = middle;
        } else {
            a = middle;
        }
    }
}

/// The slope of the line of least squares through (ln x, ln y).
pub fn log_slope(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<_> = points.iter().map(|&(x, y)| (libm::log(x), libm::log(y))).collect();
    let n = logs.len() as f64;
    let (mx, my) = (logs.iter().map(|p| p.0).sum::<f64>() / n, logs.iter().map(|p| p.1).sum::<f64>() / n);
    let up: f64 = logs.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
    up / logs.iter().map(|p| (p.0 - mx) * (p.0 - mx)).sum::<f64>()
}

/// The roots of a x² + b x + c = 0, the one of the larger imaginary part first.
pub fn quadratic(a: f64, b: Complex<f64>, c: Complex<f64>) -> [Complex<f64>; 2] {
    let root = square_root(b * b - c * (4.0 * a));
    let mut roots = [-b + root, -b - root].map(|sum| sum / (2.0 * a));
    roots.sort_by(|p, q| q.im.total_cmp(&p.im));
    roots
}

/// The square root with a real part ≥ 0.
fn square_root(z: Complex<f64>) -> Complex<f64> {
    let size = libm::hypot(z.re, z.im);
    let part = |x: f64| (0.5 * (size + x)).max(0.0).sqrt();
    Complex::new(part(z.re), libm::copysign(part(-z.re), z.im))
}

/// exp z.
pub fn exp(z: Complex<f64>) -> Complex<f64> {
    Complex::new(libm::cos(z.im), libm::sin(z.im)) * libm::exp(z.re)
}
