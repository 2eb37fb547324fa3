//! What the command leaves behind in target/hard-cases/: hard-cases.md, .csv and .json.

use super::row::Row;
use super::{Extent, table};
use crate::sheets;
use anyhow::Result;
use serde_json::json;

/// Writes the files, and shows the table.
pub fn write(rows: &[Row], extent: &Extent) -> Result<()> {
    let objects = sheets::objects(rows.iter().map(Row::columns));
    let json = json!({ "part": extent.part, "whole": extent.whole, "mutants": extent.mutants, "rows": objects });
    let (json, table) = (serde_json::to_string_pretty(&json)? + "\n", table::markdown(rows));
    let csv = sheets::csv(&rows.iter().map(Row::columns).collect::<Vec<_>>());
    let files = [("hard-cases.md", &*table), ("hard-cases.csv", &csv), ("hard-cases.json", &json)];
    let folder = sheets::folder(None, "hard-cases")?;
    sheets::write(&folder, files)?;
    println!("\n{table}\n{}", folder.join("hard-cases.md").display());
    Ok(())
}
