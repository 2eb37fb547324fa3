//! The golden bits of every scene and method by the libraries of every platform: that of Windows under wine, that of Arm under qemu.

use crate::c::tool;
use crate::package::package_for;
use crate::progress::Progress;
use crate::run::{output, run, side_by_side};
use crate::unpacked::{self, Unpacked, unpack_for};
use crate::{paths, python, scenes, sheet};
use anyhow::{Context, Result, ensure};
use split_rotor_model::scene::Scene;
use split_rotor_model::variables::METHODS;
use split_rotor_model::xml;
use split_rotor_tools::general::{self, GENERAL};
use split_rotor_tools::platform::{AARCH64_LINUX, LINUX64, Platform, WIN64};
use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};

const PLATFORMS: [Platform; 3] = [LINUX64, WIN64, AARCH64_LINUX];

/// Where all of it lies.
fn folder() -> PathBuf {
    paths::target().join("abroad")
}

/// Packages scenes for every platform, each in one FMU, and runs them there. To compile each list of effects three times would take half
/// an hour: the scenes that the general library can be run over it.
pub fn bits_of_every_platform() -> Result<String> {
    let all = Scene::names(&paths::scenes());
    let all = all.iter().map(|name| scenes::find(name)).collect::<Result<Vec<_>>>()?;
    let general = scenes::find(GENERAL)?;
    let is_general = |scene: &&Scene| general::values(&general, scene).is_ok();
    let (over_general, own): (Vec<_>, Vec<_>) = all.iter().partition(is_general);
    let names = own.iter().chain([&&general]).map(|scene| scene.name.clone()).collect::<Vec<_>>();
    let fmus = package_for(&names, &PLATFORMS.map(|platform| platform.name), Some(&folder()))?;
    for fmu in &fmus {
        run(python::python()?.args(["-m", "fmpy", "validate"]).arg(fmu))?;
    }
    let (rotor, own) = fmus.split_last().context("the general scene is one of them")?;
    let mut runs = Vec::new();
    for platform in PLATFORMS {
        let machine = Machine::of(platform)?;
        let library = fs::read(unpack_for(rotor, platform)?.library)?;
        for fmu in own {
            runs.push((machine.clone(), unpack_for(fmu, platform)?));
        }
        for scene in &over_general {
            runs.push((machine.clone(), over(&general, library.clone(), scene, platform)?));
        }
    }
    let (golden, compared) = (Golden::read()?, AtomicUsize::new(0));
    let progress = Progress::of(runs.len());
    progress.set_message("running on every platform");
    side_by_side(&runs, |_, (machine, fmu)| {
        let rows = golden.of(&fmu.name)?;
        let methods = rows.iter().map(|(method, _)| method.to_string());
        let said = output(machine.command()?.arg(&fmu.sheet).arg(&fmu.library).args(methods))?;
        let hashes: Vec<_> = rows.iter().map(|(_, hash)| *hash).collect();
        let platform = machine.platform.name;
        ensure!(said.lines().eq(hashes.iter().copied()), "{} on {platform}: {said} is not {hashes:?}", fmu.name);
        compared.fetch_add(hashes.len(), Ordering::Relaxed);
        progress.inc(1);
        Ok(())
    })?;
    drop(progress);
    Ok(format!("{} trajectories, bit for bit", compared.into_inner()))
}

/// A scene over the general library, with a sheet of its own variables only: the states of effects that are off are not in its hash.
fn over(general: &Scene, library: Vec<u8>, scene: &Scene, platform: Platform) -> Result<Unpacked> {
    let own = scenes::find(&scene.name)?;
    let (whole, library) = general::over(general, library, own)?;
    let sheet = sheet::sheet(&xml::model_description(scene))?.replace(&xml::guid(scene), &xml::guid(&whole));
    unpacked::write(&folder().join(platform.name), &scene.name, &sheet, (platform, &library))
}

/// What runs a host on a platform.
#[derive(Clone)]
struct Machine {
    platform: Platform,
    host: PathBuf,
}

impl Machine {
    /// With its host compiled.
    fn of(platform: Platform) -> Result<Self> {
        let folder = folder().join(platform.name);
        fs::create_dir_all(&folder)?;
        let (mut compiler, last) = match platform {
            // Zig's linker has been seen to wait for ever when it links for Windows.
            WIN64 => (tool("x86_64-w64-mingw32-gcc", "gcc-mingw-w64-x86-64")?, None),
            AARCH64_LINUX => (python::zig_cc("aarch64-linux-gnu")?, Some("-ldl")),
            _ => (python::zig_cc("x86_64-linux-gnu")?, Some("-ldl")),
        };
        let host = folder.join("bits.exe");
        compiler.current_dir(paths::root()).args(["-std=c99", "-O2", "-I", "tests/c", "-I", "modelDescription/linear"]);
        compiler.args(["tests/platforms/bits.c", "tests/c/library.c", "tests/c/sheet.c", "-o"]).arg(&host);
        run(compiler.args(last))?;
        if platform == WIN64 {
            make_windows()?;
        }
        Ok(Self { platform, host })
    }

    /// Starts the host.
    fn command(&self) -> Result<Command> {
        let mut command = match self.platform {
            WIN64 => wine()?,
            AARCH64_LINUX => {
                let mut qemu = tool("qemu-aarch64", "qemu-user libc6-arm64-cross")?;
                qemu.args(["-L", "/usr/aarch64-linux-gnu"]);
                qemu
            }
            _ => return Ok(Command::new(&self.host)),
        };
        command.arg(&self.host);
        Ok(command)
    }
}

/// Where Windows is made.
fn windows() -> PathBuf {
    folder().join("wine")
}

/// Makes Windows: two programs that start at once would each make it, and one of them fails. Wine 8 has been seen to leave it without
/// kernel32.dll, once: it is made anew, and a second time it is an error.
fn make_windows() -> Result<()> {
    let make = || run(wine()?.args(["wineboot", "--init"]));
    make().or_else(|error| {
        println!("{error}: once more, in a new folder");
        fs::remove_dir_all(windows())?;
        make()
    })
}

/// Windows, in a folder of its own.
fn wine() -> Result<Command> {
    let mut wine = tool("wine", "wine64 wine")?;
    wine.env("WINEPREFIX", windows()).env("WINEDEBUG", "-all");
    Ok(wine)
}

/// The hash of each scene and method, as tests/bits.rs left them.
struct Golden(String);

impl Golden {
    fn read() -> Result<Self> {
        Ok(Self(fs::read_to_string(paths::root().join("tests/golden/bits.csv"))?))
    }

    /// Of a scene: each method's number, and the hash.
    fn of(&self, scene: &str) -> Result<Vec<(i32, &str)>> {
        let rows = self.0.lines().filter_map(|line| line.strip_prefix(scene)?.strip_prefix(',')?.split_once(','));
        let rows = rows.map(|(name, hash)| {
            let method = METHODS.items.iter().find(|(_, known, _)| *known == name);
            Ok((method.context("a method")?.0, hash))
        });
        let rows = rows.collect::<Result<Vec<_>>>()?;
        ensure!(!rows.is_empty(), "tests/golden/bits.csv does not have {scene}");
        Ok(rows)
    }
}
