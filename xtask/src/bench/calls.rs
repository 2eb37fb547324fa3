//! What single calls of the packaged FMU take, in time and, where valgrind is installed, in instructions
//! (`benches/fmi_calls.c`).

use super::{head, scenes, target};
use crate::run::output;
use crate::unpacked::{Unpacked, unpack};
use crate::{c, package};
use anyhow::{Context, Result, bail};
use std::path::Path;
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
    let program = c::bench("fmi_calls")?;
    let counts = c::is_installed("valgrind");
    for fmu in package::package(&scenes(), None)? {
        let fmu = unpack(&fmu)?;
        println!("{}", head(&[&fmu.name, "ns", "at most", "instructions"]));
        let lines = output(Command::new(&program).arg(&fmu.sheet).arg(&fmu.library))?;
        for line in lines.lines() {
            let line = parse(line).with_context(|| format!("fmi_calls printed `{line}`"))?;
            let count = if counts { format!("{:.0}", instructions(&program, &fmu, &line)?) } else { "-".into() };
            println!("| {} | {:.1} | {} | {count} |", line.what, line.time, target(line.target, line.time));
        }
    }
    Ok(())
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
    let [none, many] = [0, CALLS].map(|calls| {
        let functions = line.functions.iter().map(String::as_str);
        c::instructions(program, fmu, functions, &[line.key.clone(), calls.to_string()])
    });
    Ok((many?.0 - none?.0) / f64::from(CALLS))
}
