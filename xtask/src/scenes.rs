//! `scenes`: what scenes there are and what they hold.

use crate::paths;
use anyhow::Result;
use split_rotor_model::effects::Info;
use split_rotor_model::scene::Scene;
use split_rotor_model::simulation::General;
use split_rotor_model::variable::Place;
use split_rotor_model::variables::{Variable, numbers};

/// The scene that the user means.
pub fn find(name_or_path: &str) -> Result<Scene> {
    Ok(Scene::find(name_or_path, &paths::scenes())?)
}

/// The variables of one effect of a scene, the `index`th of its kind.
pub fn variables_of<'s>(scene: &'s Scene, info: &Info, index: u32) -> impl Iterator<Item = &'s Variable> {
    let block = Place::effect_block(info.number, index);
    scene.variables.iter().filter(move |variable| variable.place.block == block)
}

/// What a scene's parameters and inputs are at the start, by their names.
pub fn values(scene: &Scene) -> impl Fn(&str) -> Option<f64> {
    let told: General = scene.parameters().into();
    move |name| told.value(scene.variables.iter().find(|variable| variable.name == name)?.place)
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
