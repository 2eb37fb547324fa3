//! The result in words and Markdown tables: what the terminal shows, and what the documents quote.

use super::Accuracy;
use super::advice::{self, GOALS, at_least};
use super::row::{OURS, Row, Scale};
use super::run::Setting;
use super::sweep::STEP;
use std::fmt::Write;

/// Everything, for people.
pub fn report(result: &Accuracy) -> String {
    let Accuracy { reference, rows, scale, .. } = result;
    let (agreed, sizes) = (&reference.floor, &reference.sizes);
    let name = |setting: &Setting| format!("{} at {}", setting.method, power(setting.value));
    let mut text = format!(
        "The place moves by {} m across e, the axis by {} rad, φ by {} rad: errors are relative to that. The reference is {}, \
         checked by {}: at worst they differ by {} in place, {} in axis and {} in φ. No smaller error can be told: it is given \
         as `<`.\n",
        short(sizes.place),
        short(sizes.axis),
        short(sizes.phi),
        name(&reference.setting),
        name(&reference.check),
        short(agreed.place),
        short(agreed.axis),
        short(agreed.phi),
    );
    // In Markdown, each sentence is an item.
    let sentences = result.sentences.iter().chain(&result.left_out).map(|sentence| format!("- {sentence}\n"));
    for part in [overview(rows, *scale), sentences.collect(), decades(result)] {
        write!(text, "\n{}\n", part.trim_end()).expect("a String can be written to");
    }
    text
}

/// What each method needs for each goal.
fn overview(rows: &[Row], scale: Scale) -> String {
    let mut text = "| CPU time [ms] for an error of at most".to_owned();
    text += &GOALS.map(|goal| format!(" | {}", power(goal))).concat();
    text += " |\n|---|--:|--:|--:|\n";
    for (tool, method) in methods(rows) {
        let own = || rows.iter().filter(|row| row.tool == tool && row.method == method);
        let cell = |goal: f64| match advice::cheapest(own(), goal) {
            Some((row, m)) if goal > scale.floor => format!(" | {} ({})", short(1e3 * m.cpu_time), shown(row)),
            _ => " | -".into(),
        };
        writeln!(text, "| {tool} {method}{} |", GOALS.map(cell).concat()).expect("a String can be written to");
    }
    text + "\nIn brackets the setting: a tolerance, or a step [s] where a method has a fixed one, after the order.\n"
}

/// Tools and methods in the order of the rows.
pub fn methods(rows: &[Row]) -> Vec<(&str, &str)> {
    let mut found: Vec<(&str, &str)> = rows.iter().map(|row| (row.tool.as_str(), row.method.as_str())).collect();
    found.dedup();
    found
}

/// Our rows at powers of ten, and what went wrong.
fn decades(result: &Accuracy) -> String {
    let Accuracy { rows, scale, reference, .. } = result;
    let floor = &reference.floor;
    let mut text =
        "| method | setting | error | place | axis | φ | energy | evaluations | CPU time [ms] | × real time |\n\
                    |---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
            .to_owned();
    let is_shown = |row: &&Row| match row.parameter.as_str() {
        STEP => is_best(row, rows),
        _ => power(row.value).starts_with("1e"),
    };
    for row in rows.iter().filter(|row| row.tool == OURS).filter(is_shown) {
        let cells = match &row.outcome {
            Ok(m) => [
                at_least(m.error(), scale.floor),
                at_least(m.relative.place, floor.place),
                at_least(m.relative.axis, floor.axis),
                at_least(m.relative.phi, floor.phi),
                short(m.worst.energy / scale.energy),
                m.evaluations.map_or("-".into(), count),
                short(1e3 * m.cpu_time),
                about(scale.simulated / m.cpu_time),
            ]
            .join(" | "),
            Err(why) => why.replace('|', "\\|"),
        };
        writeln!(text, "| {} | {} | {cells} |", row.method, shown(row)).expect("a String can be written to");
    }
    text
}

/// Whether no other row of the same method is better in both error and time.
fn is_best(row: &Row, rows: &[Row]) -> bool {
    let told = |row: &Row| row.outcome.as_ref().ok().map(|m| (m.cpu_time, m.error()));
    let Some((time, error)) = told(row) else { return false };
    let better = |other: &&Row| told(other).is_some_and(|(t, e)| t < time && e <= error);
    !rows.iter().filter(|other| other.tool == row.tool && other.method == row.method).any(|other| better(&other))
}

/// How the setting of a row stands in a table: `1e-7`, or `order 4, 2e-3`.
fn shown(row: &Row) -> String {
    let exact = power(row.value);
    // Steps of peers are parts of the span, with as many digits as a double has.
    let value = if exact.len() > 8 { short(row.value) } else { exact };
    row.order.map_or(value.clone(), |order| format!("order {order}, {value}"))
}

/// The setting of a row in words: `solver.order = 4, solver.step_size = 2e-3`.
pub fn setting(row: &Row) -> String {
    let order = row.order.map(|order| format!("solver.order = {order}, ")).unwrap_or_default();
    format!("{order}{} = {}", row.parameter, power(row.value))
}

/// A number with two digits or a whole one: `4.6e-7`, `0.50`, `31`.
pub fn short(value: f64) -> String {
    match value {
        0.0 => "0".into(),
        _ if value.is_nan() => "-".into(),
        _ if !(0.1..1000.0).contains(&value) => format!("{value:.1e}"),
        _ if value < 1.0 => format!("{value:.2}"),
        _ if value < 10.0 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    }
}

/// A setting as a user types it: `1e-7`, `2e-8`, `0.001`.
pub fn power(value: f64) -> String {
    format!("{value:e}")
}

/// A large number with two digits that count.
pub fn about(value: f64) -> String {
    count(format!("{value:.1e}").parse().expect("a number"))
}

/// A large number, in groups of three digits.
pub fn count(value: f64) -> String {
    let digits = format!("{value:.0}");
    let first = digits.len() % 3;
    let groups = digits.as_bytes()[first..].chunks(3).map(|group| String::from_utf8_lossy(group).into_owned());
    let first = (first > 0).then(|| digits[..first].to_owned());
    first.into_iter().chain(groups).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::super::row::tests::row;
    use super::*;

    #[test]
    fn a_setting_is_shown_as_short_as_it_is() {
        let at = |value| shown(&row(OURS, "m", value, 1.0, 1.0));
        assert_eq!([1e-7, 2e-13, 10.0 / 997.0].map(at), ["1e-7", "2e-13", "1.0e-2"]);
    }

    #[test]
    fn numbers_have_two_digits() {
        let cases = [(4.56e-7, "4.6e-7"), (0.5, "0.50"), (3.52, "3.5"), (31.4, "31"), (0.0, "0"), (1234.0, "1.2e3")];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
        assert_eq!(short(f64::NAN), "-");
        assert_eq!([2e-8, 1e-3].map(power), ["2e-8", "1e-3"]);
        assert_eq!(about(31_323.0), "31 000");
        assert_eq!([7.0, 123.4, 12345.0, 1e6].map(count), ["7", "123", "12 345", "1 000 000"]);
    }
}
