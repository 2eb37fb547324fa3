//! Ordinary differential equations by extrapolation.

/// y a step of size `h` [s] later, dy/dt = f(t, y): the modified midpoint rule in 2, 4, … 16 parts, extrapolated to none.
///
/// Source: Gragg (1965); Bulirsch and Stoer (1966). Of order 16. Checks: `exact_rigid_body.rs`.
pub fn step<const N: usize>(f: impl Fn(f64, &[f64; N]) -> [f64; N], t: f64, y: &[f64; N], h: f64) -> [f64; N] {
    const COLUMNS: u32 = 8;
    let first = f(t, y);
    let mut table: Vec<[f64; N]> = Vec::new();
    for column in 1..=COLUMNS {
        let parts = f64::from(2 * column);
        let mut value = midpoint(&mut |t, y| f(t, y), t, y, &first, h, 2 * column);
        for (previous, fewer) in table.iter_mut().zip((1..column).rev()) {
            let ratio = parts / f64::from(2 * fewer);
            let better = std::array::from_fn(|n| value[n] + (value[n] - previous[n]) / (ratio * ratio - 1.0));
            *previous = std::mem::replace(&mut value, better);
        }
        table.push(value);
    }
    let change = table[COLUMNS as usize - 1];
    std::array::from_fn(|n| y[n] + change[n])
}

/// The same, in so many steps.
pub fn steps<const N: usize>(
    f: impl Fn(f64, &[f64; N]) -> [f64; N],
    t: f64,
    y: &[f64; N],
    h: f64,
    count: u32,
) -> [f64; N] {
    let part = h / f64::from(count);
    (0..count).fold(*y, |y, i| step(&f, t + f64::from(i) * part, &y, part))
}

/// By how much y changes, by Gragg's smoothed midpoint rule in an even number of parts: changes, because extrapolation
/// multiplies their rounding by a hundred.
pub fn midpoint<const N: usize>(
    f: &mut impl FnMut(f64, &[f64; N]) -> [f64; N],
    t: f64,
    y: &[f64; N],
    first: &[f64; N],
    h: f64,
    parts: u32,
) -> [f64; N] {
    let part = h / f64::from(parts);
    let mut rates = |i: u32, change: &[f64; N]| f(t + f64::from(i) * part, &std::array::from_fn(|n| y[n] + change[n]));
    let (mut before, mut now) = ([0.0; N], first.map(|rate| part * rate));
    for i in 1..parts {
        let rates = rates(i, &now);
        let next = std::array::from_fn(|n| before[n] + 2.0 * part * rates[n]);
        before = std::mem::replace(&mut now, next);
    }
    let rates = rates(parts, &now);
    std::array::from_fn(|n| 0.5 * (before[n] + now[n] + part * rates[n]))
}
