//! The table: where the answer is largest, and how large it is at a few frequencies.

use super::{Found, Point, is_of_spin};
use crate::numbers::{rounded, spread};
use nalgebra::ComplexField;
use split_rotor_model::linear::Obstacle;
use split_rotor_tools::doubts;
use std::f64::consts::TAU;
use std::fmt::Write;

/// So many frequencies are shown.
const SHOWN: usize = 9;

/// All of it, in Markdown.
pub fn table(found: &Found) -> Result<String, Obstacle> {
    let mut text = format!("{}: {}\n\nFrequency response {}", found.scene.name, found.scene.title, found.between());
    text += ", drives off, the spin held; linear, about the steady state.\n\n";
    if found.peaks.is_empty() {
        text += "No resonance peak in this range.\n\n";
    } else {
        rows("peak", found.peaks.iter(), found, &mut text);
    }
    rows("frequency", spread(found.points.len(), SHOWN).map(|n| &found.points[n]), found, &mut text);
    if is_of_spin(&found.space.outputs[found.to].name) {
        let _ = writeln!(text, "{}.", found.held_spin());
    }
    if found.space.steady.modes()?.iter().any(|mode| mode.grows()) {
        text += "A mode grows: a run does not settle to this answer.\n";
    }
    for line in doubts::words(&found.scene, [found.space.steady.speed; 2]) {
        let _ = writeln!(text, "{line}.");
    }
    Ok(text)
}

fn rows<'p>(name: &str, points: impl Iterator<Item = &'p Point>, found: &Found, text: &mut String) {
    let _ = writeln!(text, "| {name} [rad/s] | [Hz] | magnitude [{}] | phase [°] |\n|--:|--:|--:|--:|", found.unit());
    for Point { frequency, answer } in points {
        let _ = write!(text, "| {} | {} | ", rounded(*frequency), rounded(frequency / TAU));
        let _ = match answer {
            // 0 degrees, not −0.
            Some(answer) => {
                let phase = 0.01 * libm::round(100.0 * answer.argument().to_degrees());
                writeln!(text, "{:.4e} | {:.2} |", answer.modulus(), phase + 0.0)
            }
            None => writeln!(text, "no bound: nothing damps it | - |"),
        };
    }
    *text += "\n";
}
