//! Against two parameters: the lowest speed at which a mode grows.

use super::{Against, Axis, Column, added, column, leave, machine};
use crate::numbers::{rounded, spread};
use crate::{chart, sheets, speeds};
use anyhow::{Context, Result, ensure};
use plotters::prelude::*;
use serde_json::json;
use split_rotor_model::scene::Scene;
use split_rotor_tools::doubts;
use std::path::Path;

/// What the command found.
pub(super) struct Plane {
    scene: Scene,
    axes: [Axis; 2],
    /// The first and the last speed [rad/s].
    ends: [f64; 2],
    /// How many were looked at.
    count: usize,
    /// By the value of the second parameter, then of the first: the lowest speed at which a mode grows [rad/s], where there is one.
    rows: Vec<Vec<Option<f64>>>,
}

/// So many values of each parameter are shown in the table.
const SHOWN: usize = 7;

/// So many shades the speeds have, the lowest the darkest.
const SHADES: usize = 6;

pub(super) fn plane(scene: Scene, against: [&Against; 2], ends: Option<[f64; 2]>, steps: u32) -> Result<Plane> {
    let file = || scene.file.display().to_string();
    ensure!(against[0].name != against[1].name, "--against {}: twice the same parameter", against[0].name);
    let [first, second] = against.map(|one| Axis::of(&scene, one).with_context(file));
    let axes = [first?, second?];
    let at = |x: f64, y: f64| [(&axes[0], x), (&axes[1], y)];
    let machine = machine(&scene, &at(axes[0].values[0], axes[1].values[0]))?;
    let speeds = speeds::range(&scene, Some(&machine), ends, steps).with_context(file)?;
    let cell = |x: f64, y: f64| Ok(lowest(&column(&scene, &at(x, y), &speeds)?, &speeds));
    let row = |&y: &f64| axes[0].values.iter().map(|&x| cell(x, y)).collect::<Result<_>>();
    let rows = axes[1].values.iter().map(row).collect::<Result<_>>()?;
    Ok(Plane { ends: [speeds[0], speeds[speeds.len() - 1]], count: speeds.len(), scene, axes, rows })
}

/// The lowest speed [rad/s] at which a mode grows.
fn lowest(column: &Column, speeds: &[f64]) -> Option<f64> {
    if column.grows[0] {
        return Some(speeds[0]);
    }
    column.thresholds.iter().map(|at| at.speed).reduce(f64::min)
}

impl Plane {
    pub(super) fn leave(&self, out: Option<&Path>) -> Result<()> {
        let rows = self.cells();
        let json = json!({
            "scene": self.scene.name,
            "title": self.scene.title,
            "parameters": self.axes.each_ref().map(|axis| json!({ "name": axis.name, "unit": axis.unit })),
            "tables": doubts::tables(&self.scene),
            "lowest_unstable": sheets::objects(rows.clone()),
        });
        leave(&self.scene, out, &self.table(), &rows, &json, self.svg()?)
    }

    /// A row for each pair of values.
    fn cells(&self) -> Vec<sheets::Row> {
        let [x, y] = &self.axes;
        let row = |(y, row): (&f64, &Vec<Option<f64>>)| {
            let cell = |(x, speed): (&f64, &Option<f64>)| {
                vec![("value", json!(x)), ("second_value", json!(y)), ("speed_rad_s", json!(speed))]
            };
            x.values.iter().zip(row).map(cell).collect::<Vec<_>>()
        };
        y.values.iter().zip(&self.rows).flat_map(row).collect()
    }

    fn table(&self) -> String {
        let Self { scene, axes: [x, y], ends, count, .. } = self;
        let [from, to] = ends.map(rounded);
        let columns: Vec<_> = spread(x.values.len(), SHOWN).collect();
        let line = |first: String, cells: &mut dyn Iterator<Item = String>| {
            format!("| {first} | {} |\n", cells.collect::<Vec<_>>().join(" | "))
        };
        let mut text = format!("{}: {}\n\n", scene.name, scene.title);
        text += &format!(
            "Lowest speed [rad/s] at which a mode grows. Balanced, drives off, the spin held; looked at {count} speeds from {from} to {to} rad/s.\n\n"
        );
        let head = format!("{} down, {} across", y.label(), x.label());
        text += &line(head, &mut columns.iter().map(|&n| rounded(x.values[n])));
        text += &format!("|--:|{}\n", "--:|".repeat(columns.len()));
        let none = || format!("none{}", doubts::mark_within(scene, *ends));
        for n in spread(y.values.len(), SHOWN) {
            let cell = |&m: &usize| self.rows[n][m].map_or_else(none, |speed| doubts::marked(scene, speed));
            text += &line(rounded(y.values[n]), &mut columns.iter().map(cell));
        }
        text += &self.axes.each_ref().map(|axis| added(scene, axis)).concat();
        doubts::below(text, scene, ends)
    }

