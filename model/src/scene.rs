//! A scene: which effects, which values, which method. Read from TOML and checked, so that what is wrong is told with
//! file, line, key, value and what would be right.

mod tables;
mod toml_reader;

use crate::effects::{All, Effects, Info};
use crate::variable::Place;
use crate::variables::{Parameters, Variable};
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

/// A scene that can be simulated.
#[derive(Debug)]
pub struct Scene {
    /// Its file.
    pub file: PathBuf,
    /// Its name: that of its file.
    pub name: String,
    /// One line on what it shows.
    pub title: String,
    /// Whether its effects have switches; then it holds them all, and calls for those that are on at first.
    pub general: bool,
    /// The effects that it holds, each with its index among its kind, in the order of the catalogue.
    pub effects: Vec<(&'static Info, u32)>,
    /// Its variables.
    pub variables: Vec<Variable>,
    /// The start value of each parameter and input, by value reference.
    pub starts: BTreeMap<u32, f64>,
    /// When and how finely to look at it.
    pub experiment: Experiment,
}

/// The default experiment of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Experiment {
    /// Start time \[s].
    pub start: f64,
    /// Stop time \[s].
    pub stop: f64,
    /// Communication step \[s].
    pub step: f64,
    /// Relative tolerance \[1].
    pub tolerance: f64,
}

/// Why a scene cannot be simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneError {
    /// The file.
    pub file: PathBuf,
    /// The line, from 1, where one is to blame.
    pub line: Option<usize>,
    /// What is wrong, and what would be right.
    pub message: String,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if let Some(line) = self.line {
            write!(f, ", line {line}")?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for SceneError {}

impl Scene {
    /// The scene that a user means: a path to a TOML file, or a name in `folder`.
    pub fn find(name_or_path: &str, folder: &Path) -> Result<Self, SceneError> {
        let is_path = name_or_path.ends_with(".toml") || name_or_path.contains(std::path::is_separator);
        let file = if is_path { name_or_path.into() } else { folder.join(format!("{name_or_path}.toml")) };
        if file.is_file() {
            return Self::read(&file);
        }
        let message = if file.is_dir() {
            "is a folder: a scene is a TOML file".into()
        } else if is_path {
            "there is no such file".into()
        } else {
            let names = Self::names(folder).join(", ");
            format!("there is no such scene: give a path to a TOML file, or one of the names {names}")
        };
        Err(SceneError { file, line: None, message })
    }

    /// The names of the scenes in a folder, sorted.
    pub fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let files = entries.map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|e| e == "toml"));
        let mut names: Vec<_> = files.map(|path| name_of(&path)).collect();
        names.sort();
        names
    }

    /// The scene in this file.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        let text = std::fs::read_to_string(file).map_err(|error| SceneError {
            file: file.into(),
            line: None,
            message: format!("cannot be read: {error}"),
        })?;
        Self::parse(file, &text)
    }

    /// The scene in this text; `file` names it.
    pub fn parse(file: &Path, text: &str) -> Result<Self, SceneError> {
        let file_error = |line, message| SceneError { file: file.into(), line, message };
        if !is_one_line(&name_of(file)) {
            let message = "cannot be the name of a model: a file of a scene has no control characters in its name";
            return Err(file_error(None, message.into()));
        }
        let found = toml_reader::read(text).map_err(|(line, message)| file_error(line, message))?;
        let scene = Self {
            file: file.into(),
            name: name_of(file),
            title: found.title.unwrap_or_else(|| name_of(file)),
            general: found.general,
            effects: found.effects,
            variables: found.variables,
            starts: found.starts,
            experiment: found.experiment,
        };
        scene.parameters().check().map_err(|invalid| {
            // A bound on several components, such as |start.gamma|, or on a table is shown at the first that the file names.
            let name = invalid.variable.trim_matches('|').split(' ').next().unwrap_or_default();
            let line = found.lines.iter().find(|(key, _)| key.starts_with(name)).map(|(_, line)| *line);
            file_error(line, invalid.to_string())
        })?;
        Ok(scene)
    }

    /// The scene's parameters, over the list of all effects.
    pub fn parameters(&self) -> Parameters<All> {
        let mut parameters = Parameters::<All>::default();
        // Those of a general scene are switched by their start values.
        for (info, index) in self.effects.iter().filter(|_| !self.general) {
            parameters.effects.switch_on(Place::effect_block(info.number, *index));
        }
        for (reference, value) in &self.starts {
            parameters.begin_with(Place::of(*reference), *value);
        }
        parameters
    }

    /// The list of its effects, as a type.
    pub fn list(&self) -> String {
        let member = if self.general { "Switched" } else { "Called" };
        self.effects.iter().rev().fold("()".to_owned(), |rest, (info, index)| {
            let nodes = match self.nodes(Place::effect_block(info.number, *index)) {
                0 => String::new(),
                nodes => format!("<{nodes}>"),
            };
            format!("(split_rotor_model::effects::{member}<{}{nodes}, {index}>, {rest})", info.type_path)
        })
    }

    /// For how many start values a library of this list has room: those of all parameters and inputs.
    pub fn room(&self) -> usize {
        self.variables.iter().filter(|variable| variable.meta.has_start()).count()
    }

    /// How many nodes the table of an effect has; 0 where there is none.
    pub fn nodes(&self, block: u32) -> usize {
        let of_block = self.variables.iter().filter(|variable| variable.place.block == block);
        of_block.filter_map(|variable| Some(variable.meta.node()?.1)).max().unwrap_or(0)
    }

    /// The scene's name made a C identifier.
    pub fn identifier(&self) -> String {
        let mut identifier: String =
            self.name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        if identifier.starts_with(|c: char| c.is_ascii_digit()) {
            identifier.insert(0, '_');
        }
        identifier
    }
}

/// Whether there is nothing but what a line of XML can hold.
fn is_one_line(text: &str) -> bool {
    !text.contains(|c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'))
}

fn name_of(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// The start values of a list of variables as its defaults have them; what has none is left out.
fn defaults(list: &[Variable]) -> BTreeMap<u32, f64> {
    let default = |variable: &Variable| Some((variable.place.value_reference(), variable.meta.default()?));
    list.iter().filter_map(default).collect()
}
