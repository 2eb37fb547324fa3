//! A million random sequences of FMI calls under AddressSanitizer and LeakSanitizer, led by libFuzzer (`fuzz/`).

use crate::paths;
use crate::run::{installed, run};
use anyhow::{Context, Result, bail};
use std::env::consts::ARCH;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};

/// The version of what builds the fuzz target.
const CARGO_FUZZ: &str = "0.13.2";

/// Half of the sequences with each scene, at the same time: one whose solver runs ahead, and one with an input.
const SCENES: [&str; 2] = ["paper", "driven"];
const SEQUENCES: usize = 1_000_000;

/// Where somebody has no half hour for them: the name of an environment variable with the longest time \[s], after which none is begun.
const LONGEST_TIME: &str = "SPLIT_ROTOR_FUZZ_SECONDS";

/// The longest sequence, in bytes; a call takes some five.
const LONGEST: u32 = 200;

/// A sequence that takes longer \[s] hangs; it takes a few milliseconds.
const PATIENCE: u32 = 120;

/// Runs them; the same seed makes the same sequences.
pub fn fuzz() -> Result<()> {
    if !(cfg!(target_os = "linux") && cfg!(target_env = "gnu")) {
        bail!("fuzzing needs Linux with the GNU C library, for the sanitizers");
    }
    let seconds = match std::env::var(LONGEST_TIME) {
        Ok(number) => {
            Some(number.parse().with_context(|| format!("{LONGEST_TIME} = {number} must be a whole number"))?)
        }
        Err(_) => None,
    };
    let cargo_fuzz = installed("cargo-fuzz", CARGO_FUZZ)?;
    let folder = paths::target().join("fuzz");
    let targets = SCENES.iter().map(|scene| build(scene, &cargo_fuzz, &folder)).collect::<Result<Vec<_>>>()?;
    let started = SCENES.iter().zip(&targets).map(|(scene, target)| start(scene, target, seconds, &folder));
    let mut running = started.collect::<Result<Vec<_>>>()?;
    let statuses = running.iter_mut().map(|(_, child)| child.wait()).collect::<Result<Vec<_>, _>>()?;
    for ((log, _), status) in running.iter().zip(statuses) {
        if !status.success() {
            bail!("{}: the fuzz target failed ({status}): {}", log.display(), end(log, 40)?);
        }
        println!("{}: {}", log.display(), end(log, 1)?);
    }
    Ok(())
}

/// The fuzz target with this scene compiled in.
fn build(scene: &str, cargo_fuzz: &Path, folder: &Path) -> Result<PathBuf> {
    run(Command::new(cargo_fuzz)
        // Comparisons tell nothing of a sequence of calls, and to watch them takes half of the time.
        .args(["build", "--no-trace-compares", "calls"])
        .arg("--target-dir")
        .arg(folder)
        .current_dir(paths::root())
        .env("SPLIT_ROTOR_SCENE", paths::scenes().join(format!("{scene}.toml")))
        // The stable compiler has the sanitizer, behind a switch meant for the standard library.
        .env("RUSTC_BOOTSTRAP", "1"))
    .context("the fuzz target cannot be built: libFuzzer needs a C++ compiler (Debian: apt-get install g++)")?;
    // The next scene's overwrites it.
    let target = folder.join(format!("calls-{scene}"));
    std::fs::copy(folder.join(format!("{ARCH}-unknown-linux-gnu/release/calls")), &target)?;
    Ok(target)
}

/// Starts a run; its log and its process.
fn start(scene: &str, target: &Path, seconds: Option<u32>, folder: &Path) -> Result<(PathBuf, Child)> {
    let (log, sequences) = (folder.join(format!("{scene}.log")), SEQUENCES / SCENES.len());
    let within = seconds.map_or(String::new(), |seconds| format!(", as many as {seconds} s hold"));
    eprintln!("{sequences} random sequences of calls with {scene}{within}, log in {}", log.display());
    let child = Command::new(target)
        .args(seconds.map(|seconds| format!("-max_total_time={seconds}")))
        .args([format!("-runs={sequences}"), "-seed=1".into()])
        .args([format!("-max_len={LONGEST}"), "-len_control=0".into(), format!("-timeout={PATIENCE}")])
        .arg(format!("-artifact_prefix={}/{scene}-", folder.display()))
        .env("ASAN_OPTIONS", "detect_leaks=1:detect_stack_use_after_return=1")
        .stdout(File::create(&log)?)
        .stderr(File::options().append(true).open(&log)?)
        .spawn()?;
    Ok((log, child))
}

/// So many last lines of a log.
fn end(log: &Path, count: usize) -> Result<String> {
    let text = String::from_utf8_lossy(&std::fs::read(log)?).into_owned();
    let lines: Vec<_> = text.lines().collect();
    Ok(lines[lines.len().saturating_sub(count)..].join("\n"))
}
