//! `package`: each scene as an FMU, with the library of its effects.

use crate::debug;
use crate::library::{self, Kept};
use crate::platforms::{HERE, Toolchain};
use crate::progress::Progress;
use crate::run::side_by_side;
use crate::{licences, paths, scenes};
use anyhow::{Context, Result, bail};
use split_rotor_model::scene::Scene;
use split_rotor_tools::archive::{archive, fill};
use split_rotor_tools::general::{self, GENERAL};
use std::fs;
use std::path::{Path, PathBuf};

/// Packages these scenes for this machine, into target/fmu where `out` is not given; the paths of the FMUs.
pub fn package(names: &[String], out: Option<&Path>) -> Result<Vec<PathBuf>> {
    package_for(names, &[HERE], out)
}

/// Packages them for these platforms, or for all at hand where none is named.
pub fn package_for(names: &[String], platforms: &[&str], out: Option<&Path>) -> Result<Vec<PathBuf>> {
    // All scenes are read first: a slip in the last should not cost the time of building the others.
    let scenes = names.iter().map(|name| scenes::find_warned(name)).collect::<Result<Vec<_>>>()?;
    if let Some((first, second)) = same_name(&scenes) {
        bail!("{} and {} would both become {}.fmu", first.file.display(), second.file.display(), first.name);
    }
    let toolchains = &Toolchain::named(platforms)?;
    let out = out.map_or_else(paths::fmus, Path::to_owned);
    fs::create_dir_all(&out).with_context(|| format!("cannot make the folder {}", out.display()))?;
    let origin = licences::of("split-rotor", toolchains)?;
    let lists = library::by_list(&scenes);
    let libraries = lists.iter().flat_map(|scenes| toolchains.iter().map(move |toolchain| (scenes[0], toolchain)));
    let libraries: Vec<_> = libraries.collect();
    let progress = Progress::of(libraries.len());
    progress.set_message("packaging");
    // A library is compiled and linked by one thread.
    side_by_side(&libraries, |_, (scene, toolchain)| {
        library::of(scene, toolchain, &progress)?;
        progress.inc(1);
        Ok(())
    })?;
    let fmu = |scene: &Scene| paths::fmu_in(&out, &scene.name);
    for scenes in lists {
        let kept = |toolchain| library::of(scenes[0], toolchain, &progress);
        let kept = toolchains.iter().map(|toolchain| Ok((toolchain, kept(toolchain)?)));
        let kept = kept.collect::<Result<Vec<_>>>()?;
        for scene in scenes {
            let filled = |kept: &Kept| library::signed(library::filled(kept.library.clone(), scene)?);
            let libraries = kept.iter().map(|(toolchain, kept)| Ok((toolchain.platform, filled(kept)?)));
            let (libraries, fmu) = (libraries.collect::<Result<Vec<_>>>()?, fmu(scene));
            archive(&fmu, |add| fill(scene, &libraries, &origin, add))?;
            let folder = fmu.with_extension("debug");
            // What an earlier build left would be that of another library.
            let _ = fs::remove_dir_all(&folder);
            for (toolchain, kept) in &kept {
                debug::publish(kept, toolchain, &folder)?;
            }
            progress.suspend(|| {
                for (platform, library) in &libraries {
                    eprintln!("  {} {} kB", platform.name, library.len() / 1000);
                }
                println!("{}", fmu.display());
            });
        }
    }
    drop(progress);
    Ok(scenes.iter().map(fmu).collect())
}

/// Makes the FMUs of these scenes for this machine, into `out`, over the library of every effect: none is compiled for them.
pub fn over_general(names: &[String], out: &Path) -> Result<Vec<PathBuf>> {
    let (general, own) = (scenes::find(GENERAL)?, Toolchain::own()?);
    let library = library::of(&general, &own, &Progress::of(1))?.library;
    let origin = licences::of("split-rotor", std::slice::from_ref(&own))?;
    let write = |name: &String| {
        let fmu = paths::fmu_in(out, name);
        let (scene, library) = general::over(&general, library.clone(), scenes::find(name)?)?;
        archive(&fmu, |add| fill(&scene, &[(own.platform, library)], &origin, add))?;
        println!("{}, over the library of every effect", fmu.display());
        Ok(fmu)
    };
    names.iter().map(write).collect()
}

fn same_name(scenes: &[Scene]) -> Option<(&Scene, &Scene)> {
    let pairs =
        scenes.iter().enumerate().flat_map(|(i, first)| scenes[i + 1..].iter().map(move |second| (first, second)));
    pairs.into_iter().find(|(first, second)| first.name == second.name && first.file != second.file)
}
