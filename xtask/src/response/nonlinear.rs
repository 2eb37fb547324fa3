//! The response by the laws as they stand: motions that repeat with each revolution, followed through the speeds.

use super::{Found, Station, once, table};
use crate::numbers::{micrometres, rounded, rpm};
use crate::sheets;
use serde_json::json;
use split_rotor_model::periodic::{Branch, End, Obstacle, Orbit, Rotating};
use split_rotor_model::scene::Scene;
use std::fmt::Write;

/// One step for so many of the linear response.
const COARSER: u32 = 4;

/// Nor is it looked for below this part of the highest speed \[1]: there revolutions are long, and an unbalance does little.
const LOWEST: f64 = 0.05;

/// Follows the motions of a scene through these speeds [rad/s] that are not too low; of both signs, through those with the spin.
pub fn branch(scene: &Scene, speeds: &[f64]) -> Result<Branch, Obstacle> {
    let [first, last] = [speeds[0], speeds[speeds.len() - 1]];
    let ends = if last > 0.0 { [first.max(LOWEST * last), last] } else { [last.min(LOWEST * first), first] };
    let steps = (speeds.len() as u32 / COARSER).max(2);
    Rotating::of(&scene.parameters())?.branch(ends, steps)
}

/// Neighbours that all last, or all leave in the same way.
pub fn alike(branch: &Branch) -> impl Iterator<Item = &[Orbit]> {
    branch.orbits.chunk_by(|a, b| a.loss() == b.loss())
}

/// A row for each station in each motion, in the order in which they go over into one another.
pub fn rows(found: &Found) -> Vec<sheets::Row> {
    let branch = found.nonlinear.iter().flatten();
    let orbits = branch.flat_map(|branch| &branch.orbits);
    let all = orbits.flat_map(|orbit| found.stations.iter().map(move |station| (orbit, station)));
    let row = |(orbit, station): (&Orbit, &Station)| {
        let path = orbit.path(station.position);
        let place = vec![
            ("speed_rad_s", json!(orbit.speed)),
            ("lasts", json!(orbit.loss().is_none())),
            ("largest_multiplier", json!(orbit.largest_multiplier())),
            ("station", json!(station.name)),
            ("position_m", json!(station.position)),
        ];
        let whole = vec![
            ("mean_y_m", json!(path.mean.x)),
            ("mean_z_m", json!(path.mean.y)),
            ("reach_m", json!(path.reach)),
            ("farthest_m", json!(path.farthest)),
        ];
        [place, once(path.once), whole].concat()
    };
    all.map(row).collect()
}

/// What the table says of it.
pub fn words(found: &Found, text: &mut String) {
    let branch = match &found.nonlinear {
        None => return,
        Some(Err(obstacle)) => {
            *text += &format!("\nNo nonlinear response: {obstacle}.\n");
            return;
        }
        Some(Ok(branch)) => branch,
    };
    let [first, last] = [&branch.orbits[0], &branch.orbits[branch.orbits.len() - 1]];
    let (from, to, count) = (rounded(first.speed), rounded(last.speed), branch.orbits.len());
    *text += &format!(
        "\nNonlinear, by the laws as they stand: {count} motions that repeat with each revolution, from {from} to {to} rad/s.\n"
    );
    let _ = match &branch.end {
        End::Range => Ok(()),
        End::Long => writeln!(text, "They go on; so many were looked at."),
        End::Lost(obstacle) => writeln!(text, "Further they could not be followed: {obstacle}."),
    };
    for fold in branch.folds() {
        let speed = branch.orbits[fold].speed;
        let _ = writeln!(
            text,
            "They turn back at {} rad/s ({} rpm): there the whirl jumps.",
            rounded(speed),
            rounded(rpm(speed))
        );
    }
    for part in alike(branch) {
        if let Some(loss) = part[0].loss() {
            let [from, to] = [&part[0], &part[part.len() - 1]].map(|orbit| rounded(orbit.speed));
            let _ = writeln!(
                text,
                "From {from} to {to} rad/s none lasts: a small disturbance grows, and the rotor {}.",
                loss.words()
            );
        }
    }
    *text += "\n| nonlinear peak at [rad/s] | [rpm] | station | half axes [µm] | farthest from the line [µm] | lasts |\n|--:|--:|---|---|--:|---|\n";
    for station in &found.stations {
        for peak in peaks(branch, station) {
            let (speed, path) = (peak.speed, peak.path(station.position));
            let [major, minor, farthest] = [path.once.major(), path.once.minor(), path.farthest].map(micrometres);
            let lasts = if peak.loss().is_none() { "yes" } else { "no" };
            let _ = writeln!(
                text,
                "| {} | {} | {} | {major} and {minor} | {farthest} | {lasts} |",
                rounded(speed),
                rounded(rpm(speed)),
                table::name(station)
            );
        }
    }
}

/// The motions in which the orbit of a station is larger than beside them.
fn peaks<'b>(branch: &'b Branch, station: &Station) -> Vec<&'b Orbit> {
    let size = |orbit: &Orbit| orbit.path(station.position).once.major();
    let three = branch
        .orbits
        .windows(3)
        .filter(|three| size(&three[1]) > size(&three[0]) && size(&three[1]) >= size(&three[2]));
    three.map(|three| &three[1]).collect()
}
