//! Compiles a list of effects in as a type, and the section that holds the values of a scene.
//!
//! The scene is the TOML file in the environment variable `SPLIT_ROTOR_SCENE`; without it, `scenes/paper.toml`, or with the feature `driven`
//! `scenes/driven.toml`. `cargo xtask package` names in its place a list, `SPLIT_ROTOR_LIST`, and the file of a section without values,
//! `SPLIT_ROTOR_SECTION`: it writes the values of each scene into copies of that library. It leaves the feature `scene` out, and with it
//! the copy of the model that reads scenes.

use std::path::PathBuf;

fn main() {
    for variable in ["LIST", "SECTION", "SCENE"] {
        println!("cargo::rerun-if-env-changed=SPLIT_ROTOR_{variable}");
    }
    match std::env::var("SPLIT_ROTOR_LIST") {
        Ok(list) => {
            let file =
                PathBuf::from(std::env::var_os("SPLIT_ROTOR_SECTION").expect("SPLIT_ROTOR_SECTION names a file"));
            println!("cargo::rerun-if-changed={}", file.display());
            write(&list, &std::fs::read(file).expect("SPLIT_ROTOR_SECTION can be read"));
        }
        #[cfg(feature = "scene")]
        Err(_) => scene::compile_in(),
        #[cfg(not(feature = "scene"))]
        Err(_) => println!(
            "cargo::error=there is no SPLIT_ROTOR_LIST; a scene is read with the feature `scene`, which is a default"
        ),
    }
}

/// What `src/scene.rs` includes.
fn write(list: &str, section: &[u8]) {
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let list = format!("/// The effects that the scene calls for.\npub type Effects = {list};\n");
    std::fs::write(out.join("list.rs"), list).expect("OUT_DIR can be written");
    std::fs::write(out.join("section"), section).expect("OUT_DIR can be written");
}

#[cfg(feature = "scene")]
mod scene {
    use split_rotor_model::scene::Scene;
    use split_rotor_model::variable::Role;
    use split_rotor_model::{section, xml};
    use std::path::PathBuf;

    /// Compiles in the scene that the environment names, or else the usual one.
    pub fn compile_in() {
        let usual = if cfg!(feature = "driven") { "scenes/driven.toml" } else { "scenes/paper.toml" };
        let file = std::env::var_os("SPLIT_ROTOR_SCENE").map_or(usual.into(), PathBuf::from);
        println!("cargo::rerun-if-changed={}", file.display());
        match Scene::read(&file) {
            Err(error) => error.to_string().lines().for_each(|line| println!("cargo::error={line}")),
            Ok(scene) => {
                set_test_cfgs(&scene);
                let mut section = section::blank(&scene.list(), scene.room());
                section::fill(&mut section, &xml::guid(&scene), &scene.starts);
                super::write(&scene.list(), &section);
            }
        }
    }

    /// Sets a cfg for each kind of test that the scene allows, so that the others are reported as ignored, not as passed.
    fn set_test_cfgs(scene: &Scene) {
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
}
