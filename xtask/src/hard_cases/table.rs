//! The result as a Markdown table: what the terminal shows, and what docs/hard-cases.md quotes.

use super::row::{Outcome, Row};
use std::fmt::Write;

/// A row a method; what the rows of a case have in common stands in the first.
pub fn markdown(rows: &[Row]) -> String {
    let mut text =
        "| case | what is hard | oracle | method | error | of | bound | evaluations | mutant | its error |\n\
                    |---|---|---|---|--:|---|--:|--:|---|--:|\n"
            .to_owned();
    let mut last = "";
    for row in rows {
        let first = row.case.name != last;
        last = &row.case.name;
        let common = |text: &'static str| if first { text } else { "" };
        let (error, of) = match &row.outcome {
            Ok(found) => (short(found.error), found.of.clone()),
            Err(why) => ("failed".into(), why.clone()),
        };
        let cells = [
            if first { row.case.name.clone() } else { String::new() },
            common(row.case.hard).into(),
            common(row.case.oracle).into(),
            row.method.label(),
            error,
            of,
            short(row.bound),
            format!("{:.0}", row.evaluations),
            if first { row.mutant() } else { String::new() },
            row.mutated.as_ref().map_or(String::new(), of_mutant),
        ];
        let cells = cells.map(|cell| cell.replace('|', "\\|").replace('\n', " "));
        writeln!(text, "| {} |", cells.join(" | ")).expect("a String can be written to");
    }
    text
}

fn of_mutant(outcome: &Outcome) -> String {
    outcome.as_ref().map_or("refused".into(), |found| short(found.error))
}

/// A number with two digits: `4.6e-7`.
fn short(value: f64) -> String {
    if value == 0.0 { "0".into() } else { format!("{value:.1e}") }
}
