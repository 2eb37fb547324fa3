//! The packaged FMUs, as they travel, under valgrind's memcheck.

use crate::run::{run, side_by_side};
use crate::unpacked::unpack;
use crate::{c, c_host, paths};
use anyhow::Result;
use split_rotor_model::scene::Scene;

/// Runs a shorter C host on every scene's FMU, as it was packaged last, under memcheck: errors and leaks fail.
pub fn valgrind() -> Result<()> {
    let host = c_host::compile("host", &[])?;
    side_by_side(&Scene::names(&paths::scenes()), |_, name| {
        let mut command = c::tool("valgrind", "valgrind")?;
        command.args(["--quiet", "--error-exitcode=99", "--leak-check=full", "--trace-children=yes"]).arg(&host);
        let shorter = ["--cycles", "20", "--steps", "100", "--no-memory"];
        // A caught panic with a backtrace keeps symbols in memory, which looks like a leak.
        run(c_host::arguments(&mut command, &unpack(&paths::fmu(name))?)?.args(shorter).env("RUST_BACKTRACE", "0"))
    })
}
