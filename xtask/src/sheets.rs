//! What a command leaves behind, in target/ or where the user says.

use crate::paths;
use anyhow::{Context, Result};
use serde_json::Value;
pub use split_rotor_tools::rows::{Row, csv, objects};
use std::path::{Path, PathBuf};

/// The folder that the user names with --out, or this one of target/; it is made where it is not there.
pub fn folder(out: Option<&Path>, usual: &str) -> Result<PathBuf> {
    let folder = match out {
        Some(out) => std::path::absolute(out)?,
        None => paths::target().join(usual),
    };
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
    Ok(folder)
}

/// Writes these files, names and texts, into a folder.
pub fn write(folder: &Path, files: [(&str, &str); 3]) -> Result<()> {
    for (name, text) in files {
        std::fs::write(folder.join(name), text)?;
    }
    Ok(())
}

/// What a command that looks at a machine leaves in a folder: its table, rows and all of it as NAME.md, .csv and .json, and
/// pictures by their files' names.
pub fn leave(
    folder: PathBuf,
    name: &str,
    table: &str,
    rows: &[Row],
    all: &Value,
    pictures: &[(&str, String)],
) -> Result<Left> {
    let [md, csv_name, json_name] = ["md", "csv", "json"].map(|form| format!("{name}.{form}"));
    let (csv, all) = (csv(rows), serde_json::to_string_pretty(all)? + "\n");
    write(&folder, [(&md, table), (&csv_name, &csv), (&json_name, &all)])?;
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
