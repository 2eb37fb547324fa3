//! The library of a list of effects: built where what it is made of has changed, kept for all scenes of that list, and a copy of it with
//! the values of a scene.

use crate::alone::{first_free, once};
use crate::debug::{self, Objcopy};
use crate::paths;
use crate::platforms::Toolchain;
use crate::progress::Progress;
use crate::run::run;
use anyhow::{Context, Result, anyhow};
use split_rotor_model::scene::Scene;
use split_rotor_model::{section, xml};
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

/// These scenes, those of the same list together; what takes longest to build first.
pub fn by_list(scenes: &[Scene]) -> Vec<Vec<&Scene>> {
    let mut lists = BTreeMap::<_, Vec<_>>::new();
    scenes.iter().for_each(|scene| lists.entry(scene.list()).or_default().push(scene));
    let mut lists: Vec<_> = lists.into_values().collect();
    lists.sort_by_key(|scenes| Reverse(scenes[0].effects.len()));
    lists
}

/// A library without values, and the file of its debug information, where that is kept.
pub struct Kept {
    pub library: Vec<u8>,
    pub debug: Option<PathBuf>,
}

/// The library of the scene's list for a platform: as it was kept, or built.
pub fn of(scene: &Scene, toolchain: &Toolchain, progress: &Progress) -> Result<Kept> {
    let (list, folder) = (scene.list(), paths::target().join("package"));
    let mut name = DefaultHasher::new();
    (&list, scene.room(), toolchain.key()).hash(&mut name);
    let kept = folder.join("lists").join(format!("{:016x}{}", name.finish(), toolchain.platform.suffix));
    let stamp = kept.with_extension("stamp");
    let objcopy = Objcopy::of(toolchain);
    let look = || {
        let debug = objcopy.is_some().then(|| debug::beside(&kept));
        let is_here = debug.as_ref().is_none_or(|debug| debug.is_file());
        let library = fs::read(&kept).ok().filter(|library| is_here && is_fresh(library, &stamp, toolchain))?;
        Some(Kept { library, debug })
    };
    let (of_scene, platform) = (&scene.name, toolchain.platform.name);
    let waits = || progress.tell(&format!("waiting for another build, before {of_scene}, {platform}"));
    // First the list's lock: another xtask may be compiling it. Then that of a builder, whose folder other lists need too.
    once(&kept.with_extension("lock"), look, waits, || {
        let builders: Vec<_> = toolchain.builders()?.iter().map(|name| folder.join(name)).collect();
        let locks: Vec<_> = builders.iter().map(|builder| builder.join("lock")).collect();
        let (which, _alone) = first_free(&locks, waits)?;
        make(scene, toolchain, objcopy.as_ref(), &builders[which], (&kept, &stamp), progress)
    })
}

/// Compiles the library and keeps it.
fn make(
    scene: &Scene,
    toolchain: &Toolchain,
    objcopy: Option<&Objcopy>,
    builder: &Path,
    (kept, stamp): (&Path, &Path),
    progress: &Progress,
) -> Result<Kept> {
    let (name, platform) = (&scene.name, toolchain.platform.name);
    let before =
        if toolchain.begins_with_std(builder) { ", and as long for Rust's standard library before it" } else { "" };
    progress
        .tell(&format!("compiling the library for the effects of {name}, {platform}: half a minute to two{before}"));
    let began = SystemTime::now();
    if objcopy.is_none() && toolchain.has_debug_within() {
        progress.suspend(|| {
            eprintln!(
                "  {platform}: no debug information is kept, which takes LLVM's objcopy (Debian: apt-get install llvm)"
            )
        });
    }
    let built = build(toolchain, objcopy, paths::root(), scene, builder)?;
    let mut library = objcopy.map_or_else(|| Ok(fs::read(&built)?), |objcopy| objcopy.split(&built))?;
    toolchain.check(&library)?;
    section_of(&mut library, scene)?;
    // Without its stamp a library is not taken, so one that is cut is none.
    let _ = fs::remove_file(stamp);
    fs::write(kept, &library)?;
    let debug = objcopy.map(|_| debug::beside(kept));
    if let Some(debug) = &debug {
        // What has been published of the last one is that file.
        let _ = fs::remove_file(debug);
        fs::copy(debug::beside(&built), debug)?;
    }
    let sources = sources(&fs::read_to_string(built.with_extension("d"))?);
    if sources.iter().all(|file| is_older(file, began)) {
        fs::write(stamp, format!("{}\n{}", fingerprint(&library, &sources, toolchain)?, sources.join("\n")))?;
    }
    Ok(Kept { library, debug })
}

