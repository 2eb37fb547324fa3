//! The Python environment: target/venv, made from pinned and hashed requirements.

use crate::paths;
use crate::run::run;
use anyhow::{Context, Result, bail};
use std::path::PathBuf;
use std::process::Command;

const NEEDED: &str = "Python >= 3.10 with the module venv is needed (Debian: apt-get install python3-venv)";

/// A command of the environment's Python, which is made first where it is missing or out of date.
pub fn python() -> Result<Command> {
    let folder = paths::target().join("venv");
    let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let requirements = paths::root().join("xtask/python/requirements.txt");
    let wanted = std::fs::read_to_string(&requirements)?;
    // What was installed; it is written last, so an environment that was cut short is made anew.
    let stamp = folder.join("requirements.txt");
    if std::fs::read_to_string(&stamp).is_ok_and(|installed| installed == wanted) && python.is_file() {
        return Ok(command(python));
    }
    eprintln!("making the Python environment {}", folder.display());
    run(Command::new(system_python()?).args(["-m", "venv", "--clear"]).arg(&folder)).context(NEEDED)?;
    let install =
        ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--require-hashes", "--requirement"];
    run(command(python.clone()).args(install).arg(&requirements))?;
    std::fs::write(stamp, wanted)?;
    Ok(command(python))
}

fn command(python: PathBuf) -> Command {
    let mut command = Command::new(python);
    command.current_dir(paths::root()).env("PYTHONDONTWRITEBYTECODE", "1").env_remove("PYTHONPATH");
    command
}

/// The machine's own Python, if it is new enough.
fn system_python() -> Result<&'static str> {
    let new_enough = "import sys, venv; sys.exit(sys.version_info < (3, 10))";
    for name in ["python3", "python"] {
        if Command::new(name).args(["-c", new_enough]).output().is_ok_and(|output| output.status.success()) {
            return Ok(name);
        }
    }
    bail!("{NEEDED}: neither `python3` nor `python` is");
}
