//! Compiles a list of effects in as a type, and the section that holds the values of a scene.
//!
//! The scene is the TOML file in the environment variable `SPLIT_ROTOR_SCENE`; without it, `scenes/paper.toml`, or with the feature `driven`
//! `scenes/driven.toml`. `cargo xtask package`
//! names in its place a list, `SPLIT_ROTOR_LIST`, and for how many start values there must be room, `SPLIT_ROTOR_ROOM`: it writes the
//! values of each scene into copies of that library.

use split_rotor_model::scene::Scene;
use split_rotor_model::variable::Role;
use split_rotor_model::{section, xml};
use std::path::{Path, PathBuf};

fn main() {
    for variable in ["LIST", "ROOM", "SCENE"] {
        println!("cargo::rerun-if-env-changed=SPLIT_ROTOR_{variable}");
    }
    match std::env::var("SPLIT_ROTOR_LIST") {
        Ok(list) => {
            let room = std::env::var("SPLIT_ROTOR_ROOM").ok().and_then(|room| room.parse().ok());
            write(&list, &section::blank(&list, room.expect("SPLIT_ROTOR_ROOM is a whole number")));
        }
        Err(_) => {
            let usual = if cfg!(feature = "driven") { "scenes/driven.toml" } else { "scenes/paper.toml" };
            of_scene(&std::env::var_os("SPLIT_ROTOR_SCENE").map_or(usual.into(), PathBuf::from));
        }
    }
}

fn of_scene(file: &Path) {
    println!("cargo::rerun-if-changed={}", file.display());
    match Scene::read(file) {
        Err(error) => error.to_string().lines().for_each(|line| println!("cargo::error={line}")),
        Ok(scene) => {
            tell_tests(&scene);
            let mut section = section::blank(&scene.list(), scene.room());
            section::fill(&mut section, &xml::guid(&scene), &scene.starts);
            write(&scene.list(), &section);
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
fn write(list: &str, section: &[u8]) {
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let list = format!("/// The effects that the scene calls for.\npub type Effects = {list};\n");
    std::fs::write(out.join("list.rs"), list).expect("OUT_DIR can be written");
    std::fs::write(out.join("section"), section).expect("OUT_DIR can be written");
}
