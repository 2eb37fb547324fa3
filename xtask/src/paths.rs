//! Where things are.

use std::path::{Path, PathBuf};

/// The project's folder.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask is a folder of the project")
}

/// The scenes that come with the project.
pub fn scenes() -> PathBuf {
    root().join("scenes")
}

/// Where everything goes that is made.
pub fn target() -> PathBuf {
    root().join("target")
}

/// Where FMUs are packaged.
pub fn fmus() -> PathBuf {
    target().join("fmu")
}

/// Where the tests have theirs, some over the library of every effect.
pub fn tested_fmus() -> PathBuf {
    target().join("test/fmu")
}

/// A scene's FMU in a folder.
pub fn fmu_in(folder: &Path, scene: &str) -> PathBuf {
    folder.join(format!("{scene}.fmu"))
}
