//! The table: where the orbits are largest, and how large they are at a few speeds.

use super::{Found, Station};
use crate::numbers::{SHOWN, rounded, rpm, spread};
use nalgebra::ComplexField;
use split_rotor_model::linear::Response;
use std::fmt::Write;

/// All of it, in Markdown.
pub fn table(found: &Found) -> String {
    let mut text = format!("{}: {}\n\n", found.scene.name, found.scene.title);
    text += "Unbalance response, drives off, the spin held; linear, about the steady state at each speed.\n\n";
    peaks(found, &mut text);
    sizes(found, &mut text);
    text
}

fn peaks(found: &Found, text: &mut String) {
    if found.peaks.iter().all(Vec::is_empty) {
        *text += "No resonance peak in this range.\n\n";
        return;
    }
    *text += "| peak at [rad/s] | [rpm] | station | half axes [µm] | behind the mark, y [°] |\n|--:|--:|---|---|--:|\n";
    for (station, peaks) in found.stations.iter().zip(&found.peaks) {
        for peak in peaks {
            let orbit = peak.orbit(station.position);
            let speed = peak.steady.speed;
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} and {} | {:.1} |",
                rounded(speed),
                rounded(rpm(speed)),
                name(station),
                micrometres(orbit.major()),
                micrometres(orbit.minor()),
                -orbit.y.argument().to_degrees()
            );
        }
    }
    *text += "\n";
}

fn sizes(found: &Found, text: &mut String) {
    let shown: Vec<&Response> = spread(found.responses.len(), SHOWN).map(|n| &found.responses[n]).collect();
    *text += "| station |";
    shown.iter().for_each(|response| *text += &format!(" at {} rad/s |", rounded(response.steady.speed)));
    *text += &format!("\n|---|{}\n", "--:|".repeat(shown.len()));
    for station in &found.stations {
        *text += &format!("| {} |", name(station));
        for response in &shown {
            *text += &format!(" {} |", micrometres(response.orbit(station.position).major()));
        }
        *text += "\n";
    }
    *text += "\nThe larger half axis of the orbit [µm]; a smaller one that is negative is run backward. The mark is the y axis of the rotor.\n";
}

pub fn name(station: &Station) -> String {
    format!("{} at {} m", station.name, station.position)
}

fn micrometres(length: f64) -> String {
    rounded(1e6 * length)
}
