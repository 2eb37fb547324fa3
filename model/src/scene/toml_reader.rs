//! From the text of a scene to its values. The known keys are the names of the variables; there is no second list.

use super::tables::Columns;
use super::{Experiment, defaults, is_one_line};
use crate::effects::{self, CATALOGUE, Info};
use crate::error::Invalid;
use crate::variable::{Bound, Kind, Place};
use crate::variables::{self, TOLERANCES, Variable};
use std::collections::BTreeMap;
use std::fmt::Write;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Effects that had another name, and what they are called now: `shaft` since 0.2.0, for elastic shafts need the name.
const RENAMED: &[(&str, &str)] = &[("shaft", "drive")];

/// The effect that is measured from the support point a.
const SUPPORT: &str = "support";

/// What a text says.
pub(super) struct Found {
    pub title: Option<String>,
    pub general: bool,
    pub effects: Vec<(&'static Info, u32)>,
    pub variables: Vec<Variable>,
    pub starts: BTreeMap<u32, f64>,
    pub experiment: Experiment,
    /// The line of each parameter that the file names.
    pub lines: Vec<(String, usize)>,
}

/// The values of a scene, while they are read.
struct Values<'v> {
    variables: &'v [Variable],
    starts: BTreeMap<u32, f64>,
    lines: Vec<(String, usize)>,
    columns: Columns,
}

impl<'v> Values<'v> {
    /// What a file may give a value: parameters and inputs.
    fn settable(&self) -> impl Iterator<Item = &'v Variable> + use<'v> {
        self.variables.iter().filter(|variable| variable.meta.has_start())
    }
}

