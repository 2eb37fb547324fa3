//! `stability`: where a machine begins to whirl by itself, against one or two parameters and the spin.

mod picture;
mod plane;
mod table;

use crate::{known, scenes, sheets, speeds};
use anyhow::{Context, Result, anyhow, ensure};
use serde_json::json;
use split_rotor_model::linear::{Campbell, Crossing, Machine};
use split_rotor_model::scene::{Given, Scene};
use split_rotor_model::variable::{Place, Role};
use split_rotor_model::variables::Variable;
use split_rotor_tools::doubts;
use std::path::Path;

/// What the command found against one parameter.
struct Map {
    scene: Scene,
    against: Axis,
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

/// A parameter and its values.
struct Axis {
    name: String,
    unit: &'static str,
    place: Place,
    values: Vec<f64>,
}

impl Axis {
    /// `against` in this scene.
    fn of(scene: &Scene, Against { name, values: [first, last], count }: &Against) -> Result<Self> {
        let variable = parameter(scene, name)?;
        let values = Given::pair([first, last], variable.meta.unit);
        let [from, to] = values.map_err(|wrong| anyhow!("--values {wrong}"))?;
        ensure!(from < to, "--values {first} {last}: the second must be more than the first");
        ensure!(*count >= 2, "--count {count}: at least 2 values are needed");
        let value = |n: u32| from + (to - from) * f64::from(n) / f64::from(count - 1);
        let values = (0..*count).map(value).collect();
        Ok(Self { name: (*name).to_owned(), unit: variable.meta.unit.name, place: variable.place, values })
    }

    /// Its name and unit, as a picture and a table have it.
    fn label(&self) -> String {
        format!("{} [{}]", self.name, if self.unit.is_empty() { "1" } else { self.unit })
    }
}

/// The parameter of a map: its name, the first and the last value, and how many.
pub struct Against<'a> {
    pub name: &'a str,
    pub values: [Given; 2],
    pub count: u32,
}

/// Finds the map of a scene against one parameter or two, between these speeds [rad/s], looked at so many. Into the folder `out`, or
/// target/stability/SCENE.
pub fn stability(
    scene: &str,
    against: &[Against],
    ends: Option<[f64; 2]>,
    steps: u32,
    out: Option<&Path>,
) -> Result<()> {
    let scene = scenes::find(scene)?;
    match against {
        [one] => map(scene, one, ends, steps)?.leave(out),
        [one, other] => plane::plane(scene, [one, other], ends, steps)?.leave(out),
        _ => anyhow::bail!("--against: one parameter or two, each with its own --values FROM TO"),
    }
}

impl Map {
    fn leave(&self, out: Option<&Path>) -> Result<()> {
        let (table, rows) = (table::table(self), rows(self));
        let json = json!({
            "scene": self.scene.name,
            "title": self.scene.title,
            "parameter": self.against.name,
            "unit": self.against.unit,
            "tables": doubts::tables(&self.scene),
            "thresholds": sheets::objects(rows.clone()),
        });
        leave(&self.scene, out, &table, &rows, &json, picture::svg(self)?)
    }
}

/// Table, rows, all of it and the picture.
fn leave(
    scene: &Scene,
    out: Option<&Path>,
    table: &str,
    rows: &[sheets::Row],
    all: &serde_json::Value,
    svg: String,
) -> Result<()> {
    let folder = sheets::folder(out, &format!("stability/{}", scene.name))?;
    sheets::leave(folder, "stability", table, rows, all, &[("stability.svg", svg)])?.show();
    Ok(())
}

fn map(scene: Scene, against: &Against, ends: Option<[f64; 2]>, steps: u32) -> Result<Map> {
    let file = || scene.file.display().to_string();
    let against = Axis::of(&scene, against).with_context(file)?;
    let first = machine(&scene, &[(&against, against.values[0])])?;
    let speeds = speeds::range(&scene, Some(&first), ends, steps).with_context(file)?;
    let columns =
        against.values.iter().map(|&value| column(&scene, &[(&against, value)], &speeds)).collect::<Result<_>>()?;
    Ok(Map { against, speeds, columns, scene })
}

/// The scene's machine with these values.
fn machine(scene: &Scene, with: &[(&Axis, f64)]) -> Result<Machine> {
    let mut parameters = scene.parameters();
    for (axis, value) in with {
        parameters.begin_with(axis.place, *value);
    }
    Machine::of(&parameters).with_context(|| told(scene, with))
}

/// What it is that cannot be.
fn told(scene: &Scene, with: &[(&Axis, f64)]) -> String {
    let values: Vec<_> = with.iter().map(|(axis, value)| format!("{} = {value:?}", axis.name)).collect();
    format!("{}: {}", scene.file.display(), values.join(", "))
}

/// That a coefficient is added to its table, where the scene has one.
fn added(scene: &Scene, axis: &Axis) -> String {
    let value = scenes::values(scene);
    let is_table = (1..).map_while(|n| value(&format!("{}[{n}]", axis.name))).any(|node| node != 0.0);
    if is_table { format!("\n{} is added to its table at every speed.\n", axis.name) } else { String::new() }
}

