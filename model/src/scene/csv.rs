//! The points of an input from a CSV: a time and a value in each line, below a line that may name the columns and their units.

use super::columns::{Column, Wanted, begins_with_time, cells, may_name};
use super::other_files::{Purpose, recognised};
use super::problem::{Line, Problem};
use std::ops::Range;
use std::path::Path;

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
    /// The points of an input; else what is wrong with the file.
    pub fn points(&self, wanted: &Wanted) -> Result<Points, Vec<Problem>> {
        let whole =
            |wrong: &str, right: &str| vec![Problem::at(self.place.clone(), format!("{} {wrong}", self.name), right)];
        if !self.path.is_file() {
            let wrong = if self.path.is_dir() { "is a folder" } else { "is not there" };
            return Err(whole(wrong, "the path counts from the folder of the scene"));
        }
        let bytes = std::fs::read(self.path).map_err(|error| whole(&format!("cannot be read: {error}"), ""))?;
        if let Some([is, right]) = recognised(self.path, &bytes, Purpose::Input) {
            return Err(whole(&format!("is {is}"), right));
        }
        let text = String::from_utf8_lossy(&bytes);
        // Spreadsheets begin with a mark of the order of bytes.
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        let numbered = || (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
        let mut lines = numbered().filter(|(_, line)| !is_comment(line)).peekable();
        let first = lines.peek().copied();
        if let Some(separator) = first.and_then(|(_, line)| other_separator(line)) {
            let right = "write a comma between a time and its value, and decimals behind a point";
            return Err(whole(&format!("has {separator} between its columns"), right));
        }
        // As numpy writes it, behind a #.
        let comments = || numbered().take_while(|(_, line)| is_comment(line));
        let head = lines.next_if(|(_, line)| names(line)).or_else(|| head_of_comments(comments, first?.1));
        let columns = match head {
            Some(line) => wanted.columns(uncommented(line.1)).map_err(|wrong| {
                let known = wrong.known;
                vec![match &wanted.column {
                    Some((_, place)) if wrong.of_scene => Problem {
                        known,
                        ..Problem::at(place.clone(), format!("{} {}", self.name, wrong.is), wrong.right)
                    },
                    _ => Problem { known, ..self.at(line, &wrong.is, &wrong.right) },
                }]
            })?,
            None if wanted.column.is_some() => {
                return Err(whole("does not name its columns", "its first line must name them, or leave `column` out"));
            }
            None => wanted.unnamed(),
        };
        let width = head.map_or(2, |(_, line)| cells(uncommented(line)).len());
        let (mut points, mut wrong, mut latest) = (Vec::new(), Vec::new(), f64::NEG_INFINITY);
        for line in lines {
            match point(line.1, &columns, width) {
                Ok((time, _)) if time < latest => {
                    wrong.push((line, format!("comes after {latest:?} s"), DESCENDS.to_owned()));
                }
                Ok((time, value)) => {
                    latest = time;
                    points.push((time, value));
                }
                Err((is, right)) => wrong.push((line, is, right)),
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

/// The time and value in a line of so many cells; else what is wrong with it, and what would be right.
fn point(line: &str, [time, value]: &[Column; 2], width: usize) -> Result<(f64, f64), (String, String)> {
    let cells = cells(line);
    let number = |column: &Column| column.number(cells.get(column.index)?);
    if let Some(point) = number(time).zip(number(value)).filter(|_| cells.len() == width) {
        return Ok(point);
    }
    let is_number = |cell: &&str| cell.parse::<f64>().is_ok();
    let right = match cells.len() {
        2 if width == 2 => POINT.into(),
        given if given == width => {
            format!("its cells 1 and {} must be a time and a value, two finite numbers", value.index + 1)
        }
        given if width > 2 => format!("it has {given} cells, the line of names {width}"),
        given if given > 2 && cells.iter().all(is_number) => UNNAMED.into(),
        _ => POINT.into(),
    };
    Err(("is no point".into(), right))
}

/// What is said of several columns without names.
const UNNAMED: &str =
    "decimals stand behind a point, not a comma; where a file has more than two columns, its first line must name them";

fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with('#')
}

fn uncommented(line: &str) -> &str {
    line.trim_start().trim_start_matches('#').trim_start()
}

/// Of the comments above the first point, the one that names the columns: the last that begins with a time and has as many cells, or the
/// line just above it where that has as many and is no sentence.
fn head_of_comments<'l, C>(comments: impl Fn() -> C, point: &str) -> Option<(usize, &'l str)>
where
    C: Iterator<Item = (usize, &'l str)>,
{
    let width = cells(point).len();
    let is_wide = |(_, line): &(usize, &str)| width > 1 && cells(uncommented(line)).len() == width;
    let begins = |(_, line): &(usize, &str)| begins_with_time(uncommented(line));
    let last = || comments().last().filter(is_wide).filter(|(_, line)| may_name(uncommented(line)));
    comments().filter(|line| is_wide(line) && begins(line)).last().or_else(last)
}

/// What a line has between its columns in place of commas.
fn other_separator(line: &str) -> Option<&'static str> {
    match line.trim() {
        line if line.contains(';') => Some("semicolons"),
        line if line.contains(',') => None,
        line if line.contains('\t') => Some("tabs"),
        line => (line.split_whitespace().count() == 2).then_some("blanks"),
    }
}

/// Whether a line names columns: what begins as a number is meant to be one.
fn names(line: &str) -> bool {
    let first = line.trim_start().trim_start_matches(['"', ' ']);
    // As pandas writes it, with no name above the index.
    let is_nameless = first.starts_with(',') && first.contains(char::is_alphabetic);
    first.starts_with(char::is_alphabetic) || is_nameless
}
