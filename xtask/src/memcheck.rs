//! The packaged FMUs, as they travel, under valgrind's memcheck.

use crate::run::{run, side_by_side};
use crate::test::by_library;
use crate::unpacked::unpack;
use crate::{c, c_host, library, paths, scenes};
use anyhow::{Context, Result};
use split_rotor_model::scene::Scene;
use split_rotor_tools::general::GENERAL;

/// Runs a shorter C host under memcheck on one scene's FMU of every library, as the tests packaged it last, one that does model exchange where there
/// is one: what the same library runs is the same machine code. Errors and leaks fail.
pub fn valgrind() -> Result<()> {
    let host = c_host::compile("host", &[])?;
    let (compiled, others) = by_library(Scene::names(&paths::scenes()))?;
    let found = |names: Vec<String>| names.iter().map(|name| scenes::find(name)).collect::<Result<Vec<_>>>();
    let (compiled, others) = (found(compiled)?, found(others)?);
    let mut libraries = library::by_list(&compiled);
    let is_general = |scenes: &&mut Vec<&Scene>| scenes.iter().any(|scene| scene.name == GENERAL);
    libraries.iter_mut().find(is_general).context("every effect has a library")?.extend(&others);
    side_by_side(&libraries, |_, scenes| {
        let scene = scenes.iter().find(|scene| scenes::is_gentle(scene)).unwrap_or(&scenes[0]);
        let mut command = c::tool("valgrind", "valgrind")?;
        command.args(["--quiet", "--error-exitcode=99", "--leak-check=full", "--trace-children=yes"]).arg(&host);
        let shorter = ["--cycles", "20", "--steps", "100", "--no-memory"];
        let fmu = unpack(&paths::fmu_in(&paths::tested_fmus(), &scene.name))?;
        // A caught panic with a backtrace keeps symbols in memory, which looks like a leak.
        run(c_host::arguments(&mut command, &fmu)?.args(shorter).env("RUST_BACKTRACE", "0"))
    })
}
