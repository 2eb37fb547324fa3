//! The values of a scene while its file is read, by the names of their variables.

use super::moment::{self, Moment};
use super::reader::SECTIONS;
use super::tables::Columns;
use super::{defaults, experiment};
use crate::effects::{self, Info};
use crate::variable::Place;
use crate::variables::Variable;
use std::collections::BTreeMap;
use std::ops::Range;

/// The effect that is measured from the support point a.
const SUPPORT: &str = "support";

/// The values of a scene, while they are read.
pub(super) struct Values<'v> {
    variables: &'v [Variable],
    pub(super) starts: BTreeMap<u32, f64>,
    pub(super) places: Vec<(String, Range<usize>)>,
    /// Value references of what the file gives, but cannot be.
    pub(super) refused: Vec<u32>,
    /// What stands in the file, but not as it should: a misspelt key or section, or one of another type. It is not missing besides.
    pub(super) meant: Vec<String>,
    pub(super) columns: Columns,
    /// The blocks of effects whose housing can move.
    pub(super) housed: Vec<u32>,
    pub(super) moments: Vec<Moment>,
}

impl<'v> Values<'v> {
    pub(super) fn new(variables: &'v [Variable]) -> Self {
        let (starts, columns) = (defaults(variables), Columns::default());
        let (places, refused, meant, housed, moments) = Default::default();
        Self { variables, starts, places, refused, meant, columns, housed, moments }
    }

    /// What a file may give a value: parameters and inputs.
    pub(super) fn settable(&self) -> impl Iterator<Item = &'v Variable> + use<'v> {
        self.variables.iter().filter(|variable| variable.meta.has_start())
    }

    pub(super) fn find(&self, name: &str) -> Option<&'v Variable> {
        self.settable().find(|variable| variable.name == name)
    }

    /// The value of the variable of this name, if it has one so far that is possible.
    pub(super) fn start(&self, name: &str) -> Option<f64> {
        let reference = self.find(name)?.place.value_reference();
        self.starts.get(&reference).copied().filter(|_| !self.refused.contains(&reference))
    }

    /// The names of those whose values are not as the file means them: refused, misspelt or missing.
    pub(super) fn unsure(&self) -> Vec<String> {
        let is_unsure = |variable: &&Variable| {
            let reference = variable.place.value_reference();
            let is_meant = self.meant.iter().any(|meant| variable.name.starts_with(&**meant));
            self.refused.contains(&reference) || !self.starts.contains_key(&reference) || is_meant
        };
        self.settable().filter(is_unsure).map(|variable| variable.name.clone()).collect()
    }

    /// Gives the variable of this name its value, None where that is not possible; `place` is that in the file.
    pub(super) fn give(&mut self, name: &str, value: Option<f64>, place: Range<usize>) {
        let Some(variable) = self.find(name) else { return };
        let reference = variable.place.value_reference();
        match value {
            Some(value) => _ = self.starts.insert(reference, value),
            None => self.refused.push(reference),
        }
        self.places.push((name.to_owned(), place));
    }

    /// Its effect has this housing, which moves unless the file says that it does not.
    pub(super) fn call_housing(&mut self, prefix: &str) {
        let Some(moves) = self.find(&format!("{prefix}.moves")).filter(|moves| moves.place.is_of_housing()) else {
            return;
        };
        self.starts.insert(moves.place.value_reference(), 1.0);
        self.housed.push(moves.place.block);
    }

    /// Whether there is such a variable: of a table so long, of a housing that the file names.
    pub(super) fn hold(&self, variable: &Variable) -> bool {
        let is_named = !variable.place.is_of_housing() || self.housed.contains(&variable.place.block);
        is_named && self.columns.hold(variable)
    }

    /// Without a support its point a need not be told: it is c.
    pub(super) fn measure_from_c(&mut self, called: &[(&'static Info, u32)]) {
        if called.iter().all(|(info, _)| info.name != SUPPORT)
            && let Some(l) = self.find("rotor.l")
        {
            self.starts.entry(l.place.value_reference()).or_insert(0.0);
        }
    }

    /// The keys that may follow `prefix`.
    pub(super) fn keys(&self, prefix: &str) -> Vec<&'v str> {
        let mut keys: Vec<&str> = Vec::new();
        for variable in self.settable() {
            if let Some(rest) = variable.name.strip_prefix(prefix).and_then(|rest| rest.strip_prefix('.')) {
                let key = rest.split(['.', '[']).next().unwrap_or(rest);
                if !keys.contains(&key) {
                    keys.push(key);
                }
            }
        }
        if is_unbalance(prefix) {
            keys.push(moment::KEY);
        }
        keys
    }

    /// What is said of a key that is known, but not where it stands: `prefix` is what names begin with there.
    pub(super) fn known_elsewhere(&self, prefix: &str, key: &str) -> Option<String> {
        let is_output = |variable: &Variable| {
            let rest = variable.name.strip_prefix(prefix).and_then(|rest| rest.strip_prefix('.'));
            rest.is_some_and(|rest| rest.split('.').next() == Some(key))
        };
        let home = |variable: &Variable| {
            let (section, rest) = variable.name.split_once('.')?;
            (rest.split(['.', '[']).next() == Some(key)).then(|| heading(&in_file(variable.place, section)))
        };
        let belongs = |to: String| Some(format!("it belongs under {to}"));
        if self.variables.iter().any(is_output) {
            Some("it is calculated, not given".into())
        } else if SECTIONS.contains(&key) {
            Some("it belongs at the head of the file, above all sections".into())
        } else if let Some(info) = effects::named(key) {
            Some(format!("write {}", heading(&info.switch_name(1))))
        } else if experiment::KEYS.iter().any(|known| known.name == key) {
            belongs("[experiment]".into())
        } else {
            belongs(self.settable().find_map(home)?)
        }
    }

    /// Switches on what is called for; of the rest, what has no default is zero, and counts only once it is switched on.
    pub(super) fn switch(&mut self, called: &[(&'static Info, u32)]) {
        let called: Vec<_> = called.iter().map(|(info, index)| Place::effect_block(info.number, *index)).collect();
        for variable in self.settable().filter(|variable| variable.place.block >= Place::FIRST_EFFECT) {
            let (Place { block, row }, reference) = (variable.place, variable.place.value_reference());
            let is_called = called.contains(&block);
            if row == Place::SWITCH {
                self.starts.insert(reference, f64::from(is_called));
            } else if !is_called {
                self.starts.entry(reference).or_insert(0.0);
            }
        }
    }
}

/// Whether the names of an unbalance begin so.
pub(super) fn is_unbalance(prefix: &str) -> bool {
    prefix.split('[').next() == Some(moment::EFFECT) && !prefix.contains('.')
}

/// The key of the section in the file: `effects.bearing[1]` of `bearing[1]`.
pub(super) fn in_file(place: Place, section: &str) -> String {
    if place.block < Place::FIRST_EFFECT { section.to_owned() } else { format!("effects.{section}") }
}

/// What stands in the file above the keys of a section: `[effects.drag]`, `[[effects.bearing]]`.
pub(super) fn heading(section: &str) -> String {
    match section.split_once('[') {
        Some((name, rest)) if rest.ends_with(']') => format!("[[{name}]]"),
        Some((name, rest)) => format!("[{name}{}]", rest.split_once(']').map_or("", |(_, within)| within)),
        None => format!("[{section}]"),
    }
}
