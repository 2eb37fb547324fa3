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
