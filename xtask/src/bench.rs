//! `bench`: what single calls of the packaged FMU, the right-hand side and the steps of the methods take, in instructions
//! and in time.

mod calls;
mod counts;
mod general;
mod operations;
mod sets;
mod spending;
mod times;

use crate::library::UNPACKED;
use crate::run::cargo;
use crate::{known, paths};
use anyhow::{Result, ensure};
use split_rotor_model::scene::Scene;
use std::process::Command;

/// The scenes that are measured, as far as they are there: without inputs, and with one.
fn scenes() -> Vec<String> {
    let there = Scene::names(&paths::scenes());
    ["paper", "driven"].map(str::to_owned).into_iter().filter(|name| there.contains(name)).collect()
}

/// Measures and prints tables, those whose names hold `part`; sets of effects are drawn with `seed`.
pub fn bench(part: &str, seed: Option<u64>) -> Result<()> {
    let general = || general::print(seed.unwrap_or(general::SEED)).map(drop);
    let tables: [(&str, &dyn Fn() -> Result<()>); 7] = [
        ("calls", &calls::print),
        ("scenes", &spending::print_scenes),
        ("effects", &spending::print_effects),
        ("general", &general),
        ("off", &|| general::print_off().map(drop)),
        ("counts", &|| counts::print(&scenes()).map(drop)),
        ("times", &times::print),
    ];
    let names = tables.map(|(name, _)| name);
    ensure!(
        names.iter().any(|name| name.contains(part)),
        "no table's name holds {part:?}{}: there are {}",
        known::meant(part, names),
        names.join(", ")
    );
    for (name, print) in tables.iter().filter(|(name, _)| name.contains(part)) {
        // What is missing is told with the remedy, and the rest is measured all the same.
        print().unwrap_or_else(|error| println!("\n{name} not measured: {error:#}"));
    }
    Ok(())
}

/// Counts, and fails where that is not possible or where a limit that is met no longer holds.
pub fn must_hold() -> Result<()> {
    let limited: Vec<_> = scenes().into_iter().filter(|scene| counts::is_limited(scene)).collect();
    let broken = [counts::print(&limited)?, general::print(general::SEED)?, general::print_off()?].concat();
    ensure!(broken.is_empty(), "more than the limit: {}", broken.join("; "));
    Ok(())
}

/// `cargo bench` of one of `benches/` with a scene compiled in.
fn cargo_bench(name: &str, scene: &str) -> Command {
    let mut command = cargo();
    command
        .args(["bench", "--quiet", "--package", "split-rotor-benches", "--bench", name])
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

#[cfg(test)]
mod tests {
    #[test]
    fn a_table_that_is_not_there_is_an_error() {
        let refused = super::bench("nosuchtable", None).expect_err("nothing to measure").to_string();
        let names = "calls, scenes, effects, general, off, counts, times";
        assert_eq!(refused, format!("no table's name holds \"nosuchtable\": there are {names}"));
    }
}
