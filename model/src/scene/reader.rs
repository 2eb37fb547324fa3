//! From the text of a scene to its values. The known keys are the names of the variables; there is no second list.

use super::experiment::{self, Experiment};
use super::input::{self, Input};
use super::moment::{self, Moment};
use super::number::brackets;
use super::problem::Problem;
use super::similar::similar;
use super::values::{Values, heading, in_file, is_unbalance};
use super::{is_one_line, syntax};
use crate::effects::{self, CATALOGUE, Info};
use crate::variable::{Bound, Meta, Place};
use crate::variables::{self, Variable};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Effects that had another name, and what they are called now: `shaft` since 0.2.0, for elastic shafts need the name.
const RENAMED: &[(&str, &str)] = &[("shaft", "drive")];

/// What others call a key of a section.
const CALLED: &[(&str, &str, &str)] = &[
    ("rotor", "mass", "m"),
    ("rotor", "length", "l"),
    ("rotor", "Jp", "Ja"),
    ("rotor", "Ip", "Ja"),
    ("rotor", "Jd", "Jt"),
    ("rotor", "Id", "Jt"),
    ("rotor", "It", "Jt"),
    ("start", "speed", "omega"),
];

/// What a text says.
pub(super) struct Found {
    pub title: Option<String>,
    pub general: bool,
    pub effects: Vec<(&'static Info, u32)>,
    pub variables: Vec<Variable>,
    pub starts: BTreeMap<u32, f64>,
    pub experiment: Experiment,
    pub inputs: Vec<Input>,
    /// Where the file gives each parameter that it names.
    pub places: Vec<(String, Range<usize>)>,
    /// The names of parameters whose values are not as the file means them: refused, misspelt or missing.
    pub unsure: Vec<String>,
}

/// How many of a kind a general scene has at least.
const OF_A_KIND_IN_GENERAL: u32 = 2;

/// What a general scene holds whose file calls for these.
fn every_effect(called: &[(&Info, u32)]) -> Vec<(&'static Info, u32)> {
    let called = |info: &Info| called.iter().filter(|(one, _)| one.number == info.number).count() as u32;
    let number = |info: &Info| if info.several { called(info).max(OF_A_KIND_IN_GENERAL) } else { 1 };
    CATALOGUE.iter().flat_map(|info| (1..=number(info)).map(move |index| (info, index))).collect()
}

/// The keys at the head of a file, and its sections.
pub(super) const SECTIONS: [&str; 8] =
    ["title", "general", "rotor", "start", "effects", "solver", "experiment", input::SECTION];

/// Reads a scene whose file is in this folder, as far as it can be read, and what is wrong with it.
pub(super) fn read(text: &str, folder: &Path) -> (Option<Found>, Vec<Problem>) {
    let (root, errors) = DeTable::parse_recoverable(text);
    let (mut problems, rest_is_sound) = syntax::problems(text, &errors);
    let mut reader = Reader { text, folder, problems: Vec::new() };
    let found = rest_is_sound.then(|| reader.scene(root.get_ref()));
    // What else is wrong in a line that is no TOML follows from that.
    let mut others = reader.problems;
    others.retain(|other| {
        let line = other.place.as_ref().map(|place| syntax::line_around(text, place.start));
        !line.is_some_and(|line| problems.iter().any(|problem| syntax::within(problem, &line)))
    });
    problems.append(&mut others);
    (found, problems)
}

/// Reads on where something is wrong, and remembers what.
pub(super) struct Reader<'t> {
    text: &'t str,
    pub(super) folder: &'t Path,
    pub(super) problems: Vec<Problem>,
}

pub(super) type Value<'i> = Spanned<DeValue<'i>>;

