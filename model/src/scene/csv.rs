//! The points of an input from a CSV: a time and a value in each line, below a line that may name the columns and their units.

use super::number::brackets;
use super::problem::{Line, Problem};
use super::units;
use crate::variable::Role;
use crate::variable::units::{SECOND, Unit};
use crate::variables::Variable;
use std::ops::Range;
use std::path::Path;

/// What the column of times is called.
const TIMES: [&str; 2] = ["time", "t"];

/// A column: the unit of the input's variable, and how the first line writes another one.
struct Column<'l> {
    unit: &'static Unit,
    written: Option<&'l str>,
}

/// So many lines of a file are told; of a file of another kind every line is wrong.
const MOST_TOLD: usize = 3;

/// What a line must be.
const POINT: &str = "a line has a time in s and a value, two finite numbers with a comma between them";

/// What times must do, here and in a scene.
pub(super) const DESCENDS: &str = "times must not descend";

/// The times \[s] and values of a variable.
type Points = (Vec<f64>, Vec<f64>);

/// A file that a scene names.
pub(super) struct Csv<'f> {
    /// Where it is, and how and where the scene names it.
    pub path: &'f Path,
    pub name: &'f str,
    pub place: Range<usize>,
}

impl Csv<'_> {
    /// The points of this variable, one of `variables`; else what is wrong with the file.
    pub fn points(&self, variable: &Variable, variables: &[Variable]) -> Result<Points, Vec<Problem>> {
        let whole =
            |wrong: &str, right: &str| vec![Problem::at(self.place.clone(), format!("{} {wrong}", self.name), right)];
        if !self.path.is_file() {
            let wrong = if self.path.is_dir() { "is a folder" } else { "is not there" };
            return Err(whole(wrong, "the path counts from the folder of the scene"));
        }
        let bytes = std::fs::read(self.path).map_err(|error| whole(&format!("cannot be read: {error}"), ""))?;
        let text = String::from_utf8_lossy(&bytes);
        // Spreadsheets begin with a mark of the order of bytes.
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        if let Some(separator) = other_separator(text) {
            let right = "write a comma between a time and its value, and decimals behind a point";
            return Err(whole(&format!("has {separator} between its columns"), right));
        }
        let mut lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty()).peekable();
        let mut columns = [&SECOND, variable.meta.unit].map(|unit| Column { unit, written: None });
        if let Some((number, line)) = lines.next_if(|(_, line)| names(line)) {
            let (own, unit) = (&variable.name, brackets(variable.meta.unit));
            let right = "the first line has a time in s and a value, or names both columns: time [s]";
            let wrong = |is: String| vec![self.at((number, line), &is, &format!("{right},{own}{unit}"))];
            columns = columns_of(line, variable, variables).map_err(wrong)?;
        }
        let (mut points, mut wrong, mut latest) = (Vec::new(), Vec::new(), f64::NEG_INFINITY);
        for line in lines {
            match point(line.1, &columns) {
                Some((time, _)) if time < latest => wrong.push((line, format!("comes after {latest:?} s"), DESCENDS)),
                Some((time, value)) => {
                    latest = time;
                    points.push((time, value));
                }
                None => wrong.push((line, "is no point".into(), POINT)),
            }
        }
        if points.is_empty() && wrong.is_empty() {
            return Err(whole("has no points", "give a time in s and a value in each line"));
        }
        if wrong.is_empty() {
            return Ok(points.into_iter().unzip());
        }
        let mut told: Vec<_> =
            wrong.iter().take(MOST_TOLD).map(|(line, is, right)| self.at(*line, is, right)).collect();
        let rest = wrong.len() - told.len();
        if let Some(last) = told.last_mut().filter(|_| rest > 0) {
            last.known = format!("{rest} more lines of {} are wrong", self.name);
        }
        Err(told)
    }

    /// What a line is, and what would be right.
    fn at(&self, (number, text): (usize, &str), is: &str, right: &str) -> Problem {
        let line = Line { file: self.name.to_owned(), number, text: text.to_owned() };
        let problem = Problem::at(self.place.clone(), format!("line {number} of {} {is}", self.name), right);
        Problem { line: Some(line), ..problem }
    }
}

/// The time and value in a line.
fn point(line: &str, columns: &[Column; 2]) -> Option<(f64, f64)> {
    let (time, value) = line.split_once(',')?;
    Some((columns[0].number(time)?, columns[1].number(value)?))
}

/// What a text has between its columns in place of commas.
fn other_separator(text: &str) -> Option<&'static str> {
    let line = text.lines().find(|line| !line.trim().is_empty())?.trim();
    match line {
        line if line.contains(';') => Some("semicolons"),
        line if line.contains(',') => None,
        line if line.contains('\t') => Some("tabs"),
        line => (line.trim_start_matches('#').split_whitespace().count() == 2).then_some("blanks"),
    }
}

/// Whether a line names columns: what begins as a number is meant to be one.
fn names(line: &str) -> bool {
    line.trim_start().starts_with(|c: char| c.is_alphabetic() || c == '"' || c == '#')
}

/// The columns that this line names, or what it does instead.
fn columns_of<'l>(line: &'l str, variable: &Variable, variables: &[Variable]) -> Result<[Column<'l>; 2], String> {
    let unnamed = || "does not name the columns".to_owned();
    // As numpy writes it, behind a #.
    let (time, value) = line.trim_start().trim_start_matches('#').split_once(',').ok_or_else(unnamed)?;
    let ((time, time_unit), (value, value_unit)) = (cell(time), cell(value));
    let ends = |variable: &Variable| variable.name == value || variable.name.ends_with(&format!(".{value}"));
    let other = |other: &Variable| other.name == value || matches!(other.meta.role, Role::Input { .. }) && ends(other);
    let is_other = !ends(variable) && variables.iter().any(other);
    let is_time = |name: &str| TIMES.iter().any(|known| known.eq_ignore_ascii_case(name));
    if !is_time(time) || is_time(value) || !names(value) || value.contains(',') || is_other {
        return Err(unnamed());
    }
    let columns = [(&SECOND, time_unit), (variable.meta.unit, value_unit)].map(|(unit, written)| {
        let written = written.filter(|written| *written != unit.name);
        Column { unit, written }
    });
    match columns.iter().find(|column| column.number("1").is_none()) {
        None => Ok(columns),
        Some(unfit) => Err(format!("has a unit that does not fit, [{}]", unfit.written.unwrap_or_default())),
    }
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
                (quantity.fits(self.unit) && !quantity.may_count_turns(self.unit)).then_some(quantity.value)?
            }
        };
        number.is_finite().then_some(number)
    }
}
