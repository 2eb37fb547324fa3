//! What is tried on a copy of the project: that effects which a scene does not call for leave no trace in its machine code, nor the
//! place where the project lies in its library, and that an effect is added as `docs/adding-an-effect.md` says.

use crate::debug::Objcopy;
use crate::platforms::Toolchain;
use crate::progress::Progress;
use crate::run::{cargo, output, run};
use crate::{alone, c, library, paths, scenes};
use anyhow::{Context, Result, ensure};
use split_rotor_model::effects::CATALOGUE;
use split_rotor_tools::platform::{LINUX64, WIN64};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Until it is dropped no other xtask works on copies: they share what is built of them.
fn alone() -> Result<File> {
    alone::alone(&paths::target().join("copies/lock"), || println!("waiting for another job that works on copies"))
}

/// A fresh copy of what git knows, as it stands here, in target/copies/`name`.
fn copied(name: &str) -> Result<PathBuf> {
    copied_to(paths::target().join("copies").join(name))
}

fn copied_to(copy: PathBuf) -> Result<PathBuf> {
    if copy.exists() {
        fs::remove_dir_all(&copy)?;
    }
    let files = output(Command::new("git").current_dir(paths::root()).args(["ls-files", "--cached", "--deduplicate"]))?;
    for file in files.lines().filter(|file| paths::root().join(file).is_file()) {
        let to = copy.join(file);
        fs::create_dir_all(to.parent().context("a file lies in a folder")?)?;
        fs::copy(paths::root().join(file), to).with_context(|| file.to_owned())?;
    }
    Ok(copy)
}

/// The machine code of a library.
fn text(library: &[u8]) -> Result<Vec<u8>> {
    let [whole, section] = ["library", "text"].map(|name| paths::target().join("copies").join(name));
    fs::write(&whole, library)?;
    run(c::tool("objcopy", "binutils")?.args(["-O", "binary", "--only-section=.text"]).args([&whole, &section]))?;
    Ok(fs::read(section)?)
}

/// The machine code of `paper` as it travels is the same to the byte where every effect that it does not call for is taken out of the
/// catalogue.
pub fn absence_is_free() -> Result<()> {
    let _alone = alone()?;
    let (scene, own) = (scenes::find("paper")?, Toolchain::own()?);
    let all = text(&library::of(&scene, &own, &Progress::of(1))?.library)?;
    let copy = copied("absence")?;
    let effects = copy.join("model/src/effects");
    let catalogue = effects.with_extension("rs");
    let mut source = fs::read_to_string(&catalogue)?;
    for info in CATALOGUE.iter().filter(|info| !scene.effects.iter().any(|(called, _)| called.name == info.name)) {
        fs::remove_file(effects.join(format!("{}.rs", info.name)))?;
        let start = format!("    {} {} ", info.number, info.name);
        let line = source.lines().find(|line| line.starts_with(&start)).context("an effect is a line")?.to_owned();
        source = source.replace(&format!("{line}\n"), "");
    }
    fs::write(&catalogue, source)?;
    let built = library::build(&own, None, &copy, &scene, &paths::target().join("copies/code"))?;
    let few = text(&fs::read(built)?)?;
    println!("machine code of {}: {} bytes with every effect, {} with its own alone", scene.name, all.len(), few.len());
    ensure!(!all.is_empty() && all == few, "effects that {} does not call for changed its machine code", scene.name);
    Ok(())
}

/// The libraries of no effect that travel, for any Linux and for Windows, are the same to the byte where the project lies elsewhere: behind
/// the system's libraries in the order of names, by which a linker may sort, or before them.
pub fn place_leaves_no_trace() -> Result<()> {
    let _alone = alone()?;
    let scene = scenes::find("free_top")?;
    let parent = if paths::root() < Path::new("/usr") { "/var/tmp" } else { "/tmp" };
    let copy = copied_to(Path::new(parent).join(format!("split-rotor elsewhere {}", std::process::id())))?;
    for toolchain in Toolchain::named(&[LINUX64.name, WIN64.name])? {
        let here = library::of(&scene, &toolchain, &Progress::of(1))?.library;
        let objcopy = Objcopy::of(&toolchain).context("debug information is kept apart by LLVM's objcopy")?;
        let built = library::build(&toolchain, Some(&objcopy), &copy, &scene, &copy.join("target"))?;
        let there = objcopy.split(&built)?;
        let platform = toolchain.platform.name;
        ensure!(here == there, "the library of {platform} is another in {}", copy.display());
        println!("{platform}: {} bytes, the same in {}", here.len(), copy.display());
    }
    Ok(fs::remove_dir_all(copy)?)
}

/// Adds the effect of the page, runs the test that holds every effect to its power, and compiles the library of the page's scene; nobody
/// runs that one, so nothing is optimised.
pub fn example_is_right() -> Result<()> {
    let _alone = alone()?;
    let page = fs::read_to_string(paths::root().join("docs/adding-an-effect.md"))?;
    let block = |language: &str| -> Result<&str> {
        let after = page.split_once(&format!("```{language}\n")).with_context(|| format!("no block of {language}"))?.1;
        Ok(after.split_once("```").context("a block ends")?.0)
    };
    let (file, line, scene) = (block("rust")?, block("text")?, block("toml")?);
    let copy = copied("example")?;
    let catalogue = copy.join("model/src/effects.rs");
    let source = fs::read_to_string(&catalogue)?;
    fs::write(&catalogue, source.replace("catalogue! {\n", &format!("catalogue! {{\n    {line}")))?;
    fs::write(copy.join("model/src/effects/tether.rs"), file)?;
    fs::write(copy.join("scenes/tethered.toml"), scene)?;
    let target = paths::target().join("copies/target");
    let within = |command: &str, arguments: &[&str]| {
        let mut cargo = cargo();
        cargo.current_dir(&copy).args([command, "--quiet", "--profile", "unoptimised", "--target-dir"]).arg(&target);
        run(cargo.args(arguments).env("SPLIT_ROTOR_SCENE", "scenes/tethered.toml"))
    };
    within("test", &["--package", "split-rotor-model", "--test", "power"])?;
    within("build", &["--package", "split-rotor", "--lib"])
}