    /// As SVG: a shade for each range of speeds.
    fn svg(&self) -> Result<String> {
        let speeds = || self.rows.iter().flatten().flatten().copied();
        let [low, high] = [speeds().fold(f64::INFINITY, f64::min), speeds().fold(f64::NEG_INFINITY, f64::max)];
        let width = (high - low) / SHADES as f64;
        let shade = |speed: f64| (((speed - low) / width) as usize).min(SHADES - 1);
        let ink = |shade: usize| chart::ORANGE.mix(0.9 - 0.8 * shade as f64 / SHADES as f64);
        let title = format!("{}: lowest unstable speed [rad/s]", self.scene.title);
        chart::square(&title, |area| {
            let [x, y] = self.axes.each_ref().map(|axis| axis.values[0]..axis.values[axis.values.len() - 1]);
            let [x_name, y_name] = self.axes.each_ref().map(Axis::label);
            let mut axes = chart::axes_of(area, "", (x, &x_name), (y, &y_name))?;
            // Where nothing is unstable, there is nothing to fill.
            for n in 0..if low <= high { SHADES } else { 0 } {
                let cells = self.rows.iter().enumerate().flat_map(|(row, cells)| {
                    let in_shade =
                        move |(_, speed): &(usize, &Option<f64>)| speed.is_some_and(|speed| shade(speed) == n);
                    cells.iter().enumerate().filter(in_shade).map(move |(column, _)| (column, row))
                });
                let squares = cells.map(|(column, row)| {
                    let ([left, right], [low, high]) = (around(&self.axes[0], column), around(&self.axes[1], row));
                    Rectangle::new([(left, low), (right, high)], ink(n).filled())
                });
                let [from, to] = [n, n + 1].map(|edge| rounded(low + width * edge as f64));
                axes.draw_series(squares)?
                    .label(format!("{from} to {to}"))
                    .legend(move |(x, y)| Rectangle::new([(x, y - 6), (x + 20, y + 6)], ink(n).filled()));
            }
            chart::legend(&mut axes)
        })
    }
}

/// What lies nearer to this value of an axis than to the others.
fn around(axis: &Axis, n: usize) -> [f64; 2] {
    let [first, last] = [axis.values[0], axis.values[axis.values.len() - 1]];
    let half = 0.5 * (last - first) / (axis.values.len() - 1) as f64;
    [axis.values[n] - half, axis.values[n] + half].map(|value| value.clamp(first, last))
}

#[cfg(test)]
mod tests {
    use super::super::tests::scene;
    use super::*;
    use split_rotor_model::scene::Given;

    #[test]
    fn the_lowest_unstable_speed_is_that_of_the_closed_form() {
        let [outer, inner] = [("support.d1", [10.0, 50.0]), ("rotating_damping.d", [5.0, 20.0])]
            .map(|(name, values)| Against { name, values: values.map(Given::from), count: 4 });
        let plane = plane(scene(), [&outer, &inner], Some([0.0, 150.0]), 21).expect("a map");
        let mut stable = 0;
        for (inner, row) in plane.axes[1].values.iter().zip(&plane.rows) {
            for (outer, speed) in plane.axes[0].values.iter().zip(row) {
                // Beyond ω_n (1 + c_ext/c_int) it whirls by itself.
                let exact = 20.0 * (1.0 + outer / inner);
                match speed {
                    Some(speed) => assert!((speed / exact - 1.0).abs() < 1e-11, "{speed} for {exact} rad/s"),
                    None => stable += 1,
                }
                assert_eq!(speed.is_some(), exact < 150.0, "{outer} and {inner}");
            }
        }
        // 20 (1 + 36.7/5) and 20 (1 + 50/5) rad/s lie beyond.
        assert_eq!(stable, 2);
        assert!(plane.table().contains("| none |"));
        let quiet = Plane { rows: vec![vec![None; 4]; 4], ..plane };
        assert!(!quiet.svg().expect("a picture").contains("inf"));
    }
}
