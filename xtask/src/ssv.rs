//! `ssv`: a scene as a parameter set of SSP 1.0 for the general FMU.

use crate::{paths, scenes};
use anyhow::{Context, Result};
use minijinja::{Value, context};
use split_rotor_model::scene::Scene;
use split_rotor_model::variable::{Enumeration, Kind};
use split_rotor_model::variables::Variable;
use split_rotor_tools::general::{GENERAL, values};
use split_rotor_tools::templates;
use std::path::Path;

/// Writes the parameter set of a scene into the folder `out`, or target/ssv.
pub fn ssv(scene: &str, out: Option<&Path>) -> Result<()> {
    let (scene, general) = (scenes::find(scene)?, scenes::find(GENERAL)?);
    let values = values(&general, &scene).with_context(|| scene.file.display().to_string())?;
    let folder = out.map_or_else(|| paths::target().join("ssv"), Path::to_owned);
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let file = folder.join(format!("{}.ssv", scene.name));
    std::fs::write(&file, render(&scene, &values)?)?;
    println!("{}", file.display());
    Ok(())
}

fn render(scene: &Scene, values: &[(&Variable, f64)]) -> Result<String> {
    let parameter = |(variable, value): &(&Variable, f64)| {
        let mut of = None;
        let (kind, value) = match variable.meta.kind {
            Kind::Real => ("Real", format!("{value:?}")),
            Kind::Boolean => ("Boolean", (*value != 0.0).to_string()),
            Kind::Integer => ("Integer", value.to_string()),
            Kind::Enumeration(enumeration) => {
                of = Some(enumeration.name);
                let item = enumeration.items.iter().find(|item| f64::from(item.0) == *value);
                ("Enumeration", item.map_or_else(String::new, |item| item.1.to_owned()))
            }
        };
        context! { name => &variable.name, kind, value, unit => variable.meta.unit.name, of }
    };
    let enumerations = values.iter().filter_map(|(variable, _)| match variable.meta.kind {
        Kind::Enumeration(of) => Some(of),
        _ => None,
    });
    let enumeration = |of: &Enumeration| {
        let items: Vec<_> = of.items.iter().map(|&(value, name, _)| context! { name, value }).collect();
        context! { name => of.name, items }
    };
    let context = context! {
        name => &scene.name,
        title => &scene.title,
        version => env!("CARGO_PKG_VERSION"),
        parameters => values.iter().map(parameter).collect::<Value>(),
        enumerations => enumerations.map(enumeration).collect::<Value>(),
        units => templates::units(values.iter().map(|(variable, _)| variable.meta.unit)),
    };
    templates::render("ssv/parameters.xml", context)
}
