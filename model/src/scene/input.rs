//! `[[input]]`: an input over time, from the file of the scene or from a CSV beside it.

use super::columns::Wanted;
use super::csv::{Csv, DESCENDS};
use super::problem::Problem;
use super::reader::{Reader, Value};
use super::similar::{did_you_mean, similar};
use super::values::heading;
use crate::effects;
use crate::variable::Role;
use crate::variable::units::{SECOND, Unit};
use crate::variables::Variable;
use std::ops::Range;
use toml::de::DeTable;

/// The key of the section in the file, and its keys.
pub(super) const SECTION: &str = "input";
const KEYS: [&str; 5] = ["name", "time", "value", "file", "column"];

/// An input over time: linear between its points, held before and after them.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// The full name of its variable.
    pub name: String,
    /// Times that do not descend \[s], at least one; at two that are equal it jumps.
    pub time: Vec<f64>,
    /// Its value at each, in the unit of its variable.
    pub value: Vec<f64>,
}

impl Input {
    /// Its value at time `t` \[s] and how fast it changes from there on [1/s]; where it jumps, those after the jump.
    pub fn from(&self, t: f64) -> [f64; 2] {
        let after = self.time.partition_point(|time| *time <= t);
        let [from, to] = [after.saturating_sub(1), after.min(self.time.len() - 1)];
        let span = self.time[to] - self.time[from];
        if from == to || span <= 0.0 {
            return [self.value[from], 0.0];
        }
        let part = (t - self.time[from]) / span;
        let rate = (self.value[to] - self.value[from]) / span;
        [self.value[from] * (1.0 - part) + self.value[to] * part, rate]
    }
}

