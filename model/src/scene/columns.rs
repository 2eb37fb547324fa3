//! Which columns of a CSV are the time and the value of an input, and in which units.

use super::number::brackets;
use super::similar::did_you_mean;
use super::units::{self, Unreadable};
use crate::effects;
use crate::variable::Role;
use crate::variable::units::{SECOND, Unit};
use crate::variables::Variable;
use std::ops::Range;

/// What the column of times is called.
const TIMES: [&str; 2] = ["time", "t"];

/// A column: its place, the unit of the input's variable, and how its head writes another one.
pub(super) struct Column<'l> {
    pub index: usize,
    pub unit: &'static Unit,
    pub written: Option<&'l str>,
}

/// The cells of a line, between commas that stand in no quotes, without blanks and quotes around them.
pub(super) fn cells(line: &str) -> Vec<&str> {
    let mut quoted = false;
    let is_between = |c: char| {
        quoted ^= c == '"';
        c == ',' && !quoted
    };
    line.split(is_between).map(|cell| cell.trim().trim_matches('"').trim()).collect()
}

/// The head of a column, `name [unit]`.
struct Head<'l> {
    whole: &'l str,
    name: &'l str,
    unit: Option<&'l str>,
}

impl<'l> Head<'l> {
    fn of(whole: &'l str) -> Self {
        let with_unit = |open, close| whole.strip_suffix(close)?.rsplit_once(open);
        match with_unit('[', ']').or_else(|| with_unit('(', ')')) {
            Some((name, unit)) => Self { whole, name: name.trim(), unit: Some(unit.trim()) },
            None => Self { whole, name: whole, unit: None },
        }
    }

    /// Its column as values of this unit; None where it has another unit.
    fn column(&self, index: usize, unit: &'static Unit) -> Option<Column<'l>> {
        let is_own = |written: &str| written == unit.name || unit.name.is_empty() && ["-", "1"].contains(&written);
        let column = Column { index, unit, written: self.unit.filter(|written| !is_own(written)) };
        column.number("1").map(|_| column)
    }

    fn is_time(&self) -> bool {
        TIMES.iter().any(|known| known.eq_ignore_ascii_case(self.name))
    }

    /// Its name and the unit that stands at its end without brackets: speed_rpm, speedHz.
    fn bare_unit(&self) -> Option<(&'l str, &'l str)> {
        let behind = self.name.rfind(['_', ' ', '.', '-', ',', ':']).map(|at| (&self.name[..at], &self.name[at + 1..]));
        let capital =
            || (1..self.name.len()).filter_map(|at| self.name.split_at_checked(at)).find(is_capital_behind_small);
        let (name, unit) = behind.or_else(capital)?;
        let is_unit = units::read(&one(unit)).is_ok() || units::may_be_meant(unit);
        (self.unit.is_none() && is_unit).then_some((name, unit))
    }
}

/// Whether a second word of two letters or more begins by a capital, right behind a small letter.
fn is_capital_behind_small((first, second): &(&str, &str)) -> bool {
    first.ends_with(char::is_lowercase) && second.starts_with(char::is_uppercase) && second.chars().count() > 1
}

/// Whether the first cell of a line is a time's.
pub(super) fn begins_with_time(line: &str) -> bool {
    let first = Head::of(cells(line)[0]);
    first.is_time() || first.name.to_lowercase().starts_with(TIMES[0])
}

/// Whether a line may name columns: it has a unit, or a single word in each cell. A sentence with a comma has neither.
pub(super) fn may_name(line: &str) -> bool {
    let heads: Vec<_> = cells(line).into_iter().map(Head::of).collect();
    heads.iter().any(|head| head.unit.is_some() || head.bare_unit().is_some())
        || heads.iter().all(|head| head.name.split_whitespace().count() == 1)
}

/// What is wrong with the columns of a file, and what would be right.
pub(super) struct Wrong {
    pub is: String,
    pub right: String,
    pub known: String,
    /// Whether it is the scene's word for the column, not the line.
    pub of_scene: bool,
}

/// The input, and the column that the scene gives for it.
pub(super) struct Wanted<'w> {
    pub variable: &'w Variable,
    /// All of the scene.
    pub variables: &'w [Variable],
    /// `column = ...`, and where.
    pub column: Option<(&'w str, Range<usize>)>,
}

impl Wanted<'_> {
    /// The columns of the time and of the value without a line of names: the first and the second of two.
    pub fn unnamed(&self) -> [Column<'static>; 2] {
        let units = [&SECOND, self.variable.meta.unit];
        [0, 1].map(|index| Column { index, unit: units[index], written: None })
    }

