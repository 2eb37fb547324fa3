//! `scenes`: what scenes there are and what they hold.

use crate::paths;
use anyhow::Result;
use split_rotor_model::scene::Scene;
use split_rotor_model::variables::numbers;
pub use split_rotor_tools::scenes::values;

/// The scene that the user means.
pub fn find(name_or_path: &str) -> Result<Scene> {
    Ok(Scene::find(name_or_path, &paths::scenes())?)
}

/// The scene that the user means, to be run or packaged; what may not be meant is told.
pub fn find_warned(name_or_path: &str) -> Result<Scene> {
    let scene = find(name_or_path)?;
    scene.warnings().iter().for_each(|warning| eprintln!("warning: {}: {warning}", scene.file.display()));
    Ok(scene)
}

/// Whether a scene names an adaptive method. The others are too stiff, too fast or too long for the loops of a host in model exchange,
/// and for differences.
pub fn is_gentle(scene: &Scene) -> bool {
    ![numbers::AUTO, numbers::SYMPLECTIC].contains(&scene.parameters().setup.solver.method_in_force())
}

/// Lists the scenes and their effects.
pub fn list() -> Result<()> {
    let scenes = Scene::names(&paths::scenes()).into_iter().map(|name| find(&name)).collect::<Result<Vec<_>>>()?;
    let width = scenes.iter().map(|scene| scene.name.len()).max().unwrap_or(0);
    for scene in scenes {
        let effects: Vec<_> = scene.effects.iter().map(|(info, _)| info.name).collect();
        let effects = if effects.is_empty() { "no effects".into() } else { effects.join(", ") };
        println!("{:width$}  {}  [{effects}]", scene.name, scene.title);
    }
    Ok(())
}
