//! `test`: everything that must hold.

use crate::run::{cargo, run};
use crate::{c_host, package, paths, python};
use anyhow::Result;
use model::scene::Scene;

/// Runs the Rust tests, the bit tests in the other builds, and the tests of the packaged FMUs.
pub fn test() -> Result<()> {
    run(cargo().args(["test", "--quiet", "--workspace"]))?;
    for profile in ["unoptimised", "release"] {
        run(cargo().args(["test", "--quiet", "--test", "bits", "--profile", profile]))?;
    }
    let fmus = package::package(&Scene::names(&paths::scenes()), None)?;
    c_host::plain(&fmus)?;
    run(python::python()?.args(["-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/fmu"]))
}
