//! The C host of the tests (`tests/c`): it does with an FMU whatever a host can do. Plain here; `sanitize` and `memcheck`
//! start it under checkers.

use crate::c;
use crate::run::run;
use crate::scenes;
use crate::unpacked::{Unpacked, unpack};
use anyhow::Result;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The compiled host.
pub fn compile(name: &str, flags: &[&str]) -> Result<PathBuf> {
    c::compile(name, &c::sources("tests/c")?, &[&["-g"], flags].concat())
}

/// The parts in which the host steps or differences by itself: too coarsely where a scene is not gentle.
const OWN_STEPS: [&str; 3] = ["model_exchange", "directional", "signals"];

/// Adds the host's own arguments: the FMU, where the host may write, and what its scene is not fit for.
pub fn arguments<'c>(command: &'c mut Command, fmu: &Unpacked) -> Result<&'c mut Command> {
    let folder = fmu.sheet.parent().unwrap_or(Path::new("."));
    command.arg(&fmu.sheet).arg(&fmu.library).arg(folder);
    let scene = scenes::find(&fmu.name)?;
    if !scenes::is_gentle(&scene) {
        command.args(OWN_STEPS.iter().flat_map(|part| ["--without", part]));
    } else if scene.general {
        // Its inputs belong to effects that are off.
        command.args(["--without", "signals"]);
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
    for fmu in fmus {
        run(arguments(&mut Command::new(&host), &unpack(fmu)?)?)?;
    }
    Ok(())
}
