//! The points of an input from a CSV: a time and a value in each line, below a line that may name the columns and their units.

use super::number::brackets;
use super::units;
use crate::variable::Role;
use crate::variable::units::{SECOND, Unit};
use crate::variables::Variable;
use std::path::Path;

/// What the column of times is called.
const TIMES: [&str; 2] = ["time", "t"];

/// A column: the unit of the input's variable, and how the first line writes another one.
struct Column<'l> {
    unit: &'static Unit,
    written: Option<&'l str>,
}

/// What is wrong, and what would be right.
type Wrong = (String, String);

/// The times \[s] and values of this variable, one of `variables`.
pub(super) fn points(file: &Path, variable: &Variable, variables: &[Variable]) -> Result<(Vec<f64>, Vec<f64>), Wrong> {
    if !file.is_file() {
        let wrong = if file.is_dir() { " is a folder" } else { " is not there" };
        return Err((wrong.into(), "the path counts from the folder of the scene".into()));
    }
    let text = std::fs::read_to_string(file).map_err(|error| (format!(" cannot be read: {error}"), String::new()))?;
    // Spreadsheets begin with a mark of the order of bytes.
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let at = |number: usize, line: &str| format!(", line {number}: {line}");
    let mut lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty()).peekable();
    let mut columns = [&SECOND, variable.meta.unit].map(|unit| Column { unit, written: None });
    if let Some((number, line)) = lines.next_if(|(_, line)| names(line)) {
        columns = columns_of(line, variable, variables).map_err(|right| (at(number, line), right))?;
    }
    let point = |line: &str| {
        let (time, value) = line.split_once(',')?;
        Some((columns[0].number(time)?, columns[1].number(value)?))
    };
    let points = lines.map(|(number, line)| {
        let right = "a line has a time in s and a value, two finite numbers with a comma between them";
        point(line).ok_or_else(|| (at(number, line), right.to_owned()))
    });
    let points = points.collect::<Result<Vec<_>, _>>()?;
    if points.is_empty() {
        return Err((" has no points".into(), "give a time in s and a value in each line".into()));
    }
    Ok(points.into_iter().unzip())
}

/// Whether a line names columns: what begins as a number is meant to be one.
fn names(line: &str) -> bool {
    line.trim_start().starts_with(|c: char| c.is_alphabetic() || c == '"' || c == '#')
}

/// The columns that this line names, or what would be right.
fn columns_of<'l>(line: &'l str, variable: &Variable, variables: &[Variable]) -> Result<[Column<'l>; 2], String> {
    let right = || {
        let (own, unit) = (&variable.name, brackets(variable.meta.unit));
        format!("the first line has a time in s and a value, or names both columns: time [s],{own}{unit}")
    };
    // As numpy writes it, behind a #.
    let (time, value) = line.trim_start().trim_start_matches('#').split_once(',').ok_or_else(right)?;
    let ((time, time_unit), (value, value_unit)) = (cell(time), cell(value));
    let ends = |variable: &Variable| variable.name == value || variable.name.ends_with(&format!(".{value}"));
    let other = |other: &Variable| other.name == value || matches!(other.meta.role, Role::Input { .. }) && ends(other);
    let is_other = !ends(variable) && variables.iter().any(other);
    let is_time = |name: &str| TIMES.iter().any(|known| known.eq_ignore_ascii_case(name));
    if !is_time(time) || is_time(value) || !names(value) || value.contains(',') || is_other {
        return Err(right());
    }
    let columns = [(&SECOND, time_unit), (variable.meta.unit, value_unit)].map(|(unit, written)| {
        let written = written.filter(|written| *written != unit.name);
        Column { unit, written }
    });
    if columns.iter().all(|column| column.number("1").is_some()) { Ok(columns) } else { Err(right()) }
}

/// The name and the unit in brackets of `name [unit]`.
fn cell(text: &str) -> (&str, Option<&str>) {
    let text = text.trim().trim_matches('"').trim();
    let with_unit = |open, close| text.strip_suffix(close)?.split_once(open);
    match with_unit('[', ']').or_else(|| with_unit('(', ')')) {
        Some((name, unit)) => (name.trim(), Some(unit.trim())),
        None => (text, None),
    }
}

impl Column<'_> {
    /// A finite number in a cell, in the unit of the variable.
    fn number(&self, cell: &str) -> Option<f64> {
        let number = match self.written {
            None => cell.trim().parse().ok()?,
            Some(unit) => {
                let text = format!("{} {unit}", cell.trim());
                let quantity = units::read(&text).ok()?;
                // As in a scene, a radian is a pure number.
                (quantity.exponents[..3] == self.unit.exponents[..3]).then_some(quantity.value)?
            }
        };
        number.is_finite().then_some(number)
    }
}
