//! How the library of a platform is built here: by which compiler of Rust, from which standard library, with which linker.

use crate::c::is_installed;
use crate::python;
use crate::run::{cargo, output, run};
use anyhow::{Context, Result, anyhow, bail, ensure};
use split_rotor_tools::platform::{AARCH64_LINUX, LINUX64, Platform, WIN64};
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

/// What can be asked for: this machine and its like, which is the quickest, or any machine of a platform.
pub const NAMES: [&str; 4] = [HERE, LINUX64.name, WIN64.name, AARCH64_LINUX.name];

/// This machine and its like.
pub const HERE: &str = "here";

/// A platform whose libraries can be built on others, and run on any machine of it.
struct Target {
    platform: Platform,
    /// What Rust calls it.
    triple: &'static str,
    /// How the name of a library begins there.
    prefix: &'static str,
    linker: Linker,
    /// What Rust's compiler must pass on to it.
    flags: &'static [&'static str],
}

enum Linker {
    /// Knows the symbols of every glibc.
    Zig,
    /// By its name, and Debian's package of it.
    Installed(&'static str, &'static str),
}

const PORTABLE: [Target; 3] = [
    Target { platform: LINUX64, triple: "x86_64-unknown-linux-gnu", prefix: "lib", linker: Linker::Zig, flags: &[] },
    Target {
        platform: WIN64,
        triple: "x86_64-pc-windows-gnu",
        prefix: "",
        linker: Linker::Installed("x86_64-w64-mingw32-gcc", "gcc-mingw-w64-x86-64"),
        // A time within would make every build another.
        flags: &["-Clink-arg=-Wl,--no-insert-timestamp", IMPORTS.1],
    },
    Target {
        platform: AARCH64_LINUX,
        triple: "aarch64-unknown-linux-gnu",
        prefix: "lib",
        linker: Linker::Zig,
        // What is relocated ends with a page, also where pages are largest: only whole ones can be write-protected.
        flags: &["-Clink-arg=-Wl,-z,common-page-size=65536"],
    },
];

/// MinGW's libraries once more, in the project's folder, where the linker is started. It sorts imports by the paths of what they come
/// from: beside those of the project a whole one would come sooner or later as the project lies, a relative one comes last anywhere.
const IMPORTS: (&str, &str) = ("target/mingw", "-Clink-arg=-Ltarget/mingw");

/// The oldest glibc with which a portable library for Linux runs.
const GLIBC: [u32; 2] = [2, 17];

