//! The numbers of a scene's file: bare, with a unit, or told by a name.

use super::problem::Problem;
use super::reader::{Reader, Value};
use super::units::{self, Quantity, Unreadable};
use crate::variable::units::Unit;
use crate::variable::{Enumeration, Kind, Meta};
use toml::de::DeValue;

/// What word processors make of a minus.
const DASHES: [char; 3] = ['−', '–', '—'];

impl Reader<'_> {
    /// The value of a parameter or input, checked; None where it is not possible.
    pub(super) fn number(&mut self, value: &Value, meta: &Meta, in_file: &str) -> Option<f64> {
        let number = match meta.kind {
            Kind::Real => self.real(value, meta.unit, in_file),
            Kind::Enumeration(of) => self.item(value, of, in_file),
            Kind::Integer => as_number(value.get_ref()).or_else(|| self.wrong_type(value, in_file, "a number")),
            Kind::Boolean => {
                let given = value.get_ref().as_bool().map(f64::from);
                given.or_else(|| self.wrong_type(value, in_file, "true or false"))
            }
        }?;
        let Err(invalid) = meta.check(|| in_file.to_owned(), number) else { return Some(number) };
        let (text, given) = (invalid.to_string(), self.given(value));
        let (_, right) = text.split_once(": ").unwrap_or_default();
        let overflows = number.is_infinite() && given.contains(|c: char| c.is_ascii_digit());
        let right = if overflows { "it is beyond the largest number that there is, 1.797e308" } else { right };
        self.problems.push(Problem::at(self.place(value), format!("{in_file} = {given} is not possible"), right));
        None
    }

    /// A number, or one with its unit as a text.
    pub(super) fn real(&mut self, value: &Value, unit: &Unit, in_file: &str) -> Option<f64> {
        let of_unit =
            |before: &str| if unit.name.is_empty() { String::new() } else { format!("{before}{}", unit.name) };
        if let Some(text) = value.get_ref().as_str() {
            let tell = |reader: &mut Self, wrong: String, right: String| {
                reader.problems.push(Problem::at(reader.place(value), wrong, right));
                None
            };
            let impossible = format!("{in_file} = {} is not possible", self.given(value));
            let is_pure = unit.name.is_empty();
            return match units::read(text) {
                Ok(quantity) if quantity.may_count_turns(unit) => tell(
                    self,
                    format!("{in_file} = {} may count turns or radians", self.given(value)),
                    units::RPM.into(),
                ),
                Ok(quantity) if quantity.fits(unit) => Some(quantity.value),
                Ok(Quantity { exponents, unit: given, .. }) => {
                    let what = units::quantity(unit.exponents).unwrap_or("a quantity");
                    let found = units::quantity(exponents).map_or_else(|| format!("in {given}"), str::to_owned);
                    let pounds = units::pounds(given, unit).unwrap_or_default();
                    let right = match is_pure {
                        true => "write it without a unit".into(),
                        false => format!("give it in {}{pounds}", unit.name),
                    };
                    tell(
                        self,
                        format!("{in_file} is {what}{}; {} is {found}", brackets(unit), self.given(value)),
                        right,
                    )
                }
                Err(Unreadable::NoNumber) if text.contains(DASHES) => {
                    tell(self, impossible, format!("a minus is written `-`: \"{}\"", text.replace(DASHES, "-")))
                }
                Err(Unreadable::NoNumber) => tell(self, impossible, format!("it must be a number{}", of_unit(" in "))),
                Err(Unreadable::NoUnit) if is_pure => tell(self, impossible, "write it without quotes".into()),
                Err(Unreadable::NoUnit) => {
                    let right = format!("write it without quotes, or with its unit: \"{text} {}\"", unit.name);
                    tell(self, impossible, right)
                }
                Err(Unreadable::Comma(comma, right)) => {
                    tell(self, format!("{in_file} = {} {comma}", self.given(value)), format!("write \"{right}\""))
                }
                Err(Unreadable::Unit(what, right)) => {
                    tell(self, format!("{in_file}{}: `{what}` is no unit", brackets(unit)), right)
                }
            };
        }
        as_number(value.get_ref()).or_else(|| self.wrong_type(value, in_file, &format!("a number{}", of_unit(" in "))))
    }

    /// The number of an item that is told by its name.
    fn item(&mut self, value: &Value, of: &Enumeration, in_file: &str) -> Option<f64> {
        let names: Vec<_> = of.items.iter().map(|item| item.1).collect();
        let quoted: Vec<_> = names.iter().map(|name| format!("\"{name}\"")).collect();
        let right = format!("one of {}", quoted.join(", "));
        let Some(name) = value.get_ref().as_str() else { return self.wrong_type(value, in_file, &right) };
        let item = of.items.iter().find(|item| item.1 == name);
        if item.is_none() {
            let known = format!("it must be {right}");
            let problem = Problem::unknown(self.place(value), in_file, name, &names, known);
            self.problems.push(problem);
        }
        Some(f64::from(item?.0))
    }
}

/// ` [m]`, or nothing for a pure number.
pub(super) fn brackets(unit: &Unit) -> String {
    if unit.name.is_empty() { String::new() } else { format!(" [{}]", unit.name) }
}

fn as_number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
        DeValue::Integer(integer) => Some(i64::from_str_radix(integer.as_str(), integer.radix()).ok()? as f64),
        _ => None,
    }
}
