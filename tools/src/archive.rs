//! An FMU: a zip of its modelDescription.xml, its library, and what describes it to people.

use crate::platform::{AARCH64_LINUX, LINUX64, Libraries};
use crate::{page, terminals};
use anyhow::{Context, Result};
use split_rotor_model::scene::Scene;
use split_rotor_model::xml;
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// Adds a file to an FMU: its path there, and what it holds.
pub type Add<'a> = dyn FnMut(&str, &[u8]) -> Result<()> + 'a;

/// Writes an FMU of what `fill` adds: whole, or it stays as it was before.
pub fn archive(fmu: &Path, fill: impl FnOnce(&mut Add) -> Result<()>) -> Result<()> {
    // Another process may write the same.
    let beside = fmu.with_extension(format!("fmu.{}.part", std::process::id()));
    let written = write_archive(&beside, fill).and_then(|()| Ok(fs::rename(&beside, fmu)?));
    if written.is_err() {
        // Where it cannot be removed either, what went wrong says more.
        let _ = fs::remove_file(&beside);
    }
    written.with_context(|| format!("cannot write {}", fmu.display()))
}

fn write_archive(file: &Path, fill: impl FnOnce(&mut Add) -> Result<()>) -> Result<()> {
    let mut zip = ZipWriter::new(File::create(file)?);
    fill(&mut |path, bytes| {
        // The options carry no time: the same source gives the same bytes.
        zip.start_file(path, SimpleFileOptions::default())?;
        Ok(zip.write_all(bytes)?)
    })?;
    zip.finish()?;
    Ok(())
}

/// What others made of a library.
pub struct Origin {
    /// Their licences, a text.
    pub licences: String,
    /// The bill of materials, CycloneDX in JSON.
    pub bill: String,
}

/// Adds what the FMU of a scene holds, with these libraries and what others made of them.
pub fn fill(scene: &Scene, libraries: &Libraries, origin: &Origin, add: &mut Add) -> Result<()> {
    let licence = licence("The licences of the libraries in its binary stand in third-party.txt.");
    add("modelDescription.xml", xml::model_description(scene).as_bytes())?;
    add("model.png", ICON)?;
    let identifier = scene.identifier();
    for (platform, library) in libraries {
        add(&platform.library_path(&identifier), library)?;
    }
    let of = |wanted| libraries.iter().find(|(platform, _)| *platform == wanted);
    if let (Some((_, library)), None) = (of(AARCH64_LINUX), of(LINUX64)) {
        // fmpy takes any Linux for this one.
        add(&LINUX64.library_path(&identifier), library)?;
    }
    add("documentation/index.html", page::page(scene)?.as_bytes())?;
    add("documentation/licenses/license.txt", licence.as_bytes())?;
    add("documentation/licenses/third-party.txt", origin.licences.as_bytes())?;
    add("documentation/licenses/bill-of-materials.cdx.json", origin.bill.as_bytes())?;
    add("terminalsAndIcons/terminalsAndIcons.xml", terminals::terminals_and_icons(scene)?.as_bytes())?;
    // Where FMI 3.0, which defines that file, looks for the icon.
    add("terminalsAndIcons/icon.png", ICON)
}

/// The picture of an FMU, model.png.
pub const ICON: &[u8] = include_bytes!("../../modelDescription/model.png");

/// Our own licence, for documentation/licenses/license.txt; what it says of `others`, the licences of libraries, is a line.
pub fn licence(others: &str) -> String {
    let [mit, apache] = [include_str!("../../LICENSE-MIT"), include_str!("../../LICENSE-APACHE")];
    format!(
        "split-rotor is licensed under the MIT licence or the Apache licence 2.0, at your choice.\n{others}\n\n{mit}\n\n{apache}"
    )
}

#[cfg(test)]
mod tests {
    use super::{Origin, archive, fill};
    use crate::platform::{AARCH64_LINUX, LINUX64, Platform, WIN64};
    use crate::scenes;
    use std::{env, fs};

    /// Where libraries lie in an FMU for these platforms.
    fn libraries(platforms: &[Platform]) -> Vec<String> {
        let origin = Origin { licences: String::new(), bill: String::new() };
        let libraries: Vec<_> = platforms.iter().map(|platform| (*platform, platform.name.into())).collect();
        let mut found = Vec::new();
        let add = &mut |path: &str, bytes: &[u8]| {
            if path.starts_with("binaries") {
                found.push(format!("{path}: {}", String::from_utf8_lossy(bytes)));
            }
            Ok(())
        };
        fill(&scenes::find("paper"), &libraries, &origin, add).unwrap();
        found
    }

    #[test]
    fn the_library_for_arm_stands_where_fmpy_looks_unless_another_does() {
        let (arm, windows) = ("binaries/aarch64-linux/paper.so: aarch64-linux", "binaries/win64/paper.dll: win64");
        let there = "binaries/linux64/paper.so: aarch64-linux";
        assert_eq!(libraries(&[WIN64, AARCH64_LINUX]), [windows, arm, there]);
        assert_eq!(libraries(&[LINUX64, AARCH64_LINUX]), ["binaries/linux64/paper.so: linux64", arm]);
    }

    #[test]
    fn a_package_that_fails_leaves_what_was_there() {
        let folder = env::temp_dir().join(format!("refused-package-{}", std::process::id()));
        // A file cannot take the place of a folder that holds something.
        let fmu = folder.join("paper.fmu");
        fs::create_dir_all(&fmu).unwrap();
        fs::write(fmu.join("file"), "as it was").unwrap();
        let scene = scenes::find("paper");
        let origin = Origin { licences: String::new(), bill: String::new() };
        archive(&fmu, |add| fill(&scene, &[(LINUX64, b"library".to_vec())], &origin, add))
            .expect_err("a folder is there");
        assert_eq!(fs::read_to_string(fmu.join("file")).unwrap(), "as it was");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }
}
