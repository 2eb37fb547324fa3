//! `bench`: what single calls of the packaged FMU, the right-hand side and the steps of the methods take, in instructions
//! and in time.

mod calls;
mod counts;
mod operations;
mod times;

pub use counts::must_hold;

use crate::package::UNPACKED;
use crate::paths;
use crate::run::cargo;
use anyhow::Result;
use model::scene::Scene;
use std::process::Command;

/// The scenes that are measured, as far as they are there: without inputs, and with one.
fn scenes() -> Vec<String> {
    let there = Scene::names(&paths::scenes());
    ["paper", "driven"].map(str::to_owned).into_iter().filter(|name| there.contains(name)).collect()
}

/// Measures and prints tables.
pub fn bench() -> Result<()> {
    calls::print()?;
    // What is missing is told with the remedy, and the rest is measured all the same.
    counts::print().unwrap_or_else(|error| println!("\ninstructions are not counted: {error:#}"));
    times::print()
}

/// `cargo bench` of one of `benches/` with a scene compiled in.
fn cargo_bench(name: &str, scene: &str) -> Command {
    let mut command = cargo();
    command
        .args(["bench", "--quiet", "--bench", name])
        .env("SPLIT_ROTOR_SCENE", paths::scenes().join(format!("{scene}.toml")))
        // The portable build, as the FMU is packaged, whatever the machine's own settings are.
        .env("RUSTFLAGS", UNPACKED);
    command
}

/// The head of a table with these columns, numbers to the right.
fn head(columns: &[&str]) -> String {
    format!("\n| {} |\n|---{}|", columns.join(" | "), "|--:".repeat(columns.len() - 1))
}

/// A target beside what was measured: "-" where there is none.
fn target(at_most: Option<f64>, measured: f64) -> String {
    match at_most {
        None => "-".into(),
        Some(at_most) if measured > at_most => format!("{at_most} (missed)"),
        Some(at_most) => at_most.to_string(),
    }
}