/// This library with the values of a scene of its list.
pub fn filled(mut library: Vec<u8>, scene: &Scene) -> Result<Vec<u8>> {
    section::fill(section_of(&mut library, scene)?, &xml::guid(scene), &scene.starts);
    Ok(library)
}

/// The section of this library for the values of a scene.
fn section_of<'l>(library: &'l mut [u8], scene: &Scene) -> Result<&'l mut [u8]> {
    section::find(library, &scene.list(), scene.room())
        .map_err(|wrong| anyhow!("the library for {}: {wrong}", scene.file.display()))
}

/// On macOS a library is signed when it is linked, and one that was changed since is not loaded unless it is signed anew.
pub fn signed(library: Vec<u8>) -> Result<Vec<u8>> {
    if !cfg!(target_os = "macos") {
        return Ok(library);
    }
    let file = paths::target().join("package").join(format!("{:?}", std::thread::current().id()));
    fs::write(&file, library)?;
    run(Command::new("codesign").args(["--force", "--sign", "-"]).arg(&file))?;
    Ok(fs::read(&file)?)
}

/// Says to a build which list of effects it is for, by a file in this folder too.
pub fn of_list<'c>(command: &'c mut Command, scene: &Scene, folder: &Path) -> Result<&'c mut Command> {
    fs::create_dir_all(folder)?;
    let (list, file) = (scene.list(), folder.join("section"));
    let blank = section::blank(&list, scene.room());
    // What is written anew is compiled in anew.
    if fs::read(&file).ok().as_ref() != Some(&blank) {
        fs::write(&file, blank)?;
    }
    Ok(command.env("SPLIT_ROTOR_LIST", list).env("SPLIT_ROTOR_SECTION", file).arg("--no-default-features"))
}

/// Builds the library of the scene's list, of the project in the folder `root`: with its debug information within, if something will split it.
pub fn build(
    toolchain: &Toolchain,
    objcopy: Option<&Objcopy>,
    root: &Path,
    scene: &Scene,
    target: &Path,
) -> Result<PathBuf> {
    toolchain.prepare(root)?;
    let within = objcopy.map_or(&[][..], |_| &debug::WITHIN);
    let flags = [&[flags(root)?.as_str()], toolchain.flags(), within].concat().join("\x1f");
    run(of_list(&mut toolchain.cargo()?, scene, target)?
        .current_dir(root)
        .args(["--package", "split-rotor", "--profile", "fmu", "--lib", "--crate-type", "cdylib", "--target-dir"])
        .arg(target)
        .env("CARGO_ENCODED_RUSTFLAGS", flags)
        .env_remove("RUSTFLAGS"))?;
    Ok(toolchain.built(target))
}

/// What the compiler must not do with the physics: to pack scalars into vectors by itself, which makes the right-hand side
/// wait for what is packed last (24 instead of 40 ns in a chain of them; what gains by it, packs itself).
pub const UNPACKED: &str = "-Cno-vectorize-slp";

