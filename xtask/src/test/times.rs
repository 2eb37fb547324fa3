//! What each job took: `target/test/times.csv`, one row a job that did not fail, the dearest first.

use crate::alone::alone;
use crate::paths;
use anyhow::{Context, Result};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The columns of the file.
const HEADER: &str = "job,wall_s,cpu_s";

/// A job that runs in this process.
pub struct Watch {
    job: &'static str,
    start: Instant,
}

/// What a job took.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    job: String,
    /// Wall-clock time \[s].
    wall: f64,
    /// Time of all processors, of this process and of all that it started \[s]; unknown where the system does not count it.
    cpu: Option<f64>,
}

impl Watch {
    /// Starts with the job.
    pub fn of(job: &'static str) -> Self {
        Self { job, start: Instant::now() }
    }

    /// Writes and prints what the job took.
    pub fn stop(self) -> Result<()> {
        let row = Row { job: self.job.into(), wall: self.start.elapsed().as_secs_f64(), cpu: cpu_time()? };
        let cpu = row.cpu.map_or_else(String::new, |cpu| format!(", {cpu:.0} s of CPU time"));
        println!("== {}: {:.0} s{cpu}", row.job, row.wall);
        put(&file(), row)
    }
}

/// Forgets what earlier runs took.
pub fn clear() -> Result<()> {
    match fs::remove_file(file()) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(error.into()),
        _ => Ok(()),
    }
}

/// Prints what the jobs took, the dearest first.
pub fn print() -> Result<()> {
    if let Ok(text) = fs::read_to_string(file()) {
        println!("\n== {}", file().display());
        for Row { job, wall, cpu } in rows(&text)? {
            println!("{wall:6.0} s {:>6} s of CPU time  {job}", cpu.map_or("?".into(), |cpu| format!("{cpu:.0}")));
        }
    }
    Ok(())
}

fn file() -> PathBuf {
    paths::target().join("test/times.csv")
}

/// Puts a row into the file, in place of an earlier one of this job; one process at a time.
fn put(file: &Path, row: Row) -> Result<()> {
    let _alone = alone(&file.with_extension("lock"), || ())?;
    // Of a file that is damaged nothing is kept.
    let mut all = rows(&fs::read_to_string(file).unwrap_or_default()).unwrap_or_default();
    all.retain(|other| other.job != row.job);
    all.push(row);
    all.sort_by(|a, b| b.cost().total_cmp(&a.cost()));
    let mut text = format!("{HEADER}\n");
    for Row { job, wall, cpu } in all {
        writeln!(text, "{job},{wall:.1},{}", cpu.map_or_else(String::new, |cpu| format!("{cpu:.1}")))?;
    }
    let whole = file.with_extension("new");
    fs::write(&whole, text)?;
    Ok(fs::rename(whole, file)?)
}

impl Row {
    fn cost(&self) -> f64 {
        self.cpu.unwrap_or(self.wall)
    }
}

fn rows(text: &str) -> Result<Vec<Row>> {
    let row = |line: &str| {
        let mut cells = line.rsplitn(3, ',');
        let mut next = || cells.next().with_context(|| format!("{line:?} is no row of {HEADER}"));
        let (cpu, wall, job) = (next()?, next()?.parse()?, next()?.to_owned());
        Ok(Row { job, wall, cpu: (!cpu.is_empty()).then(|| cpu.parse()).transpose()? })
    };
    text.lines().skip(1).map(row).collect()
}

/// The CPU time of this process and of all that it started and that have ended \[s].
#[cfg(unix)]
fn cpu_time() -> Result<Option<f64>> {
    use nix::sys::resource::{UsageWho, getrusage};
    let mut sum = 0.0;
    for who in [UsageWho::RUSAGE_SELF, UsageWho::RUSAGE_CHILDREN] {
        let usage = getrusage(who)?;
        for time in [usage.user_time(), usage.system_time()] {
            sum += time.tv_sec() as f64 + 1e-6 * time.tv_usec() as f64;
        }
    }
    Ok(Some(sum))
}

#[cfg(not(unix))]
fn cpu_time() -> Result<Option<f64>> {
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::{Row, put, rows};
    use crate::paths;
    use std::fs;

    #[test]
    fn each_job_has_one_row_and_the_dearest_is_the_first() {
        let file = paths::target().join("tests/times/times.csv");
        let _ = fs::remove_file(&file);
        let row = |job: &str, wall, cpu| Row { job: job.into(), wall, cpu };
        for row in [row("fuzz", 2.0, Some(3.0)), row("docs, code", 4.0, None), row("fuzz", 2.0, Some(9.5))] {
            put(&file, row).unwrap();
        }
        let text = fs::read_to_string(&file).unwrap();
        fs::write(file.with_file_name("damaged.csv"), "garbage\ngarbage").unwrap();
        put(&file.with_file_name("damaged.csv"), row("fuzz", 2.0, None)).unwrap();
        assert_eq!(text, "job,wall_s,cpu_s\nfuzz,2.0,9.5\ndocs, code,4.0,\n");
        assert_eq!(rows(&text).unwrap(), [row("fuzz", 2.0, Some(9.5)), row("docs, code", 4.0, None)]);
        assert!(rows("job\nfuzz,2.0").is_err());
    }

    #[test]
    #[cfg(unix)]
    fn the_time_of_a_program_that_has_ended_counts() {
        let before = super::cpu_time().unwrap().unwrap();
        let busy = "i=0; while [ $i -lt 200000 ]; do i=$((i + 1)); done";
        crate::run::run(std::process::Command::new("sh").args(["-c", busy])).unwrap();
        assert!(super::cpu_time().unwrap().unwrap() > before + 0.02);
    }
}
