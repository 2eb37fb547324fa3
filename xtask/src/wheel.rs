//! `wheel`: the Python package, built for every Linux of x86-64 that Python's wheels know, and tried in a new environment without Rust.

use crate::platforms::Toolchain;
use crate::progress::Progress;
use crate::run::run;
use crate::test::FMUS;
use crate::{library, licences, package, paths, python, scenes};
use anyhow::{Context, Result, ensure};
use split_rotor_model::scene::Scene;
use split_rotor_tools::archive;
use split_rotor_tools::general::GENERAL;
use split_rotor_tools::platform::LINUX64;
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

/// What the wheel runs on, with glibc 2.17 and later (manylinux2014).
const TARGET: &str = "x86_64-unknown-linux-gnu";

/// Their FMUs, each with a library of its own list, are compared with what the package makes of the same scenes.
const COMPARED: [&str; 3] = ["paper", "rubbing", "run_up"];

/// Builds the wheel into target/wheel and tries it; its path.
pub fn wheel() -> Result<PathBuf> {
    ensure!(cfg!(all(target_os = "linux", target_arch = "x86_64")), "the wheel is built on Linux, x86-64");
    let fmus = paths::target().join("test/wheel");
    package::package(&COMPARED.map(str::to_owned), Some(&fmus))?;
    let wheel = build()?;
    let mut python = python::of_wheel(&wheel)?;
    // Pytest's folder is no part of the package's path: what is imported is what was installed.
    run(python.args(python::PYTEST).arg("python/tests").env(FMUS, fmus).env("PATH", without_rust()?))?;
    println!("{}", wheel.display());
    Ok(wheel)
}

/// Builds the wheel.
fn build() -> Result<PathBuf> {
    let (folder, root) = (paths::target().join("wheel"), paths::root());
    let package = root.join("python/split_rotor");
    // An extension that somebody built there would travel along.
    let _ = fs::remove_file(package.join("_core.abi3.so"));
    fill(&package.join("data"))?;
    let _ = fs::remove_dir_all(&folder);
    let mut maturin = python::wheel_builder("maturin")?;
    maturin.args(["build", "--zig", "--target", TARGET, "--compatibility", "manylinux2014", "--profile", "fmu"]);
    maturin.args(["--manifest-path", "python/Cargo.toml", "--locked", "--quiet", "--out"]).arg(&folder);
    run(maturin.env("CARGO_ENCODED_RUSTFLAGS", library::flags(root)?).env_remove("RUSTFLAGS"))?;
    let made = fs::read_dir(&folder)?.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>>>()?;
    made.into_iter().next().context("maturin made no wheel")
}

/// Puts together what travels with the package: the scenes, the library of every effect, and the licences of both binaries.
fn fill(data: &Path) -> Result<()> {
    let _ = fs::remove_dir_all(data);
    fs::create_dir_all(data.join("scenes"))?;
    for name in Scene::names(&paths::scenes()) {
        let file = format!("{name}.toml");
        fs::copy(paths::scenes().join(&file), data.join("scenes").join(&file))?;
    }
    let toolchains = Toolchain::named(&[LINUX64.name])?;
    let library = library::of(&scenes::find(GENERAL)?, &toolchains[0], &Progress::of(1))?.library;
    fs::write(data.join(format!("{DLL_PREFIX}split_rotor{DLL_SUFFIX}")), library)?;
    let origin = licences::of("split-rotor", &toolchains)?;
    fs::write(data.join("third-party.txt"), origin.licences)?;
    fs::write(data.join("bill-of-materials.cdx.json"), origin.bill)?;
    let own = archive::licence("The licences of the libraries in its binary follow.");
    fs::write(data.join("license.txt"), own + "\n" + &licences::of("split-rotor-python", &toolchains)?.licences)?;
    Ok(())
}

/// Where programs are found, without the folders that hold a compiler of Rust.
fn without_rust() -> Result<OsString> {
    let has_rust = |folder: &PathBuf| ["cargo", "rustc", "rustup"].iter().any(|name| folder.join(name).exists());
    let path = std::env::var_os("PATH").unwrap_or_default();
    Ok(std::env::join_paths(std::env::split_paths(&path).filter(|folder| !has_rust(folder)))?)
}
