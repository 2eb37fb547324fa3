//! documentation/index.html: what the model of one scene is, for the one who was handed the FMU.

use crate::{scenes, templates};
use anyhow::Result;
use minijinja::{Value, context};
use model::log::Category;
use model::scene::Scene;
use model::variable::{Kind, Place, Role};
use model::variables::{METHODS, Variable};

/// The scene's documentation page.
pub fn page(scene: &Scene) -> Result<String> {
    let always = scene.variables.iter().filter(|variable| variable.place.block < Place::FIRST_EFFECT);
    let effects = scene.effects.iter().map(|(info, index)| {
        let variables: Value = scenes::variables_of(scene, info, *index).map(|variable| row(scene, variable)).collect();
        context! { name => info.name, number => info.number, variables }
    });
    let values = context! {
        title => &scene.title,
        name => &scene.name,
        identifier => scene.identifier(),
        version => env!("CARGO_PKG_VERSION"),
        licence => env!("CARGO_PKG_LICENSE"),
        stop => number(scene.experiment.stop),
        step => number(scene.experiment.step),
        variables => scene.variables.iter().map(|variable| row(scene, variable)).collect::<Value>(),
        always => always.map(|variable| row(scene, variable)).collect::<Value>(),
        effects => effects.collect::<Value>(),
        methods => METHODS.items.iter().map(|&(_, name, what)| context! { name, what }).collect::<Value>(),
        categories => Category::EACH.map(Category::words).map(|(name, what)| context! { name, what }).to_vec(),
    };
    templates::render("documentation/index.html", values)
}

/// A variable as the page's tables show it.
fn row(scene: &Scene, variable: &Variable) -> Value {
    let Variable { name, place, meta } = variable;
    let reference = place.value_reference();
    let (causality, bound) = match meta.role {
        // The page says once that every number must be finite.
        Role::Parameter { bound, .. } => ("parameter", Some(bound.words(meta.kind).replace("a finite number", ""))),
        Role::Input { .. } => ("input", None),
        Role::Output => ("output", None),
        Role::State | Role::Mode => ("local", None),
    };
    let (start, bound) = match (scene.starts.get(&reference), meta.kind) {
        (None, _) => (None, bound),
        (Some(value), Kind::Real) => (Some(number(*value)), bound),
        (Some(value), Kind::Integer) => (Some(value.to_string()), bound),
        (Some(value), Kind::Boolean) => (Some((*value != 0.0).to_string()), Some(String::new())),
        (Some(value), Kind::Enumeration(of)) => (Some(value.to_string()), Some(of.words())),
    };
    let (unit, description) = (meta.unit.name, meta.description);
    context! { name, block => place.block, reference, causality, unit, start, bound, description }
}

/// A number that reads back to the same bits, as in modelDescription.xml.
fn number(value: f64) -> String {
    format!("{value:?}")
}

#[cfg(test)]
mod tests {
    use crate::paths;
    use model::effects::CATALOGUE;
    use std::collections::BTreeSet;

    #[test]
    fn exact_each_effect_has_its_text_and_each_text_its_effect() {
        let texts = std::fs::read_dir(paths::root().join("modelDescription/documentation/effects")).unwrap();
        let texts: BTreeSet<_> = texts.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        let effects: BTreeSet<_> = CATALOGUE.iter().map(|info| format!("{}.html", info.name)).collect();
        assert_eq!(texts, effects);
    }
}
