//! The response by the laws as they stand: motions that repeat with each revolution, followed through the speeds.

use super::{Found, Sight, Station, once};
use crate::doubts::marked;
use crate::numbers::{micrometres, rounded, rpm};
use crate::rows::Row;
use serde_json::json;
use split_rotor_model::periodic::{Branch, End, Obstacle, Orbit, Rotating};
use split_rotor_model::scene::Scene;

/// One step for so many of the linear response.
const COARSER: u32 = 4;

/// Of a range that begins at standstill it is looked for from this part of its end on \[1]: below, revolutions are long, and an unbalance
/// does little.
const LOWEST: f64 = 0.05;

/// A branch that goes down meets that which goes up where their motions are alike by this \[1].
const ALIKE: f64 = 1e-6;

/// Follows the motions of a scene up through these speeds [rad/s] that are not too low; of both signs, through the positive ones. Down
/// too, where the way up turns back or ends: what is there at the highest may not hang together with it.
pub(super) fn branches(scene: &Scene, speeds: &[f64]) -> Vec<Result<Branch, Obstacle>> {
    let [first, last] = [speeds[0], speeds[speeds.len() - 1]];
    let [slow, fast] = match (first, last) {
        (first, last) if first > 0.0 => [first, last],
        (first, last) if last < 0.0 => [last, first],
        (_, last) if last > 0.0 => [LOWEST * last, last],
        (first, _) => [LOWEST * first, first],
    };
    let steps = (speeds.len() as u32 / COARSER).max(2);
    let machine = match Rotating::of(&scene.parameters()) {
        Ok(machine) => machine,
        Err(obstacle) => return vec![Err(obstacle)],
    };
    let up = machine.branch([slow, fast], steps);
    if up.as_ref().is_ok_and(|up| up.end == End::Range && up.folds().next().is_none()) {
        return vec![up];
    }
    let down = machine.branch([fast, slow], steps);
    match (&up, &down) {
        // Then it is all of it.
        (Ok(up), Ok(down)) if is_start(up, down) => vec![Ok(down.clone())],
        _ => vec![up, down],
    }
}

/// Whether the second of these branches ends where the first one begins.
fn is_start(up: &Branch, down: &Branch) -> bool {
    let [first, last] = [&up.orbits[0], &down.orbits[down.orbits.len() - 1]];
    let apart = (first.state - last.state).norm();
    first.speed == last.speed && apart < ALIKE * (first.state.norm() + last.state.norm())
}

/// What was found.
pub fn of<'f>(found: &'f Found<'_>) -> impl Iterator<Item = &'f Branch> {
    found.nonlinear.iter().flatten().flatten()
}

/// Neighbours that all last, or all leave in the same way.
pub fn alike(branch: &Branch) -> impl Iterator<Item = &[Orbit]> {
    branch.orbits.chunk_by(|a, b| a.loss() == b.loss())
}

/// A row for each station in each motion, in the order in which they go over into one another.
pub fn rows(found: &Found) -> Vec<Row> {
    let orbits = of(found).flat_map(|branch| &branch.orbits);
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
pub(super) fn words(found: &Found, text: &mut String) {
    let Some(branches) = &found.nonlinear else { return };
    *text += "\nNonlinear, by the laws as they stand: motions that repeat with each revolution; where the range holds 0, from a twentieth of \
              its end on.\n";
    for branch in branches {
        match branch {
            Ok(branch) => tell(found.scene, branch, text),
            Err(obstacle) => *text += &format!("\n- None found: {obstacle}.\n"),
        }
    }
    if of(found).all(|branch| found.stations.iter().all(|station| peaks(branch, station).next().is_none())) {
        return;
    }
    *text += "\n| largest found at [rad/s] | [rpm] | station | seen along | 0-to-peak [µm] | half axes [µm] | farthest from the line [µm] | lasts |\n|--:|--:|---|---|--:|---|--:|---|\n";
    for (station, (sight, peak)) in found
        .stations
        .iter()
        .flat_map(|station| of(found).flat_map(move |branch| peaks(branch, station).map(move |peak| (station, peak))))
    {
        let (speed, path) = (peak.speed, peak.path(station.position));
        let all = [sight.of(&path.once), path.once.major(), path.once.minor(), path.farthest];
        let [seen, major, minor, farthest] = all.map(micrometres);
        let lasts = if peak.loss().is_none() { "yes" } else { "no" };
        let name = station.title();
        let (at, rpm) = (marked(found.scene, speed), rounded(rpm(speed)));
        *text += &format!(
            "| {at} | {rpm} | {name} | {} | {seen} | {major} and {minor} | {farthest} | {lasts} |\n",
            sight.name()
        );
    }
}

/// Where a branch goes, turns back, and does not last.
fn tell(scene: &Scene, branch: &Branch, text: &mut String) {
    let at = |orbit: &Orbit| format!("{} rad/s", marked(scene, orbit.speed));
    let [first, last] = [&branch.orbits[0], &branch.orbits[branch.orbits.len() - 1]].map(at);
    *text += &format!("\n- From {first} to {last}.\n");
    for fold in branch.folds() {
        *text += &format!("  They turn back at {}: there the whirl jumps.\n", at(&branch.orbits[fold]));
    }
    for part in alike(branch) {
        if let Some(loss) = part[0].loss() {
            let [from, to] = [&part[0], &part[part.len() - 1]].map(at);
            *text += &format!(
                "  From {from} to {to} none lasts: a small disturbance grows, and the rotor {}.\n",
                loss.words()
            );
        }
    }
    *text += &match &branch.end {
        End::Range => String::new(),
        End::Long => "  They go on; with more --steps they are followed further.\n".into(),
        End::Lost(obstacle) => format!(
            "  Beyond {last} they could not be followed: a contact may begin or end there, or nothing damps the whirl ({obstacle}).\n"
        ),
    };
}

/// The motions in which what is seen of a station is larger than beside them.
fn peaks<'b>(branch: &'b Branch, station: &'b Station) -> impl Iterator<Item = (Sight, &'b Orbit)> {
    station.sights().flat_map(move |sight| {
        let size = move |orbit: &Orbit| sight.of(&orbit.path(station.position).once);
        let is_peak = move |three: &&[Orbit]| size(&three[1]) > size(&three[0]) && size(&three[1]) >= size(&three[2]);
        branch.orbits.windows(3).filter(is_peak).map(move |three| (sight, &three[1]))
    })
}
