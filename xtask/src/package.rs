//! `package`: each scene as an FMU, with the library of its effects.

use crate::progress::Progress;
use crate::run::side_by_side;
use crate::{library, licences, paths, scenes};
use anyhow::{Context, Result, bail};
use split_rotor_model::scene::Scene;
use split_rotor_tools::archive::{archive, fill};
use std::fs;
use std::path::{Path, PathBuf};

/// Packages these scenes, into target/fmu where `out` is not given; the paths of the FMUs.
pub fn package(names: &[String], out: Option<&Path>) -> Result<Vec<PathBuf>> {
    // All scenes are read first: a slip in the last should not cost the time of building the others.
    let scenes = names.iter().map(|name| scenes::find(name)).collect::<Result<Vec<_>>>()?;
    if let Some((first, second)) = same_name(&scenes) {
        bail!("{} and {} would both become {}.fmu", first.file.display(), second.file.display(), first.name);
    }
    let out = out.map_or_else(|| paths::target().join("fmu"), Path::to_owned);
    fs::create_dir_all(&out).with_context(|| format!("cannot make the folder {}", out.display()))?;
    let licences = licences::third_party("split-rotor")?;
    let progress = Progress::of(scenes.len());
    progress.set_message("packaging");
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
