//! How fast the fastest part of linear equations changes.

/// The matrix is squared so often: its power is then the 64th.
const SQUARINGS: i32 = 6;

/// The largest |λ| [1/s] of dy/dt = J y, of which the first `size` numbers matter; within some per cent.
pub fn spectral_radius<const N: usize>(jacobian: &[[f64; N]; N], size: usize) -> f64 {
    let mut power = *jacobian;
    let mut exponent = 0.0;
    for _ in 0..SQUARINGS {
        let largest = norm(&power, size);
        if !(largest > 0.0 && largest.is_finite()) {
            return 0.0;
        }
        power = squared(&power, size, 1.0 / largest);
        exponent = 2.0 * (exponent + libm::log2(largest));
    }
    // eq. 87: |λ| = lim |Jⁿ|^(1/n)
    libm::exp2((exponent + libm::log2(norm(&power, size))) / f64::from(1 << SQUARINGS))
}

/// (scale A)²
fn squared<const N: usize>(a: &[[f64; N]; N], size: usize, scale: f64) -> [[f64; N]; N] {
    let scaled = a.map(|row| row.map(|number| number * scale));
    let entry = |i: usize, j: usize| (0..size).map(|k| scaled[i][k] * scaled[k][j]).sum();
    std::array::from_fn(|i| std::array::from_fn(|j| if i < size && j < size { entry(i, j) } else { 0.0 }))
}

/// The largest sum of a row's magnitudes.
fn norm<const N: usize>(a: &[[f64; N]; N], size: usize) -> f64 {
    let sum = |row: &[f64; N]| row[..size].iter().map(|number| number.abs()).sum::<f64>();
    a[..size].iter().map(sum).fold(0.0, |most, sum| if sum > most || sum.is_nan() { sum } else { most })
}