impl Reader<'_> {
    /// The inputs of a scene with these variables.
    pub(super) fn inputs(&mut self, root: &DeTable, variables: &[Variable]) -> Vec<Input> {
        let Some(value) = root.get(SECTION) else { return Vec::new() };
        let Some(tables) = value.get_ref().as_array() else {
            self.problems.push(Problem::at(
                self.place(value),
                "there may be several inputs",
                "write [[input]] above each",
            ));
            return Vec::new();
        };
        let mut inputs: Vec<Input> = Vec::new();
        for (value, number) in tables.iter().zip(1..) {
            let section = format!("{SECTION}[{number}]");
            let Some(table) = self.table(value, &section) else { continue };
            if let Some(input) = self.input(table, value, &section, variables) {
                if inputs.iter().any(|other| other.name == input.name) {
                    let wrong = format!("the input {} stands twice", input.name);
                    self.problems.push(Problem::at(self.place(value), wrong, "keep one [[input]] of each name"));
                }
                inputs.push(input);
            }
        }
        inputs
    }

    fn input(&mut self, table: &DeTable, whole: &Value, section: &str, variables: &[Variable]) -> Option<Input> {
        let before = self.problems.len();
        for key in table.keys().filter(|key| !KEYS.contains(&key.get_ref().as_ref())) {
            let known = format!("[[input]] knows {}", KEYS.join(", "));
            let name = format!("{section}.{}", key.get_ref());
            self.problems.push(Problem::unknown(key.span(), "key", &name, &KEYS, known));
        }
        let is_misspelt = |key: &str| {
            let mut unknown = table.keys().filter(|one| !KEYS.contains(&one.get_ref().as_ref()));
            unknown.any(|one| similar(one.get_ref(), KEYS) == [key])
        };
        let variable = match table.get("name") {
            None if is_misspelt("name") => None,
            None => self.missing(whole, "an input without a name", "give `name = ...`, such as \"drive.tau\""),
            Some(name) => self.variable(name, section, variables),
        };
        let unit = variable.map(|variable| variable.meta.unit);
        if let Some(column) = table.get("column").filter(|_| table.get("file").is_none()) {
            let right = "a column is one of a CSV: give `file = \"x.csv\"` too";
            self.problems.push(Problem::at(self.place(column), format!("{section}.column without a file"), right));
        }
        let points = match [table.get("file"), table.get("time"), table.get("value")] {
            [Some(file), None, None] => {
                let column = self.column(table, section);
                variable.and_then(|variable| self.of_file(file, section, Wanted { variable, variables, column }))
            }
            [None, Some(time), Some(value)] => {
                let times = self.numbers(time, &SECOND, &format!("{section}.time"));
                let values = unit.and_then(|unit| self.numbers(value, unit, &format!("{section}.value")));
                times.zip(values).map(|(times, values)| (times, values, self.place(time)))
            }
            _ if ["time", "value", "file"].into_iter().any(is_misspelt) => None,
            _ => self.missing(
                whole,
                "an input has either times and values or a file",
                "give `time = [...]` and `value = [...]`, or `file = \"x.csv\"`",
            ),
        };
        let (time, value, place) = points?;
        if time.len() != value.len() || time.is_empty() {
            let wrong = format!("{section} has {} times and {} values", time.len(), value.len());
            self.problems.push(Problem::at(place.clone(), wrong, "there must be as many of both, at least one"));
        } else if let Some(n) = (1..time.len()).find(|n| time[*n] < time[n - 1]) {
            let wrong = format!("{section}: the time {:?} s comes after {:?} s", time[n], time[n - 1]);
            self.problems.push(Problem::at(place, wrong, DESCENDS));
        }
        let name = variable?.name.clone();
        (self.problems.len() == before).then_some(Input { name, time, value })
    }

    fn missing<T>(&mut self, whole: &Value, wrong: &str, right: &str) -> Option<T> {
        self.problems.push(Problem::at(self.place(whole), wrong, right));
        None
    }

    /// The input of this name.
    fn variable<'v>(&mut self, value: &Value, section: &str, variables: &'v [Variable]) -> Option<&'v Variable> {
        let Some(name) = value.get_ref().as_str() else {
            return self.wrong_type(value, &format!("{section}.name"), "a name in quotes");
        };
        let inputs = || variables.iter().filter(|variable| matches!(variable.meta.role, Role::Input { .. }));
        let found = inputs().find(|variable| variable.name == name);
        if found.is_none() {
            let names: Vec<_> = inputs().map(|variable| &*variable.name).collect();
            let known = match &names[..] {
                [] => "the effects of this scene have no inputs".to_owned(),
                names => format!("the inputs are {}", names.join(", ")),
            };
            let block = name.split(['.', '[']).next().unwrap_or(name);
            let missing = || Some(format!("call for {}", heading(&effects::named(block)?.switch_name(1))));
            let is_there = variables.iter().any(|variable| variable.name.split(['.', '[']).next() == Some(block));
            let missing = if is_there { None } else { missing() };
            let right = missing.or_else(|| did_you_mean(name, names.iter().copied())).unwrap_or_default();
            let problem = Problem::at(self.place(value), format!("unknown input `{name}`"), right);
            self.problems.push(Problem { known, ..problem });
        }
        found
    }

    /// An array of finite numbers.
    fn numbers(&mut self, value: &Value, unit: &Unit, in_file: &str) -> Option<Vec<f64>> {
        let Some(numbers) = value.get_ref().as_array() else {
            return self.wrong_type(value, in_file, "an array of numbers");
        };
        let numbers: Vec<_> =
            numbers.iter().zip(1..).map(|(number, n)| self.finite(number, unit, &format!("{in_file}[{n}]"))).collect();
        numbers.into_iter().collect()
    }

    fn finite(&mut self, value: &Value, unit: &Unit, in_file: &str) -> Option<f64> {
        match self.real(value, unit, in_file)? {
            number if number.is_finite() => Some(number),
            _ => self.wrong_type(value, in_file, "a finite number"),
        }
    }

    /// The column that the file of an input has for it, where the scene says which.
    fn column<'t>(&mut self, table: &'t DeTable, section: &str) -> Option<(&'t str, Range<usize>)> {
        let value = table.get("column")?;
        match value.get_ref().as_str() {
            Some(column) => Some((column.trim(), self.place(value))),
            None => self.wrong_type(value, &format!("{section}.column"), "the name of a column in quotes"),
        }
    }

    /// The points of an input from a CSV.
    fn of_file(&mut self, value: &Value, section: &str, wanted: Wanted) -> Option<(Vec<f64>, Vec<f64>, Range<usize>)> {
        let Some(name) = value.get_ref().as_str() else {
            return self.wrong_type(value, &format!("{section}.file"), "the path of a CSV in quotes");
        };
        let place = self.place(value);
        let csv = Csv { path: &self.folder.join(name), name, place: place.clone() };
        let points = csv.points(&wanted).map_err(|wrong| self.problems.extend(wrong)).ok()?;
        Some((points.0, points.1, place))
    }
}

#[cfg(test)]
mod tests {
    use super::Input;

    #[test]
    fn exact_linear_between_points_and_jumps() {
        let input = Input { name: String::new(), time: vec![1.0, 2.0, 2.0, 4.0], value: vec![0.0, 1.0, 5.0, 6.0] };
        let course = [
            (0.0, [0.0, 0.0]),
            (1.0, [0.0, 1.0]),
            (1.5, [0.5, 1.0]),
            (2.0, [5.0, 0.5]),
            (3.0, [5.5, 0.5]),
            (4.0, [6.0, 0.0]),
            (9.0, [6.0, 0.0]),
        ];
        for (t, from_there) in course {
            assert_eq!(input.from(t), from_there, "{t}");
        }
        let constant = Input { name: String::new(), time: vec![1.0], value: vec![7.0] };
        assert_eq!([0.0, 1.0, 2.0].map(|t| constant.from(t)), [[7.0, 0.0]; 3]);
    }
}
