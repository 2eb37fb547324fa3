//! The C host of the tests (`tests/c`): it does with an FMU whatever a host can do. Plain here; `sanitize` and `memcheck`
//! start it under checkers.

use crate::c;
use crate::run::{run, side_by_side};
use crate::scenes;
use crate::unpacked::{Unpacked, unpack};
use anyhow::Result;
use std::path::PathBuf;
use std::process::Command;

/// The C library keeps no freed memory at hand for a thread: it would count as used, more or less of it as lives go by.
const EXACT: (&str, &str) = ("GLIBC_TUNABLES", "glibc.malloc.tcache_count=0");

/// The compiled host.
pub fn compile(name: &str, flags: &[&str]) -> Result<PathBuf> {
    c::compile(name, &c::sources("tests/c")?, &[&["-g"], flags].concat())
}

/// Adds the host's own arguments: the FMU, and what its scene is not fit for.
pub fn arguments<'c>(command: &'c mut Command, fmu: &Unpacked) -> Result<&'c mut Command> {
    command.arg(&fmu.sheet).arg(&fmu.library);
    if !scenes::is_gentle(&scenes::find(&fmu.name)?) {
        // There the host steps by itself, too coarsely for such a scene.
        command.args(["--without", "model_exchange"]);
    }
    Ok(command)
}

/// The host, plain, on packaged FMUs.
pub fn plain(fmus: &[PathBuf]) -> Result<()> {
    if !cfg!(target_os = "linux") {
        println!("the C host is skipped: it measures memory as Linux tells it");
        return Ok(());
    }
    let host = compile("host", &[])?;
    side_by_side(fmus, |_, fmu| {
        let mut command = Command::new(&host);
        run(arguments(command.env(EXACT.0, EXACT.1), &unpack(fmu)?)?)
    })
}