    /// The columns of the time and of the value below a line that names them.
    pub fn columns<'l>(&'l self, line: &'l str) -> Result<[Column<'l>; 2], Wrong> {
        let heads: Vec<_> = cells(line).into_iter().map(Head::of).collect();
        let time = self.time(&heads)?;
        let value = match &self.column {
            Some((column, _)) => self.given(column, &heads)?,
            None => self.found(&heads)?,
        };
        Ok([time, value])
    }

    /// The first column, which must be the time.
    fn time<'l>(&self, heads: &[Head<'l>]) -> Result<Column<'l>, Wrong> {
        let head = &heads[0];
        let is_time = head.is_time() || head.unit.is_some();
        match head.column(0, &SECOND) {
            Some(column) if is_time => Ok(column),
            None if head.is_time() => Err(unfit(head, &SECOND)),
            _ => {
                let right = match head.bare_unit() {
                    Some((name, unit)) if fits(unit, &SECOND) => {
                        format!("write the unit of the first column in brackets: {name} [{unit}]")
                    }
                    _ => "the first column must be the time: time, or time [ms]".to_owned(),
                };
                Err(Wrong::of_line(UNNAMED, right))
            }
        }
    }

    /// The column that the scene names, with its unit where the file does not say it.
    fn given<'l>(&'l self, column: &'l str, heads: &[Head<'l>]) -> Result<Column<'l>, Wrong> {
        let asked = Head::of(column);
        let is_meant = |head: &Head| {
            head.name == asked.name && (asked.unit.is_none() || head.unit.is_none() || head.unit == asked.unit)
        };
        let whole = heads.iter().position(|head| head.whole == column);
        let by_name = || (0..heads.len()).filter(|index| is_meant(&heads[*index]));
        let index = match (whole, by_name().count()) {
            (Some(index), _) => index,
            (None, 1) => by_name().next().unwrap_or_default(),
            (None, 0) => {
                let of_another_unit = heads.iter().find(|head| head.name == asked.name);
                let names = heads.iter().map(|head| head.name);
                let right = match of_another_unit.and_then(|head| head.unit) {
                    Some(unit) => format!("its unit is [{unit}]: write column = \"{}\"", asked.name),
                    None => {
                        did_you_mean(asked.name, names).unwrap_or_else(|| "give the name of one of its columns".into())
                    }
                };
                let is = format!("has no column `{column}`");
                return Err(Wrong { known: of_columns(heads), of_scene: true, ..Wrong::of_line(is, right) });
            }
            _ => {
                let right = "add its unit, as in `Speed [rpm]`, or rename one of them".to_owned();
                let is = format!("has several columns `{column}`");
                return Err(Wrong { known: of_columns(heads), of_scene: true, ..Wrong::of_line(is, right) });
            }
        };
        let head = &heads[index];
        let unit = head.unit.or(asked.unit);
        if unit.is_none() {
            self.may_lack_unit(head)?;
        }
        Head { unit, ..*head }
            .column(index, self.variable.meta.unit)
            .ok_or_else(|| unfit(&Head { unit, ..*head }, self.variable.meta.unit))
    }

    /// A column without a unit has SI's, unless its name says otherwise.
    fn may_lack_unit(&self, head: &Head) -> Result<(), Wrong> {
        let own = self.variable.meta.unit;
        let of_scene = self.variables.iter().filter(|other| is_called(other, head.name)).map(|other| other.meta.unit);
        let others: Vec<_> = of_scene.chain(unit_of_effect(head.name)).collect();
        if let Some(other) = others.first() {
            let fits = others.iter().any(|other| other.exponents[..3] == own.exponents[..3]);
            return if fits { Ok(()) } else { Err(unfit(&Head { unit: Some(other.name), ..*head }, own)) };
        }
        let Some((_, unit)) = head.bare_unit() else { return Ok(()) };
        let is_own = units::read(&one(unit)).is_ok_and(|one| one.fits(own) && one.value == 1.0);
        // A letter may be an index: tau_m.
        let is_index = !fits(unit, own) && unit.chars().count() == 1;
        if is_own || is_index { Ok(()) } else { Err(bare(head, own)) }
    }

    /// The column with the name of the input, or the only one with a unit that fits.
    fn found<'l>(&self, heads: &[Head<'l>]) -> Result<Column<'l>, Wrong> {
        let full = &self.variable.name;
        let own = full.split_once('.').map_or(&**full, |(_, own)| own);
        for name in [full, own] {
            let named: Vec<_> = (1..heads.len()).filter(|index| heads[*index].name == name).collect();
            match named[..] {
                [] => {}
                [index] => {
                    let unit = self.variable.meta.unit;
                    return heads[index].column(index, unit).ok_or_else(|| unfit(&heads[index], unit));
                }
                _ => {
                    let wrong = Wrong::of_line(format!("names {name} more than once"), "rename one of them".into());
                    return Err(Wrong { known: of_columns(heads), ..wrong });
                }
            }
        }
        let is_others = |name: &str| self.variables.iter().any(|other| is_called(other, name)) || is_of_effect(name);
        let of_others = |head: &Head| head.is_time() || is_others(head.name);
        let is_open = |index: &usize| heads[*index].unit.is_some() && !of_others(&heads[*index]);
        let mut fitting =
            (1..heads.len()).filter(is_open).filter_map(|index| heads[index].column(index, self.variable.meta.unit));
        match (fitting.next(), fitting.next()) {
            (Some(only), None) => Ok(only),
            (Some(first), Some(_)) => {
                let right = format!("say which: column = \"{}\" in the scene", heads[first.index].whole);
                let wrong = Wrong::of_line(format!("has several columns that may be {full}"), right);
                Err(Wrong { known: of_columns(heads), ..wrong })
            }
            (None, _) => Err(self.not_found(heads, of_others)),
        }
    }

    /// What to say where no column is the input's.
    fn not_found(&self, heads: &[Head], of_others: impl Fn(&Head) -> bool) -> Wrong {
        let own = self.variable.meta.unit;
        let mut others = heads.iter().skip(1).filter(|head| !of_others(head));
        if let Some(head) = others.clone().find(|head| head.bare_unit().is_some_and(|(_, unit)| fits(unit, own))) {
            return bare(head, own);
        }
        match (heads.len(), others.next()) {
            (2, Some(head)) if head.unit.is_some() => unfit(head, own),
            (2, Some(head)) if head.bare_unit().is_some_and(|(_, unit)| unit.chars().count() > 1) => bare(head, own),
            (_, example) => {
                let (name, unit) = (&self.variable.name, brackets(own));
                let right = match example.filter(|head| head.unit.is_none() && !head.name.is_empty()) {
                    // Its name is a unit: what is advised must not be another one.
                    Some(head) if fits(head.name, own) => {
                        let unit = head.name;
                        format!("name the column {name} [{unit}], or say column = \"{unit} [{unit}]\" in the scene")
                    }
                    // Nobody here knows its unit.
                    Some(head) => {
                        let column = head.name;
                        format!(
                            "name the column {name}{unit}, or say column = \"{column} [...]\" in the scene, with its unit"
                        )
                    }
                    None => format!("name the column {name}{unit}, or say column = \"...\" in the scene"),
                };
                let known = if heads.len() > 2 { of_columns(heads) } else { String::new() };
                Wrong { known, ..Wrong::of_line(UNNAMED, right) }
            }
        }
    }
}

