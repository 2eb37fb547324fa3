//! What a scene holds, by name.

use split_rotor_model::effects::Info;
use split_rotor_model::scene::Scene;
use split_rotor_model::simulation::General;
use split_rotor_model::variable::Place;
use split_rotor_model::variables::Variable;

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

/// A scene of the project.
#[cfg(test)]
pub fn find(name: &str) -> Scene {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    Scene::find(name, &folder).unwrap_or_else(|error| panic!("{error}"))
}
