//! `bench`: what single calls of the packaged FMU take, in time and, where valgrind is installed, in instructions.

use crate::run::output;
use crate::unpacked::{Unpacked, unpack};
use crate::{c, package, paths};
use anyhow::{Context, Result, bail};
use model::scene::Scene;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The scenes whose FMUs are measured, as far as they are there: without inputs, and with one.
const SCENES: [&str; 2] = ["paper", "driven"];

/// What the C program tells of one measurement.
struct Line {
    key: String,
    what: String,
    /// [ns]; 0: none.
    target: f64,
    /// [ns]
    time: f64,
    /// The functions whose instructions count.
    functions: Vec<String>,
}

/// Measures and prints a table.
pub fn bench() -> Result<()> {
    let there = Scene::names(&paths::scenes());
    let scenes: Vec<_> = SCENES.map(str::to_owned).into_iter().filter(|name| there.contains(name)).collect();
    let sources = ["benches/fmi_calls.c", "tests/c/library.c", "tests/c/sheet.c"].map(PathBuf::from);
    let program = c::compile("fmi_calls", &sources, &[])?;
    let counts = c::is_installed("valgrind");
    for fmu in package::package(&scenes, None)? {
        let fmu = unpack(&fmu)?;
        println!("\n| {} | ns | at most | instructions |\n|---|--:|--:|--:|", fmu.name);
        let lines = output(program_on(&fmu, &mut Command::new(&program)))?;
        for line in lines.lines() {
            let line = parse(line).with_context(|| format!("fmi_calls printed `{line}`"))?;
            let count = if counts { format!("{:.0}", instructions(&program, &fmu, &line)?) } else { "-".into() };
            let target = if line.target > 0.0 { format!("{:.0}", line.target) } else { "-".into() };
            let missed = if line.target > 0.0 && line.time > line.target { " (missed)" } else { "" };
            println!("| {} | {:.1} | {target}{missed} | {count} |", line.what, line.time);
        }
    }
    if !counts {
        println!("\ninstructions are not counted: valgrind is not installed (Debian: apt-get install valgrind)");
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
        target: target.parse()?,
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
