//! An axis of angles, with numbers at right angles.

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use std::ops::Range;

/// From one multiple of the step to another, numbers at all of them \[°].
pub struct Degrees {
    along: RangedCoordf64,
    numbers: Vec<f64>,
}

/// So many numbers are read easily.
const NUMBERS: f64 = 8.0;

impl Degrees {
    /// That holds all of these.
    pub fn of(angles: impl Iterator<Item = f64>) -> Self {
        let (least, most) =
            angles.fold((0.0, 0.0), |(least, most): (f64, f64), angle| (least.min(angle), most.max(angle)));
        let step = 90.0 * libm::ceil((most - least) / 90.0 / NUMBERS).max(1.0);
        // A little room, or rounding would be a step.
        let [from, to] = [libm::ceil(least / step - 0.99), libm::floor(most / step + 0.99)];
        let [from, to] = if from == to { [from - 1.0, to + 1.0] } else { [from, to] };
        let numbers = (from as i32..=to as i32).map(|n| step * f64::from(n)).collect();
        Self { along: (step * from..step * to).into(), numbers }
    }
}

impl Ranged for Degrees {
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

impl ValueFormatter<f64> for Degrees {
    fn format(value: &f64) -> String {
        value.to_string()
    }
}
