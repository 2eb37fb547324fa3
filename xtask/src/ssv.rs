//! `ssv`: a scene as a parameter set of SSP 1.0 for the general FMU.

use crate::{paths, scenes};
use anyhow::{Context, Result};
use minijinja::{Value, context};
use split_rotor_model::scene::Scene;
use split_rotor_model::variable::Kind;
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
        let (kind, value) = match variable.meta.kind {
            Kind::Real => ("Real", format!("{value:?}")),
            Kind::Boolean => ("Boolean", (*value != 0.0).to_string()),
            Kind::Integer | Kind::Enumeration(_) => ("Integer", value.to_string()),
        };
        context! { name => &variable.name, kind, value, unit => variable.meta.unit.name }
    };
    let context = context! {
        name => &scene.name,
        title => &scene.title,
        version => env!("CARGO_PKG_VERSION"),
        parameters => values.iter().map(parameter).collect::<Value>(),
        units => templates::units(values.iter().map(|(variable, _)| variable.meta.unit)),
    };
    templates::render("ssv/parameters.xml", context)
}
