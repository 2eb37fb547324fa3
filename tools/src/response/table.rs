//! The table: where the orbits are largest, and how large they are at a few speeds.

use super::{Found, Linear, Peak, lag, nonlinear};
use crate::doubts::{below, marked};
use crate::numbers::{SHOWN, micrometres, rounded, rpm, spread};
use std::fmt::Write;

/// All of it, in Markdown.
pub fn table(found: &Found) -> String {
    let mut text = format!("{}: {}\n\n", found.scene.name, found.scene.title);
    text += &crate::speeds::told(&found.speeds);
    text += "Unbalance response, drives off, the spin held.\n\n";
    match &found.linear {
        Ok(linear) => {
            text += "Linear, about the steady state at each speed.\n\n";
            peaks(found, linear, &mut text);
            sizes(found, linear, &mut text);
        }
        Err(obstacle) => text += &format!("No linear response: {obstacle}.\n"),
    }
    nonlinear::words(found, &mut text);
    below(text, found.scene, &found.speeds)
}

fn peaks(found: &Found, linear: &Linear, text: &mut String) {
    if linear.peaks.iter().all(Vec::is_empty) {
        *text += "No resonance peak in this range.\n\n";
        return;
    }
    *text += "Peaks of each station, 0-to-peak, as a fixed probe along y, along z, or along a probe's `angle` sees them, and of the larger semi-axis of the orbit.\n\n";
    *text += "| peak at [rad/s] | [rpm] | station | seen along | 0-to-peak [µm] | half axes [µm] | behind the mark, y [°] |\n\
              |--:|--:|---|---|--:|---|--:|\n";
    for (station, peaks) in found.stations.iter().zip(&linear.peaks) {
        for Peak { sight, point } in peaks {
            let (speed, name) = (point.speed, station.title());
            let at = marked(found.scene, speed);
            let _ = write!(text, "| {at} | {} | {name} | {} | ", rounded(rpm(speed)), sight.name());
            let _ = match point.orbit(station) {
                Some(orbit) => {
                    let [seen, major, minor] = [sight.of(&orbit), orbit.major(), orbit.minor()].map(micrometres);
                    writeln!(text, "{seen} | {major} and {minor} | {:.1} |", lag(speed, &orbit))
                }
                None => writeln!(text, "no bound: nothing damps it | - | - |"),
            };
        }
    }
    *text += "\n";
}

fn sizes(found: &Found, linear: &Linear, text: &mut String) {
    let shown: Vec<_> = spread(linear.points.len(), SHOWN).map(|n| &linear.points[n]).collect();
    *text += "| station |";
    shown.iter().for_each(|point| *text += &format!(" at {} rad/s |", marked(found.scene, point.speed)));
    *text += &format!("\n|---|{}\n", "--:|".repeat(shown.len()));
    for station in &found.stations {
        *text += &format!("| {} |", station.title());
        for point in &shown {
            let size = point.size(station);
            *text += &format!(" {} |", if size.is_finite() { micrometres(size) } else { "no bound".into() });
        }
        *text += "\n";
    }
    *text += "\nThe larger half axis of the orbit [µm]; where the smaller one is negative, the orbit is run against the spin. The mark is the y axis of the rotor.\n";
}