/// The user's own compiler flags, [`UNPACKED`], and that no path of this machine stays in the library: not that of the project,
/// `root`, nor that of its libraries.
pub fn flags(root: &Path) -> Result<String> {
    let own = match std::env::var("CARGO_ENCODED_RUSTFLAGS") {
        Ok(flags) => flags.split('\x1f').map(str::to_owned).collect(),
        Err(_) => {
            std::env::var("RUSTFLAGS").unwrap_or_default().split_whitespace().map(str::to_owned).collect::<Vec<_>>()
        }
    };
    let home = std::env::home_dir().context("there is no home folder")?;
    let cargo_home = std::env::var_os("CARGO_HOME").map_or_else(|| home.join(".cargo"), PathBuf::from);
    let hidden = [(root, "split-rotor"), (&cargo_home, "cargo")];
    let hide = hidden.map(|(path, name)| format!("--remap-path-prefix={}={name}", path.display()));
    Ok(own
        .into_iter()
        .chain([UNPACKED.to_owned()])
        .chain(hide)
        .filter(|flag| !flag.is_empty())
        .collect::<Vec<_>>()
        .join("\x1f"))
}

/// What a library is made of beside its sources, as cargo names these.
const MANIFESTS: [&str; 4] = ["Cargo.toml", "Cargo.lock", "model/Cargo.toml", ".cargo/config.toml"];

/// The files and folders that a library was made of, from what cargo wrote beside it for make.
fn sources(dependencies: &str) -> Vec<String> {
    let listed = dependencies.split_once(": ").map_or("", |(_, listed)| listed).trim().replace("\\ ", "\0");
    let manifests = MANIFESTS.map(|name| paths::root().join(name).display().to_string());
    let files = listed.split(' ').map(|file| file.replace('\0', " "));
    // What build.rs writes there follows from the rest.
    files.filter(|file| !Path::new(file).starts_with(paths::target())).chain(manifests).collect()
}

fn is_older(file: &str, time: SystemTime) -> bool {
    fs::metadata(file).and_then(|metadata| metadata.modified()).is_ok_and(|changed| changed < time)
}

/// Whether nothing has changed of the library with this stamp, and of what it was made of.
fn is_fresh(library: &[u8], stamp: &Path, toolchain: &Toolchain) -> bool {
    let stamp = fs::read_to_string(stamp).unwrap_or_default();
    let Some((then, sources)) = stamp.split_once('\n') else { return false };
    let sources: Vec<_> = sources.lines().map(str::to_owned).collect();
    fingerprint(library, &sources, toolchain).is_ok_and(|now| now == then)
}

/// Of a library, of the compiler, its flags, the settings of cargo in the environment, and of what these files hold, and which files a folder.
fn fingerprint(library: &[u8], sources: &[String], toolchain: &Toolchain) -> Result<String> {
    let mut all = DefaultHasher::new();
    library.hash(&mut all);
    toolchain.compiler()?.hash(&mut all);
    flags(paths::root())?.hash(&mut all);
    settings().hash(&mut all);
    for source in sources {
        let path = Path::new(source);
        if path.is_dir() {
            let mut names = fs::read_dir(path)?.map(|entry| Ok(entry?.file_name())).collect::<Result<Vec<_>>>()?;
            names.sort();
            (source, names).hash(&mut all);
        } else {
            (source, fs::read(path).with_context(|| source.clone())?).hash(&mut all);
        }
    }
    Ok(format!("{:016x}", all.finish()))
}

/// The settings of cargo and its compiler in the environment, but those of the commands' own profile.
pub fn settings() -> Vec<(OsString, OsString)> {
    let begins = ["CARGO_BUILD_", "CARGO_ENCODED_", "CARGO_PROFILE_", "RUSTC", "RUSTFLAGS"];
    let is_setting =
        |name: &str| begins.iter().any(|begin| name.starts_with(begin)) && !name.starts_with("CARGO_PROFILE_DEV_");
    let mut settings: Vec<_> = std::env::vars_os().filter(|(name, _)| is_setting(&name.to_string_lossy())).collect();
    settings.sort();
    settings
}

