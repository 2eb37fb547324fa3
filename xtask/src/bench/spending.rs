//! What a second of motion takes, in instructions of fmi2DoStep, counted by callgrind (`benches/spend.c`): of each scene,
//! and of each effect alone.

use super::head;
use super::sets::{self, Set};
use crate::unpacked::{Unpacked, unpack};
use crate::{c, package, paths};
use anyhow::Result;
use split_rotor_model::effects::CATALOGUE;
use split_rotor_model::scene::Scene;
use std::path::Path;

/// A second, in so many communication steps.
const STEPS: u32 = 10;
const STEP: f64 = 0.1;

/// What a run spent.
pub struct Spent {
    pub instructions: f64,
    pub evaluations: f64,
}

impl Spent {
    /// Instructions an evaluation, the method's own among them.
    pub fn each(&self) -> f64 {
        self.instructions / self.evaluations
    }
}

/// Runs an FMU for a second with these values set, `NAME=VALUE`.
pub fn spent(fmu: &Unpacked, values: &[String]) -> Result<Spent> {
    let arguments = [&[STEPS.to_string(), STEP.to_string()], values].concat();
    let (instructions, printed) = c::instructions(&c::bench("spend")?, fmu, ["fmi2DoStep"], &arguments)?;
    Ok(Spent { instructions, evaluations: printed.trim().parse()? })
}

/// Packages these scenes, names or files, into `folder`.
pub fn packaged(scenes: &[String], folder: &Path) -> Result<Vec<Unpacked>> {
    package::package(scenes, Some(folder))?.iter().map(|fmu| unpack(fmu)).collect()
}

/// Prints what a second of each scene takes, by the method that it names.
pub fn print_scenes() -> Result<()> {
    println!("{}", head(&["a second of", "instructions", "evaluations", "instructions an evaluation"]));
    for fmu in package::package(&Scene::names(&paths::scenes()), None)? {
        row(&unpack(&fmu)?)?;
    }
    Ok(())
}

/// Prints what a second of a rotor takes on which nothing acts, or one effect alone.
pub fn print_effects() -> Result<()> {
    println!("{}", head(&["a second of", "instructions", "evaluations", "instructions an evaluation"]));
    let folder = paths::target().join("alone");
    let alone = CATALOGUE.iter().map(|info| (info.name, vec![(info, 1)]));
    let sets = std::iter::once(("nothing", Set::new())).chain(alone);
    let scenes = sets.map(|(name, set)| sets::written(&folder, name, "", &set)).collect::<Result<Vec<_>>>()?;
    packaged(&scenes, &folder)?.iter().try_for_each(row)
}

fn row(fmu: &Unpacked) -> Result<()> {
    let spent = spent(fmu, &[])?;
    println!("| {} | {} | {} | {:.0} |", fmu.name, spent.instructions, spent.evaluations, spent.each());
    Ok(())
}
