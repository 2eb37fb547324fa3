//! Axes with the numbers that people expect: a logarithmic one with powers of ten, one of angles with right angles.

use plotters::coord::combinators::{IntoLogRange, LogCoord};
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use std::ops::Range;

/// An axis with these numbers.
pub struct Numbered<C> {
    along: C,
    numbers: Vec<f64>,
}

/// So many numbers are read easily.
const POWERS: i32 = 9;
const ANGLES: f64 = 8.0;

/// Numbers between these are written without a power of ten.
const PLAIN: Range<f64> = 1e-3..1e5;

/// From one positive number to another, logarithmic.
pub fn decades(range: Range<f64>) -> Numbered<LogCoord<f64>> {
    let [from, to] = [range.start, range.end].map(|end| libm::floor(libm::log10(end) + 1e-9) as i32);
    // Within three decades some between, where there are many not each.
    let parts: &[f64] = if to - from <= 2 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let step = 1 + (to - from) / POWERS;
    let all = (from..=to).step_by(step as usize).flat_map(|power| parts.iter().map(move |part| number(*part, power)));
    let is_seen = |number: &f64| (range.start * (1.0 - 1e-9)..=range.end * (1.0 + 1e-9)).contains(number);
    Numbered { numbers: all.filter(is_seen).collect(), along: range.log_scale().into() }
}

/// As it is written: a power would be rounded.
fn number(part: f64, power: i32) -> f64 {
    format!("{part}e{power}").parse().expect("it is a number")
}

/// That holds all of these angles \[°], from one multiple of a right angle to another.
pub fn degrees(angles: impl Iterator<Item = f64>) -> Numbered<RangedCoordf64> {
    let (least, most) = angles.fold((0.0, 0.0), |(least, most): (f64, f64), angle| (least.min(angle), most.max(angle)));
    let step = 90.0 * libm::ceil((most - least) / 90.0 / ANGLES).max(1.0);
    // A little room, or rounding would be a step.
    let [from, to] = [libm::ceil(least / step - 0.99), libm::floor(most / step + 0.99)];
    let [from, to] = if from == to { [from - 1.0, to + 1.0] } else { [from, to] };
    let numbers = (from as i32..=to as i32).map(|n| step * f64::from(n)).collect();
    Numbered { along: (step * from..step * to).into(), numbers }
}

impl<C: Ranged<ValueType = f64>> Ranged for Numbered<C> {
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

impl<C> ValueFormatter<f64> for Numbered<C> {
    fn format(value: &f64) -> String {
        if *value == 0.0 || PLAIN.contains(&value.abs()) { value.to_string() } else { format!("{value:e}") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_people_write_them() {
        let written = |range| decades(range).numbers.iter().map(Numbered::<LogCoord<f64>>::format).collect::<Vec<_>>();
        assert_eq!(written(1e-6..0.1), ["1e-6", "1e-5", "1e-4", "0.001", "0.01", "0.1"]);
        assert_eq!(written(5.0..40.0), ["5", "10", "20"]);
    }
}
