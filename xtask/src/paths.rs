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

/// A scene's FMU as it was packaged last.
pub fn fmu(scene: &str) -> PathBuf {
    target().join("fmu").join(format!("{scene}.fmu"))
}
