//! `test`: everything that must hold, as a list of jobs.

use crate::run::{cargo, run};
use crate::{accuracy, bench, c_host, fuzz, memcheck, package, paths, python, sanitize};
use anyhow::{Result, bail};
use model::scene::Scene;

/// Runs what its name says; where it cannot, that is an error, which names what is to be installed.
type Job = fn() -> Result<()>;

/// What always runs, the quickest first.
const SHORT: [Job; 4] = [rust_tests, driven_tests, other_builds, packaged_fmus];

/// What takes long, or needs more than the README asks for.
const LONG: [Job; 7] =
    [clients, wide_builds, peers, sanitize::sanitizers, memcheck::valgrind, bench::must_hold, fuzz::fuzz];

/// Runs the short jobs, and the long ones too where they are asked for.
pub fn test(long: bool) -> Result<()> {
    SHORT.iter().chain(LONG.iter().filter(|_| long)).try_for_each(|job| job())
}

fn rust_tests() -> Result<()> {
    run(cargo().args(["test", "--quiet", "--workspace"]))
}

/// The call rules once more with a scene that has an input.
fn driven_tests() -> Result<()> {
    // A target directory of its own, or both scenes would be built anew each time.
    let tests = ["abi", "arguments", "inputs", "many", "random_calls", "serialized", "state"]
        .into_iter()
        .flat_map(|name| ["--test", name]);
    run(cargo()
        .args(["test", "--quiet"])
        .args(tests)
        .arg("--target-dir")
        .arg(paths::target().join("driven"))
        .env("SPLIT_ROTOR_SCENE", paths::scenes().join("driven.toml")))
}

/// The bits are the same in every build.
fn other_builds() -> Result<()> {
    let profiles = ["unoptimised", "release"];
    profiles
        .iter()
        .try_for_each(|profile| run(cargo().args(["test", "--quiet", "--test", "bits", "--profile", profile])))
}

/// The bits are the same with wide vectors and fused arithmetic at the compiler's disposal, as far as this machine has them.
fn wide_builds() -> Result<()> {
    let mut flags = vec!["-Ctarget-cpu=native"];
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            flags.push("-Ctarget-feature=+avx2,+fma");
        }
        if is_x86_feature_detected!("avx512bw") && is_x86_feature_detected!("avx512vl") {
            flags.push("-Ctarget-cpu=x86-64-v4");
        }
    }
    flags.into_iter().try_for_each(|flags| {
        println!("bits with {flags}");
        let bits = ["test", "--quiet", "--test", "bits", "--release", "--target-dir"];
        run(cargo().args(bits).arg(paths::target().join("wide")).env("RUSTFLAGS", flags))
    })
}

/// The packaged FMUs under a host in C and under fmpy.
fn packaged_fmus() -> Result<()> {
    c_host::plain(&package::package(&Scene::names(&paths::scenes()), None)?)?;
    pytest(&["tests/fmu", "tests/clients"])
}

/// The packaged FMUs under third-party clients, and pytest's other long tests.
fn clients() -> Result<()> {
    python::clients()?;
    pytest(&["--long", "-m", "long", "tests/fmu", "tests/clients"])
}

/// What a user would pick instead of us still runs, all of it.
fn peers() -> Result<()> {
    let left_out = accuracy::accuracy("paper", true)?;
    if !left_out.is_empty() {
        bail!("{}", left_out.join(" "));
    }
    Ok(())
}

fn pytest(arguments: &[&str]) -> Result<()> {
    run(python::python()?.args(["-m", "pytest", "-q", "-p", "no:cacheprovider"]).args(arguments))
}
