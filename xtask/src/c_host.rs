//! The C host of the tests (`tests/c`): it does with an FMU whatever a host can do. Plain here; `sanitize` and `memcheck`
//! start it under checkers.

use crate::c;
use crate::run::run;
use crate::unpacked::{Unpacked, unpack};
use anyhow::Result;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The compiled host.
pub fn compile(name: &str, flags: &[&str]) -> Result<PathBuf> {
    c::compile(name, &c::sources("tests/c")?, &[&["-g"], flags].concat())
}

/// Adds the host's own arguments: the FMU, and where the host may write.
pub fn arguments<'c>(command: &'c mut Command, fmu: &Unpacked) -> Result<&'c mut Command> {
    let folder = fmu.sheet.parent().unwrap_or(Path::new("."));
    Ok(command.arg(&fmu.sheet).arg(&fmu.library).arg(folder))
}

/// The host, plain, on packaged FMUs.
pub fn plain(fmus: &[PathBuf]) -> Result<()> {
    if !cfg!(target_os = "linux") {
        println!("the C host is skipped: it measures memory as Linux tells it");
        return Ok(());
    }
    let host = compile("host", &[])?;
    for fmu in fmus {
        run(arguments(&mut Command::new(&host), &unpack(fmu)?)?)?;
    }
    Ok(())
}
