//! Solvers in Rust, measured like the FMU: reads a task as a line of JSON from the standard input, prints a JSON line for every
//! setting that it tried. `cargo xtask accuracy --peers` builds and runs it.

mod differential_equations;
mod equations;
mod ode_solvers;
mod task;

use anyhow::{Result, bail};
use task::Task;

fn main() -> Result<()> {
    let package = std::env::args().nth(1).unwrap_or_default();
    let task = Task::read(&package)?;
    match package.as_str() {
        "ode_solvers" => ode_solvers::answer(&task),
        "differential-equations" => differential_equations::answer(&task),
        _ => bail!("usage: split-rotor-peers ode_solvers|differential-equations < TASK"),
    }
    Ok(())
}
