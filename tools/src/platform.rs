//! The platforms that a library is made for, and where it lies in an FMU.

use anyhow::{Result, bail};
use std::env::consts::{ARCH, OS};

/// A platform: its folder in an FMU, and how the name of a library ends there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Platform {
    /// The name by FMI 2.0, or for what that does not name, one in its manner.
    pub name: &'static str,
    /// With the dot.
    pub suffix: &'static str,
}

/// Linux on x86-64.
pub const LINUX64: Platform = Platform { name: "linux64", suffix: ".so" };
/// Windows on x86-64.
pub const WIN64: Platform = Platform { name: "win64", suffix: ".dll" };
/// Linux on 64-bit Arm, for which FMI 2.0 has no name.
pub const AARCH64_LINUX: Platform = Platform { name: "aarch64-linux", suffix: ".so" };
/// macOS, on either of its processors.
pub const DARWIN64: Platform = Platform { name: "darwin64", suffix: ".dylib" };

impl Platform {
    /// That of this machine.
    ///
    /// # Errors
    ///
    /// No FMU is made for it.
    pub fn here() -> Result<Self> {
        Ok(match (OS, ARCH) {
            ("linux", "x86_64") => LINUX64,
            ("linux", "aarch64") => AARCH64_LINUX,
            ("macos", _) => DARWIN64,
            ("windows", "x86_64") => WIN64,
            _ => bail!("no FMU is made for the platform {OS} on {ARCH}"),
        })
    }

    /// Where its library lies in an FMU with this model identifier.
    pub fn library_path(self, identifier: &str) -> String {
        format!("binaries/{}/{identifier}{}", self.name, self.suffix)
    }
}

/// Libraries, and which platform each is for.
pub type Libraries = [(Platform, Vec<u8>)];
