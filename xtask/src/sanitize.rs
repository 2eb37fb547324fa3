//! The FMU and the C host with AddressSanitizer, the host and the linear FMU, which is C, with UndefinedBehaviorSanitizer too, and leaks
//! looked for at the end.

use crate::run::{cargo, run, side_by_side};
use crate::{c_host, library, linear_fmu, paths, scenes, sheet, state_space, unpacked};
use anyhow::{Context, Result, bail};
use split_rotor_model::scene::Scene;
use split_rotor_model::xml;
use split_rotor_tools::platform::Platform;
use std::env::consts::{ARCH, DLL_PREFIX, DLL_SUFFIX};
use std::path::{Path, PathBuf};
use std::process::Command;

/// GCC's runtime serves the library too: a shared library compiled by rustc leaves the sanitizer's symbols open.
const FLAGS: [&str; 3] = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-fno-omit-frame-pointer"];

/// What is tried with sanitizers; a list of effects takes half a minute to build: one that no explicit method can follow, and every effect
/// there is. Fuzzing has a body alone and one with an input, and memcheck runs on an FMU of each library.
const SCENES: [&str; 2] = ["high_spin", "rotor"];

/// Runs the C host on the FMUs of these scenes, both with sanitizers.
pub fn sanitizers() -> Result<()> {
    if !(cfg!(target_os = "linux") && cfg!(target_env = "gnu")) {
        bail!("the sanitizers need Linux with the GNU C library");
    }
    let host = c_host::compile("host-sanitized", &FLAGS).context(
        "the C host cannot be compiled with sanitizers: GCC's are needed (Debian: apt-get install gcc libasan8 libubsan1)",
    )?;
    linear(&host)?;
    let scenes = SCENES.iter().map(|name| scenes::find(name)).collect::<Result<Vec<_>>>()?;
    side_by_side(&library::by_list(&scenes), |worker, scenes| {
        let folder = paths::target().join("sanitized").join(worker.to_string());
        let built = std::fs::read(build(scenes[0], &folder)?)?;
        scenes.iter().try_for_each(|scene| {
            let (library, folder) = (library::filled(built.clone(), scene)?, folder.join("unpacked"));
            let sheet = sheet::sheet(&xml::model_description(scene))?;
            let fmu = unpacked::write(&folder, &scene.name, &sheet, (Platform::here()?, &library))?;
            run(c_host::arguments(&mut strict(&host), &fmu)?.args(["--steps", "200"]))
        })
    })
}

/// A command that runs the host.
fn strict(host: &Path) -> Command {
    let mut command = Command::new(host);
    command
        .env("ASAN_OPTIONS", "detect_leaks=1:detect_stack_use_after_return=1:strict_string_checks=1")
        .env("UBSAN_OPTIONS", "print_stacktrace=1");
    command
}

/// Runs the host on the linear FMU of a scene with inputs, but for what it asks of a rotor and its solver.
fn linear(host: &Path) -> Result<()> {
    let (scene, folder) = (scenes::find("coupled")?, paths::target().join("sanitized/linear"));
    std::fs::create_dir_all(&folder)?;
    let fmu = unpacked::unpack(&linear_fmu::write(&scene, &state_space::of(&scene, None)?, &folder)?)?;
    std::fs::copy(linear_fmu::library(&scene, &FLAGS)?, &fmu.library)?;
    let others =
        ["cycles", "logs", "derivatives", "model_exchange", "threads"].into_iter().flat_map(|part| ["--without", part]);
    run(strict(host).arg(&fmu.sheet).arg(&fmu.library).args(others))
}

/// The library of the scene's list, instrumented, built in this folder. The next list's overwrites it.
fn build(scene: &Scene, folder: &Path) -> Result<PathBuf> {
    let target = format!("{ARCH}-unknown-linux-gnu");
    run(library::of_list(cargo().args(["rustc", "--quiet"]), scene, folder)?
        .args(["--package", "split-rotor", "--release", "--lib", "--crate-type", "cdylib"])
        // With a target named, build scripts and macros are not instrumented.
        .args(["--target", &target])
        .arg("--target-dir")
        .arg(folder)
        .env("CARGO_ENCODED_RUSTFLAGS", ["-Zsanitizer=address", "-Cforce-frame-pointers=yes"].join("\x1f"))
        // The stable compiler has the sanitizer, behind a switch meant for the standard library.
        .env("RUSTC_BOOTSTRAP", "1")
        .env("CARGO_PROFILE_RELEASE_DEBUG", "line-tables-only")
        .env("CARGO_PROFILE_RELEASE_OVERFLOW_CHECKS", "true")
        .env_remove("RUSTFLAGS"))?;
    Ok(folder.join(target).join("release").join(format!("{DLL_PREFIX}split_rotor{DLL_SUFFIX}")))
}