/// What is said of a speed in 1/min.
const CLEAR: &str = "turns a minute are [rpm], radians [rad/min]";

/// What is said of a line that names no column of the input.
const UNNAMED: &str = "does not name the columns";

impl Wrong {
    fn of_line(is: impl Into<String>, right: String) -> Self {
        Self { is: is.into(), right, known: String::new(), of_scene: false }
    }
}

/// A column has another unit than one of what has this unit.
fn unfit(head: &Head, own: &Unit) -> Wrong {
    let unit = head.unit.unwrap_or_default();
    let right = match (units::read(&one(unit)), units::quantity(own.exponents)) {
        (Err(Unreadable::Unit(_, right)), _) => right,
        (Ok(one), _) if one.may_count_turns(own) => CLEAR.into(),
        (_, Some(what)) if own.name.is_empty() => format!("the column must hold {what}: write [-]"),
        (_, Some(what)) => {
            let pounds = units::pounds(unit, own).unwrap_or_default();
            format!("the column must hold {what}, in [{}] or another unit of it{pounds}", own.name)
        }
        (_, None) => format!("the column must hold values in [{}]", own.name),
    };
    Wrong::of_line(format!("has a unit that does not fit, [{unit}]"), right)
}

/// A column of what has this unit has its own unit without brackets.
fn bare(head: &Head, own: &Unit) -> Wrong {
    let (name, unit) = head.bare_unit().unwrap_or((head.name, ""));
    let right = match units::read(&one(unit)) {
        Ok(one) if one.may_count_turns(own) => format!("{CLEAR}: write {name} [rpm]"),
        Ok(one) if one.fits(own) => {
            format!("write {name} [{unit}], or column = \"{} [{unit}]\" in the scene", head.name)
        }
        Err(Unreadable::Unit(_, right)) => format!("{right} Units stand in brackets: {name} [...]"),
        read => {
            let what = read.ok().and_then(|one| units::quantity(one.exponents)).unwrap_or("no unit");
            let ours = brackets(own);
            format!("{unit} is {what}; if it is no unit here, write column = \"{}{ours}\" in the scene", head.name)
        }
    };
    Wrong::of_line(format!("has a unit without brackets, {}", head.whole), right)
}

