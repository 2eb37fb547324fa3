//! The table: the thresholds at a few values of the parameter.

use super::{Column, Map};
use crate::numbers::{rounded, rpm, spread};
use crate::speeds;
use split_rotor_tools::doubts::{below, mark};

/// So many values are shown.
const SHOWN: usize = 12;

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
        if column.thresholds.is_empty() {
            let where_ = if column.grows[0] { "at all these speeds" } else { "at none of these speeds" };
            text += &format!("| {value} | {where_} | - | - | - |\n");
        }
        for at in &column.thresholds {
            let (speed, rpm, whirl) = (rounded(at.speed), rounded(rpm(at.speed)), rounded(at.mode.frequency()));
            let mark = mark(&map.scene, at.speed);
            text += &format!("| {value} | {} | {speed}{mark} | {rpm} | {whirl} |\n", side(column, map, at.speed));
        }
    }
    below(text, &map.scene, &map.speeds)
}

/// On which side of a threshold [rad/s] the machine is unstable.
fn side(column: &Column, map: &Map, threshold: f64) -> &'static str {
    let above = map.speeds.iter().position(|speed| *speed > threshold);
    match (above.is_some_and(|n| column.grows[n]), above.is_some_and(|n| n > 0 && column.grows[n - 1])) {
        (true, true) => "on both sides",
        (true, false) => "above",
        (false, _) => "below",
    }
}