/// Where the scene with these values, of which the first is the column's, is unstable.
fn column(scene: &Scene, with: &[(&Axis, f64)], speeds: &[f64]) -> Result<Column> {
    let here = || told(scene, with);
    let machine = machine(scene, with)?;
    let campbell = Campbell::of(&machine, speeds).with_context(here)?;
    let grows = |speed: &f64| campbell.at(*speed).any(|(_, mode)| mode.grows());
    let grows = speeds.iter().map(grows).collect();
    Ok(Column { value: with[0].1, grows, thresholds: campbell.thresholds().with_context(here)? })
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
        let meant = known::meant(name, names.iter().copied());
        format!("--against {name}: no such parameter{meant}; it can be {}", names.join(", "))
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

    pub(super) fn scene() -> Scene {
        Scene::parse(Path::new("inner.toml"), INNER).expect("a scene")
    }

    #[test]
    fn thresholds_against_a_damper_are_those_of_the_closed_form() {
        let against = Against { name: "support.d1", values: [10.0, 50.0].map(Given::from), count: 9 };
        let map = map(scene(), &against, Some([0.0, 200.0]), 21).expect("a map");
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
    fn exact_values_may_have_units() {
        let axis = |name, values: [&str; 2]| {
            let against = Against { name, values: values.map(Given::new), count: 2 };
            Axis::of(&scene(), &against).map(|axis| axis.values).map_err(|error| error.to_string())
        };
        assert_eq!(axis("support.c1", ["1 N/mm", "2 kN/m"]), Ok(vec![1e3, 2e3]));
        assert_eq!(
            axis("support.c1", ["1", "2 kN/m"]),
            Err("--values 1 \"2 kN/m\": 1 has no unit and \"2 kN/m\" has one: give both the same".into())
        );
        let wrong = axis("support.c1", ["1 kg", "2 kg"]).unwrap_err();
        assert_eq!(wrong, "--values \"1 kg\" is a mass: a number in N/m is needed, or one with such a unit");
    }

    #[test]
    fn regress_an_unstable_rotor_is_not_called_stable() {
        let text = "[rotor]\nm = 6.0\nJa = 0.01\nJt = 0.06\n[start]\nomega.x = 100.0\n\
            [[effects.bearing]]\nposition = 0.15\nkyy = -2e5\nkzz = -2e5\n";
        let scene = Scene::parse(Path::new("unseen.toml"), text).expect("a scene");
        let against = Against { name: "bearing[1].kyy", values: [-2e5, -1e5].map(Given::from), count: 3 };
        let map = map(scene, &against, Some([50.0, 500.0]), 21).expect("a map");
        assert!(map.columns.iter().all(|column| column.grows.iter().all(|grows| *grows)));
        let table = table::table(&map);
        assert!(table.contains("at all these speeds") && !table.contains("none of these"), "{table}");
    }

    /// Cross stiffness at one of two bearings, without damping: at standstill one mode grows, beyond it two. Two rows had a threshold at 0.
    #[test]
    fn regress_the_first_speed_is_no_threshold_where_a_mode_grows_already() {
        let bearing = |at: &str, cross: f64| {
            format!(
                "[[effects.bearing]]\nposition = {at}\nkyy = 16842.7\nkzz = 16842.7\nkyz = {cross:?}\nkzy = {:?}\n",
                -cross
            )
        };
        let text =
            format!("[rotor]\nm = 6.0\nJa = 0.1\nJt = 0.06\n{}{}", bearing("0.1", 0.0), bearing("-0.1", 16842.7));
        let scene = Scene::parse(Path::new("cross.toml"), &text).expect("a scene");
        let against = Against { name: "bearing[1].kyz", values: [0.0, 3368.5].map(Given::from), count: 3 };
        let map = map(scene, &against, Some([0.0, 628.0]), 61).expect("a map");
        let at_first = |column: &&Column| column.thresholds.iter().any(|at| at.speed < 1e-6);
        assert!(map.columns.iter().any(|column| at_first(&column)), "no threshold is at the first speed");
        let table = table::table(&map);
        let rows: Vec<_> = table.lines().filter(|line| line.starts_with("| ")).collect();
        assert!(rows.iter().all(|row| !row.contains("on both sides | 0 |")), "{table}");
        assert!(rows.windows(2).all(|pair| pair[0] != pair[1]), "{table}");
    }

    #[test]
    fn regress_a_coefficient_is_said_to_be_added_to_its_table() {
        let text = "[rotor]\nm = 10.0\nJa = 0.1\nJt = 0.2\n[[effects.bearing]]\nposition = 0.0\nspeed = [100, 300]\nkyy = [1e6, 1e6]\nkzz = [1e6, 1e6]\n\
            cyy = [100, 100]\nczz = 100.0\nkxx = 1e6\nkt = 1e5\n";
        let scene = || Scene::parse(Path::new("table.toml"), text).expect("a scene");
        for (name, is_added) in [("bearing[1].cyy", true), ("bearing[1].czz", false)] {
            let against = Against { name, values: [50.0, 400.0].map(Given::from), count: 2 };
            let table = table::table(&map(scene(), &against, Some([350.0, 500.0]), 4).expect("a map"));
            assert_eq!(table.contains(&format!("{name} is added to its table at every speed.")), is_added, "{table}");
            assert!(table.contains("at none of these speeds * |"), "{table}");
        }
    }

    #[test]
    fn a_parameter_that_is_not_there_is_named_with_those_that_are() {
        let error = |name, values: [f64; 2]| {
            let values = values.map(Given::from);
            let against = Against { name, values, count: 3 };
            format!("{:#}", map(scene(), &against, None, 11).err().expect("no map"))
        };
        let unknown = error("support.d3", [0.0, 1.0]);
        assert!(
            unknown.starts_with(
                "inner.toml: --against support.d3: no such parameter (did you mean `support.d1` or `support.d2`?); it can be rotor.m, "
            ),
            "{unknown}"
        );
        let negative = error("support.d1", [-1.0, 1.0]);
        assert!(negative.contains("support.d1 = -1.0") && negative.contains("it must be"), "{negative}");
    }
}
