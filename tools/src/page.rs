//! documentation/index.html: what the model of one scene is, for the one who was handed the FMU.

use crate::{scenes, templates};
use anyhow::Result;
use minijinja::{Value, context};
use split_rotor_model::log::Category;
use split_rotor_model::scene::Scene;
use split_rotor_model::variable::{Kind, Place, Role};
use split_rotor_model::variables::{METHODS, Variable};

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
        general => scene.general,
        identifier => scene.identifier(),
        version => env!("CARGO_PKG_VERSION"),
        licence => env!("CARGO_PKG_LICENSE"),
        stop => number(scene.experiment.stop),
        step => number(scene.experiment.step),
        variables => scene.variables.iter().map(|variable| row(scene, variable)).collect::<Value>(),
        always => always.map(|variable| row(scene, variable)).collect::<Value>(),
        effects => effects.collect::<Value>(),
        methods => METHODS.items.iter().map(|&(number, name, what)| context! { number, name, what }).collect::<Value>(),
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
    use super::page;
    use crate::scenes;
    use split_rotor_model::effects::CATALOGUE;
    use std::collections::BTreeSet;

    #[test]
    fn each_text_has_its_effect() {
        let texts =
            std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../modelDescription/documentation/effects"))
                .unwrap();
        let texts: BTreeSet<_> = texts.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        let effects: BTreeSet<_> = CATALOGUE.iter().map(|info| format!("{}.html", info.name)).collect();
        let astray: Vec<_> = texts.difference(&effects).collect();
        assert!(astray.is_empty(), "no effect is called as {astray:?}");
    }

    /// Of each law: what only a page with `asymmetry`, with `unbalance` and with neither says.
    #[test]
    fn laws_are_those_of_the_scene() {
        let (even, of_c) = ("<i>φ</i>, on which nothing depends,", "½ <i>m</i> |<b>v</b><sub>c</sub>|²");
        let (asymmetric, of_g) = ("<i>φ</i>, which the motion follows", "½ <i>M</i> |<b>v</b><sub>G</sub>|²");
        let (on_c, on_g) = ("<b>g</b><sub>0</sub>·<b>r</b><sub>c</sub>", "<b>g</b><sub>0</sub>·<b>r</b><sub>G</sub>");
        let (axial, tensor) = ("1/<i>J</i><sub>a</sub>", "<b>J</b><sup>−1</sup>");
        let tensor_of_g = "<b>J</b><sub>G</sub><sup>−1</sup>";
        let switched = "while <code>asymmetry</code> or <code>unbalance</code> is on";
        let every = [even, of_c, asymmetric, of_g, on_c, on_g, axial, tensor, tensor_of_g, switched];
        for (scene, said) in [
            ("paper", vec![even, of_c, on_c, axial]),
            ("dzhanibekov", vec![asymmetric, of_c, tensor]),
            ("jeffcott", vec![asymmetric, of_g, tensor_of_g]),
            ("rotor", vec![asymmetric, of_g, on_g, tensor_of_g, switched]),
        ] {
            let page = page(&scenes::find(scene)).unwrap();
            let found: Vec<_> = every.into_iter().filter(|law| page.contains(law)).collect();
            assert_eq!(found, every.into_iter().filter(|law| said.contains(law)).collect::<Vec<_>>(), "{scene}");
        }
    }
}
