//! A scene: which effects, which values, which method. Read from TOML and checked, so that all that is wrong is told with
//! file, line, key, value and what would be right.

mod columns;
mod csv;
mod experiment;
mod given;
mod input;
mod moment;
mod number;
mod other_files;
mod problem;
mod reader;
pub mod reference;
mod similar;
mod syntax;
mod tables;
mod units;
mod values;
mod warnings;

pub use experiment::Experiment;
pub use given::Given;
pub use input::Input;
pub use problem::{Problem, SceneError};
pub use similar::did_you_mean;

use crate::effects::{All, Effects, Info};
use crate::error::Invalid;
use crate::simulation::ALWAYS_INDICATED;
use crate::variable::Place;
use crate::variables::{Parameters, Variable};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A scene that can be simulated.
#[derive(Debug)]
pub struct Scene {
    /// Its file.
    pub file: PathBuf,
    /// What stands in it, and where there each parameter that it names.
    text: String,
    places: Vec<(String, Range<usize>)>,
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
    /// How many indicators of events its library has.
    pub indicators: usize,
    /// When and how finely to look at it.
    pub experiment: Experiment,
    /// What its inputs are over time, for those who run it; the FMU leaves that to its host.
    pub inputs: Vec<Input>,
}

impl Scene {
    /// The scene that a user means: a path to a TOML file, or a name in `folder`.
    pub fn find(name_or_path: &str, folder: &Path) -> Result<Self, SceneError> {
        let with_suffix = format!("{name_or_path}.toml");
        let named = folder.join(&with_suffix);
        // A scene of the folder may have a dot in its name.
        let is_path = name_or_path.contains(|c| c == '.' || std::path::is_separator(c)) && !named.is_file();
        let file = if is_path { name_or_path.into() } else { named };
        if file.is_file() {
            return Self::read(&file);
        }
        let error = |wrong: &str, right: &str| SceneError::of_file(&file, wrong, right);
        Err(if file.is_dir() {
            error("this is a folder", "a scene is a TOML file")
        } else if is_path {
            error("there is no such file", "")
        } else {
            let names = Self::names(folder);
            let beside = Path::new(&with_suffix).is_file().then(|| format!("did you mean `{with_suffix}`?"));
            let meant = beside.or_else(|| did_you_mean(name_or_path, names.iter().map(String::as_str)));
            let right = meant.unwrap_or_else(|| "give a path to a TOML file, or the name of a scene".into());
            let mut error = error(&format!("there is no scene `{name_or_path}`"), &right);
            error.problems[0].known = format!("the scenes are {}", names.join(", "));
            error
        })
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
        let bytes = std::fs::read(file);
        let bytes = bytes.map_err(|error| SceneError::of_file(file, format!("it cannot be read: {error}"), ""))?;
        if let Some([is, right]) = other_files::recognised(file, &bytes, other_files::Purpose::Scene) {
            return Err(SceneError::of_file(file, format!("this is {is}, not a scene"), right));
        }
        let text = String::from_utf8_lossy(&bytes);
        match text.find(char::REPLACEMENT_CHARACTER).filter(|_| std::str::from_utf8(&bytes).is_err()) {
            None => Self::parse(file, &text),
            Some(at) => {
                let place = at..at + char::REPLACEMENT_CHARACTER.len_utf8();
                let problem = Problem::at(place, "this letter is not written in UTF-8", "save the file as UTF-8");
                Err(SceneError::of_text(file, &text, vec![problem]))
            }
        }
    }

