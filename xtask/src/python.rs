//! The Python environments: folders in target/, made from pinned and hashed requirements.

use crate::paths;
use crate::progress::stage;
use crate::run::{output, run};
use anyhow::{Context, Result, bail};
use std::fs;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::process::Command;

/// An environment, before it is made.
struct Environment<'a> {
    /// Its folder in target/.
    folder: &'a str,
    /// Its requirements, from the project's folder, each a list of its own: what comes later is added to what is there.
    requirements: &'a [&'a str],
    /// The versions of Python 3 for which they were resolved.
    minors: RangeInclusive<u32>,
}

/// fmpy and what makes the report.
const MAIN: Environment<'static> =
    Environment { folder: "venv", requirements: &["xtask/python/requirements.txt"], minors: 10..=u32::MAX };

/// The same, and what draws the other pictures and runs the tests.
const ALL: Environment<'static> =
    Environment { requirements: &["xtask/python/requirements.txt", "xtask/python/requirements-all.txt"], ..MAIN };

/// The other simulators. They do not fit beside fmpy of today: CoFMPy holds on to an old one.
const CLIENTS: Environment<'static> =
    Environment { folder: "venv-clients", requirements: &["xtask/python/requirements-clients.txt"], minors: 11..=14 };

/// What builds the Python package.
const BUILDER: Environment<'static> =
    Environment { folder: "venv-wheel", requirements: &["xtask/python/requirements-wheel.txt"], minors: 10..=u32::MAX };

/// What the tests of the Python package need beside it.
const USER: Environment<'static> =
    Environment { folder: "venv-user", requirements: &["python/tests/requirements.txt"], minors: 10..=u32::MAX };

/// mdBook, and what makes MathML of equations.
const BOOK: Environment<'static> =
    Environment { folder: "venv-book", requirements: &["xtask/python/requirements-book.txt"], minors: 11..=u32::MAX };

/// How pytest runs our tests; what those that pass have written is removed, since packed FMUs would fill the disk.
pub const PYTEST: [&str; 7] =
    ["-m", "pytest", "-q", "-p", "no:cacheprovider", "-o", "tmp_path_retention_policy=failed"];

/// A command of the Python that has fmpy; its environment is made first where it is missing or out of date.
pub fn python() -> Result<Command> {
    MAIN.python()
}

/// The same, with matplotlib and pytest.
pub fn python_with_all() -> Result<Command> {
    ALL.python()
}

/// A program that builds the Python package, where it finds the others.
pub fn wheel_builder(program: &str) -> Result<Command> {
    let python = PathBuf::from(BUILDER.python()?.get_program());
    let programs = python.parent().context("a Python lies in a folder")?;
    let path = std::env::var_os("PATH").unwrap_or_default();
    let mut command = command(programs.join(program));
    command.env("PATH", std::env::join_paths([programs.into()].into_iter().chain(std::env::split_paths(&path)))?);
    Ok(command)
}

/// Zig as a compiler of C for a target.
pub fn zig_cc(target: &str) -> Result<Command> {
    let mut zig = BUILDER.python()?;
    zig.args(["-m", "ziglang", "cc", "-target", target]);
    Ok(zig)
}

/// The version of zig.
pub fn zig_version() -> Result<String> {
    Ok(output(BUILDER.python()?.args(["-m", "ziglang", "version"]))?.trim().to_owned())
}

/// Whether its programs are here already.
pub fn has_wheel_builder() -> bool {
    BUILDER.folder().join("installed-0.txt").is_file()
}

/// The Python of a new environment with this wheel.
pub fn of_wheel(wheel: &Path) -> Result<Command> {
    let _ = fs::remove_dir_all(USER.folder());
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--no-index"];
    run(USER.python()?.args(install).arg(wheel))?;
    USER.python()
}

/// Makes the environment that has the other simulators, where it is missing or out of date.
pub fn clients() -> Result<()> {
    let load = "import ecospy, libcosimpy.CosimExecution";
    run(CLIENTS.python()?.args(["-c", load])).context(
        "the clients cannot be loaded; ecospy needs the library libtbb.so.12 (Debian: apt-get install libtbb12)",
    )
}

/// A command of the Python that makes the site of the documents.
pub fn book() -> Result<Command> {
    BOOK.python()
}

/// A command that runs this module of xtask/python/peers; each has a Python of its own, so that one that cannot be installed
/// keeps no other from it.
pub fn peer(name: &str) -> Result<Command> {
    let mut command = python_of_peer(name)?;
    command.current_dir(paths::root().join("xtask/python")).args(["-m", &format!("peers.{name}")]);
    // Threads of their linear algebra would count as time of a run.
    command.env("OMP_NUM_THREADS", "1").env("OPENBLAS_NUM_THREADS", "1");
    Ok(command)
}

/// A command of the Python that has SciPy: the peer's, which is there already where somebody compared with that.
pub fn scipy() -> Result<Command> {
    python_of_peer("scipy")
}

fn python_of_peer(name: &str) -> Result<Command> {
    let (folder, requirements) = (format!("venv-peers/{name}"), format!("xtask/python/peers/requirements/{name}.txt"));
    Environment { folder: &folder, requirements: &[&requirements], minors: 11..=14 }.python()
}

/// Of pip; the lists are whole, but for what fmpy does not need here (cmake, 30 MB).
const INSTALL: [&str; 7] =
    ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--require-hashes"];

impl Environment<'_> {
    fn folder(&self) -> PathBuf {
        paths::target().join(self.folder)
    }

    /// Its Python; it is made first where it is missing or out of date.
    fn python(&self) -> Result<Command> {
        let folder = self.folder();
        let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
        for (number, name) in self.requirements.iter().enumerate() {
            let requirements = paths::root().join(name);
            let wanted = fs::read_to_string(&requirements)?;
            // What was installed; it is written last, so an environment that was cut short is made anew.
            let stamp = folder.join(format!("installed-{number}.txt"));
            if fs::read_to_string(&stamp).is_ok_and(|installed| installed == wanted) && python.is_file() {
                continue;
            }
            stage(&format!("making the Python environment {}, {name}", folder.display()), || {
                if number == 0 {
                    run(Command::new(self.system_python()?).args(["-m", "venv", "--clear"]).arg(&folder))
                        .with_context(|| self.needed())?;
                }
                run(command(python.clone()).args(INSTALL).arg("--requirement").arg(&requirements))
            })?;
            fs::write(stamp, wanted)?;
        }
        Ok(command(python))
    }

    /// The machine's own Python, if its version is right.
    fn system_python(&self) -> Result<&'static str> {
        let (oldest, newest) = (self.minors.start(), self.minors.end());
        let right = format!("import sys, venv; sys.exit(not {oldest} <= sys.version_info.minor <= {newest})");
        for name in ["python3", "python"] {
            if Command::new(name).args(["-c", &right]).output().is_ok_and(|output| output.status.success()) {
                return Ok(name);
            }
        }
        bail!("{}: neither `python3` nor `python` is", self.needed());
    }

    fn needed(&self) -> String {
        let (oldest, newest) = (self.minors.start(), self.minors.end());
        let versions = if *newest == u32::MAX { format!(">= 3.{oldest}") } else { format!("3.{oldest} to 3.{newest}") };
        format!("Python {versions} with the module venv is needed (Debian: apt-get install python3-venv)")
    }
}

fn command(python: PathBuf) -> Command {
    let mut command = Command::new(python);
    command.current_dir(paths::root()).env("PYTHONDONTWRITEBYTECODE", "1").env_remove("PYTHONPATH");
    command
}
