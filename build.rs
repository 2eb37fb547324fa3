//! Compiles the chosen scene in: its effects become a type, its GUID and start values constants.
//!
//! The scene is the TOML file in the environment variable `SPLIT_ROTOR_SCENE`, which `cargo xtask package` sets for its
//! own child; without it, `scenes/paper.toml`.

use split_rotor_model::scene::Scene;
use split_rotor_model::variable::{Place, Role};
use split_rotor_model::xml;
use std::fmt::Write;
use std::path::{Path, PathBuf};

fn main() {
    println!("cargo::rerun-if-env-changed=SPLIT_ROTOR_SCENE");
    let file = std::env::var_os("SPLIT_ROTOR_SCENE").map_or("scenes/paper.toml".into(), PathBuf::from);
    println!("cargo::rerun-if-changed={}", file.display());
    match Scene::read(&file) {
        Err(error) => error.to_string().lines().for_each(|line| println!("cargo::error={line}")),
        Ok(scene) => {
            tell_tests(&scene);
            let out = std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR");
            std::fs::write(Path::new(&out).join("scene.rs"), source(&scene)).expect("OUT_DIR can be written");
        }
    }
}

/// Says as a cfg for which tests the scene is one, so that the others are told as ignored, not as passed.
fn tell_tests(scene: &Scene) {
    let has = |name: &str| scene.effects.iter().any(|(info, _)| info.name == name);
    let has_inputs = scene.variables.iter().any(|variable| matches!(variable.meta.role, Role::Input { .. }));
    for (cfg, holds) in [
        ("scene_has_inputs", has_inputs),
        ("scene_has_support", has("support")),
        ("scene_is_driven", has("drive") && has("support") && has("gravity")),
    ] {
        println!("cargo::rustc-check-cfg=cfg({cfg})");
        if holds {
            println!("cargo::rustc-cfg={cfg}");
        }
    }
}

/// What `src/scene.rs` includes.
fn source(scene: &Scene) -> String {
    let member = if scene.general { "Switched" } else { "Called" };
    let list = scene.effects.iter().rev().fold("()".to_owned(), |rest, (info, index)| {
        let nodes = match scene.nodes(Place::effect_block(info.number, *index)) {
            0 => String::new(),
            nodes => format!("<{nodes}>"),
        };
        format!("(split_rotor_model::effects::{member}<{}{nodes}, {index}>, {rest})", info.type_path)
    });
    let mut starts = String::new();
    for (reference, value) in &scene.starts {
        write!(starts, "({reference}, {value:?}), ").expect("writing to memory does not fail");
    }
    format!(
        "/// The effects that the scene calls for.\n\
         pub type Effects = {list};\n\n\
         /// The GUID of its modelDescription.xml.\n\
         pub const GUID: &str = {:?};\n\n\
         /// The start value of each parameter, by value reference.\n\
         pub const STARTS: &[(u32, f64)] = &[{starts}];\n",
        xml::guid(scene)
    )
}
