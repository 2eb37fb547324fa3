//! A logarithmic axis, with numbers at powers of ten.

use plotters::coord::combinators::{IntoLogRange, LogCoord};
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// From one positive number to another.
pub struct Decades {
    along: LogCoord<f64>,
    numbers: Vec<f64>,
}

/// So many numbers are read easily.
const NUMBERS: i32 = 9;

/// Numbers between these are written without a power of ten.
const PLAIN: Range<f64> = 1e-3..1e5;

impl Decades {
    /// Of this range.
    pub fn of(range: Range<f64>) -> Self {
        let [from, to] = [range.start, range.end].map(|end| libm::floor(libm::log10(end) + 1e-9) as i32);
        // Within two decades some between, where there are many not each.
        let parts: &[f64] = if to - from <= 1 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let step = 1 + (to - from) / NUMBERS;
        let all =
            (from..=to).step_by(step as usize).flat_map(|power| parts.iter().map(move |part| number(*part, power)));
        let is_seen = |number: &f64| (range.start * (1.0 - 1e-9)..=range.end * (1.0 + 1e-9)).contains(number);
        Self { numbers: all.filter(is_seen).collect(), along: range.log_scale().into() }
    }
}

/// As it is written: a power would be rounded.
fn number(part: f64, power: i32) -> f64 {
    format!("{part}e{power}").parse().expect("it is a number")
}

impl Ranged for Decades {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        self.along.map(value, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, _hint: Hint) -> Vec<f64> {
        self.numbers.clone()
    }

    fn range(&self) -> Range<f64> {
        self.along.range()
    }
}

impl ValueFormatter<f64> for Decades {
    fn format(value: &f64) -> String {
        if PLAIN.contains(value) { value.to_string() } else { format!("{value:e}") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_people_write_them() {
        let written = |range| Decades::of(range).numbers.iter().map(Decades::format).collect::<Vec<_>>();
        assert_eq!(written(1e-6..0.1), ["1e-6", "1e-5", "1e-4", "0.001", "0.01", "0.1"]);
        assert_eq!(written(5.0..40.0), ["5", "10", "20"]);
    }
}
