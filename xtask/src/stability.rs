//! `stability`: where a machine begins to whirl by itself, against a parameter and the spin.

mod picture;
mod table;

use crate::{scenes, sheets, speeds};
use anyhow::{Context, Result, ensure};
use serde_json::json;
use split_rotor_model::linear::{Campbell, Crossing, Machine};
use split_rotor_model::scene::Scene;
use split_rotor_model::variable::Role;
use split_rotor_model::variables::Variable;

/// What the command found.
struct Map {
    scene: Scene,
    /// The parameter and its unit.
    name: String,
    unit: &'static str,
    /// Speeds that were looked at [rad/s].
    speeds: Vec<f64>,
    /// By the parameter's value.
    columns: Vec<Column>,
}

/// A value of the parameter.
struct Column {
    value: f64,
    /// At each speed, whether a mode grows.
    grows: Vec<bool>,
    /// Where one begins or ceases to.
    thresholds: Vec<Crossing>,
}

impl Map {
    /// Its name and unit, as a picture and a table have it.
    fn label(&self) -> String {
        format!("{} [{}]", self.name, if self.unit.is_empty() { "1" } else { self.unit })
    }
}

/// The parameter of a map: its name, the first and the last value, and how many.
pub struct Against<'a> {
    pub name: &'a str,
    pub values: [f64; 2],
    pub count: u32,
}

/// Finds the map of a scene against a parameter, between these speeds [rad/s], looked at so many.
pub fn stability(scene: &str, against: &Against, ends: Option<&[f64]>, steps: u32) -> Result<()> {
    let scene = scenes::find(scene)?;
    let map = map(scene, against, ends, steps)?;
    let (table, rows) = (table::table(&map), rows(&map));
    let json = json!({
        "scene": map.scene.name,
        "title": map.scene.title,
        "parameter": map.name,
        "unit": map.unit,
        "thresholds": sheets::objects(rows.clone()),
    });
    let folder = format!("stability/{}", map.scene.name);
    sheets::leave(&folder, "stability", &table, &rows, &json, &[("stability.svg", picture::svg(&map)?)])?.show();
    Ok(())
}

fn map(scene: Scene, against: &Against, ends: Option<&[f64]>, steps: u32) -> Result<Map> {
    let Against { name, values: [from, to], count } = *against;
    let file = scene.file.display().to_string();
    ensure!(
        from < to && from.is_finite() && to.is_finite(),
        "--values {from} {to}: the second must be more than the first"
    );
    ensure!(count >= 2, "--count {count}: at least 2 values are needed");
    let variable = parameter(&scene, name).with_context(|| file.clone())?;
    let machine = |value: f64| {
        let mut parameters = scene.parameters();
        parameters.begin_with(variable.place, value);
        Machine::of(&parameters).with_context(|| format!("{file}: {name} = {value:?}"))
    };
    let speeds = speeds::range(&scene, Some(&machine(from)?), ends, steps).with_context(|| file.clone())?;
    let column = |n: u32| {
        let value = from + (to - from) * f64::from(n) / f64::from(count - 1);
        let machine = machine(value)?;
        let here = || format!("{file}: {name} = {value:?}");
        let campbell = Campbell::of(&machine, &speeds).with_context(here)?;
        let points = || campbell.branches.iter().flat_map(|branch| &branch.points);
        let grows = |speed: &f64| points().any(|point| point.speed == *speed && point.mode.grows());
        let grows = speeds.iter().map(grows).collect();
        Ok(Column { value, grows, thresholds: campbell.thresholds().with_context(here)? })
    };
    let columns = (0..count).map(column).collect::<Result<_>>()?;
    let (name, unit) = (name.to_owned(), variable.meta.unit.name);
    Ok(Map { name, unit, speeds, columns, scene })
}

/// A parameter of the rotor or of its effects.
fn parameter<'s>(scene: &'s Scene, name: &str) -> Result<&'s Variable> {
    let is_number = |variable: &&Variable| {
        matches!(variable.meta.role, Role::Parameter { .. })
            && !["start.", "solver."].iter().any(|block| variable.name.starts_with(block))
    };
    let known = || scene.variables.iter().filter(is_number);
    known().find(|variable| variable.name == name).with_context(|| {
        let names: Vec<_> = known().map(|variable| &*variable.name).collect();
        format!("--against {name}: no such parameter; it can be {}", names.join(", "))
    })
}

/// A row for each threshold.
fn rows(map: &Map) -> Vec<sheets::Row> {
    let all = map.columns.iter().flat_map(|column| column.thresholds.iter().map(move |at| (column.value, at)));
    let row = |(value, at): (f64, &Crossing)| {
        vec![
            ("value", json!(value)),
            ("speed_rad_s", json!(at.speed)),
            ("frequency_rad_s", json!(at.mode.frequency())),
            ("direction", json!(at.mode.direction.name())),
        ]
    };
    all.map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    const INNER: &str = "[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.0\n[effects.support]\nc1 = 2000.0\nc2 = 500.0\nd1 = 30.0\nd2 = 1.0\n\
                         [effects.rotating_damping]\nd = 10.0\n";

    fn scene() -> Scene {
        Scene::parse(Path::new("inner.toml"), INNER).expect("a scene")
    }

    #[test]
    fn thresholds_against_a_damper_are_those_of_the_closed_form() {
        let against = Against { name: "support.d1", values: [10.0, 50.0], count: 9 };
        let map = map(scene(), &against, Some(&[0.0, 200.0]), 21).expect("a map");
        for column in &map.columns {
            // Beyond ω_n (1 + c_ext/c_int) it whirls by itself.
            let exact = 20.0 * (1.0 + column.value / 10.0);
            let [threshold] = &column.thresholds[..] else { panic!("{:?}", column.thresholds) };
            assert!((threshold.speed / exact - 1.0).abs() < 1e-11, "{} for {exact} rad/s", threshold.speed);
            for (speed, grows) in map.speeds.iter().zip(&column.grows) {
                assert!(*grows == (*speed > exact) || (speed - exact).abs() < 1e-9, "at {speed} rad/s");
            }
        }
    }

    #[test]
    fn a_parameter_that_is_not_there_is_named_with_those_that_are() {
        let error = |name, values| {
            let against = Against { name, values, count: 3 };
            format!("{:#}", map(scene(), &against, None, 11).err().expect("no map"))
        };
        let unknown = error("support.d3", [0.0, 1.0]);
        assert!(
            unknown.starts_with("inner.toml: --against support.d3: no such parameter; it can be rotor.m, "),
            "{unknown}"
        );
        let negative = error("support.d1", [-1.0, 1.0]);
        assert!(negative.contains("support.d1 = -1.0") && negative.contains("it must be"), "{negative}");
    }
}
