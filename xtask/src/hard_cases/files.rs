//! What the command leaves behind in target/hard-cases/: hard-cases.md, .csv and .json.

use super::row::Row;
use super::{Extent, table};
use crate::paths;
use crate::sheets::csv;
use anyhow::{Context, Result};
use serde_json::{Map, Value, json};

/// Writes the files, and shows the table.
pub fn write(rows: &[Row], extent: &Extent) -> Result<()> {
    let folder = paths::target().join("hard-cases");
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let objects: Vec<Map<String, Value>> = rows
        .iter()
        .map(|row| row.columns().into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
        .collect();
    let json = json!({ "part": extent.part, "whole": extent.whole, "mutants": extent.mutants, "rows": objects });
    let table = table::markdown(rows);
    for (name, text) in [
        ("hard-cases.md", table.clone()),
        ("hard-cases.csv", csv(&rows.iter().map(Row::columns).collect::<Vec<_>>())),
        ("hard-cases.json", serde_json::to_string_pretty(&json)? + "\n"),
    ] {
        std::fs::write(folder.join(name), text)?;
    }
    println!("\n{table}\n{}", folder.join("hard-cases.md").display());
    Ok(())
}
