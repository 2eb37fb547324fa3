//! A number that a user gives a command, with or without its unit: `3000 rpm`, `314.16`.

use super::units::{self, Quantity, Unreadable};
use crate::variable::units::Unit;
use std::fmt::{self, Display, Formatter};

/// Such a number.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    text: String,
}

impl Given {
    /// A number as it is written.
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: text.into() }
    }

    /// Its value in `unit`, which is its own where it has none.
    ///
    /// # Errors
    /// Where it is no finite number, or has a unit of another quantity: what is wrong and what would be right.
    pub fn value(&self, unit: &Unit) -> Result<f64, String> {
        let (text, own) = (self.text.trim(), unit.name);
        let in_unit = if own.is_empty() { String::new() } else { format!(" in {own}") };
        let wrong = |what: &str| Err(format!("{text:?} {what}"));
        let value = match units::read(text) {
            Ok(quantity) if quantity.may_count_turns(unit) => {
                return wrong(&format!("may count turns or radians: {}", units::RPM));
            }
            Ok(quantity) if quantity.fits(unit) => quantity.value,
            Ok(Quantity { exponents, unit: given, .. }) => {
                let what = units::quantity(exponents).unwrap_or(given);
                return wrong(&format!("is {what}: a number{in_unit} is needed, or one with such a unit"));
            }
            Err(Unreadable::NoUnit) => text.parse().unwrap_or(f64::NAN),
            Err(Unreadable::NoNumber) => return wrong(&format!("is no number: a number{in_unit} is needed")),
            Err(Unreadable::Comma(comma, right)) => return wrong(&format!("{comma}: write {right:?}")),
            Err(Unreadable::Unit(what, right)) => return wrong(&format!("has `{what}`, which is no unit: {right}")),
        };
        if value.is_finite() { Ok(value) } else { wrong("is not finite") }
    }

    /// Whether it has no unit and needs one to be clear beside a number that has one.
    fn lacks_unit(&self) -> bool {
        let is_zero = self.text.trim().parse() == Ok(0.0);
        units::read(&self.text) == Err(Unreadable::NoUnit) && !is_zero
    }

    /// The values of two that belong together, as the first and the last of a range: both have a unit, or none of them.
    ///
    /// # Errors
    /// As [`value`](Self::value), and where one of them has a unit and the other none, unless that is 0.
    pub fn pair([from, to]: [&Self; 2], unit: &Unit) -> Result<[f64; 2], String> {
        let values = [from.value(unit)?, to.value(unit)?];
        let has_unit = |given: &Self| units::read(&given.text).is_ok();
        for (one, other) in [(from, to), (to, from)] {
            if one.lacks_unit() && has_unit(other) {
                return Err(format!("{from} {to}: {one} has no unit and {other} has one: give both the same"));
            }
        }
        Ok(values)
    }
}

impl Display for Given {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let quotes = if self.text.contains(' ') { "\"" } else { "" };
        write!(f, "{quotes}{}{quotes}", self.text)
    }
}

impl From<f64> for Given {
    fn from(value: f64) -> Self {
        Self { text: format!("{value:?}") }
    }
}

#[cfg(test)]
mod tests {
    use super::Given;
    use crate::variable::units::{ONE, RADIAN_PER_SECOND};
    use std::f64::consts::PI;

    #[test]
    fn exact_numbers_with_and_without_a_unit() {
        let value = |text: &str| Given::new(text).value(&RADIAN_PER_SECOND);
        assert_eq!(value("3000 rpm"), Ok(3000.0 * 2.0 * PI / 60.0));
        assert_eq!([value("-50 Hz"), value("1e3"), value("7rad/s")], [Ok(-100.0 * PI), Ok(1e3), Ok(7.0)]);
        assert_eq!(Given::from(0.1).value(&RADIAN_PER_SECOND), Ok(0.1));
        assert_eq!(Given::new("0.3").value(&ONE), Ok(0.3));
        for (text, wrong) in [
            ("5 kg", "\"5 kg\" is a mass: a number in rad/s is needed, or one with such a unit"),
            ("60 1/min", "\"60 1/min\" may count turns or radians: turns a minute are rpm, radians rad/min"),
            ("5 rmp", "\"5 rmp\" has `rmp`, which is no unit: did you mean `rpm`?"),
            ("3,5", "\"3,5\" has a decimal comma: write \"3.5\""),
            ("--steps", "\"--steps\" is no number: a number in rad/s is needed"),
            ("1e999", "\"1e999\" is not finite"),
        ] {
            assert_eq!(value(text), Err(wrong.to_owned()));
        }
    }

    #[test]
    fn a_range_has_a_unit_at_both_ends_or_at_none() {
        let pair = |from: &str, to: &str| Given::pair([&Given::new(from), &Given::new(to)], &RADIAN_PER_SECOND);
        assert_eq!(pair("10", "20"), Ok([10.0, 20.0]));
        assert_eq!(pair("0", "30 rpm"), Ok([0.0, PI]));
        assert_eq!(pair("-30 rpm", "1 Hz"), Ok([-PI, 2.0 * PI]));
        let mixed = "100 \"3000 rpm\": 100 has no unit and \"3000 rpm\" has one: give both the same";
        assert_eq!(pair("100", "3000 rpm"), Err(mixed.to_owned()));
    }
}
