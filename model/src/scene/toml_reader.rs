//! From the text of a scene to its values. The known keys are the names of the variables; there is no second list.

use super::{Experiment, defaults};
use crate::effects::{self, CATALOGUE, Info};
use crate::error::Invalid;
use crate::variable::{Bound, Kind};
use crate::variables::{self, TOLERANCES, Variable};
use std::collections::BTreeMap;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// What a text says.
pub(super) struct Found {
    pub title: Option<String>,
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
}

impl<'v> Values<'v> {
    /// What a file may give a value: parameters and inputs.
    fn settable(&self) -> impl Iterator<Item = &'v Variable> + use<'v> {
        self.variables.iter().filter(|variable| variable.meta.has_start())
    }
}

/// A line from 1, where one is to blame, and what is wrong with it.
type Wrong = (Option<usize>, String);

const SECTIONS: &str = "title, rotor, start, effects, solver, experiment";
const EXPERIMENT: [&str; 4] = ["start", "stop", "step", "tolerance"];

pub(super) fn read(text: &str) -> Result<Found, Wrong> {
    let reader = Reader { text };
    let root = DeTable::parse(text).map_err(|error| {
        let line = error.span().map(|span| reader.line(span.start));
        (line, format!("is not TOML: {}", error.message().replace('\n', ", ")))
    })?;
    reader.scene(root.get_ref())
}

struct Reader<'t> {
    text: &'t str,
}

type Value<'i> = Spanned<DeValue<'i>>;

impl Reader<'_> {
    fn scene(&self, root: &DeTable) -> Result<Found, Wrong> {
        let mut title = None;
        let mut effects = Vec::new();
        for (key, value) in root {
            match key.get_ref().as_ref() {
                "title" => match value.get_ref().as_str() {
                    Some(text) => title = Some(text.to_owned()),
                    None => return Err(self.wrong_type(value, "title", "a string")),
                },
                "effects" => effects = self.effects(self.table(value, "effects")?)?,
                "rotor" | "start" | "solver" | "experiment" => {}
                other => {
                    let message = format!("unknown key `{other}`: a scene knows {SECTIONS}");
                    return Err((Some(self.line(key.span().start)), message));
                }
            }
        }
        let variables = variables::of_scene(&effects);
        let mut values = Values { variables: &variables, starts: defaults(&variables), lines: Vec::new() };
        for section in ["rotor", "start", "solver"] {
            if let Some(value) = root.get(section) {
                self.block(self.table(value, section)?, section, section, &mut values)?;
            }
        }
        if let Some(called) = root.get("effects").and_then(|value| value.get_ref().as_table()) {
            for (key, value) in called {
                let name = key.get_ref().as_ref();
                let section = format!("effects.{name}");
                self.block(self.table(value, &section)?, name, &section, &mut values)?;
            }
        }
        nothing_missing(&values)?;
        let Values { starts, lines, .. } = values;
        let tolerance = variables.iter().find(|variable| variable.name == "solver.relative_tolerance");
        let tolerance = tolerance.map_or(0.0, |variable| starts[&variable.place.value_reference()]);
        let experiment = self.experiment(root.get("experiment"), tolerance)?;
        Ok(Found { title, effects, variables, starts, experiment, lines })
    }

    /// The effects that are called for, in the order of the catalogue.
    fn effects(&self, called: &DeTable) -> Result<Vec<(&'static Info, u32)>, Wrong> {
        for (key, value) in called {
            if value.get_ref().is_array() {
                let message = format!("there is only one {0}: write [effects.{0}]", key.get_ref());
                return Err((Some(self.line(key.span().start)), message));
            }
            if effects::named(key.get_ref()).is_none() {
                let known: Vec<_> = CATALOGUE.iter().map(|info| info.name).collect();
                let message = format!("unknown effect `{}`: there are {}", key.get_ref(), known.join(", "));
                return Err((Some(self.line(key.span().start)), message));
            }
        }
        Ok(CATALOGUE.iter().filter(|info| called.contains_key(info.name)).map(|info| (info, 1)).collect())
    }

    /// Takes the values of a table whose keys are variables beginning with `prefix`; `section` is its key in the file.
    fn block(&self, table: &DeTable, prefix: &str, section: &str, values: &mut Values) -> Result<(), Wrong> {
        for (key, value) in table {
            let name = format!("{prefix}.{}", key.get_ref());
            let in_file = format!("{section}.{}", key.get_ref());
            let within = format!("{name}.");
            if let Some(variable) = values.settable().find(|variable| variable.name == name) {
                let number = self.number(value, variable, &in_file)?;
                values.starts.insert(variable.place.value_reference(), number);
                values.lines.push((name, self.line(value.span().start)));
            } else if values.settable().any(|variable| variable.name.starts_with(&within)) {
                let keys = next_keys(values.settable(), &name);
                let right = format!("a table of {}, such as {{ {} = 0.1 }}", keys.join(", "), keys[0]);
                let table = value.get_ref().as_table().ok_or_else(|| self.wrong_type(value, &in_file, &right))?;
                self.block(table, &name, &in_file, values)?;
            } else {
                let known = next_keys(values.settable(), prefix);
                let message = if known.is_empty() {
                    format!("unknown key `{in_file}`: [{section}] has no keys")
                } else {
                    format!("unknown key `{in_file}`: [{section}] knows {}", known.join(", "))
                };
                return Err((Some(self.line(key.span().start)), message));
            }
        }
        Ok(())
    }

    /// The value of a parameter, checked.
    fn number(&self, value: &Value, variable: &Variable, in_file: &str) -> Result<f64, Wrong> {
        let number = match variable.meta.kind {
            Kind::Real | Kind::Integer => as_number(value.get_ref()).ok_or_else(|| {
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
        let tolerance = or(3, tolerance, TOLERANCES, &TOLERANCES.words())?;
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
            let right = format!("give the {what} in {unit} as `{key} = ...` under [{section}]");
            return Err((None, format!("`{}` is missing: {right}", variable.name)));
        }
    }
    Ok(())
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
            let key = rest.split('.').next().unwrap_or(rest);
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
    }
    keys
}
