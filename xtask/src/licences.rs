//! What others made of a library: their licences, and a bill of materials.

use crate::platforms::{Runtime, Toolchain};
use crate::run::{cargo, output};
use anyhow::{Context, Result};
use serde_json::{Value, json};
use split_rotor_tools::archive::Origin;
use std::path::{Path, PathBuf};

/// A crate that is linked in.
struct Crate {
    name: String,
    version: String,
    /// As SPDX writes it.
    licence: String,
    folder: PathBuf,
}

/// What is linked into the library of this package, in the order of names, and what these toolchains add.
pub fn of(package: &str, toolchains: &[Toolchain]) -> Result<Origin> {
    let (crates, runtimes) = (crates(package)?, runtimes(toolchains)?);
    Ok(Origin { licences: third_party(&crates, &runtimes)?, bill: bill(package, &crates, &runtimes)? })
}

/// What compilers and linkers add, and to the libraries of which platforms: several have mostly the same.
fn runtimes(toolchains: &[Toolchain]) -> Result<Vec<(Runtime, String)>> {
    let mut runtimes = Vec::<(Runtime, String)>::new();
    for toolchain in toolchains {
        let platform = toolchain.platform.name;
        for runtime in toolchain.runtime()? {
            match runtimes.iter_mut().find(|(known, _)| *known == runtime) {
                Some((_, platforms)) => *platforms += &format!(", {platform}"),
                None => runtimes.push((runtime, platform.to_owned())),
            }
        }
    }
    Ok(runtimes)
}

fn crates(package: &str) -> Result<Vec<Crate>> {
    let tree = ["tree", "--package", package, "--edges", "normal,no-proc-macro", "--prefix", "none"];
    let linked = output(cargo().args(tree).args(["--format", "{p}|{l}"]))?;
    // Of this platform only: cargo would fetch the crates of all others.
    let compiler = Toolchain::own()?.compiler()?;
    let host = compiler.lines().find_map(|line| line.strip_prefix("host: ")).context("rustc tells its host")?;
    let metadata = ["metadata", "--format-version", "1", "--locked", "--filter-platform", host];
    let metadata = output(cargo().args(metadata))?;
    let metadata: Value = serde_json::from_str(&metadata).context("cargo metadata prints JSON")?;
    let packages = metadata["packages"].as_array().context("cargo metadata lists packages")?;
    let mut lines: Vec<_> = linked.lines().map(|line| line.trim_end_matches(" (*)")).collect();
    lines.sort_unstable();
    lines.dedup();
    let others = lines.into_iter().filter(|line| !line.starts_with("split-rotor"));
    let crates = others.map(|line| {
        let (package, licence) = line.split_once('|').context("a crate and its licence")?;
        let (name, version) = package.split_once(" v").context("a name and a version")?;
        let found = packages.iter().find(|package| package["name"] == name && package["version"] == version);
        let manifest = found.and_then(|package| package["manifest_path"].as_str()).context("a crate has a manifest")?;
        let folder = Path::new(manifest).parent().context("a manifest lies in a folder")?.to_owned();
        // Older crates write MIT/Apache-2.0.
        Ok(Crate { name: name.into(), version: version.into(), licence: licence.replace('/', " OR "), folder })
    });
    crates.collect()
}

fn third_party(crates: &[Crate], runtimes: &[(Runtime, String)]) -> Result<String> {
    let mut text = "What compilers and linkers add, each with what is within it:\n".to_owned();
    for ((name, version, licence, _), platforms) in runtimes {
        text += &format!("{name} {version} ({platforms}): {licence}\n");
    }
    for ((name, _, _, notice), _) in runtimes.iter().filter(|((.., notice), _)| !notice.is_empty()) {
        text += &format!("\n{name}:\n{notice}");
    }
    for Crate { name, version, licence, folder } in crates {
        text += &format!("\n{0}\n{name} {version}: {licence}\n{0}\n{1}", "=".repeat(80), texts(folder)?);
    }
    Ok(text)
}

/// The bill of materials, as CycloneDX 1.6 writes it in JSON.
fn bill(package: &str, crates: &[Crate], runtimes: &[(Runtime, String)]) -> Result<String> {
    let library = |name: &str, version: &str, licence: &str| json!({ "type": "library", "name": name, "version": version, "licenses": [{ "expression": licence }] });
    let own = "MIT OR Apache-2.0";
    let components = crates.iter().map(|Crate { name, version, licence, .. }| {
        let mut component = library(name, version, licence);
        component["purl"] = format!("pkg:cargo/{name}@{version}").into();
        component
    });
    let added = runtimes.iter().map(|((name, version, licence, _), platforms)| {
        let mut component = library(name, version, licence);
        component["description"] = format!("In the libraries for {platforms}").into();
        component
    });
    let components: Vec<_> = components.chain(added).collect();
    let bill = json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": { "component": library(package, env!("CARGO_PKG_VERSION"), own) },
        "components": components,
    });
    Ok(serde_json::to_string_pretty(&bill)? + "\n")
}

/// The texts of the licences in a crate's folder.
fn texts(folder: &Path) -> Result<String> {
    let names = std::fs::read_dir(folder)?.flatten().map(|entry| entry.path());
    let is_licence = |path: &Path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_uppercase();
        path.is_file() && ["LICENSE", "LICENCE", "COPYING", "NOTICE"].iter().any(|start| name.starts_with(start))
    };
    let mut files: Vec<_> = names.filter(|path| is_licence(path)).collect();
    files.sort();
    let texts = files.iter().map(std::fs::read_to_string).collect::<Result<Vec<_>, _>>()?;
    Ok(texts.iter().map(|text| format!("\n{}\n", text.trim_end())).collect())
}
