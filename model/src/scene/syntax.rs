//! What is no TOML, told as what the writer of a scene meant.

use super::problem::Problem;
use super::units::{self, Unreadable};
use crate::effects;
use std::ops::Range;
use toml::de::Error;

/// What the reader of TOML calls a key that stands twice, and a text without quotes.
const DUPLICATE: &str = "duplicate key";
const UNQUOTED: &str = "string values must be quoted";
/// What it says of the line below a bracket that nobody closes, and what is said of that.
const UNSEPARATED: &str = "missing comma between array elements";
const OPEN: &str = "a bracket `[` above is not closed";

/// What is no TOML in a text, and whether all else in it was read as it is meant.
pub(super) fn problems(text: &str, errors: &[Error]) -> (Vec<Problem>, bool) {
    let (mut problems, mut rest_is_sound) = (Vec::<Problem>::new(), true);
    let place = |error: &Error| error.span().unwrap_or(text.len()..text.len());
    let mut errors: Vec<_> = errors.iter().map(|error| (place(error), error.message())).collect();
    errors.sort_by_key(|(place, _)| place.start);
    for (place, message) in &errors {
        let line = line_around(text, place.start);
        let is_below_open = message.starts_with(UNSEPARATED) && is_header_or_key(text[line.clone()].trim_start());
        // All below it is read as if it stood within.
        let follows = |problem: &Problem| within(problem, &line) || problem.wrong == OPEN;
        let told = if problems.iter().any(follows) {
            None
        } else if is_below_open {
            rest_is_sound = false;
            Some(Problem::at(place.clone(), OPEN, "write `]` before this"))
        } else if let Some((place, comma, right)) = comma(text, &line) {
            let given = &text[place.clone()];
            Some(Problem::at(place.clone(), format!("{given} {comma}"), format!("write {right}")))
        } else if *message == DUPLICATE {
            doubled(text, place, &line, &problems)
        } else if message.starts_with(UNQUOTED) && !place.is_empty() && line.end >= place.end {
            Some(unquoted(text, place))
        } else {
            rest_is_sound = false;
            Some(other(text, place, &line, message))
        };
        problems.extend(told);
    }
    (problems, rest_is_sound)
}

/// Whether a line is no part of a list.
fn is_header_or_key(line: &str) -> bool {
    line.starts_with('[') || line.contains('=') && !line.starts_with('{')
}

/// Whether a problem stands in this line.
pub(super) fn within(problem: &Problem, line: &Range<usize>) -> bool {
    problem.place.as_ref().is_some_and(|place| (line.start..=line.end).contains(&place.start))
}

/// The line in which a byte stands, without its end.
pub(super) fn line_around(text: &str, at: usize) -> Range<usize> {
    let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
    start..text[at..].find('\n').map_or(text.len(), |length| at + length)
}

/// Where a line has a number with a comma for a value, what that does, and how it is right.
fn comma(text: &str, line: &Range<usize>) -> Option<(Range<usize>, &'static str, String)> {
    let values = text[line.clone()].match_indices('=').map(|(at, _)| line.start + at + 1);
    values.into_iter().find_map(|at| {
        let value = text[at..line.end].trim_start();
        let end = value.find(|c: char| c.is_whitespace() || "}]#".contains(c)).unwrap_or(value.len());
        let start = line.end - text[at..line.end].trim_start().len();
        match units::read(&value[..end]) {
            Err(Unreadable::Comma(comma, right)) => Some((start..start + end, comma, right)),
            _ => None,
        }
    })
}

/// A table or key that stands twice; None of a key in a table that stands twice itself.
fn doubled(text: &str, place: &Range<usize>, line: &Range<usize>, told: &[Problem]) -> Option<Problem> {
    let (name, is_header) = (&text[place.clone()], |line: &str| line.trim_start().starts_with('['));
    if is_header(&text[line.clone()]) {
        let header = text[line.clone()].split('#').next().unwrap_or_default().trim();
        let right = match effects::named(name).filter(|info| info.several) {
            Some(_) => format!("there may be several: write [[effects.{name}]] above each"),
            None => format!("keep one {header}, with all its keys"),
        };
        return Some(Problem::at(place.clone(), format!("`{name}` stands twice"), right));
    }
    let section = text[..line.start].lines().scan(0, |at, line| {
        let start = std::mem::replace(at, *at + line.len() + 1);
        Some((start..start + line.len(), line))
    });
    let section = section.filter(|(_, line)| is_header(line)).last();
    let follows = section.is_some_and(|(header, _)| told.iter().any(|problem| within(problem, &header)));
    (!follows).then(|| Problem::at(place.clone(), format!("key `{name}` stands twice"), "keep one of them"))
}

/// A text without quotes.
fn unquoted(text: &str, place: &Range<usize>) -> Problem {
    let given = &text[place.clone()];
    if given.starts_with('(') {
        return bare_list(text, place);
    }
    let right = match given.to_lowercase().as_str() {
        "yes" | "on" | "true" => "write true, if a yes is meant".into(),
        "no" | "off" | "false" => "write false, if a no is meant".into(),
        _ => format!("write \"{}\"", given.trim_matches(['‘', '’', '“', '”', '\''])),
    };
    let is_quantity = matches!(units::read(given), Ok(_) | Err(Unreadable::Unit(..)));
    let wrong = if is_quantity { "a number with its unit needs quotes" } else { "a text needs quotes" };
    Problem::at(place.clone(), format!("{wrong}: {given}"), right)
}

/// Numbers in a row without square brackets.
fn bare_list(text: &str, place: &Range<usize>) -> Problem {
    let line = line_around(text, place.start);
    let value = text[line].split_once('=').map_or("", |(_, value)| value).split('#').next().unwrap_or_default();
    let numbers = value.trim().trim_matches(['(', ')']);
    Problem::at(place.clone(), "numbers in a row need square brackets", format!("write [{numbers}]"))
}

/// What the reader of TOML says, with a remedy of ours where its own says little.
fn other(text: &str, place: &Range<usize>, line: &Range<usize>, message: &str) -> Problem {
    let message = message.replace('\n', ", ");
    let (wrong, expected) = message.split_once(", expected ").unwrap_or((&message, ""));
    let key = text[line.clone()].split(['=', ':']).next().unwrap_or_default().trim();
    let right = match (wrong, expected) {
        (UNQUOTED, _) if place.is_empty() => {
            return Problem::at(place.clone(), format!("`{key}` has no value"), format!("write `{key} = ...`"));
        }
        ("unexpected key or value", _) if text[place.start..].starts_with(',') => return bare_list(text, place),
        ("unexpected leading zero", _) => "leave it out; a decimal point, if one is meant, is a `.`".into(),
        _ if text[place.start..].starts_with(':') => "write `=` between a key and its value".into(),
        ("invalid fraction" | "invalid mantissa", _) => "a point has digits on both sides, as in 0.5".into(),
        ("invalid float", _) => "write one number".into(),
        (_, "nothing") => "leave it out".into(),
        (_, "") => String::new(),
        _ => format!("expected {expected}"),
    };
    Problem::at(place.clone(), format!("no TOML: {wrong}"), right)
}
