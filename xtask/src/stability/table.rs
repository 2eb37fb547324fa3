//! The table: the thresholds at a few values of the parameter.

use super::{Column, Map, added};
use crate::numbers::{rounded, rpm, spread};
use crate::speeds;
use split_rotor_model::linear::Crossing;
use split_rotor_tools::doubts::{below, mark_within, marked};

/// So many values are shown.
const SHOWN: usize = 12;

/// A threshold is at the first speed where it is nearer to it than this part of the range \[1].
const AT_THE_END: f64 = 1e-9;

const BOTH: &str = "on both sides";

/// All of it, in Markdown.
pub fn table(map: &Map) -> String {
    let mut text = format!("{}: {}\n\n", map.scene.name, map.scene.title);
    text += &speeds::told(&map.speeds);
    text += "Balanced, drives off, the spin held.\n\n";
    text += &format!(
        "| {} | a mode grows | threshold [rad/s] | [rpm] | whirl there [rad/s] |\n|--:|---|--:|--:|--:|\n",
        map.against.label()
    );
    for column in spread(map.columns.len(), SHOWN).map(|n| &map.columns[n]) {
        let value = rounded(column.value);
        let mut rows: Vec<_> = column.thresholds.iter().filter_map(|at| row(column, map, at)).collect();
        // Of modes that are alike.
        rows.dedup();
        if rows.is_empty() {
            let where_ = if column.grows[0] { "at all these speeds" } else { "at none of these speeds" };
            let mark = mark_within(&map.scene, ends(map));
            rows.push(format!("{where_}{mark} | - | - | -"));
        }
        rows.iter().for_each(|row| text += &format!("| {value} | {row} |\n"));
    }
    text += &added(&map.scene, &map.against);
    below(text, &map.scene, &map.speeds)
}

/// The first and the last speed [rad/s].
fn ends(map: &Map) -> [f64; 2] {
    [map.speeds[0], map.speeds[map.speeds.len() - 1]]
}

/// The row of a threshold; None where one more mode begins to grow at the first speed, at which another one does already.
fn row(column: &Column, map: &Map, at: &Crossing) -> Option<String> {
    let ([first, last], side) = (ends(map), side(column, map, at.speed));
    if side == BOTH && at.speed - first <= AT_THE_END * (last - first) {
        return None;
    }
    let (rpm, whirl) = (rounded(rpm(at.speed)), rounded(at.mode.frequency()));
    Some(format!("{side} | {} | {rpm} | {whirl}", marked(&map.scene, at.speed)))
}

/// On which side of a threshold [rad/s] the machine is unstable.
fn side(column: &Column, map: &Map, threshold: f64) -> &'static str {
    let above = map.speeds.iter().position(|speed| *speed > threshold);
    match (above.is_some_and(|n| column.grows[n]), above.is_some_and(|n| n > 0 && column.grows[n - 1])) {
        (true, true) => BOTH,
        (true, false) => "above",
        (false, _) => "below",
    }
}
