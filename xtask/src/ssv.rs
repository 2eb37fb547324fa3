//! `ssv`: a scene as a parameter set of SSP 1.0 for the general FMU.

use crate::{paths, scenes, templates};
use anyhow::{Context, Result};
use minijinja::{Value, context};
use split_rotor_model::scene::Scene;
use split_rotor_model::simulation::General;
use split_rotor_model::variable::{Kind, Role};
use split_rotor_model::variables::Variable;
use std::path::Path;

/// The scene whose FMU has every effect.
const GENERAL: &str = "rotor";

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

/// What a general FMU must be told to be this scene: which effects act, each parameter, and what each input is until somebody sets it.
pub fn values<'g>(general: &'g Scene, scene: &Scene) -> Result<Vec<(&'g Variable, f64)>> {
    let told: General = scene.parameters().into();
    let is_set = |variable: &&Variable| matches!(variable.meta.role, Role::Parameter { .. } | Role::Input { .. });
    let of_scene = scene.variables.iter().filter(is_set).map(|variable| {
        let same = general.variables.iter().find(|own| own.place == variable.place);
        let same = same.with_context(|| lacking(&variable.name))?;
        Ok((same, told.value(variable.place).context("a parameter has a value")?))
    });
    let switches = general.effects.iter().filter(|_| !scene.general).map(|(info, index)| {
        let name = info.switch_name(*index);
        let switch = general.variables.iter().find(|variable| variable.name == name);
        let acts = scene.effects.iter().any(|(called, number)| (called.number, number) == (info.number, index));
        Ok((switch.with_context(|| format!("the general FMU has no {name}"))?, f64::from(u8::from(acts))))
    });
    switches.chain(of_scene).collect()
}

/// Why there is no parameter set, and what to do.
fn lacking(name: &str) -> String {
    format!("the general FMU has no {name} (two of a kind at most, and no tables): package the scene itself")
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
