//! `ssv`: a scene as a parameter set of SSP 1.0 for the general FMU.

use crate::{paths, scenes};
use anyhow::{Context, Result};
use minijinja::{Value, context};
use split_rotor_model::scene::Scene;
use split_rotor_model::variable::{Kind, Role};
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

/// The parameter set of a scene for its own FMU: parameters and start values of inputs, with these switches on.
pub fn own(scene: &Scene, on: &[String]) -> Result<String> {
    let value = scenes::values(scene);
    let is_set = |variable: &&Variable| matches!(variable.meta.role, Role::Parameter { .. } | Role::Input { .. });
    let values = scene.variables.iter().filter(is_set).map(|variable| {
        let value = if on.contains(&variable.name) { Some(1.0) } else { value(&variable.name) };
        Ok((variable, value.with_context(|| format!("{} has no value", variable.name))?))
    });
    render(scene, &values.collect::<Result<Vec<_>>>()?)
}

/// The method by its name and by its number. The number is written: ecos 0.7.2 refuses an Enumeration.
const METHOD: &str = "solver.method";
const METHOD_NUMBER: &str = "solver.method_number";

fn render(scene: &Scene, values: &[(&Variable, f64)]) -> Result<String> {
    let method = values.iter().find(|(variable, _)| variable.name == METHOD).map_or(0.0, |(_, value)| *value);
    let values = values.iter().filter(|(variable, _)| variable.name != METHOD);
    let parameter = |(variable, value): &(&Variable, f64)| {
        let value = if variable.name == METHOD_NUMBER && *value == 0.0 { method } else { *value };
        let (kind, value) = match variable.meta.kind {
            Kind::Real => ("Real", format!("{value:?}")),
            Kind::Boolean => ("Boolean", (value != 0.0).to_string()),
            Kind::Integer | Kind::Enumeration(_) => ("Integer", value.to_string()),
        };
        context! { name => &variable.name, kind, value, unit => variable.meta.unit.name }
    };
    let context = context! {
        name => &scene.name,
        title => &scene.title,
        version => env!("CARGO_PKG_VERSION"),
        parameters => values.clone().map(parameter).collect::<Value>(),
        units => templates::units(values.map(|(variable, _)| variable.meta.unit)),
    };
    templates::render("ssv/parameters.xml", context)
}
