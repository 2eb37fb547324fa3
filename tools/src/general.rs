//! A scene over the library of the general one, which holds every effect behind a switch: its FMU needs no compiler.

use anyhow::{Context, Result, anyhow};
use split_rotor_model::scene::Scene;
use split_rotor_model::simulation::General;
use split_rotor_model::variable::{Place, Role};
use split_rotor_model::variables::Variable;
use split_rotor_model::{section, xml};

/// The scene whose FMU has every effect.
pub const GENERAL: &str = "rotor";

/// A scene as the general library runs it, and a copy of that library with its values. The scene shows the states and indicators of all
/// effects, for a host in model exchange asks for them all; of those that are off they stay as they are.
pub fn over(general: &Scene, mut library: Vec<u8>, mut scene: Scene) -> Result<(Scene, Vec<u8>)> {
    let mut starts = general.starts.clone();
    starts.extend(
        values(general, &scene)?.into_iter().map(|(variable, value)| (variable.place.value_reference(), value)),
    );
    let is_there = |place: Place| scene.variables.iter().any(|variable| variable.place == place);
    let is_state = |variable: &&Variable| matches!(variable.meta.role, Role::State);
    let states = general.variables.iter().filter(is_state).filter(|state| !is_there(state.place));
    let states: Vec<_> = states.cloned().collect();
    scene.variables.extend(states);
    scene.indicators = general.indicators;
    let section = section::find(&mut library, &general.list(), general.room());
    let section = section.map_err(|wrong| anyhow!("the general library: {wrong}"))?;
    section::fill(section, &xml::guid(&scene), &starts);
    Ok((scene, library))
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
    format!(
        "the general FMU has no {name} (two of a kind at most, and no tables or housings): package the scene itself"
    )
}