impl Reader<'_> {
    fn scene(&mut self, root: &DeTable) -> Found {
        let title = root.get("title").and_then(|value| self.title(value));
        let general = root.get("general").is_some_and(|value| match value.get_ref() {
            DeValue::Boolean(given) => *given,
            _ => self.wrong_type(value, "general", "true or false"),
        });
        let tables = root.get("effects").and_then(|value| self.table(value, "effects"));
        let called = tables.map_or_else(Vec::new, |tables| self.effects(tables));
        let names: Vec<_> = called.iter().map(|(info, index, _)| (*info, *index)).collect();
        let (effects, mut variables) = if general {
            let all = every_effect(&names);
            let variables = variables::of_general(&all);
            (all, variables)
        } else {
            (names.clone(), variables::of_scene(&names))
        };
        let mut values = Values::new(&variables);
        self.sections(root, &mut values);
        let mut headings = Vec::new();
        for section in ["rotor", "start", "solver"] {
            if let Some(value) = root.get(section) {
                headings.push((section.to_owned(), self.place(value)));
                self.block(value, section, section, &mut values);
            }
        }
        for (info, index, value) in &called {
            let (name, section) = (info.block_name(*index), info.switch_name(*index));
            headings.push((name.clone(), self.place(value)));
            values.places.push((section.clone(), self.place(value)));
            self.block(value, &name, &section, &mut values);
            if value.get_ref().as_table().is_some_and(|table| table.is_empty()) {
                let given = info.where_empty.iter().map(|(key, value)| (effects::full_name(&name, key), *value));
                given.for_each(|(name, number)| values.give(&name, Some(number), self.place(value)));
            }
        }
        if general {
            values.switch(&names);
        }
        values.measure_from_c(&names);
        self.problems.extend(values.take_moments());
        self.nothing_missing(&values, &headings);
        self.problems.extend(values.columns.problems());
        let tolerance = values.find("solver.relative_tolerance");
        let tolerance = tolerance.map_or(0.0, |variable| values.starts[&variable.place.value_reference()]);
        let experiment = self.experiment(root.get("experiment"), tolerance, &mut values);
        let unsure = values.unsure();
        let absent: Vec<_> =
            variables.iter().filter(|variable| !values.hold(variable)).map(|variable| variable.place).collect();
        let Values { mut starts, places, .. } = values;
        absent.iter().for_each(|place| _ = starts.remove(&place.value_reference()));
        variables.retain(|variable| !absent.contains(&variable.place));
        let inputs = self.inputs(root, &variables);
        Found { title, general, effects, variables, starts, experiment, inputs, places, unsure }
    }

    fn title(&mut self, value: &Value) -> Option<String> {
        match value.get_ref().as_str() {
            Some(text) if is_one_line(text) => Some(text.to_owned()),
            Some(_) => self.wrong_type(value, "title", "one line without control characters"),
            None => self.wrong_type(value, "title", "a text in quotes"),
        }
    }

    /// A scene has these sections and no others.
    fn sections(&mut self, root: &DeTable, values: &mut Values) {
        for key in root.keys().filter(|key| !SECTIONS.contains(&key.get_ref().as_ref())) {
            let name = key.get_ref().as_ref();
            let known = format!("a scene knows {}", SECTIONS.join(", "));
            let problem = Problem::unknown(key.span(), "key", name, &SECTIONS, known);
            self.problems.push(problem.or_right(values.known_elsewhere("", name)));
            values.meant.extend(similar(name, SECTIONS).into_iter().map(str::to_owned));
        }
    }

    /// The effects that are called for, in the order of the catalogue, those of a kind in the order of the file, each with its table.
    fn effects<'v, 'i>(&mut self, called: &'v DeTable<'i>) -> Vec<(&'static Info, u32, &'v Value<'i>)> {
        let most = Place::OF_A_KIND as usize;
        let mut tables = Vec::new();
        for (key, value) in called {
            let name = key.get_ref().as_ref();
            let mut tell = |wrong: String, right: String| self.problems.push(Problem::at(key.span(), wrong, right));
            let Some(info) = effects::named(name) else {
                if let Some((_, now)) = RENAMED.iter().find(|(once, _)| *once == name) {
                    tell(format!("effect `{name}` has another name now"), format!("write [effects.{now}]"));
                } else {
                    let known: Vec<_> = CATALOGUE.iter().map(|info| info.name).collect();
                    let list = format!("the effects are {}", known.join(", "));
                    self.problems.push(Problem::unknown(key.span(), "effect", name, &known, list));
                }
                continue;
            };
            let several = match value.get_ref() {
                DeValue::Array(several) => &several[..],
                DeValue::Table(_) => std::slice::from_ref(value),
                _ if info.several => &[],
                _ => std::slice::from_ref(value),
            };
            match (info.several, value.get_ref()) {
                (false, DeValue::Array(_)) => {
                    tell(format!("there is only one {name}"), format!("write [effects.{name}]"));
                }
                (true, DeValue::Array(_)) if several.len() > most => tell(
                    format!("[[effects.{name}]] stands {} times", several.len()),
                    format!("there may be up to {most}"),
                ),
                (true, DeValue::Array(_)) | (false, _) => {}
                (true, _) => tell(
                    format!("there may be several of {name}"),
                    format!("write [[effects.{name}]], once for each, up to {most}"),
                ),
            }
            let most = if info.several { most } else { 1 };
            tables.extend((1..).zip(several).take(most).map(|(index, value)| (info, index, value)));
        }
        tables.sort_by_key(|(info, index, _)| (info.number, *index));
        tables
    }

    /// Takes the values of a table whose keys are variables beginning with `prefix`; `section` is its key in the file.
    fn block(&mut self, value: &Value, prefix: &str, section: &str, values: &mut Values) {
        let Some(table) = self.table(value, section) else {
            values.meant.push(prefix.to_owned());
            return;
        };
        for (key, value) in table {
            let (name, in_file) = (format!("{prefix}.{}", key.get_ref()), format!("{section}.{}", key.get_ref()));
            let (place, in_table) = (self.place(value), values.find(&format!("{name}[1]")));
            if let (Some(first), Some(numbers)) = (in_table, value.get_ref().as_array()) {
                let column = values.columns.add(first, in_file.clone(), numbers.len(), place);
                self.problems.extend(column);
                for (node, number) in (1..).zip(numbers.iter()) {
                    let name = format!("{name}[{node}]");
                    if let Some(variable) = values.find(&name) {
                        let given = self.number(number, &variable.meta, &format!("{in_file}[{node}]"));
                        values.give(&name, given, self.place(number));
                    }
                }
            } else if let Some(variable) = values.find(&name) {
                let given = self.number(value, &variable.meta, &in_file);
                values.give(&name, given, place);
            } else if let Some(first) = in_table {
                self.wrong_type(value, &in_file, &format!("an array of numbers in {}", first.meta.unit.name))
            } else if values.settable().any(|variable| variable.name.starts_with(&format!("{name}."))) {
                if value.get_ref().as_table().is_some() {
                    values.call_housing(&name);
                    self.block(value, &name, &in_file, values);
                } else {
                    let (keys, given) = (values.keys(&name), value.get_ref());
                    let is_one = given.is_str() || given.is_float() || given.is_integer();
                    let one = if is_one { self.given(value) } else { "0.1".into() };
                    let right = format!("a table of {}, such as {{ {} = {one} }}", keys.join(", "), keys[0]);
                    self.wrong_type(value, &in_file, &right)
                }
            } else if is_unbalance(prefix) && key.get_ref() == moment::KEY {
                self.moment(table, value, prefix, &in_file, values);
            } else {
                self.unknown_key(key, prefix, section, &values.keys(prefix), values);
            }
        }
    }

    /// A key that is none of those that the section knows.
    fn unknown_key(
        &mut self,
        key: &Spanned<impl AsRef<str>>,
        prefix: &str,
        section: &str,
        known: &[&str],
        values: &mut Values,
    ) {
        let (key, place, heading) = (key.get_ref().as_ref(), key.span(), heading(section));
        let list = match known {
            [] => format!("{heading} has no keys"),
            known => format!("{heading} knows {}", known.join(", ")),
        };
        let problem = Problem::unknown(place, "key", &format!("{section}.{key}"), known, list);
        let called = CALLED.iter().find(|(of, also, _)| (*of, *also) == (prefix, key)).map(|(.., name)| *name);
        let meant = called.map_or_else(|| similar(key, known.iter().copied()), |name| vec![name]);
        if let [one] = meant[..] {
            values.meant.push(format!("{prefix}.{one}"));
        }
        self.problems.push(match called {
            Some(name) => Problem { right: format!("did you mean `{name}`?"), ..problem },
            None => problem.or_right(values.known_elsewhere(prefix, key)),
        });
    }

    /// Takes the moment of an unbalance, which stands for mass and radius.
    fn moment(&mut self, table: &DeTable, value: &Value, block: &str, in_file: &str, values: &mut Values) {
        let meta = Meta::parameter(moment::KEY, &moment::UNIT, None, Bound::NotNegative, moment::MEANING);
        let (mut number, place) = (self.number(value, &meta, in_file), self.place(value));
        if let Some(other) = table.keys().find(|key| moment::INSTEAD_OF.contains(&key.get_ref().as_ref())) {
            let right = "a moment is mass times radius: give either the moment or both of these";
            self.problems.push(Problem::at(other.span(), format!("`{}` beside a moment", other.get_ref()), right));
            number = None;
        }
        values.moments.push(Moment { block: block.to_owned(), value: number, place });
    }

    fn experiment(&mut self, value: Option<&Value>, tolerance: f64, values: &mut Values) -> Experiment {
        let mut given = [const { None }; experiment::KEYS.len()];
        for (key, value) in value.and_then(|value| self.table(value, "experiment")).into_iter().flatten() {
            let name = key.get_ref().as_ref();
            if let Some(n) = experiment::KEYS.iter().position(|known| known.name == name) {
                let name = format!("experiment.{name}");
                given[n] = self.real(value, experiment::KEYS[n].unit, &name).map(|number| (number, value));
                values.places.push((name, self.place(value)));
            } else {
                let known = experiment::KEYS.map(|known| known.name);
                self.unknown_key(key, "experiment", "experiment", &known, values);
            }
        }
        let (experiment, wrong) = Experiment::of(given.map(|given| given.map(|(number, _)| number)), tolerance);
        for (n, right) in wrong {
            if let Some((_, value)) = given[n] {
                self.wrong_type(value, &format!("experiment.{}", experiment::KEYS[n].name), &right)
            }
        }
        experiment
    }

    pub(super) fn table<'v, 'i>(&mut self, value: &'v Value<'i>, key: &str) -> Option<&'v DeTable<'i>> {
        value.get_ref().as_table().or_else(|| self.wrong_type(value, key, "a table"))
    }

    /// Tells what a value must be; what is to be read instead is the default.
    pub(super) fn wrong_type<T: Default>(&mut self, value: &Value, key: &str, right: &str) -> T {
        let wrong = format!("{key} = {} is not possible", self.given(value));
        self.problems.push(Problem::at(self.place(value), wrong, format!("it must be {right}")));
        T::default()
    }

    /// Every parameter has a value.
    fn nothing_missing(&mut self, values: &Values, headings: &[(String, Range<usize>)]) {
        let mut missing: Vec<(&str, Vec<&Variable>)> = Vec::new();
        for variable in values.settable() {
            let (reference, name) = (variable.place.value_reference(), &variable.name);
            let is_told = values.starts.contains_key(&reference) || values.refused.contains(&reference);
            let section = name.split_once('.').map_or("", |(section, _)| section);
            if !is_told && !values.meant.iter().any(|meant| meant == name || meant == section) {
                match missing.last_mut().filter(|(last, _)| *last == section) {
                    Some((_, variables)) => variables.push(variable),
                    None => missing.push((section, vec![variable])),
                }
            }
        }
        for (section, variables) in missing {
            let key = |variable: &Variable| {
                let key = variable.name[section.len() + 1..].to_owned();
                let has_moment = is_unbalance(section) && moment::INSTEAD_OF.contains(&&*key);
                let or = if has_moment { ", or `moment = ...` instead of mass and radius" } else { "" };
                format!("`{key} = ...`, the {}{}{or}", variable.meta.description, brackets(variable.meta.unit))
            };
            let (keys, at) =
                (variables.iter().map(|variable| key(variable)), headings.iter().find(|(of, _)| of == section));
            if let Some((_, place)) = at {
                let problems = variables.iter().zip(keys).map(|(variable, key)| {
                    Problem::at(place.clone(), format!("`{}` is missing", variable.name), format!("give {key}"))
                });
                self.problems.extend(problems);
            } else {
                let heading = heading(&in_file(variables[0].place, section));
                let right = format!("give {heading} with {}", keys.collect::<Vec<_>>().join("; "));
                self.problems.push(Problem::of_file(format!("{heading} is missing"), right));
            }
        }
    }

    /// Where a value stands, the first line of it.
    pub(super) fn place(&self, value: &Value) -> Range<usize> {
        let Range { start, end } = value.span();
        start..end.min(syntax::line_around(self.text, start).end)
    }

    /// What the file has for a value; of several lines the first.
    pub(super) fn given(&self, value: &Value) -> String {
        let (place, rest) = (self.place(value), value.span().end);
        format!("{}{}", &self.text[place.clone()], if place.end < rest { " ..." } else { "" })
    }
}