/// A quantity of one of this unit.
fn one(unit: &str) -> String {
    format!("1 {unit}")
}

/// Whether what a text names is a unit that fits this one, and clear.
fn fits(unit: &str, own: &Unit) -> bool {
    units::read(&one(unit)).is_ok_and(|one| one.fits(own) && !one.may_count_turns(own))
}

/// Whether a variable is called so: an input by its own name too, without its block.
fn is_called(variable: &Variable, name: &str) -> bool {
    let is_input = matches!(variable.meta.role, Role::Input { .. });
    variable.name == name || is_input && variable.name.split_once('.').is_some_and(|(_, own)| own == name)
}

/// Whether this may be the name of a variable of an effect, which the scene may lack.
fn is_of_effect(name: &str) -> bool {
    name.contains('.') && name.split(['.', '[']).next().is_some_and(|block| effects::named(block).is_some())
}

/// The unit of the variable of an effect with this full name, which the scene may lack.
fn unit_of_effect(name: &str) -> Option<&'static Unit> {
    let (block, own) = name.split_once('.')?;
    let metas = effects::named(block.split('[').next()?)?.metas;
    metas().into_iter().find(|(_, meta)| meta.name == own).map(|(_, meta)| meta.unit)
}

fn of_columns(heads: &[Head]) -> String {
    format!("the columns are {}", heads.iter().map(|head| head.whole).collect::<Vec<_>>().join(", "))
}

impl Column<'_> {
    /// A finite number in a cell, in the unit of the variable.
    pub fn number(&self, cell: &str) -> Option<f64> {
        let number = match self.written {
            None => cell.parse().ok()?,
            Some(unit) => {
                let text = format!("{cell} {unit}");
                let quantity = units::read(&text).ok()?;
                (quantity.fits(self.unit) && !quantity.may_count_turns(self.unit)).then_some(quantity.value)?
            }
        };
        f64::is_finite(number).then_some(number)
    }
}
