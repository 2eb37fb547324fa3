//! Times of the right-hand side, of the methods' steps and of fmi2DoStep, measured by criterion (`benches/times.rs`).

use super::{cargo_bench, head, scenes};
use crate::paths;
use crate::run::output;
use anyhow::{Context, Result, ensure};
use serde_json::Value;
use std::path::Path;

/// Measures and prints tables.
pub fn print() -> Result<()> {
    for scene in scenes() {
        println!("{}", head(&[&scene, "ns", "95 % from", "to"]));
        for line in measured(&scene)? {
            println!("{line}");
        }
    }
    Ok(())
}

/// The lines of a scene's table: medians with their confidence intervals.
fn measured(scene: &str) -> Result<Vec<String>> {
    let folder = paths::target().join("criterion").join(scene);
    // Nothing of an earlier run.
    if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    output(cargo_bench("times", scene).env("CRITERION_HOME", &folder).args(["--", "--quiet", "--noplot"]))?;
    let entries = std::fs::read_dir(&folder)?.collect::<Result<Vec<_>, _>>()?;
    let mut lines = entries.iter().map(|entry| line(&entry.path().join("new"))).collect::<Result<Vec<_>>>()?;
    ensure!(!lines.is_empty(), "criterion measured nothing");
    lines.sort();
    Ok(lines)
}

fn line(folder: &Path) -> Result<String> {
    let read = |name: &str| -> Result<Value> {
        let path = folder.join(name);
        let text = std::fs::read_to_string(&path).with_context(|| path.display().to_string())?;
        serde_json::from_str(&text).with_context(|| path.display().to_string())
    };
    let (benchmark, estimates) = (read("benchmark.json")?, read("estimates.json")?);
    let name = benchmark["full_id"].as_str().context("a benchmark has a name")?;
    let median = &estimates["median"];
    let number = |value: &Value| value.as_f64().map(|ns| format!("{ns:.1}")).context("an estimate is a number");
    let interval = &median["confidence_interval"];
    let [at, from, to] = [&median["point_estimate"], &interval["lower_bound"], &interval["upper_bound"]].map(number);
    Ok(format!("| {name} | {} | {} | {} |", at?, from?, to?))
}
