//! Which effects are compiled: all, or for an FMU those of its list, the type in the environment variable `SPLIT_ROTOR_LIST`, which
//! `cargo xtask package` sets. What a generic crate compiles of the others is thrown away in the end, but it would tell by where
//! the rest comes to lie.

use std::path::Path;

/// One file an effect; other files there hold none.
const EFFECTS: &str = "src/effects";

fn main() {
    println!("cargo::rerun-if-changed={EFFECTS}");
    // A copy of the model that reads scenes must have all effects: no list may rebuild it.
    let wanted = if std::env::var_os("CARGO_FEATURE_SCENES").is_some() {
        None
    } else {
        println!("cargo::rerun-if-env-changed=SPLIT_ROTOR_LIST");
        std::env::var("SPLIT_ROTOR_LIST").ok()
    };
    for entry in std::fs::read_dir(Path::new(EFFECTS)).expect("the effects stand there") {
        let path = entry.expect("a folder can be read").path();
        let name = path.file_stem().expect("a file has a name").to_string_lossy().into_owned();
        println!("cargo::rustc-check-cfg=cfg({name})");
        if wanted.as_ref().is_none_or(|wanted| wanted.contains(&format!("::{name}::"))) {
            println!("cargo::rustc-cfg={name}");
        }
    }
}
