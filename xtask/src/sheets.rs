//! What a command leaves behind in target/.

use crate::paths;
use anyhow::{Context, Result};
use serde_json::Value;
pub use split_rotor_tools::rows::{Row, csv, objects};
use std::path::PathBuf;

/// Writes these files, names and texts, into a folder of target/, which is made where it is not there.
pub fn write(folder: &str, files: [(&str, &str); 3]) -> Result<PathBuf> {
    let folder = paths::target().join(folder);
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
    for (name, text) in files {
        std::fs::write(folder.join(name), text)?;
    }
    Ok(folder)
}

/// What a command that looks at a machine leaves in a folder of target/: its table, rows and all of it as NAME.md, .csv and .json, and
/// pictures by their files' names.
pub fn leave(
    folder: &str,
    name: &str,
    table: &str,
    rows: &[Row],
    all: &Value,
    pictures: &[(&str, String)],
) -> Result<Left> {
    let [md, csv_name, json_name] = ["md", "csv", "json"].map(|form| format!("{name}.{form}"));
    let (csv, all) = (csv(rows), serde_json::to_string_pretty(all)? + "\n");
    let folder = write(folder, [(&md, table), (&csv_name, &csv), (&json_name, &all)])?;
    let mut files = Vec::new();
    for (name, picture) in pictures {
        files.push(folder.join(name));
        std::fs::write(folder.join(name), picture)?;
    }
    Ok(Left { folder, table: table.to_owned(), pictures: files })
}

/// What a command left behind.
pub struct Left {
    /// Where it is.
    pub folder: PathBuf,
    table: String,
    pictures: Vec<PathBuf>,
}

impl Left {
    /// Prints the table and where the pictures are.
    pub fn show(&self) {
        println!("{}", self.table);
        for file in &self.pictures {
            println!("{}", file.display());
        }
    }
}
