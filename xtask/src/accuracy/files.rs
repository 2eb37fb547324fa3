//! What the command leaves behind, in target/accuracy/SCENE/ or where the user says: accuracy.md, .csv, .json and .svg.

use super::machine;
use crate::run::run;
use crate::{python, sheets};
use anyhow::Result;
use split_rotor_model::scene::Scene;
use split_rotor_tools::accuracy::Accuracy;
use split_rotor_tools::accuracy::row::csv;
use std::path::Path;

/// Writes the files, and shows the tables.
pub fn write(scene: &Scene, result: &Accuracy, out: Option<&Path>) -> Result<()> {
    let (report, mut all) = (result.table(), result.json());
    all["machine"] = machine::described()?;
    let json = serde_json::to_string_pretty(&all)? + "\n";
    let csv = csv(&result.rows, result.scale);
    let files = [("accuracy.md", &*report), ("accuracy.csv", &csv), ("accuracy.json", &json)];
    let folder = sheets::folder(out, &format!("accuracy/{}", scene.name))?;
    sheets::write(&folder, files)?;
    run(python::python_with_all()?.arg("xtask/python/accuracy.py").arg(&folder))?;
    println!("\n{}: {}\n\n{report}", scene.name, scene.title);
    println!("{}", folder.join("accuracy.svg").display());
    Ok(())
}
