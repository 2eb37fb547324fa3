//! What single calls of the packaged FMU take, in time and, where valgrind is installed, in instructions
//! (`benches/fmi_calls.c`).

use super::{head, scenes, target};
use crate::run::output;
use crate::unpacked::{Unpacked, unpack};
use crate::{c, package};
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the C program tells of one measurement.
struct Line {
    key: String,
    what: String,
    /// \[ns]
    target: Option<f64>,
    /// \[ns]
    time: f64,
    /// The functions whose instructions count.
    functions: Vec<String>,
}

/// Measures and prints tables.
pub fn print() -> Result<()> {
    let sources = ["benches/fmi_calls.c", "tests/c/library.c", "tests/c/sheet.c"].map(PathBuf::from);
    let program = c::compile("fmi_calls", &sources, &[])?;
    let counts = c::is_installed("valgrind");
    for fmu in package::package(&scenes(), None)? {
        let fmu = unpack(&fmu)?;
        println!("{}", head(&[&fmu.name, "ns", "at most", "instructions"]));
        let lines = output(program_on(&fmu, &mut Command::new(&program)))?;
        for line in lines.lines() {
            let line = parse(line).with_context(|| format!("fmi_calls printed `{line}`"))?;
            let count = if counts { format!("{:.0}", instructions(&program, &fmu, &line)?) } else { "-".into() };
            println!("| {} | {:.1} | {} | {count} |", line.what, line.time, target(line.target, line.time));
        }
    }
    Ok(())
}

fn program_on<'c>(fmu: &Unpacked, command: &'c mut Command) -> &'c mut Command {
    command.arg(&fmu.sheet).arg(&fmu.library)
}

fn parse(line: &str) -> Result<Line> {
    let fields: Vec<_> = line.split('|').collect();
    let [key, what, target, time, functions] = fields[..] else { bail!("not five fields") };
    Ok(Line {
        key: key.into(),
        what: what.into(),
        target: Some(target.parse()?).filter(|ns| *ns > 0.0),
        time: time.parse()?,
        functions: functions.split(' ').map(str::to_owned).collect(),
    })
}

/// Instructions of one call, those of all that it calls included.
fn instructions(program: &Path, fmu: &Unpacked, line: &Line) -> Result<f64> {
    const CALLS: u32 = 1000;
    // The way to the first call uses the same functions: it is what no call at all counts.
    let [none, many] = [0, CALLS].map(|calls| collected(program, fmu, line, calls));
    Ok((many? - none?) / f64::from(CALLS))
}

/// Instructions within the line's functions while the program makes so many calls.
fn collected(program: &Path, fmu: &Unpacked, line: &Line, calls: u32) -> Result<f64> {
    let mut command = Command::new("valgrind");
    command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]);
    command.args(line.functions.iter().map(|function| format!("--toggle-collect={function}")));
    program_on(fmu, command.arg(program)).args([&line.key, &calls.to_string()]);
    let said = String::from_utf8(command.output().context("cannot run valgrind")?.stderr)?;
    let sum = said.lines().find_map(|line| line.split("Collected :").nth(1));
    Ok(sum.with_context(|| format!("callgrind tells no sum: {said}"))?.trim().parse()?)
}
