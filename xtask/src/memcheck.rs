//! The packaged FMUs, as they travel, under valgrind's memcheck.

use crate::run::{run, side_by_side};
use crate::test::by_library;
use crate::unpacked::unpack;
use crate::{c, c_host, library, paths, scenes};
use anyhow::Result;
use split_rotor_model::scene::Scene;

/// Runs a shorter C host under memcheck on one scene's FMU of every library, as it was packaged last: what the same library runs is the same
/// machine code. Errors and leaks fail.
pub fn valgrind() -> Result<()> {
    let host = c_host::compile("host", &[])?;
    let (compiled, _) = by_library(Scene::names(&paths::scenes()))?;
    let all = compiled.iter().map(|name| scenes::find(name)).collect::<Result<Vec<_>>>()?;
    side_by_side(&library::by_list(&all), |_, scenes| {
        let mut command = c::tool("valgrind", "valgrind")?;
        command.args(["--quiet", "--error-exitcode=99", "--leak-check=full", "--trace-children=yes"]).arg(&host);
        let shorter = ["--cycles", "20", "--steps", "100", "--no-memory"];
        let fmu = unpack(&paths::fmu(&scenes[0].name))?;
        // A caught panic with a backtrace keeps symbols in memory, which looks like a leak.
        run(c_host::arguments(&mut command, &fmu)?.args(shorter).env("RUST_BACKTRACE", "0"))
    })
}
