//! The debug information of a library, apart from it: it names functions and lines to whoever built the library, and does not travel.

use crate::library::Kept;
use crate::platforms::{Toolchain, default_rustc};
use crate::run::{output, run};
use anyhow::{Context, Result};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// With these the compiler leaves it in the library. As settings of the profile they would change the symbols, by which functions are
/// ordered: so the machine code is the same with them and without.
pub const WITHIN: [&str; 2] = ["-Cdebuginfo=line-tables-only", "-Cstrip=none"];

/// LLVM's objcopy, which reads the libraries of all platforms.
pub struct Objcopy {
    program: PathBuf,
    /// Where its own libraries are.
    libraries: PathBuf,
    /// The library names the file of its debug information and a checksum, where that does not make it another in each build.
    links: bool,
}

impl Objcopy {
    /// That of the compiler, or one that is installed. None where neither is there, or where the linker leaves debug information
    /// outside of the library (macOS, Microsoft's).
    pub fn of(toolchain: &Toolchain) -> Option<Self> {
        if !toolchain.has_debug_within() {
            return None;
        }
        let print = |what| output(Command::new(default_rustc()).args(["--print", what])).ok();
        let (sysroot, host) = (print("sysroot")?, print("host-tuple")?);
        let libraries = Path::new(sysroot.trim()).join("lib");
        let own = libraries.join("rustlib").join(host.trim()).join("bin/rust-objcopy");
        let program = if own.is_file() { own } else { "llvm-objcopy".into() };
        let objcopy = Self { program, libraries, links: toolchain.has_same_debug() };
        objcopy.command().arg("--version").output().is_ok_and(|said| said.status.success()).then_some(objcopy)
    }

    fn command(&self) -> Command {
        let mut command = Command::new(&self.program);
        command.env("LD_LIBRARY_PATH", &self.libraries);
        command
    }

    /// The library without what debuggers alone need. The file [`beside`] it has that: it is the library as it was linked, since what is
    /// left of one for Windows with `--only-keep-debug` MinGW's tools cannot read.
    pub fn split(&self, library: &Path) -> Result<Vec<u8>> {
        let (debug, stripped) = (beside(library), library.with_extension("stripped"));
        fs::copy(library, &debug)?;
        let link = self.links.then(|| format!("--add-gnu-debuglink={}", debug.display()));
        run(self.command().arg("--strip-all").args(link).args([library, &stripped]))?;
        Ok(fs::read(stripped)?)
    }
}

/// The file of a library's debug information.
pub fn beside(library: &Path) -> PathBuf {
    let mut name = OsString::from(library);
    name.push(".debug");
    name.into()
}

/// Puts the debug information of a library where debuggers look for it in `folder`: by the library's build id, and in a folder of
/// the platform by the name that the library holds.
pub fn publish(kept: &Kept, toolchain: &Toolchain, folder: &Path) -> Result<()> {
    let Some(debug) = &kept.debug else { return Ok(()) };
    let by_name = beside(&toolchain.built(folder));
    let by_name = by_name.file_name().context("a library has a name")?;
    let mut files = vec![Path::new(toolchain.platform.name).join(by_name)];
    files.extend(build_id(&kept.library).map(|id| format!(".build-id/{}/{}.debug", &id[..2], &id[2..]).into()));
    for file in files.iter().map(|file| folder.join(file)) {
        fs::create_dir_all(file.parent().context("a file lies in a folder")?)?;
        // One file by several names, where these are on one disk.
        fs::hard_link(debug, &file).or_else(|_| fs::copy(debug, &file).map(drop))?;
    }
    Ok(())
}

/// What a linker for Linux wrote into a library to tell it from all others, in hexadecimal digits.
fn build_id(library: &[u8]) -> Option<String> {
    // The type of the note, and whose it is; before these, how long its name and it are.
    let mark = b"\x03\0\0\0GNU\0";
    let begin = library.windows(mark.len()).position(|bytes| bytes == mark)?;
    let length = u32::from_le_bytes(library[..begin].last_chunk().copied()?);
    let id = library[begin + mark.len()..].get(..length as usize)?;
    Some(id.iter().map(|byte| format!("{byte:02x}")).collect())
}

#[cfg(test)]
mod tests {
    use super::build_id;

    #[test]
    fn exact_a_build_id_is_what_its_note_holds() {
        let note = b"\x7fELF\x04\0\0\0\x03\0\0\0\x03\0\0\0GNU\0\x2b\xef\x0aand so on";
        assert_eq!(build_id(note).as_deref(), Some("2bef0a"));
        assert_eq!(build_id(&note[..note.len() - 11]), None);
        assert_eq!(build_id(b"MZ"), None);
    }
}
