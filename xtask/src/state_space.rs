//! `state-space`: a machine about its steady state as matrices with names and units, for control design.

use crate::speeds::HIGHEST;
use crate::{linear_fmu, paths, python, run, scenes};
use anyhow::{Context, Result, ensure};
use nalgebra::{Dim, Matrix, RawStorage};
use serde_json::{Value, json};
use split_rotor_model::linear::{Machine, Quantity, StateSpace};
use split_rotor_model::scene::Scene;
use split_rotor_tools::doubts;
use std::iter::once;
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
    println!("{}\n{}", told(&scene, &space)?, file.display());
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

fn told(scene: &Scene, space: &StateSpace) -> Result<String> {
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
    for line in doubts::words(scene, [steady.speed; 2]) {
        told += &format!("\n{line}");
    }
    Ok(told)
}

fn json(scene: &Scene, space: &StateSpace) -> Value {
    let StateSpace { steady, states, inputs, outputs, directions, a, b, c, d, .. } = space;
    let names = |of: &[Quantity]| of.iter().map(|one| json!(one.name)).collect::<Value>();
    let units = |of: &[Quantity]| of.iter().map(|one| json!(one.unit.name)).collect::<Value>();
    let safe = |of: &[Quantity]| safe_names(of.iter().map(|one| &*one.name)).into_iter().collect::<Value>();
    let values = |of: &[Quantity]| of.iter().map(|one| json!(one.steady)).collect::<Value>();
    json!({
        "scene": scene.name,
        "title": scene.title,
        "speed_rad_s": steady.speed,
        "torque_N_m": steady.torque,
        "held": doubts::held(scene, [steady.speed; 2]),
        "state_names": names(states),
        "state_safe_names": safe(states),
        "state_units": units(states),
        "input_names": names(inputs),
        "input_safe_names": safe(inputs),
        "input_units": units(inputs),
        "output_names": names(outputs),
        "output_safe_names": safe(outputs),
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

/// Names that are identifiers, in the same order and each another one: programs such as python-control refuse names with a dot.
fn safe_names<'n>(names: impl Iterator<Item = &'n str>) -> Vec<String> {
    let mut safe = Vec::<String>::new();
    for name in names {
        let words: Vec<_> = name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
        let plain = words.join("_");
        let mut candidates = once(plain.clone()).chain((2..).map(|number| format!("{plain}_{number}")));
        safe.extend(candidates.find(|candidate| !safe.contains(candidate)));
    }
    safe
}

/// A matrix row by row.
fn rows<R: Dim, C: Dim>(matrix: &Matrix<f64, R, C, impl RawStorage<f64, R, C>>) -> Value {
    matrix.row_iter().map(|row| row.iter().map(|value| json!(value)).collect::<Value>()).collect()
}

#[cfg(test)]
mod tests {
    use super::{json, of, safe_names, told};
    use split_rotor_model::scene::Scene;
    use std::path::Path;

    #[test]
    fn regress_matrices_beyond_a_table_are_said_to_stand_on_held_coefficients() {
        let table = "[rotor]\nm = 5.0\nJa = 0.1\nJt = 0.12\n[[effects.bearing]]\nposition = 0.1\nspeed = [10, 90]\nkyy = [1e6, 2e6]\n";
        let scene = Scene::parse(Path::new("table.toml"), table).expect("a scene");
        let at = |speed: f64| {
            let space = of(&scene, Some(speed)).expect("matrices");
            (told(&scene, &space).expect("modes"), json(&scene, &space)["held"].to_string())
        };
        assert!(!at(50.0).0.contains("table") && at(50.0).1 == "[]");
        let (words, held) = at(100.0);
        assert!(words.contains("bearing[1]: speeds up to 100.0 rad/s") && held == "[\"bearing[1]\"]", "{words} {held}");
    }

    #[test]
    fn exact_safe_names_are_identifiers_and_differ() {
        let names = ["port[1].f.y", "bearing[2].kyy", "omega_phi", "a.b_c", "a_b.c", "a.b.c_2", "a.b.c"];
        let safe = ["port_1_f_y", "bearing_2_kyy", "omega_phi", "a_b_c", "a_b_c_2", "a_b_c_2_2", "a_b_c_3"];
        assert_eq!(safe_names(names.into_iter()), safe);
    }
}