/// What a compiler or linker adds to a library: name, version, licence, and the notice that must travel with it.
pub type Runtime = (&'static str, String, &'static str, &'static str);

/// Of the licences of what is added, only this one wants to be shown with a library.
const NOTICE_OF_MINGW: &str = include_str!("../../modelDescription/licenses/mingw-w64.txt");

/// What builds the library of a platform.
pub struct Toolchain {
    /// For which.
    pub platform: Platform,
    /// None: as this machine compiles for itself.
    portable: Option<(&'static Target, Compiler)>,
}

impl Toolchain {
    /// That of this machine for itself.
    pub fn own() -> Result<Self> {
        Ok(Self { platform: Platform::here()?, portable: None })
    }

    /// Those of these names, in the order of [`NAMES`]: the same FMU comes of any order. Where none is named, those at hand. What is
    /// missing is an error that names the remedy.
    pub fn named(names: &[&str]) -> Result<Vec<Self>> {
        if names.is_empty() {
            return Self::at_hand();
        }
        let here = names.contains(&HERE).then(Self::own).transpose()?;
        let targets = PORTABLE.iter().filter(|target| names.contains(&target.platform.name));
        let all = here.map(Ok).into_iter().chain(targets.map(Self::of)).collect::<Result<Vec<_>>>()?;
        if let [own, others @ ..] = &all[..]
            && let Some(same) = others.iter().find(|other| other.platform == own.platform)
        {
            bail!("`{HERE}` is {} too: name one of them", same.platform.name);
        }
        Ok(all)
    }

    /// Those for which nothing need be fetched, this machine's own platform among them; says of each other what it lacks.
    fn at_hand() -> Result<Vec<Self>> {
        let (own, mut all) = (Self::own()?, Vec::new());
        for target in &PORTABLE {
            let name = target.platform.name;
            let toolchain = if matches!(target.linker, Linker::Zig) && !python::has_wheel_builder() {
                Err(anyhow!("its linker, zig, is not here: `--platforms {name}` fetches it, 98 MB"))
            } else {
                Self::of(target)
            };
            match toolchain {
                Ok(toolchain) => all.push(toolchain),
                Err(lack) if target.platform == own.platform => {
                    println!("{name} is built for machines like this one; for all others {lack}")
                }
                Err(lack) => eprintln!("{name} is not built: {lack}"),
            }
        }
        if all.iter().all(|toolchain| toolchain.platform != own.platform) {
            all.insert(0, own);
        }
        Ok(all)
    }

    fn of(target: &'static Target) -> Result<Self> {
        if let Linker::Installed(program, package) = target.linker {
            ensure!(is_installed(program), "its linker, {program}, is missing (Debian: apt-get install {package})");
        }
        let compiler = Compiler::of(target.triple)?;
        Ok(Self { platform: target.platform, portable: Some((target, compiler)) })
    }

    /// Tells apart what different ones built.
    pub fn key(&self) -> String {
        let key = |(target, compiler): &(&Target, Compiler)| format!("{} {}", target.triple, compiler.from_source);
        self.portable.as_ref().map(key).unwrap_or_default()
    }

    /// Whether Rust's standard library must be compiled first, for the first library in this folder.
    pub fn begins_with_std(&self, folder: &Path) -> bool {
        let from_source = self.portable.as_ref().is_some_and(|(_, compiler)| compiler.from_source);
        from_source && !self.built(folder).exists()
    }

    /// The folders in which its libraries are compiled, one at a time in each: one a processor, or one a platform, where the standard library
    /// may have to be compiled first.
    pub fn builders(&self) -> Result<Vec<String>> {
        let own = 0..thread::available_parallelism()?.get();
        Ok(self
            .portable
            .as_ref()
            .map_or_else(|| own.map(|n| n.to_string()).collect(), |_| vec![self.platform.name.into()]))
    }

    /// What is in its libraries beside crates.
    pub fn runtime(&self) -> Result<Vec<Runtime>> {
        let compiler = self.compiler()?;
        let release = compiler.lines().find_map(|line| line.strip_prefix("release: ")).unwrap_or_default();
        let mut runtime = vec![("Rust standard library", release.to_owned(), "MIT OR Apache-2.0", "")];
        match &self.portable {
            None => (),
            Some((Target { linker: Linker::Zig, .. }, _)) => {
                let licence = "MIT AND Apache-2.0 WITH LLVM-exception";
                runtime.push(("zig compiler-rt and LLVM libunwind", python::zig_version()?, licence, ""));
            }
            Some((Target { linker: Linker::Installed(program, _), .. }, _)) => {
                let version = output(Command::new(program).arg("-dumpversion"))?.trim().to_owned();
                runtime.push(("GCC runtime library", version, "GPL-3.0-or-later WITH GCC-exception-3.1", ""));
                runtime.push(("MinGW-w64 runtime", mingw_version(program)?, "ZPL-2.1", NOTICE_OF_MINGW));
            }
        }
        Ok(runtime)
    }

    /// What its compiler says of itself.
    pub fn compiler(&self) -> Result<String> {
        let rustc = self.portable.as_ref().map_or_else(default_rustc, |(_, compiler)| compiler.rustc.clone());
        output(Command::new(rustc).arg("-vV"))
    }

    /// Cargo's `rustc` for the platform.
    pub fn cargo(&self) -> Result<Command> {
        let Some((target, compiler)) = &self.portable else {
            let mut cargo = cargo();
            cargo.args(["rustc", "--quiet"]);
            return Ok(cargo);
        };
        let (mut cargo, glibc) = match target.linker {
            Linker::Zig => (python::wheel_builder("cargo-zigbuild")?, format!(".{}.{}", GLIBC[0], GLIBC[1])),
            Linker::Installed(..) => (cargo(), String::new()),
        };
        cargo.args(["rustc", "--quiet", "--target", &format!("{}{glibc}", target.triple)]);
        cargo.env("RUSTC", &compiler.rustc);
        if compiler.from_source {
            // Of what is not stable, only that the standard library is compiled here: without the names in a backtrace, which a
            // stripped library does not have.
            let options = ["-Zbuild-std=std,panic_unwind", "-Zbuild-std-features=panic-unwind,optimize_for_size"];
            cargo.args(options).env("RUSTC_BOOTSTRAP", "1");
        }
        Ok(cargo)
    }

    /// What the compiler must be told for it.
    pub fn flags(&self) -> &'static [&'static str] {
        self.portable.as_ref().map_or(&[], |(target, _)| target.flags)
    }

    /// What the linker must find in the folder of the project that is built.
    pub fn prepare(&self, root: &Path) -> Result<()> {
        if cfg!(unix)
            && let Some((Target { linker: Linker::Installed(program, _), .. }, _)) = &self.portable
        {
            let library = output(Command::new(program).arg("-print-file-name=libkernel32.a"))?;
            let folder = Path::new(library.trim()).parent().context("a file lies in a folder")?;
            let link = root.join(IMPORTS.0);
            fs::create_dir_all(link.parent().context("it lies in target")?)?;
            run(Command::new("ln").arg("-sfn").args([folder, &link]))?;
        }
        Ok(())
    }

    /// Where [`Self::cargo`] leaves the library.
    pub fn built(&self, folder: &Path) -> PathBuf {
        match &self.portable {
            None => folder.join("fmu").join(format!("{DLL_PREFIX}split_rotor{DLL_SUFFIX}")),
            Some((target, _)) => folder
                .join(target.triple)
                .join("fmu")
                .join(format!("{}split_rotor{}", target.prefix, target.platform.suffix)),
        }
    }

    /// Whether a linker leaves debug information in its libraries: not where Apple's or Microsoft's links.
    pub fn has_debug_within(&self) -> bool {
        self.portable.is_some() || cfg!(target_os = "linux")
    }

    /// Whether that is the same wherever the project lies: zig's own runtime names the folder in which it was first compiled, and for
    /// Windows symbols are named after temporary folders.
    pub fn has_same_debug(&self) -> bool {
        self.portable.is_none()
    }

    /// Refuses a portable library that needs a newer glibc.
    pub fn check(&self, library: &[u8]) -> Result<()> {
        if self.portable.is_some()
            && let Some(newest) = newest_glibc(library)
        {
            let [is, may] = [newest, GLIBC].map(|[major, minor]| format!("{major}.{minor}"));
            ensure!(newest <= GLIBC, "the library for {} needs glibc {is}, and may need {may}", self.platform.name);
        }
        Ok(())
    }
}

/// That of the headers and libraries with which this compiler of C links.
fn mingw_version(gcc: &str) -> Result<String> {
    let header = ["-dM", "-E", "-include", "_mingw.h", "-x", "c", "-"];
    let macros = output(Command::new(gcc).args(header).stdin(Stdio::null()))?;
    let number = |part| {
        let value = macros.lines().find_map(|line| line.strip_prefix(&format!("#define __MINGW64_VERSION_{part} ")));
        value.with_context(|| format!("{gcc} is not that of MinGW-w64"))
    };
    Ok([number("MAJOR")?, number("MINOR")?, number("BUGFIX")?].join("."))
}

/// A compiler of Rust.
struct Compiler {
    rustc: PathBuf,
    /// It makes the standard library first.
    from_source: bool,
}

impl Compiler {
    /// One that has the standard library for this target, or else its source.
    fn of(triple: &str) -> Result<Self> {
        // Beside the usual one Debian's, which has a source that rustup's need not have.
        let compilers = [default_rustc(), "/usr/bin/rustc".into()];
        for from_source in [false, true] {
            for rustc in &compilers {
                if has_standard_library(rustc, triple, from_source) {
                    return Ok(Self { rustc: rustc.clone(), from_source });
                }
            }
        }
        bail!(
            "Rust's standard library for it is missing: `rustup target add {triple}` (Debian: apt-get install rustc-web rust-web-src)"
        );
    }
}

/// The compiler that cargo would take.
pub fn default_rustc() -> PathBuf {
    std::env::var_os("RUSTC").map_or_else(|| "rustc".into(), PathBuf::from)
}

/// Whether this compiler has the standard library for a target, built or as a source.
fn has_standard_library(rustc: &Path, triple: &str, as_source: bool) -> bool {
    let print = if as_source { "sysroot" } else { "target-libdir" };
    let said = Command::new(rustc).args(["--print", print, "--target", triple]).output();
    let Some(said) = said.ok().filter(|output| output.status.success()) else { return false };
    let folder = PathBuf::from(String::from_utf8_lossy(&said.stdout).trim());
    if as_source {
        return folder.join("lib/rustlib/src/rust/library/std").is_dir();
    }
    let mut files = fs::read_dir(folder).into_iter().flatten().flatten();
    files.any(|file| file.file_name().to_string_lossy().starts_with("libstd-"))
}

/// The newest version of glibc that a library names.
fn newest_glibc(library: &[u8]) -> Option<[u32; 2]> {
    let mark = b"GLIBC_";
    let begins = library.windows(mark.len()).enumerate().filter(|(_, bytes)| bytes == mark);
    let versions = begins.filter_map(|(begin, _)| {
        let version: Vec<_> = library[begin + mark.len()..].iter().take_while(|byte| **byte != 0).copied().collect();
        let mut numbers = str::from_utf8(&version).ok()?.split('.').map(|number| number.parse().ok());
        Some([numbers.next()??, numbers.next()??])
    });
    versions.max()
}

#[cfg(test)]
mod tests {
    use super::{NAMES, PORTABLE, Toolchain, newest_glibc};

    #[test]
    fn every_platform_can_be_asked_for() {
        assert!(PORTABLE.iter().map(|target| target.platform.name).eq(NAMES[1..].iter().copied()));
    }

    #[test]
    #[cfg(all(target_os = "linux", target_arch = "x86_64"))]
    fn a_platform_is_in_an_fmu_once() {
        assert_eq!(Toolchain::named(&["linux64", "linux64"]).unwrap().len(), 1);
        let refused = Toolchain::named(&["linux64", "here"]).err().expect("both are linux64").to_string();
        assert_eq!(refused, "`here` is linux64 too: name one of them");
    }

    #[test]
    fn the_newest_glibc_is_told_by_number_not_by_letter() {
        assert_eq!(newest_glibc(b"\0GLIBC_2.2.5\0GLIBC_2.14\0GLIBC_2.3\0GLIBC_PRIVATE\0"), Some([2, 14]));
        assert_eq!(newest_glibc(b"KERNEL32.dll"), None);
    }
}