impl Values<'_> {
    /// Without a support its point a need not be told: it is c.
    fn measure_from_c(&mut self, called: &[(&'static Info, u32)]) {
        if called.iter().all(|(info, _)| info.name != SUPPORT)
            && let Some(l) = self.variables.iter().find(|variable| variable.name == "rotor.l")
        {
            self.starts.entry(l.place.value_reference()).or_insert(0.0);
        }
    }

    /// Switches on what is called for; of the rest, what has no default is zero, and counts only once it is switched on.
    fn switch(&mut self, called: &[(&'static Info, u32)]) {
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

/// How many of a kind a general scene has at least.
const OF_A_KIND_IN_GENERAL: u32 = 2;

/// What a general scene holds whose file calls for these.
fn every_effect(called: &[(&Info, u32)]) -> Vec<(&'static Info, u32)> {
    let called = |info: &Info| called.iter().filter(|(one, _)| one.number == info.number).count() as u32;
    let number = |info: &Info| if info.several { called(info).max(OF_A_KIND_IN_GENERAL) } else { 1 };
    CATALOGUE.iter().flat_map(|info| (1..=number(info)).map(move |index| (info, index))).collect()
}

/// A line from 1, where one is to blame, and what is wrong with it.
pub(super) type Wrong = (Option<usize>, String);

/// What the reader of TOML calls a key that stands twice in a table.
const DUPLICATE: &str = "duplicate key";

const SECTIONS: &str = "title, general, rotor, start, effects, solver, experiment";
const EXPERIMENT: [&str; 4] = ["start", "stop", "step", "tolerance"];

pub(super) fn read(text: &str) -> Result<Found, Wrong> {
    let reader = Reader { text };
    let root = DeTable::parse(text).map_err(|error| {
        let line = error.span().map(|span| reader.line(span.start));
        let mut message = format!("is not TOML: {}", error.message().replace('\n', ", "));
        // Every other message shows what was found.
        if let (DUPLICATE, Some(span)) = (error.message(), error.span()) {
            write!(message, " `{}`", &text[span]).expect("a text can be written to");
        }
        (line, message)
    })?;
    reader.scene(root.get_ref())
}

struct Reader<'t> {
    text: &'t str,
}

type Value<'i> = Spanned<DeValue<'i>>;

impl Reader<'_> {
    fn scene(&self, root: &DeTable) -> Result<Found, Wrong> {
        let (mut title, mut general) = (None, false);
        if let Some(value) = root.get("general") {
            let given = value.get_ref().as_bool();
            general = given.ok_or_else(|| self.wrong_type(value, "general", "true or false"))?;
        }
        let mut called = Vec::new();
        for (key, value) in root {
            match key.get_ref().as_ref() {
                "title" => match value.get_ref().as_str() {
                    None => return Err(self.wrong_type(value, "title", "a string")),
                    Some(text) if !is_one_line(text) => {
                        return Err(self.wrong_type(value, "title", "one line without control characters"));
                    }
                    Some(text) => title = Some(text.to_owned()),
                },
                "effects" => called = self.effects(self.table(value, "effects")?)?,
                "general" | "rotor" | "start" | "solver" | "experiment" => {}
                other => {
                    let message = format!("unknown key `{other}`: a scene knows {SECTIONS}");
                    return Err((Some(self.line(key.span().start)), message));
                }
            }
        }
        let (effects, mut variables) = if general {
            let all = every_effect(&called);
            let variables = variables::of_general(&all);
            (all, variables)
        } else {
            (called.clone(), variables::of_scene(&called))
        };
        let (starts, columns) = (defaults(&variables), Columns::default());
        let mut values = Values { variables: &variables, starts, lines: Vec::new(), columns };
        for section in ["rotor", "start", "solver"] {
            if let Some(value) = root.get(section) {
                self.block(self.table(value, section)?, section, section, &mut values)?;
            }
        }
        if let Some(tables) = root.get("effects").and_then(|value| value.get_ref().as_table()) {
            for (info, index) in &called {
                let (name, section, value) = (info.block_name(*index), info.switch_name(*index), &tables[info.name]);
                let value = value.get_ref().as_array().map_or(value, |several| &several[*index as usize - 1]);
                values.lines.push((section.clone(), self.line(value.span().start)));
                self.block(self.table(value, &section)?, &name, &section, &mut values)?;
            }
        }
        if general {
            values.switch(&called);
        }
        values.measure_from_c(&called);
        nothing_missing(&values)?;
        let Values { mut starts, lines, columns, .. } = values;
        columns.check()?;
        let is_there = |variable: &Variable| columns.hold(variable);
        variables.iter().filter(|variable| !is_there(variable)).for_each(|variable| {
            starts.remove(&variable.place.value_reference());
        });
        variables.retain(is_there);
        let tolerance = variables.iter().find(|variable| variable.name == "solver.relative_tolerance");
        let tolerance = tolerance.map_or(0.0, |variable| starts[&variable.place.value_reference()]);
        let experiment = self.experiment(root.get("experiment"), tolerance)?;
        Ok(Found { title, general, effects, variables, starts, experiment, lines })
    }

    /// The effects that are called for, in the order of the catalogue, those of a kind in the order of the file.
    fn effects(&self, called: &DeTable) -> Result<Vec<(&'static Info, u32)>, Wrong> {
        let most = Place::OF_A_KIND;
        for (key, value) in called {
            let here = |message| Err((Some(self.line(key.span().start)), message));
            let name = key.get_ref().as_ref();
            let Some(info) = effects::named(name) else {
                if let Some((_, now)) = RENAMED.iter().find(|(once, _)| *once == name) {
                    return here(format!("effect `{name}` is now called `{now}`: write [effects.{now}]"));
                }
                let known: Vec<_> = CATALOGUE.iter().map(|info| info.name).collect();
                return here(format!("unknown effect `{name}`: there are {}", known.join(", ")));
            };
            match (info.several, value.get_ref()) {
                (false, DeValue::Array(_)) => {
                    return here(format!("there is only one {name}: write [effects.{name}]"));
                }
                (true, DeValue::Array(several)) if several.len() > most as usize => {
                    let given = several.len();
                    return here(format!("[[effects.{name}]] stands {given} times: there may be up to {most}"));
                }
                (false, _) | (true, DeValue::Array(_)) => {}
                (true, _) => {
                    let right = format!("write [[effects.{name}]], once for each, up to {most}");
                    return here(format!("there may be several of {name}: {right}"));
                }
            }
        }
        let number = |info: &Info| match called.get(info.name).map(Spanned::get_ref) {
            None => 0,
            Some(DeValue::Array(several)) => several.len() as u32,
            Some(_) => 1,
        };
        Ok(CATALOGUE.iter().flat_map(|info| (1..=number(info)).map(move |index| (info, index))).collect())
    }

    /// Takes the values of a table whose keys are variables beginning with `prefix`; `section` is its key in the file.
    fn block(&self, table: &DeTable, prefix: &str, section: &str, values: &mut Values) -> Result<(), Wrong> {
        for (key, value) in table {
            let name = format!("{prefix}.{}", key.get_ref());
            let in_file = format!("{section}.{}", key.get_ref());
            let within = format!("{name}.");
            let first = format!("{name}[1]");
            let in_table = values.settable().find(|variable| variable.name == first);
            if let (Some(first), Some(numbers)) = (in_table, value.get_ref().as_array()) {
                let line = self.line(value.span().start);
                values.columns.add(first, in_file.clone(), numbers.len(), line)?;
                for (node, number) in (1..).zip(numbers.iter()) {
                    let name = format!("{name}[{node}]");
                    let variable = values.settable().find(|variable| variable.name == name).expect("they were counted");
                    let value = self.number(number, variable, &format!("{in_file}[{node}]"))?;
                    values.starts.insert(variable.place.value_reference(), value);
                    values.lines.push((name, self.line(number.span().start)));
                }
            } else if let Some(variable) = values.settable().find(|variable| variable.name == name) {
                let number = self.number(value, variable, &in_file)?;
                values.starts.insert(variable.place.value_reference(), number);
                values.lines.push((name, self.line(value.span().start)));
            } else if let Some(first) = in_table {
                let right = format!("an array of numbers in {}", first.meta.unit.name);
                return Err(self.wrong_type(value, &in_file, &right));
            } else if values.settable().any(|variable| variable.name.starts_with(&within)) {
                let keys = next_keys(values.settable(), &name);
                let right = format!("a table of {}, such as {{ {} = 0.1 }}", keys.join(", "), keys[0]);
                let table = value.get_ref().as_table().ok_or_else(|| self.wrong_type(value, &in_file, &right))?;
                self.block(table, &name, &in_file, values)?;
            } else {
                let known = next_keys(values.settable(), prefix);
                let section = heading(section);
                let message = if known.is_empty() {
                    format!("unknown key `{in_file}`: {section} has no keys")
                } else {
                    format!("unknown key `{in_file}`: {section} knows {}", known.join(", "))
                };
                return Err((Some(self.line(key.span().start)), message));
            }
        }
        Ok(())
    }

    /// The value of a parameter, checked.
    fn number(&self, value: &Value, variable: &Variable, in_file: &str) -> Result<f64, Wrong> {
        let number = match variable.meta.kind {
            Kind::Real | Kind::Integer | Kind::Boolean => as_number(value.get_ref()).ok_or_else(|| {
                let unit = variable.meta.unit.name;
                let right = if unit.is_empty() { "a number".into() } else { format!("a number in {unit}") };
                self.wrong_type(value, in_file, &right)
            })?,
            Kind::Enumeration(of) => {
                let names: Vec<_> = of.items.iter().map(|(_, name, _)| format!("\"{name}\"")).collect();
                let right = format!("one of {}", names.join(", "));
                let name = value.get_ref().as_str().ok_or_else(|| self.wrong_type(value, in_file, &right))?;
                let item = of.items.iter().find(|item| item.1 == name);
                f64::from(item.ok_or_else(|| self.wrong_type(value, in_file, &right))?.0)
            }
        };
        let here = |invalid: Invalid| (Some(self.line(value.span().start)), invalid.to_string());
        variable.meta.check(|| in_file.to_owned(), number).map_err(here)?;
        Ok(number)
    }

    fn experiment(&self, value: Option<&Value>, tolerance: f64) -> Result<Experiment, Wrong> {
        let mut given = [const { None }; 4];
        if let Some(value) = value {
            for (key, value) in self.table(value, "experiment")? {
                let Some(place) = EXPERIMENT.iter().position(|name| *name == key.get_ref().as_ref()) else {
                    let known = EXPERIMENT.join(", ");
                    let message = format!("unknown key `experiment.{}`: [experiment] knows {known}", key.get_ref());
                    return Err((Some(self.line(key.span().start)), message));
                };
                let in_file = format!("experiment.{}", EXPERIMENT[place]);
                let right = if place == 3 { "a number" } else { "a number in s" };
                let number = as_number(value.get_ref()).ok_or_else(|| self.wrong_type(value, &in_file, right))?;
                given[place] = Some((number, self.line(value.span().start), in_file));
            }
        }
        let or = |place: usize, default: f64, bound: Bound, right: &str| match &given[place] {
            None => Ok(default),
            Some((number, ..)) if bound.holds(*number) => Ok(*number),
            Some((number, line, key)) => Err((Some(*line), Invalid::new(key, *number, right).to_string())),
        };
        let start = or(0, 0.0, Bound::Finite, "a finite number in s")?;
        let after_start = Bound::Within(start + f64::MIN_POSITIVE.max(start.abs() * f64::EPSILON), f64::MAX);
        let stop = or(1, start + 10.0, after_start, &format!("later than experiment.start = {start:?} s"))?;
        let within = Bound::Within(f64::MIN_POSITIVE, stop - start);
        let right = format!("a number of seconds > 0, at most stop - start = {:?} s", stop - start);
        let step = or(2, (stop - start) / 1000.0, within, &right)?;
        let tolerance = or(3, tolerance, TOLERANCES, &TOLERANCES.words(Kind::Real))?;
        Ok(Experiment { start, stop, step, tolerance })
    }

    fn table<'v, 'i>(&self, value: &'v Value<'i>, key: &str) -> Result<&'v DeTable<'i>, Wrong> {
        value.get_ref().as_table().ok_or_else(|| self.wrong_type(value, key, "a table"))
    }

    fn wrong_type(&self, value: &Value, key: &str, right: &str) -> Wrong {
        let given = self.text[value.span()].lines().next().unwrap_or_default();
        (Some(self.line(value.span().start)), format!("{key} = {given} is not possible: it must be {right}"))
    }

    fn line(&self, offset: usize) -> usize {
        self.text[..offset].matches('\n').count() + 1
    }
}

/// Every parameter has a value.
fn nothing_missing(values: &Values) -> Result<(), Wrong> {
    for variable in values.settable() {
        if !values.starts.contains_key(&variable.place.value_reference()) {
            let (unit, what) = (variable.meta.unit.name, variable.meta.description);
            let (section, key) = variable.name.split_once('.').unwrap_or(("", &variable.name));
            let of_effect = if variable.place.block < Place::FIRST_EFFECT { "" } else { "effects." };
            let within = heading(&format!("{of_effect}{section}"));
            let unit = if unit.is_empty() { String::new() } else { format!(" in {unit}") };
            let right = format!("give the {what}{unit} as `{key} = ...` under {within}");
            return Err((None, format!("`{}` is missing: {right}", variable.name)));
        }
    }
    Ok(())
}

/// What stands in the file above the keys of a section: `[effects.drag]`, `[[effects.bearing]]`.
fn heading(section: &str) -> String {
    match section.split_once('[') {
        Some((name, rest)) if rest.ends_with(']') => format!("[[{name}]]"),
        Some((name, rest)) => format!("[{name}{}]", rest.split_once(']').map_or("", |(_, within)| within)),
        None => format!("[{section}]"),
    }
}

fn as_number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(integer) => Some(i64::from_str_radix(integer.as_str(), integer.radix()).ok()? as f64),
        _ => None,
    }
}

/// The keys that may follow `prefix`.
fn next_keys<'v>(settable: impl Iterator<Item = &'v Variable>, prefix: &str) -> Vec<&'v str> {
    let mut keys: Vec<&str> = Vec::new();
    for variable in settable {
        if let Some(rest) = variable.name.strip_prefix(prefix).and_then(|rest| rest.strip_prefix('.')) {
            let key = rest.split(['.', '[']).next().unwrap_or(rest);
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
    }
    keys
}
