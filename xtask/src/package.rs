//! `package`: each scene as an FMU, a zip of its modelDescription.xml, the library of its effects with its values, and what describes it
//! to people.

use crate::progress::Progress;
use crate::run::side_by_side;
use crate::{library, licences, page, paths, scenes, terminals};
use anyhow::{Context, Result, bail};
use split_rotor_model::scene::Scene;
use split_rotor_model::xml;
use std::env::consts::{ARCH, DLL_SUFFIX, OS};
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// Packages these scenes, into target/fmu where `out` is not given; the paths of the FMUs.
pub fn package(names: &[String], out: Option<&Path>) -> Result<Vec<PathBuf>> {
    // All scenes are read first: a slip in the last should not cost the time of building the others.
    let scenes = names.iter().map(|name| scenes::find(name)).collect::<Result<Vec<_>>>()?;
    if let Some((first, second)) = same_name(&scenes) {
        bail!("{} and {} would both become {}.fmu", first.file.display(), second.file.display(), first.name);
    }
    let out = out.map_or_else(|| paths::target().join("fmu"), Path::to_owned);
    fs::create_dir_all(&out).with_context(|| format!("cannot make the folder {}", out.display()))?;
    let licences = licences::third_party()?;
    let progress = Progress::of(scenes.len());
    let fmu = |scene: &Scene| out.join(format!("{}.fmu", scene.name));
    // A library is compiled and linked by one thread.
    side_by_side(&library::by_list(&scenes), |builder, scenes| {
        let library = library::of(scenes[0], builder, &progress)?;
        scenes.iter().try_for_each(|scene| {
            let library = library::signed(library::filled(library.clone(), scene)?)?;
            let fmu = fmu(scene);
            archive(&fmu, |add| fill(scene, &library, &licences, add))?;
            progress.inc(1);
            progress.suspend(|| println!("{}", fmu.display()));
            Ok(())
        })
    })?;
    drop(progress);
    Ok(scenes.iter().map(fmu).collect())
}

fn same_name(scenes: &[Scene]) -> Option<(&Scene, &Scene)> {
    let pairs =
        scenes.iter().enumerate().flat_map(|(i, first)| scenes[i + 1..].iter().map(move |second| (first, second)));
    pairs.into_iter().find(|(first, second)| first.name == second.name && first.file != second.file)
}

/// Adds a file to an FMU: its path there, and what it holds.
pub type Add<'a> = dyn FnMut(&str, &[u8]) -> Result<()> + 'a;

/// Writes an FMU of what `fill` adds: whole, or it stays as it was before.
pub fn archive(fmu: &Path, fill: impl FnOnce(&mut Add) -> Result<()>) -> Result<()> {
    let beside = fmu.with_extension("fmu.part");
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

/// Adds what the FMU of a scene holds, with this library and the licences of what is in it.
fn fill(scene: &Scene, library: &[u8], third_party: &str, add: &mut Add) -> Result<()> {
    let licence = licences::own("The licences of the libraries in its binary stand in third-party.txt.")?;
    add("modelDescription.xml", xml::model_description(scene).as_bytes())?;
    let icon = icon()?;
    add("model.png", &icon)?;
    add(&library_path(&scene.identifier())?, library)?;
    add("documentation/index.html", page::page(scene)?.as_bytes())?;
    add("documentation/licenses/license.txt", licence.as_bytes())?;
    add("documentation/licenses/third-party.txt", third_party.as_bytes())?;
    add("terminalsAndIcons/terminalsAndIcons.xml", terminals::terminals_and_icons(scene)?.as_bytes())?;
    // Where FMI 3.0, which defines that file, looks for the icon.
    add("terminalsAndIcons/icon.png", &icon)
}

/// The picture of an FMU, model.png.
pub fn icon() -> Result<Vec<u8>> {
    Ok(fs::read(paths::root().join("modelDescription/model.png"))?)
}

/// Where the library of this machine's platform lies in an FMU.
pub fn library_path(identifier: &str) -> Result<String> {
    Ok(format!("binaries/{}/{identifier}{DLL_SUFFIX}", platform()?))
}

/// FMI 2.0's name of this machine's platform.
fn platform() -> Result<&'static str> {
    match (OS, ARCH) {
        ("linux", "x86_64") => Ok("linux64"),
        ("macos", _) => Ok("darwin64"),
        ("windows", "x86_64") => Ok("win64"),
        _ => bail!("FMI 2.0 has no name for the platform {OS} on {ARCH}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{archive, fill, paths, scenes};
    use std::fs;

    #[test]
    fn a_package_that_fails_leaves_what_was_there() {
        let folder = paths::target().join("tests/refused-package");
        // A file cannot take the place of a folder that holds something.
        let fmu = folder.join("paper.fmu");
        fs::create_dir_all(&fmu).unwrap();
        fs::write(fmu.join("file"), "as it was").unwrap();
        let scene = scenes::find("paper").unwrap();
        archive(&fmu, |add| fill(&scene, b"library", "licences", add)).expect_err("a folder is there");
        assert_eq!(fs::read_to_string(fmu.join("file")).unwrap(), "as it was");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
    }
}
