//! The result in words and Markdown tables: what the terminal shows, and what the documents quote.

use super::Accuracy;
use super::advice;
use super::ratio::Ratios;
use super::row::{Measured, OURS, Row};
use super::run::Setting;
use super::span::POINTS;
use super::sweep::AUTO;

/// The errors of the table.
const DECADES: [f64; 10] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11];

/// For people: tables first, then sentences, then what they rest on.
pub fn report(result: &Accuracy) -> String {
    let Accuracy { reference, rows, scale, .. } = result;
    let (agreed, sizes) = (&reference.floor, &reference.sizes);
    let name = |setting: &Setting| format!("{} at {}", setting.method, power(setting.value));
    let found_on = format!(
        "The place moves by {} m across e, the axis by {} rad, φ by {} rad: errors are relative to that. The reference is {}, \
         checked by {}: at worst they differ by {} in place, {} in axis and {} in φ. No smaller error can be told.",
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
    let parts = [
        Some(decades(rows, scale.floor)),
        Ratios::of(rows, reference).map(|ratios| ratios.table()),
        Some(sentences.collect()),
        Some(found_on),
    ];
    parts.into_iter().flatten().map(|part| part.trim_end().to_owned() + "\n").collect::<Vec<_>>().join("\n")
}

/// What each power of ten costs that can be told: with the two cheapest of our methods, with `auto`, which is one of them, and with
/// the cheapest of all others that show the whole motion.
fn decades(rows: &[Row], floor: f64) -> String {
    let peers: Vec<_> =
        rows.iter().filter(|row| row.tool != OURS && row.outcome.as_ref().is_ok_and(|m| m.told == POINTS)).collect();
    let ours: Vec<_> = methods(rows).into_iter().filter(|(tool, _)| *tool == OURS).map(|(_, method)| method).collect();
    let mut text = "| error of at most | cheapest method | next method | `auto` |".to_owned();
    text += if peers.is_empty() { "\n|--:|---|---|---|\n" } else { " cheapest peer |\n|--:|---|---|---|---|\n" };
    let cell = |name: &str, found: Option<(&Row, &Measured)>| match found {
        Some((row, m)) => format!(" {} ms, {name}{} |", short(1e3 * m.cpu_time), shown(row)),
        None => " - |".into(),
    };
    for goal in DECADES.into_iter().filter(|goal| *goal > floor) {
        let with =
            |name: &str| advice::cheapest(rows.iter().filter(|row| row.tool == OURS && row.method == name), goal);
        let mut best: Vec<_> = ours.iter().filter(|name| **name != AUTO).filter_map(|name| with(name)).collect();
        best.sort_by(|(_, a), (_, b)| a.cpu_time.total_cmp(&b.cpu_time));
        let [cheapest, next] = [0, 1].map(|n| best.get(n).copied());
        let mut line = format!("| {} |", power(goal));
        for found in [cheapest, next] {
            line += &cell(&found.map_or(String::new(), |(row, _)| format!("{} ", row.method)), found);
        }
        line += &cell("", with(AUTO));
        if !peers.is_empty() {
            let found = advice::cheapest(peers.iter().copied(), goal);
            line += &cell(&found.map_or(String::new(), |(row, _)| format!("{} {} ", row.tool, row.method)), found);
        }
        text += &(line + "\n");
    }
    text
}

/// Tools and methods in the order of the rows.
pub fn methods(rows: &[Row]) -> Vec<(&str, &str)> {
    let mut found: Vec<(&str, &str)> = rows.iter().map(|row| (row.tool.as_str(), row.method.as_str())).collect();
    found.dedup();
    found
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

/// From the least of these numbers to the most.
pub fn range(values: impl Iterator<Item = f64> + Clone) -> Option<String> {
    let [least, most] = [f64::min, f64::max].map(|end| values.clone().reduce(end).map(short));
    let (least, most) = (least?, most?);
    Some(if least == most { least } else { format!("{least} to {most}") })
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
    use super::super::row::sample::row;
    use super::*;

    #[test]
    fn a_setting_is_shown_as_short_as_it_is() {
        let at = |value| shown(&row(OURS, "m", value, 1.0, 1.0));
        assert_eq!([1e-7, 2e-13, 10.0 / 997.0].map(at), ["1e-7", "2e-13", "1.0e-2"]);
    }

    #[test]
    fn each_decade_has_the_cheapest_methods() {
        let end_only = |mut row: Row| {
            row.outcome.as_mut().unwrap().told = 1;
            row
        };
        let mut rows = vec![
            row(OURS, "a", 1e-2, 5e-3, 1e-3),
            row(OURS, "a", 1e-4, 5e-4, 3e-3),
            row(OURS, "b", 1e-3, 1e-3, 2e-3),
            row(OURS, "c", 1e-3, 1e-3, 9e-3),
            row(OURS, AUTO, 1e-3, 1e-3, 5e-3),
        ];
        let lines = |rows: &[Row]| decades(rows, 1e-5).lines().map(str::to_owned).collect::<Vec<_>>();
        let own = lines(&rows);
        assert_eq!(
            own[2..],
            [
                "| 1e-2 | 1.0 ms, a 1e-2 | 2.0 ms, b 1e-3 | 5.0 ms, 1e-3 |",
                "| 1e-3 | 2.0 ms, b 1e-3 | 3.0 ms, a 1e-4 | 5.0 ms, 1e-3 |",
                "| 1e-4 | - | - | - |",
            ]
        );
        rows.extend([row("peer", "d", 1e-6, 1e-3, 4e-3), end_only(row("peer", "e", 1e-6, 1e-9, 1e-6))]);
        assert_eq!(
            lines(&rows)[3..],
            [
                "| 1e-3 | 2.0 ms, b 1e-3 | 3.0 ms, a 1e-4 | 5.0 ms, 1e-3 | 4.0 ms, peer d 1e-6 |",
                "| 1e-4 | - | - | - | - |"
            ]
        );
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
