//! The keys of scenes, section by section, as the list of variables has them.

use super::experiment::{self, Experiment};
use super::tables::SPEED;
use super::units::{PREFIXES, UNITS};
use super::values::{heading, in_file, is_unbalance};
use super::{Scene, moment};
use crate::effects::table::MOST_NODES;
use crate::effects::{CATALOGUE, Info};
use crate::variable::units::Unit;
use crate::variable::{Bound, Kind, Meta, Place, Role};
use crate::variables::{self, Variable};
use std::collections::BTreeMap;

/// A section of a scene's file.
pub struct Section {
    /// What stands above its keys: `[[effects.bearing]]`.
    pub heading: String,
    /// The effect that it calls for, if it is one.
    pub effect: Option<&'static Info>,
    /// Its keys.
    pub keys: Vec<Key>,
}

/// A key of a section.
pub struct Key {
    /// Its name, with a dot before a component: `r_c.x`.
    pub name: String,
    /// Whether it stands for an array.
    pub is_array: bool,
    /// Its value, as the file of a scene has it; None where no scene is asked for, and where another key stands in its place.
    pub value: Option<String>,
    /// What it is where the file does not give it; None where the file must.
    pub default: Option<String>,
    /// Its unit; empty of a pure number.
    pub unit: &'static str,
    /// What it must be; empty where any number will do.
    pub bound: String,
    /// What it is.
    pub meaning: String,
}

/// The names of the units that a text may give a number in: those that may have a prefix, and the others.
pub fn units() -> [Vec<&'static str>; 2] {
    [true, false].map(|prefixed| UNITS.iter().filter(|unit| unit.prefixed == prefixed).map(|unit| unit.name).collect())
}

/// Their prefixes.
pub fn prefixes() -> Vec<&'static str> {
    PREFIXES.iter().map(|(prefix, _)| *prefix).collect()
}

/// All sections that a scene may have.
pub fn all() -> Vec<Section> {
    let effects: Vec<_> = CATALOGUE.iter().map(|info| (info, 1)).collect();
    let variables = variables::of_scene(&effects);
    let mut sections = sections(&variables, &effects, None);
    sections.push(experiment(None));
    sections
}

/// The sections of a scene, with those of the effects that are on, and its values.
pub fn of(scene: &Scene) -> Vec<Section> {
    let effects: Vec<_> = scene.acting().collect();
    let mut sections = sections(&scene.variables, &effects, Some(&scene.starts));
    sections.push(experiment(Some(scene)));
    sections
}

