//! Numbers of a machine as its tables show them.

use std::f64::consts::TAU;

/// So many speeds are shown.
pub const SHOWN: usize = 6;

/// So many of `length`, at most, from the first to the last.
pub fn spread(length: usize, most: usize) -> impl Iterator<Item = usize> {
    let (last, count) = (length - 1, most.min(length));
    (0..count).map(move |n| n * last / (count - 1).max(1))
}

/// A speed [rad/s] in revolutions a minute.
pub fn rpm(speed: f64) -> f64 {
    speed * 60.0 / TAU
}

/// A frequency, or a speed, as people read it.
pub fn rounded(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let digits = libm::floor(libm::log10(value.abs()));
    let decimals = (5.0 - digits).clamp(0.0, 9.0) as usize;
    let rounded = format!("{value:.decimals$}");
    if rounded.contains(|c: char| ('1'..='9').contains(&c)) { rounded } else { "0".into() }
}

/// A length \[m] in µm.
pub fn micrometres(length: f64) -> String {
    rounded(1e6 * length)
}
