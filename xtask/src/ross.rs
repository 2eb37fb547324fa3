//! The linear view beside ROSS, a program of beam elements: one rotor in both.

use crate::run::{Conversation, run};
use crate::{campbell, paths, python, response};
use anyhow::Result;
use std::path::PathBuf;

/// Up to which speed [rad/s], and at how many.
const SPEEDS: [f64; 2] = [0.0, 600.0];
const STEPS: u32 = 121;

/// Modes, critical speeds and unbalance response of ours: the files with them.
pub fn ours() -> Result<[PathBuf; 2]> {
    let scene = paths::root().join("xtask/python/peers/ross.toml").display().to_string();
    campbell::campbell(&scene, Some(SPEEDS), STEPS, &[1.0], None)?.show();
    response::response(&scene, Some(SPEEDS), STEPS, false, None)?;
    Ok(["campbell", "response"].map(|name| paths::target().join(name).join("ross").join(name).with_extension("json")))
}

/// Those of ROSS beside them, into target/ross: table, picture and CSV; the table. What differs by more than the beam explains is an error.
pub fn theirs() -> Result<String> {
    let mut peer = Conversation::with(python::peer("ross")?.arg(paths::target()))?;
    let table = peer.paragraph()?.join("\n");
    peer.end()?;
    let folder = paths::target().join("ross");
    run(python::python_with_all()?.arg("xtask/python/against_ross.py").arg(&folder))?;
    println!("{}", folder.join("ross.svg").display());
    Ok(table)
}
