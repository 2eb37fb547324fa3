//! `response`: how far and when an unbalance makes the stations of a machine whirl, against the spin.

mod picture;
mod table;

use crate::{scenes, sheets, speeds};
use anyhow::{Context, Result, ensure};
use nalgebra::ComplexField;
use serde_json::json;
use split_rotor_model::linear::{Machine, Obstacle, Orbit, Response};
use split_rotor_model::scene::Scene;
use split_rotor_model::simulation::Any;

/// What the command found.
struct Found {
    scene: Scene,
    stations: Vec<Station>,
    /// By speed; what stands at a resonance that nothing damps is left out.
    responses: Vec<Response>,
    /// Of each station, where its orbit is largest.
    peaks: Vec<Vec<Response>>,
}

/// A place on the axis that is looked at.
struct Station {
    name: String,
    /// From c, along t \[m].
    position: f64,
}

/// A peak is found to this part of the range of speeds \[1].
const FOUND: f64 = 1e-9;

/// Finds the response of a scene between these speeds [rad/s], at so many of them.
pub fn response(scene: &str, ends: Option<&[f64]>, steps: u32) -> Result<()> {
    let scene = scenes::find(scene)?;
    let file = || scene.file.display().to_string();
    let machine = Machine::of(&scene.parameters()).with_context(file)?;
    ensure!(machine.is_unbalanced(), "{}: nothing is out of balance (effects.unbalance)", file());
    let stations = stations(&scene);
    let mut responses: Vec<Response> = Vec::new();
    for speed in speeds::range(&scene, &machine, ends, steps).with_context(file)? {
        match machine.response(speed, responses.last().map(|last| &last.steady)) {
            Err(Obstacle::Resonant { .. }) => {}
            response => responses.push(response.with_context(file)?),
        }
    }
    ensure!(responses.len() > 1, "{}: no bounded whirl at these speeds", file());
    let found = stations.iter().map(|station| peaks(&machine, station, &responses));
    let peaks = found.collect::<Result<_, _>>().with_context(file)?;
    write(&Found { scene, stations, responses, peaks })
}

/// c, and what looks at the rotor or touches it: probes, or bearings and rings where there are none.
fn stations(scene: &Scene) -> Vec<Station> {
    let told: Any = scene.parameters().into();
    let value = |name: &str| {
        let variable = scene.variables.iter().find(|variable| variable.name == name);
        variable.and_then(|variable| told.value(variable.place))
    };
    let of = |kinds: &[&str]| -> Vec<Station> {
        let blocks = scene.variables.iter().filter_map(|variable| variable.name.strip_suffix(".position"));
        let blocks = blocks.filter(|block| kinds.iter().any(|kind| block.starts_with(kind)));
        let blocks = blocks.filter(|block| value(&format!("effects.{block}")) != Some(0.0));
        let station =
            |block: &str| Some(Station { name: block.into(), position: value(&format!("{block}.position"))? });
        blocks.filter_map(station).collect()
    };
    let probes = of(&["probe["]);
    let rest = if probes.is_empty() { of(&["bearing[", "rub["]) } else { probes };
    std::iter::once(Station { name: "c".into(), position: 0.0 }).chain(rest).collect()
}

/// Where the orbit of a station is larger than beside it, by the golden section between the speeds that were looked at.
fn peaks(machine: &Machine, station: &Station, responses: &[Response]) -> Result<Vec<Response>, Obstacle> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let size = |response: &Response| response.orbit(station.position).major();
    let range = responses[responses.len() - 1].steady.speed - responses[0].steady.speed;
    let mut found = Vec::new();
    for three in responses.windows(3) {
        if size(&three[1]) <= size(&three[0]) || size(&three[1]) < size(&three[2]) {
            continue;
        }
        let (mut from, mut to, mut largest) = (three[0].steady.speed, three[2].steady.speed, three[1].clone());
        let mut is_left = true;
        while to - from > FOUND * range {
            let speed = if is_left { to - GOLDEN * (to - from) } else { from + GOLDEN * (to - from) };
            let tried = machine.response(speed, Some(&largest.steady))?;
            let best = largest.steady.speed;
            // The larger of both stays within, the other one is an end.
            let (end, inner) = if size(&tried) > size(&largest) { (best, speed) } else { (speed, best) };
            if end < inner {
                from = end
            } else {
                to = end
            }
            if inner == speed {
                largest = tried;
            }
            is_left = largest.steady.speed - from > to - largest.steady.speed;
        }
        found.push(largest);
    }
    Ok(found)
}

fn write(found: &Found) -> Result<()> {
    let table = table::table(found);
    let rows = rows(found);
    let json =
        json!({ "scene": found.scene.name, "title": found.scene.title, "responses": sheets::objects(rows.clone()) });
    let json = serde_json::to_string_pretty(&json)? + "\n";
    let files = [("response.md", &*table), ("response.csv", &sheets::csv(&rows)), ("response.json", &json)];
    let folder = sheets::write(&format!("response/{}", found.scene.name), files)?;
    let picture = folder.join("response.svg");
    std::fs::write(&picture, picture::svg(found)?)?;
    println!("{table}\n{}", picture.display());
    Ok(())
}

/// A row for each station at each speed.
fn rows(found: &Found) -> Vec<sheets::Row> {
    let all = found.responses.iter().flat_map(|response| found.stations.iter().map(move |station| (response, station)));
    let row = |(response, station): (&Response, &Station)| {
        let orbit @ Orbit { y, z } = response.orbit(station.position);
        vec![
            ("speed_rad_s", json!(response.steady.speed)),
            ("station", json!(station.name)),
            ("position_m", json!(station.position)),
            ("major_m", json!(orbit.major())),
            ("minor_m", json!(orbit.minor())),
            ("amplitude_y_m", json!(y.modulus())),
            ("phase_y_rad", json!(y.argument())),
            ("amplitude_z_m", json!(z.modulus())),
            ("phase_z_rad", json!(z.argument())),
        ]
    };
    all.map(row).collect()
}