    /// The scene in this text; `file` names it.
    pub fn parse(file: &Path, text: &str) -> Result<Self, SceneError> {
        let name = name_of(file);
        if !is_one_line(&name) {
            let right = "the file of a scene has no control characters in its name";
            return Err(SceneError::of_file(file, "this cannot be the name of a model", right));
        }
        let (found, mut problems) = reader::read(text, file.parent().unwrap_or(Path::new("")));
        let Some(found) = found else {
            return Err(SceneError::of_text(file, text, problems));
        };
        let mut scene = Self {
            file: file.into(),
            text: text.to_owned(),
            places: found.places,
            title: found.title.unwrap_or_else(|| name.clone()),
            name,
            general: found.general,
            effects: found.effects,
            variables: found.variables,
            starts: found.starts,
            indicators: 0,
            experiment: found.experiment,
            inputs: found.inputs,
        };
        let indicated = scene.effects.iter().map(|(info, index)| {
            let has_table = scene.nodes(Place::effect_block(info.number, *index)) > 0;
            if has_table { info.facts_with_table.indicators } else { info.facts.indicators }
        });
        scene.indicators = ALWAYS_INDICATED + indicated.sum::<usize>();
        problems.extend(scene.broken_rules(&found.unsure).iter().map(|one| scene.problem(one)));
        if problems.is_empty() { Ok(scene) } else { Err(SceneError::of_text(file, text, problems)) }
    }

    /// What is wrong with this scene, shown in its file.
    pub fn refused(&self, invalid: &Invalid) -> SceneError {
        SceneError::of_text(&self.file, &self.text, vec![self.problem(invalid)])
    }

    fn problem(&self, invalid: &Invalid) -> Problem {
        // A bound on several components, such as |start.gamma|, or on a table is shown at the first that the file names.
        let name = invalid.variable.trim_matches('|').split(' ').next().unwrap_or_default();
        let place = self.places.iter().find(|(key, _)| key.starts_with(name)).map(|(_, place)| place.clone());
        Problem::invalid(place, invalid)
    }

    /// Its effects, without those that are switched off at first.
    fn acting(&self) -> impl Iterator<Item = (&'static Info, u32)> {
        let is_on = |(info, index): &(&Info, u32)| {
            let switch = Place::switch(Place::effect_block(info.number, *index)).value_reference();
            self.starts.get(&switch) != Some(&0.0)
        };
        self.effects.iter().copied().filter(is_on)
    }

    /// What does not go together, but for rules that join one of these values.
    fn broken_rules(&self, unsure: &[String]) -> Vec<Invalid> {
        let on: Vec<_> = self.acting().collect();
        // A rule's words name what it joins.
        let is_sure = |broken: &Invalid| !unsure.iter().any(|name| broken.to_string().contains(name));
        let mut broken: Vec<_> = self.parameters().broken_rules().filter(is_sure).collect();
        for (info, index) in &on {
            if let Some((other, _)) = on.iter().find(|(other, _)| info.excludes.contains(&other.name)) {
                broken.push(Invalid::excluded(info.switch_name(*index), &other.switch_name(1)));
            }
            let name = info.block_name(*index);
            if unsure.iter().any(|unsure| unsure.split_once('.').is_some_and(|(section, _)| section == name)) {
                continue;
            }
            let (mut alone, block) = (Parameters::<All>::default(), Place::effect_block(info.number, *index));
            alone.effects.switch_on(block);
            let starts = self.starts.iter().map(|(reference, value)| (Place::of(*reference), *value));
            let own = starts.filter(|(place, _)| place.block == block && place.row != Place::SWITCH);
            own.for_each(|(place, value)| _ = alone.begin_with(place, value));
            broken.extend(alone.effects.check().err());
        }
        broken
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
            let block = Place::effect_block(info.number, *index);
            let of = match (self.is_housed(block), self.nodes(block)) {
                (false, 0) => String::new(),
                (false, nodes) => format!("<split_rotor_model::effects::housing::Fixed, {nodes}>"),
                (true, 0) => "<split_rotor_model::effects::housing::Moving>".to_owned(),
                (true, nodes) => format!("<split_rotor_model::effects::housing::Moving, {nodes}>"),
            };
            format!("(split_rotor_model::effects::{member}<{}{of}, {index}>, {rest})", info.type_path)
        })
    }

    /// For how many start values a library of this list has room: those of all parameters and inputs.
    pub fn room(&self) -> usize {
        self.variables.iter().filter(|variable| variable.meta.has_start()).count()
    }

    /// Whether an effect stands in a housing that can move.
    fn is_housed(&self, block: u32) -> bool {
        self.variables.iter().any(|variable| variable.place.block == block && variable.place.is_of_housing())
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
