//! What is told of many scenes.

use super::judge::Verdict;
use super::trial::Trial;
use super::truth::{Measures, Truth};

/// A scene with its number, its reference, and what became of it.
pub struct Row {
    /// By which it is called again.
    pub number: u64,
    /// What it is.
    pub trial: Trial,
    /// The reference.
    pub truth: Truth,
    /// At each tolerance.
    pub verdicts: Vec<Verdict>,
}

/// How many scenes are told of.
const WORST: usize = 10;

/// Numbers with two digits.
pub fn short(measures: Measures) -> String {
    measures.map(|measure| format!("{measure:.1e}")).join(", ")
}

/// A table in markdown of the worst scenes and tolerances.
pub fn worst(rows: &[Row]) -> String {
    let mut all: Vec<_> = rows.iter().flat_map(|row| row.verdicts.iter().map(move |verdict| (row, verdict))).collect();
    all.sort_by(|a, b| b.1.worst.total_cmp(&a.1.worst));
    let mut lines = vec![
        "| scene | what | tolerance | method | place, axis, φ over their sizes | worst output | over bound | A | evaluations |"
            .to_owned(),
        "|---|---|--:|---|---|---|--:|--:|--:|".to_owned(),
    ];
    lines.extend(all.iter().take(WORST).map(|(row, verdict)| line(row, verdict)));
    lines.join("\n")
}

/// A line of the table.
pub fn line(row: &Row, verdict: &Verdict) -> String {
    let errors = match &verdict.errors {
        Ok(errors) => short(*errors),
        Err(why) => why.clone(),
    };
    let Verdict { tolerance, method, output: (output, error), worst, evaluations, .. } = verdict;
    let (number, name, growth) = (row.number, &row.trial.name, row.truth.growth);
    format!(
        "| {number} | {name} | {tolerance:e} | {method} | {errors} | {output}, {error:.1e} | {worst:.2e} | {growth:.1} | {evaluations} |"
    )
}

/// All that is known of a scene.
pub fn whole(row: &Row) -> String {
    let Row { number, trial, truth, verdicts } = row;
    let (sizes, own) = (short(truth.sizes), short(truth.own_error));
    let verdicts = verdicts.iter().map(|verdict| format!("{} {:.3} s\n", line(row, verdict), verdict.seconds));
    format!(
        "# scene {number}\n{}# sizes of place [m], tilt [rad], φ [rad]: {sizes}\n\
         # the reference's own error over them: {own}; evaluations: {}\n\n{}",
        trial.text(),
        truth.evaluations,
        verdicts.collect::<String>()
    )
}

/// Writes what stands on a page of the documentation after this line, up to the next comment.
pub fn write(page: &str, mark: &str, text: &str) {
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs").join(page);
    let whole = std::fs::read_to_string(&page).expect("the page");
    let (before, after) = whole.split_once(mark).expect("a place for it");
    let after = after.find("<!--").map_or("", |n| &after[n..]);
    let end = if after.is_empty() { "" } else { "\n" };
    std::fs::write(&page, format!("{before}{mark}\n\n{text}\n{end}{after}")).expect("the page is written");
}

/// Whether pages are to be written.
pub fn is_to_write() -> bool {
    std::env::var_os("UPDATE_GOLDEN").is_some_and(|value| value == "1")
}
