//! The picture: where a mode grows, filled, and the thresholds, over the parameter and the spin.

use super::Map;
use crate::chart;
use anyhow::Result;
use plotters::prelude::*;

/// What is unstable, and its border.
const GROWS: RGBColor = chart::ORANGE;

/// As SVG.
pub fn svg(map: &Map) -> Result<String> {
    let [first, last] = [&map.columns[0], &map.columns[map.columns.len() - 1]].map(|column| column.value);
    let [slow, fast] = [map.speeds[0], map.speeds[map.speeds.len() - 1]];
    chart::square(&format!("{}: unstable where filled", map.scene.title), |area| {
        let label = map.against.label();
        let mut axes = chart::axes_of(area, "", (first..last, &label), (slow..fast, "spin [rad/s]"))?;
        let half = 0.5 * (last - first) / (map.columns.len() - 1) as f64;
        for column in &map.columns {
            let [left, right] = [column.value - half, column.value + half].map(|x| x.clamp(first, last));
            // From one change to the next: the thresholds part what the speeds between them have alike.
            let ends: Vec<_> =
                [slow].into_iter().chain(column.thresholds.iter().map(|at| at.speed)).chain([fast]).collect();
            let within = |pair: &[f64]| map.speeds.iter().position(|speed| (pair[0]..=pair[1]).contains(speed));
            let parts = ends.windows(2).filter(|pair| grows(map, pair, within(pair), &column.grows));
            axes.draw_series(
                parts.map(|pair| Rectangle::new([(left, pair[0]), (right, pair[1])], GROWS.mix(0.35).filled())),
            )?;
            let marks = column.thresholds.iter().map(|at| Circle::new((column.value, at.speed), 2, GROWS.filled()));
            axes.draw_series(marks)?;
        }
        Ok(())
    })
}

/// Whether a mode grows between two speeds: at the speed in the middle of those that were looked at there.
fn grows(map: &Map, pair: &[f64], first: Option<usize>, grows: &[bool]) -> bool {
    let Some(first) = first else { return false };
    let count = map.speeds[first..].iter().take_while(|speed| **speed <= pair[1]).count();
    grows[first + (count - 1) / 2]
}
