//! Ordinary differential equations by extrapolation: the modified midpoint rule in 2, 4, 6 … parts, extrapolated to none.
//!
//! Source: Gragg (1965); Bulirsch and Stoer (1966); the choice of order and step after Hairer, Nørsett and Wanner, II.9.
//! Checks: `tests/exact/rigid_body.rs`.

/// y a step of size `h` \[s] later, dy/dt = f(t, y), of order 16.
pub fn step<const N: usize>(f: impl Fn(f64, &[f64; N]) -> [f64; N], t: f64, y: &[f64; N], h: f64) -> [f64; N] {
    let gained = change(&mut |t, y| f(t, y), t, y, &f(t, y), h, |column, _, _| column == 8);
    std::array::from_fn(|n| y[n] + gained[n])
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
fn midpoint<const N: usize>(
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

/// As many columns as there may be: order 22.
pub const MOST: usize = 11;

/// By how much y changes within `h` \[s] from `t` \[s] on, where `first` is f(t, y): `enough` is told each column's number, the
/// best change so far and by how much it differs from the one before, and ends the extrapolation.
pub fn change<const N: usize>(
    f: &mut impl FnMut(f64, &[f64; N]) -> [f64; N],
    t: f64,
    y: &[f64; N],
    first: &[f64; N],
    h: f64,
    mut enough: impl FnMut(usize, &[f64; N], &[f64; N]) -> bool,
) -> [f64; N] {
    let mut table = [[0.0; N]; MOST];
    for column in 1..=MOST {
        let mut value = midpoint(f, t, y, first, h, 2 * column as u32);
        let mut difference = [0.0; N];
        for fewer in (1..column).rev() {
            let ratio = column as f64 / fewer as f64;
            let previous = table[column - 1 - fewer];
            difference = std::array::from_fn(|n| (value[n] - previous[n]) / (ratio * ratio - 1.0));
            table[column - 1 - fewer] = value;
            value = std::array::from_fn(|n| value[n] + difference[n]);
        }
        table[column - 1] = value;
        if enough(column, &value, &difference) {
            return value;
        }
    }
    table[MOST - 1]
}

/// How many evaluations so many columns take, but for the first, which all steps from one point share.
pub fn cost(columns: usize) -> usize {
    columns * (columns + 1)
}
