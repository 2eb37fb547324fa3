//! A packaged FMU, taken apart as a simulator does it: what is tested and measured is what travels.

use crate::{paths, sheet};
use anyhow::{Context, Result};
use split_rotor_tools::platform::Platform;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use zip::ZipArchive;

/// What a C host is started with.
pub struct Unpacked {
    /// The name of the FMU's file.
    pub name: String,
    /// The library.
    pub library: PathBuf,
    /// What it must know of the modelDescription.xml.
    pub sheet: PathBuf,
    /// Keeps the files as long as this lives, where they are of this run only.
    _folder: Option<Folder>,
}

/// A folder of one run, which goes with it.
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        // Where a loaded library cannot be removed, it stays.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Takes an FMU apart, into a folder of its own in target/unpacked: another run meanwhile keeps its library.
pub fn unpack(fmu: &Path) -> Result<Unpacked> {
    unpack_for(fmu, Platform::here()?)
}

/// The same with the library of this platform.
pub fn unpack_for(fmu: &Path, platform: Platform) -> Result<Unpacked> {
    let name = fmu.file_stem().context("an FMU has a name")?.to_string_lossy().into_owned();
    let file = File::open(fmu).with_context(|| {
        format!(
            "{} is not there: `cargo xtask package`, or for the tests `cargo xtask test packaged --long`, makes it",
            fmu.display()
        )
    })?;
    let mut zip = ZipArchive::new(file)?;
    let mut read = |path: &str| -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        zip.by_name(path).with_context(|| path.to_owned())?.read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    let xml = String::from_utf8(read("modelDescription.xml")?)?;
    let sheet = sheet::sheet(&xml)?;
    let identifier = sheet.lines().find_map(|line| line.strip_prefix("attribute CoSimulation.modelIdentifier "));
    let library = platform.library_path(identifier.context("the XML has no model identifier")?);
    let library = read(&library)?;
    let folder = paths::target().join("unpacked").join(format!("{name}-{}-{}", platform.name, std::process::id()));
    let unpacked = write(&folder, &name, &sheet, (platform, &library));
    let unpacked = unpacked.with_context(|| format!("cannot take {} apart", fmu.display()))?;
    Ok(Unpacked { _folder: Some(Folder(folder)), ..unpacked })
}

/// Writes what a C host needs of this FMU into `folder`.
pub fn write(folder: &Path, name: &str, sheet: &str, (platform, library): (Platform, &[u8])) -> Result<Unpacked> {
    std::fs::create_dir_all(folder)?;
    let unpacked = Unpacked {
        name: name.into(),
        library: folder.join(format!("{name}{}", platform.suffix)),
        sheet: folder.join(format!("{name}.txt")),
        _folder: None,
    };
    std::fs::write(&unpacked.sheet, sheet)?;
    std::fs::write(&unpacked.library, library)?;
    Ok(unpacked)
}