#[cfg(test)]
mod tests {
    use super::{MANIFESTS, Toolchain, filled, fingerprint, fs, is_fresh, is_older, paths, sources};
    use crate::scenes;
    use split_rotor_model::section;
    use std::path::PathBuf;
    use std::time::{Duration, SystemTime};

    #[test]
    fn exact_the_sources_of_a_library_are_what_cargo_lists_and_the_manifests() {
        let made = paths::target().join("package/0/fmu/build/out/list.rs");
        let listed = format!("/a/libx.so: /a/build.rs /a/with\\ space.rs {} /a/effects\n", made.display());
        let manifests = MANIFESTS.map(|name| paths::root().join(name).display().to_string());
        let expected = ["/a/build.rs", "/a/with space.rs", "/a/effects"].map(str::to_owned);
        assert_eq!(sources(&listed), [&expected[..], &manifests].concat());
        assert!(manifests.iter().all(|file| fs::exists(file).unwrap()));
    }

    /// A folder with two files, one in a folder within, as a list of sources.
    fn made(name: &str) -> (PathBuf, Vec<String>) {
        let folder = paths::target().join("tests").join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(folder.join("effects")).unwrap();
        fs::write(folder.join("lib.rs"), "one").unwrap();
        fs::write(folder.join("effects/drag.rs"), "two").unwrap();
        let sources = ["lib.rs", "effects", "effects/drag.rs"].map(|file| folder.join(file).display().to_string());
        (folder, sources.to_vec())
    }

    #[test]
    fn a_kept_library_is_stale_where_any_source_changes_comes_or_goes() {
        let (folder, sources) = made("stamp");
        let (stamp, own) = (folder.join("stamp"), Toolchain::own().unwrap());
        let is_fresh = |library: &[u8]| is_fresh(library, &stamp, &own);
        assert!(!is_fresh(b"library"), "none was written");
        let found = fingerprint(b"library", &sources, &own).unwrap();
        fs::write(&stamp, format!("{found}\n{}", sources.join("\n"))).unwrap();
        assert!(!is_fresh(b"librarx"), "another library");
        let changes: [(&str, Option<&str>); 4] = [
            ("lib.rs", Some("One")),
            ("effects/drag.rs", Some("")),
            ("effects/new.rs", Some("new")),
            ("effects/drag.rs", None),
        ];
        for (file, text) in changes {
            assert!(is_fresh(b"library"), "before {file} changes");
            let (file, before) = (folder.join(file), fs::read(folder.join(file)));
            match text {
                Some(text) => fs::write(&file, text).unwrap(),
                None => fs::remove_file(&file).unwrap(),
            }
            assert!(!is_fresh(b"library"), "{} is {text:?}", file.display());
            match before {
                Ok(before) => fs::write(&file, before).unwrap(),
                Err(_) => fs::remove_file(&file).unwrap(),
            }
        }
        assert!(is_fresh(b"library"), "all is as it was");
    }

    #[test]
    fn a_source_that_changed_during_the_build_is_no_older() {
        let (_, sources) = made("during");
        let (now, second) = (SystemTime::now(), Duration::from_secs(100));
        assert!(sources.iter().all(|file| is_older(file, now + second) && !is_older(file, now - second)));
        assert!(!is_older("nosuchfile", now + second));
    }

    #[test]
    fn a_library_is_filled_for_scenes_of_its_list_only() {
        let [paper, top, free] = ["paper", "heavy_top", "free_top"].map(|name| scenes::find(name).unwrap());
        let library = section::blank(&paper.list(), paper.room());
        let [of_paper, of_top] = [&paper, &top].map(|scene| filled(library.clone(), scene).unwrap());
        assert!(of_paper != of_top && of_paper.len() == of_top.len());
        let refused = filled(library, &free).unwrap_err().to_string();
        assert!(refused.contains("free_top.toml: it is that of another list of effects"), "{refused}");
    }
}
