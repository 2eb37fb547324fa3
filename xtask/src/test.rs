//! `test`: everything that must hold, as a list of jobs.

mod times;
mod unchanged;

use crate::accuracy::{self, Peers};
use crate::hard_cases::{self, Extent};
use crate::progress::Progress;
use crate::run::{cargo, run, side_by_side};
use crate::{
    abroad, bench, c_host, copies, fuzz, known, memcheck, package, paths, python, ross, sanitize, scenes, wheel,
};
use anyhow::{Context, Result, bail, ensure};
use split_rotor_model::scene::Scene;
use std::env;
use std::fs;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::thread;
use times::Watch;
use unchanged::{Basis, unless_unchanged};

/// What a job does, the folders in target/ that it alone needs, and what runs it; where it cannot, that is an error, which names what is to
/// be installed.
type Job = (&'static str, &'static [&'static str], fn(Length) -> Result<()>);

/// How much is run.
#[derive(Clone, Copy, PartialEq)]
pub enum Length {
    Short,
    Long,
    /// Also what has not changed since it last ran.
    All,
}

impl Length {
    /// The switches that ask for it.
    const fn switches(self) -> &'static [&'static str] {
        match self {
            Length::Short => &[],
            Length::Long => &["--long"],
            Length::All => &["--long", "--all"],
        }
    }
}

/// What always runs. Several run side by side, here and below, so what takes longest comes first.
const SHORT: [Job; 3] = [
    ("Rust's tests", &[], |_| rust_tests()),
    ("packaged FMUs and hard cases", &[], packaged_fmus),
    ("documentation of the code", &[], |_| documentation()),
];

/// What takes long, or needs more than the README asks for.
const LONG: [Job; 16] = [
    ("bits of every platform", &["abroad"], bits_of_every_platform),
    ("counts that must hold", &[], |_| bench::must_hold()),
    ("third-party clients", &[], |_| clients()),
    ("fuzz", &["fuzz"], |_| fuzz::fuzz()),
    ("sanitizers", &["sanitized"], |_| sanitize::sanitizers()),
    ("bits of a plain, wide build", &["unoptimised"], |_| plain_wide_build()),
    ("call rules of a driven scene", &[], |_| driven_tests()),
    ("the example of an effect", &["copies/example", "copies/target"], |_| copies::example_is_right()),
    ("Python package", &[], |_| wheel::wheel().map(drop)),
    ("long runs", &[], long_runs),
    ("memcheck", &[], |_| memcheck::valgrind()),
    ("hard cases in full", &[], |_| whole_gallery()),
    ("absence is free", &["copies/absence", "copies/code"], |_| copies::absence_is_free()),
    ("bytes elsewhere", &[], |_| copies::place_leaves_no_trace()),
    ("peers", &["peers"], peers),
    ("against ROSS", &["venv-peers/ross"], against_ross),
];

/// Runs the short jobs, and after them the long ones where they are asked for, those whose names hold `part`; says what each took
/// ([`times`]).
pub fn test(part: &str, length: Length) -> Result<()> {
    let of = |jobs: &'static [Job]| jobs.iter().filter(|(name, ..)| name.contains(part)).collect::<Vec<_>>();
    let (short, others) = (of(&SHORT), if length == Length::Short { Vec::new() } else { of(&LONG) });
    let names = |jobs: &[Job]| jobs.iter().map(|(name, ..)| format!("\n  {name}")).collect::<String>();
    match *[&short[..], &others].concat() {
        // Nothing run would pass for nothing wrong.
        [] => bail!(
            "no job's name holds {part:?}{}: there are{}\nand with --long also{}",
            known::meant(part, SHORT.iter().chain(&LONG).map(|(name, ..)| *name)),
            names(&SHORT),
            names(&LONG)
        ),
        [(name, _, job)] => {
            println!("\n== {name}");
            let watch = Watch::of(name);
            job(length)?;
            watch.stop()
        }
        _ => {
            times::clear()?;
            let groups = [short, others];
            let done = groups.iter().filter(|jobs| !jobs.is_empty()).try_for_each(|jobs| together(jobs, length));
            let printed = times::print();
            done.and(printed)
        }
    }
}

/// Runs these jobs side by side, each by an xtask of its own, whose words are shown when it has ended.
fn together(jobs: &[&Job], length: Length) -> Result<()> {
    let (progress, running) = (Progress::of(jobs.len()), Mutex::new(Vec::new()));
    side_by_side(jobs, |_, (name, folders, _)| {
        progress.tell(&format!("== {name} begins"));
        let now = |change: &dyn Fn(&mut Vec<&str>)| {
            let mut running = running.lock().expect("no worker panics");
            change(&mut running);
            progress.set_message(running.join(", "));
        };
        now(&|running| running.push(name));
        let mut job = Command::new(env::current_exe()?);
        let output = job.args(["test", name]).args(length.switches()).stdin(Stdio::null()).output()?;
        progress.suspend(|| {
            print!("{}", String::from_utf8_lossy(&output.stdout));
            eprint!("{}", String::from_utf8_lossy(&output.stderr));
        });
        progress.inc(1);
        now(&|running| running.retain(|other| other != name));
        ensure!(output.status.success(), "the job {name:?} failed ({})", output.status);
        // All jobs together would leave twice as much on the disk.
        folders.iter().map(|folder| paths::target().join(folder)).filter(|folder| folder.exists()).try_for_each(
            |folder| fs::remove_dir_all(&folder).with_context(|| format!("cannot remove {}", folder.display())),
        )
    })
}

/// Those of the examples too, which are not built as programs besides.
fn rust_tests() -> Result<()> {
    run(cargo().args(["test", "--quiet", "--tests"]))?;
    run(cargo().args(["test", "--quiet", "--doc"]))
}

/// The comments of the code as pages, without a warning.
fn documentation() -> Result<()> {
    run(cargo().args(["doc", "--quiet", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"))
}

/// The call rules once more, and random calls, with a scene that has an input.
fn driven_tests() -> Result<()> {
    let files = ["abi", "arguments", "derivatives", "exchange", "inputs", "random_calls", "serialized", "state"];
    // Of all members, so that of what it stands on nothing is built anew.
    let test = ["test", "--quiet", "--features", "split-rotor/driven", "--test", "interface", "--"];
    run(cargo().args(test).args(files.map(|name| format!("{name}::"))))
}

/// The bits are the same where nothing is optimised, with wide vectors and fused arithmetic at the disposal of every library, where this
/// machine has them: each scene by one method. Where all is optimised, each has them by all, and so have the packaged FMUs.
fn plain_wide_build() -> Result<()> {
    // There the laws of all effects stand on the stack one within another: 2 MB of it.
    let stack = (8 << 20).to_string();
    run(cargo()
        .args(["test", "--quiet", "--test", "bits", "--profile", "unoptimised"])
        .env("RUST_MIN_STACK", stack)
        .env("SPLIT_ROTOR_METHODS_BY_TURNS", "1")
        .env("RUSTFLAGS", "-Ctarget-cpu=native"))
}

/// The packaged FMUs under a host in C and under fmpy, those of all scenes only at length; then the hard cases by them, the long ones
/// shortened, and that each can fail.
fn packaged_fmus(length: Length) -> Result<()> {
    let scenes = if length == Length::Short { first() } else { Scene::names(&paths::scenes()) };
    let (compiled, others) = by_library(scenes)?;
    let fmus = paths::tested_fmus();
    c_host::plain(&[package::package(&compiled, Some(&fmus))?, package::over_general(&others, &fmus)?].concat())?;
    let names = [("SPLIT_ROTOR_PACKAGED", compiled), ("SPLIT_ROTOR_OVER_GENERAL", others)];
    run(pytest(&["tests/fmu", "tests/clients"])?.envs(names.map(|(variable, names)| (variable, names.join(" ")))))?;
    hard_cases::run(&Extent { mutants: true, ..Extent::default() }, &fmus)
}

/// The scenes of the hard cases, one through all charts, and that of the README.
fn first() -> Vec<String> {
    hard_cases::scenes().into_iter().chain(["tumbling", "turbo"]).map(str::to_owned).collect()
}

/// To compile a list of effects takes a minute: those of these scenes are compiled, no effect, few, many, one with tables, and every effect.
const COMPILED: [&str; 5] = ["free_top", "paper", "turbo", "film_bearings", "rotor"];

/// Of these scenes those whose lists are compiled, and the others: their FMUs are made over the library of every effect, with the same bits.
pub fn by_library(scenes: Vec<String>) -> Result<(Vec<String>, Vec<String>)> {
    let list = |name: &str| Ok(scenes::find(name)?.list());
    let compiled = COMPILED.iter().map(|name| list(name)).collect::<Result<Vec<_>>>()?;
    let is_compiled = scenes.iter().map(|name| Ok(compiled.contains(&list(name)?))).collect::<Result<Vec<_>>>()?;
    let mut is_compiled = is_compiled.into_iter();
    Ok(scenes.into_iter().partition(|_| is_compiled.next() == Some(true)))
}

/// The hard cases that were shortened, in full.
fn whole_gallery() -> Result<()> {
    hard_cases::run(&Extent { whole: true, longer: true, ..Extent::default() }, &paths::tested_fmus())
}

/// The packaged FMUs under third-party clients, and pytest's other long tests.
fn clients() -> Result<()> {
    python::clients()?;
    run(&mut pytest(&["--long", "-m", "long", "tests/fmu", "tests/clients"])?)
}

/// Runs the Rust tests of the model that take long. It draws new random scenes only with `--all`: one in some hundreds is wrong, whatever was
/// changed.
fn long_runs(length: Length) -> Result<()> {
    // What costs are is measured, not tested: docs/accuracy.md has the command.
    // Of all members, as their tests were built: alone, the model would be built anew.
    let mut tests = cargo();
    tests.args(["test", "--test", "all", "--", "--ignored", "--nocapture", "--skip", "what_auto_costs"]);
    if length != Length::All {
        tests.args(["--skip", "drawn_anew"]);
    }
    run(&mut tests)
}

/// All files but those that are no part of an FMU and make none, as git's pathspecs.
const OF_FMUS: &[&str] = &[
    ".",
    ":!.ci",
    ":!docs",
    ":!examples",
    ":!findings",
    ":!fuzz",
    ":!model/examples",
    ":!model/tests",
    ":!oracles",
    ":!python",
    ":!tests/clients",
    ":!tests/fmu",
    ":!tests/golden/jobs",
    ":!tests/interface",
    ":!*.md",
];

/// The golden bits on every platform, where anything has changed that is part of an FMU or makes one.
fn bits_of_every_platform(length: Length) -> Result<()> {
    let tracked = [OF_FMUS, &[":!benches"]].concat();
    // Where rustup has no standard library for a platform, Debian's compiler stands in.
    let programs = ["/usr/bin/rustc", "x86_64-w64-mingw32-gcc", "wine", "qemu-aarch64"];
    let basis = Basis { tracked: &tracked, made: &[], programs: &programs };
    unless_unchanged(
        &unchanged::file("bits_of_every_platform"),
        &basis,
        length == Length::All,
        abroad::bits_of_every_platform,
    )
}

/// What a user would pick instead of us still runs, all of it, where anything has changed of that, or of what asks it. What it takes is
/// measured by `cargo xtask accuracy --peers`.
fn peers(length: Length) -> Result<()> {
    let basis = Basis { tracked: OF_FMUS, made: &[], programs: &[] };
    unless_unchanged(&unchanged::file("peers"), &basis, length == Length::All, || {
        let left_out = accuracy::accuracy("paper", Peers::Tried, Some(&paths::target().join("test/peers")))?;
        ensure!(left_out.is_empty(), "{}", left_out.join(" "));
        Ok(accuracy::peers().map(|name| format!("{name} runs\n")).collect())
    })
}

/// ROSS and the linear view find the same, where anything has changed of what either finds: ours is found anew in any case.
fn against_ross(length: Length) -> Result<()> {
    let basis = Basis { tracked: &["tools", "xtask"], made: &ross::ours()?, programs: &[] };
    unless_unchanged(&unchanged::file("against_ROSS"), &basis, length == Length::All, ross::theirs)
}

/// Names the folder of the FMUs to the tests in Python.
pub const FMUS: &str = "SPLIT_ROTOR_FMUS";

/// A command that runs these tests, as many files at a time as there are processors.
fn pytest(arguments: &[&str]) -> Result<Command> {
    let workers = thread::available_parallelism()?.to_string();
    let mut pytest = python::python_with_all()?;
    pytest.args(python::PYTEST).args(["--dist", "loadfile", "-n", &workers]).args(arguments);
    pytest.env(FMUS, paths::tested_fmus());
    Ok(pytest)
}

#[cfg(test)]
mod tests {
    use super::Length;

    #[test]
    fn a_job_that_is_not_there_is_an_error() {
        for part in ["nosuchjob", "absence is free"] {
            let refused = super::test(part, Length::Short).expect_err("nothing to run").to_string();
            assert!(
                refused.starts_with(&format!("no job's name holds {part:?}: there are\n  Rust's tests\n")),
                "{refused}"
            );
            assert!(refused.contains("and with --long also\n  bits of every platform\n"), "{refused}");
        }
    }
}
