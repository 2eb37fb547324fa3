//! `state-space`: a machine about its steady state as matrices with names and units, for control design.

use crate::speeds::HIGHEST;
use crate::{linear_fmu, paths, python, run, scenes};
use anyhow::{Context, Result, ensure};
use nalgebra::{Dim, Matrix, RawStorage};
use serde_json::{Value, json};
use split_rotor_model::linear::{Machine, Quantity, StateSpace};
use split_rotor_model::scene::Scene;
use std::path::Path;

/// Writes the matrices of a scene at this speed [rad/s], or the one with which it starts, as JSON, as an FMU and for MATLAB into the folder
/// `out`, or target/state-space/SCENE.
pub fn state_space(scene: &str, speed: Option<f64>, out: Option<&Path>) -> Result<()> {
    let scene = scenes::find(scene)?;
    let space = of(&scene, speed)?;
    let folder = out.map_or_else(|| paths::target().join("state-space").join(&scene.name), Path::to_owned);
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let file = folder.join("state_space.json");
    std::fs::write(&file, serde_json::to_string_pretty(&json(&scene, &space))? + "\n")?;
    println!("{}\n{}", told(&space)?, file.display());
    println!("{}", linear_fmu::write(&scene, &space, &folder)?.display());
    let converter = paths::root().join("xtask/python/state_space.py");
    run::run(python::scipy()?.arg(converter).arg(std::path::absolute(&file)?))
        .with_context(|| format!("{}: there is no MATLAB file beside it", file.display()))?;
    println!("{}", file.with_extension("mat").display());
    Ok(())
}

/// The linear equations of a scene at this speed [rad/s], or at the one with which it starts.
pub fn of(scene: &Scene, speed: Option<f64>) -> Result<StateSpace> {
    let file = || scene.file.display().to_string();
    let speed = speed.unwrap_or_else(|| speed_at_start(scene));
    ensure!(speed.abs() <= HIGHEST, "--speed {speed}: must be within ±{HIGHEST:e} rad/s");
    let machine = Machine::of(&scene.parameters()).with_context(file)?;
    machine.state_space(speed, None).with_context(file)
}

/// That of a shaft that turns it, or its own [rad/s].
fn speed_at_start(scene: &Scene) -> f64 {
    let value = scenes::values(scene);
    // In a general scene an effect may be off.
    let is_off = value("effects.imposed_speed") == Some(0.0);
    value("imposed_speed.w").filter(|_| !is_off).or(value("start.omega.x")).unwrap_or_default()
}

fn told(space: &StateSpace) -> Result<String> {
    let StateSpace { steady, states, inputs, outputs, .. } = space;
    let [states, inputs, outputs] = [states, inputs, outputs].map(Vec::len);
    let mut told = format!(
        "{states} states, {inputs} inputs, {outputs} outputs at {} rad/s, drives off, the spin held",
        steady.speed
    );
    if inputs == 0 {
        told += "\nno inputs: forces and moments come in at an [[effects.port]]";
    }
    if !steady.is_held {
        told += "\nnothing holds the rotor in some direction: A is singular";
    }
    if steady.modes()?.iter().any(|mode| mode.grows()) {
        told += "\na mode grows: the steady state is unstable";
    }
    Ok(told)
}

fn json(scene: &Scene, space: &StateSpace) -> Value {
    let StateSpace { steady, states, inputs, outputs, directions, a, b, c, d, .. } = space;
    let names = |of: &[Quantity]| of.iter().map(|one| json!(one.name)).collect::<Value>();
    let units = |of: &[Quantity]| of.iter().map(|one| json!(one.unit.name)).collect::<Value>();
    let values = |of: &[Quantity]| of.iter().map(|one| json!(one.steady)).collect::<Value>();
    json!({
        "scene": scene.name,
        "title": scene.title,
        "speed_rad_s": steady.speed,
        "torque_N_m": steady.torque,
        "state_names": names(states),
        "state_units": units(states),
        "input_names": names(inputs),
        "input_units": units(inputs),
        "output_names": names(outputs),
        "output_units": units(outputs),
        "x0": values(states),
        "u0": values(inputs),
        "y0": values(outputs),
        "directions": rows(directions),
        "A": rows(a),
        "B": rows(b),
        "C": rows(c),
        "D": rows(d),
    })
}

/// A matrix row by row.
fn rows<R: Dim, C: Dim>(matrix: &Matrix<f64, R, C, impl RawStorage<f64, R, C>>) -> Value {
    matrix.row_iter().map(|row| row.iter().map(|value| json!(value)).collect::<Value>()).collect()
}
