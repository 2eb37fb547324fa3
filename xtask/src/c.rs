//! C programs: compiled with the machine's own compiler, started with the Debian package named where a tool is missing.

use crate::paths;
use crate::run::run;
use crate::unpacked::Unpacked;
use anyhow::{Context, Result, bail, ensure};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A command, if the program is installed.
pub fn tool(program: &str, package: &str) -> Result<Command> {
    if is_installed(program) {
        return Ok(Command::new(program));
    }
    bail!("`{program}` is needed (Debian: apt-get install {package})");
}

/// Whether a program can be started.
pub fn is_installed(program: &str) -> bool {
    Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
}

/// The machine's own compiler, or the one that `CC` names.
fn compiler() -> Result<Command> {
    tool(&std::env::var("CC").unwrap_or("cc".into()), "gcc")
}

/// Compiles a source of an FMU to a shared library of this name, both in the folder of its headers.
pub fn library(folder: &Path, source: &str, name: &str, flags: &[&str]) -> Result<PathBuf> {
    let always = ["-std=c99", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-DFMI2_OVERRIDE_FUNCTION_PREFIX="];
    // What is relocated is write-protected at once.
    let hardened: &[&str] = if cfg!(target_os = "linux") { &["-Wl,-z,relro,-z,now"] } else { &[] };
    run(compiler()?.current_dir(folder).args(always).args(hardened).args(flags).args([source, "-o", name]))?;
    Ok(folder.join(name))
}

/// Compiles `sources` to target/c/`name`.
pub fn compile(name: &str, sources: &[PathBuf], flags: &[&str]) -> Result<PathBuf> {
    let folder = paths::target().join("c");
    std::fs::create_dir_all(&folder)?;
    let program = folder.join(name);
    run(compiler()?
        // Paths in messages are those of the project, and no path of this machine stays in the program.
        .current_dir(paths::root())
        .args(["-std=c99", "-D_GNU_SOURCE", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror", "-pthread"])
        .args(["-I", "tests/c", "-I", "modelDescription/linear"])
        .args(flags)
        .args(sources)
        .arg("-o")
        .arg(&program)
        .args(["-ldl", "-lm"]))?;
    Ok(program)
}

/// Compiles a program of `benches`, with what reads a sheet and loads the library of an FMU.
pub fn bench(name: &str) -> Result<PathBuf> {
    let own = format!("benches/{name}.c");
    let sources = [&own, "benches/instance.c", "tests/c/library.c", "tests/c/sheet.c"].map(PathBuf::from);
    compile(name, &sources, &[])
}

/// Runs a program on an FMU under callgrind: the instructions within these functions, and what it printed.
pub fn instructions<'f>(
    program: &Path,
    fmu: &Unpacked,
    functions: impl IntoIterator<Item = &'f str>,
    arguments: &[String],
) -> Result<(f64, String)> {
    let mut command = tool("valgrind", "valgrind")?;
    command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]);
    command.args(functions.into_iter().map(|function| format!("--toggle-collect={function}")));
    let run = command.arg(program).arg(&fmu.sheet).arg(&fmu.library).args(arguments).output()?;
    let said = String::from_utf8(run.stderr)?;
    ensure!(run.status.success(), "{}: {said}", fmu.name);
    let sum = said.lines().find_map(|line| line.split("Collected :").nth(1));
    let sum = sum.with_context(|| format!("callgrind tells no sum: {said}"))?;
    Ok((sum.trim().parse()?, String::from_utf8(run.stdout)?))
}

/// The C files in this folder of the project, sorted, relative to the project's own.
pub fn sources(folder: &str) -> Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(paths::root().join(folder))?.collect::<Result<Vec<_>, _>>()?;
    let names = entries.iter().map(|entry| Path::new(folder).join(entry.file_name()));
    let mut files: Vec<_> = names.filter(|path| path.extension().is_some_and(|extension| extension == "c")).collect();
    files.sort();
    Ok(files)
}
