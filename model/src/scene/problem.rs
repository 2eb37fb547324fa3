//! What is wrong in the file of a scene, told as a compiler tells it: the line, a mark under the place, what would be right.

use super::similar::did_you_mean;
use crate::error::Invalid;
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Why a scene cannot be simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneError {
    /// The file.
    pub file: PathBuf,
    /// What stands in it.
    pub text: String,
    /// What is wrong with it, in the order of the file; at least one.
    pub problems: Vec<Problem>,
}

/// What is wrong at one place of a file, and what would be right.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// The bytes of the text to blame; None where it is the file as a whole.
    pub place: Option<Range<usize>>,
    /// What is wrong: the key, and what was found.
    pub wrong: String,
    /// What would be right.
    pub right: String,
    /// What there is to choose from; empty where nothing is to be chosen.
    pub known: String,
    /// The line of a file beside the scene's that is to blame; `place` is where the scene names that file.
    pub line: Option<Line>,
}

/// A line of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The file, as the scene names it.
    pub file: String,
    /// Counted from 1.
    pub number: usize,
    /// What stands there.
    pub text: String,
}

impl Problem {
    /// At this place.
    pub(super) fn at(place: Range<usize>, wrong: impl Into<String>, right: impl Into<String>) -> Self {
        Self { place: Some(place), ..Self::of_file(wrong, right) }
    }

    /// With the file as a whole.
    pub fn of_file(wrong: impl Into<String>, right: impl Into<String>) -> Self {
        Self { place: None, wrong: wrong.into(), right: right.into(), known: String::new(), line: None }
    }

    /// The last part of a dotted name is none of these; `known` says which there are.
    pub(super) fn unknown(place: Range<usize>, what: &str, name: &str, names: &[&str], known: String) -> Self {
        let last = name.rsplit('.').next().unwrap_or(name);
        let right = did_you_mean(last, names.iter().copied()).unwrap_or_default();
        Self { known, ..Self::at(place, format!("unknown {what} `{name}`"), right) }
    }

    /// With this as what would be right where nothing was better.
    pub(super) fn or_right(self, right: Option<String>) -> Self {
        let right = if self.right.is_empty() { right.unwrap_or_default() } else { self.right };
        Self { right, ..self }
    }

    /// A value that breaks a bound.
    pub(super) fn invalid(place: Option<Range<usize>>, invalid: &Invalid) -> Self {
        let text = invalid.to_string();
        let (wrong, right) = text.split_once(": ").unwrap_or((&text, ""));
        Self { place, ..Self::of_file(wrong, right) }
    }

    fn group<'p>(&'p self, path: &'p str, text: &'p str) -> Group<'p> {
        let title = Level::ERROR.primary_title(&self.wrong);
        let help = |words: &'p str| (!words.is_empty()).then(|| Level::HELP.message(words));
        let mark = |place: Range<usize>| AnnotationKind::Primary.span(place).label(&self.right);
        let group = match (&self.line, &self.place) {
            (Some(Line { file, number, text }), _) => {
                let excerpt = Snippet::source(text.as_str()).line_start(*number).path(file.as_str());
                title.element(excerpt.annotation(mark(0..text.len())))
            }
            (None, None) => title.element(Origin::path(path)).elements(help(&self.right)),
            (None, Some(place)) => title.element(Snippet::source(text).path(path).annotation(mark(place.clone()))),
        };
        group.elements(help(&self.known))
    }
}

impl SceneError {
    /// With this text of a file, told in its order.
    pub(super) fn of_text(file: &Path, text: &str, mut problems: Vec<Problem>) -> Self {
        problems.sort_by_key(|problem| problem.place.as_ref().map_or(usize::MAX, |place| place.start));
        Self { file: file.into(), text: text.to_owned(), problems }
    }

    /// With a file as a whole.
    pub fn of_file(file: &Path, wrong: impl Into<String>, right: impl Into<String>) -> Self {
        Self { file: file.into(), text: String::new(), problems: vec![Problem::of_file(wrong, right)] }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.file.display().to_string();
        let groups: Vec<_> = self.problems.iter().map(|problem| problem.group(&path, &self.text)).collect();
        f.write_str(&Renderer::plain().render(&groups))
    }
}

impl std::error::Error for SceneError {}