fn sections(list: &[Variable], effects: &[(&'static Info, u32)], starts: Option<&BTreeMap<u32, f64>>) -> Vec<Section> {
    let always = ["rotor", "start", "solver"].map(|name| (name.to_owned(), None));
    let effects = effects.iter().map(|(info, index)| (info.block_name(*index), Some(*info)));
    let section = |(name, effect): (String, Option<&'static Info>)| {
        let within = format!("{name}.");
        let own = list.iter().filter(|variable| variable.meta.has_start() && variable.name.starts_with(&within));
        let own: Vec<_> = own.collect();
        let place = own.first().map_or(Place { block: Place::FIRST_EFFECT, row: 0 }, |variable| variable.place);
        let keys = own.iter().filter_map(|variable| key(variable, &within, &own, starts));
        let moment = (is_unbalance(&name) && starts.is_none()).then(moment);
        Section { heading: heading(&in_file(place, &name)), effect, keys: keys.chain(moment).collect() }
    };
    always.into_iter().chain(effects).map(section).collect()
}

/// What is said of a variable's key; of a table's nodes the first stands for the column.
fn key(variable: &Variable, within: &str, own: &[&Variable], starts: Option<&BTreeMap<u32, f64>>) -> Option<Key> {
    let Variable { name, meta, .. } = variable;
    let given = |variable: &Variable| starts.map(|starts| starts[&variable.place.value_reference()]);
    let column = |column: &str| -> Vec<&Variable> {
        own.iter().copied().filter(|other| other.meta.node().is_some_and(|(of, _)| of == column)).collect()
    };
    let is_given = |column: &[&Variable]| column.iter().any(|node| given(node) != node.meta.default());
    let (value, is_array) = match meta.node() {
        Some((_, node)) if node > 1 => return None,
        Some((of, _)) => {
            let nodes = column(of);
            let numbers: Option<Vec<_>> = nodes.iter().map(|node| Some(written(&node.meta, given(node)?))).collect();
            (numbers.filter(|_| is_given(&nodes)).map(|numbers| format!("[{}]", numbers.join(", "))), true)
        }
        // A file gives either a number or a column.
        None if starts.is_some() && is_given(&column(meta.name)) => (None, false),
        None => (given(variable).map(|value| written(meta, value)), false),
    };
    let bound = match (meta.role, meta.kind) {
        (_, Kind::Enumeration(of)) => {
            of.items.iter().map(|item| format!("\"{}\"", item.1)).collect::<Vec<_>>().join(" or ")
        }
        (_, Kind::Boolean) => "true or false".into(),
        (Role::Parameter { bound, .. }, kind) if meta.node().is_some_and(|(of, _)| of == SPEED) => {
            format!("{}, ascending, up to {MOST_NODES}", words(bound, kind))
        }
        (Role::Parameter { bound: Bound::Finite, .. } | Role::Input { .. }, _) => String::new(),
        (Role::Parameter { bound, .. }, kind) => words(bound, kind),
        _ => String::new(),
    };
    let (name, mut meaning) = (&name[within.len()..], meta.description.replace("node 1", "each node"));
    if meta.node().is_some_and(|(of, _)| of == SPEED) {
        meaning += "; between nodes monotone cubics, level at both ends, beyond them constant; at negative omega_phi kyz, kzy, cyz, czy of \
                    the table change their sign";
    }
    let (name, default) = if is_array {
        (name.split('[').next().unwrap_or(name), Some("no table".to_owned()))
    } else {
        (name, meta.default().map(|value| written(meta, value)))
    };
    Some(Key { name: name.to_owned(), is_array, value, default, unit: meta.unit.name, bound, meaning })
}

/// The key that stands for two of an unbalance.
fn moment() -> Key {
    Key {
        name: moment::KEY.into(),
        is_array: false,
        value: None,
        default: Some(String::new()),
        unit: moment::UNIT.name,
        bound: words(Bound::NotNegative, Kind::Real),
        meaning: moment::MEANING.into(),
    }
}

fn experiment(scene: Option<&Scene>) -> Section {
    let keys = experiment::KEYS.iter().enumerate().map(|(n, key)| {
        let experiment::Key { name, unit: Unit { name: unit, .. }, default, bound, meaning, get } = key;
        let number = |value: f64| format!("{value:?}");
        let value = scene.map(|scene| number(get(&scene.experiment)));
        let default = scene.map_or((*default).into(), |scene| {
            let before = std::array::from_fn(|m| (m < n).then(|| (experiment::KEYS[m].get)(&scene.experiment)));
            number(get(&Experiment::of(before, scene.parameters().setup.solver.relative_tolerance).0))
        });
        let (name, bound, meaning) = ((*name).into(), (*bound).into(), (*meaning).into());
        Key { name, is_array: false, value, default: Some(default), unit, bound, meaning }
    });
    Section { heading: "[experiment]".into(), effect: None, keys: keys.collect() }
}

/// What a value must be besides a finite number, in words.
fn words(bound: Bound, kind: Kind) -> String {
    bound.words(kind).replace("a finite number ", "").replace("a number ", "")
}

/// A value as the file of a scene has it.
fn written(meta: &Meta, value: f64) -> String {
    match meta.kind {
        Kind::Real => format!("{value:?}"),
        Kind::Integer => value.to_string(),
        Kind::Boolean => (value != 0.0).to_string(),
        Kind::Enumeration(of) => {
            let item = of.items.iter().find(|item| f64::from(item.0) == value);
            item.map_or_else(|| value.to_string(), |item| format!("\"{}\"", item.1))
        }
    }
}
