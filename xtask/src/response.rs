//! `response`: how far and when an unbalance makes the stations of a machine whirl, against the spin; by the linear equations, and by
//! the laws as they stand.

mod nonlinear;
mod picture;
mod table;

use crate::{peaks, scenes, sheets, speeds};
use anyhow::{Context, Result, bail, ensure};
use nalgebra::ComplexField;
use serde_json::json;
use split_rotor_model::linear::{Machine, Obstacle, Orbit, Response};
use split_rotor_model::periodic::{self, Branch};
use split_rotor_model::scene::Scene;

/// What the command found.
struct Found {
    scene: Scene,
    stations: Vec<Station>,
    /// [rad/s].
    speeds: Vec<f64>,
    /// By the linear equations, where they hold.
    linear: Result<Linear, Obstacle>,
    /// By the laws as they stand, where that was asked for.
    nonlinear: Option<Vec<Result<Branch, periodic::Obstacle>>>,
}

/// By the linear equations.
struct Linear {
    /// By speed.
    points: Vec<Point>,
    /// Of each station, where its orbit is larger than beside it.
    peaks: Vec<Vec<Point>>,
}

/// A speed [rad/s] that was looked at, and how the machine whirls there; None without bound, where nothing damps a resonance.
#[derive(Clone)]
struct Point {
    speed: f64,
    response: Option<Response>,
}

impl Point {
    fn of(machine: &Machine, speed: f64, near: Option<&Self>) -> Result<Self, Obstacle> {
        let steady = near.and_then(|near| near.response.as_ref()).map(|response| &response.steady);
        match machine.response(speed, steady) {
            Err(Obstacle::Resonant { speed }) => Ok(Self { speed, response: None }),
            response => Ok(Self { speed, response: Some(response?) }),
        }
    }

    fn orbit(&self, station: &Station) -> Option<Orbit> {
        self.response.as_ref().map(|response| response.orbit(station.position))
    }

    /// The larger half axis of the orbit there \[m].
    fn size(&self, station: &Station) -> f64 {
        self.orbit(station).map_or(f64::INFINITY, |orbit| orbit.major())
    }
}

/// By how much y is behind the rotor's mark at a speed [rad/s] \[°].
fn lag(speed: f64, orbit: &Orbit) -> f64 {
    -orbit.y.argument().to_degrees() * speed.signum()
}

/// A place on the axis that is looked at.
struct Station {
    name: String,
    /// From c, along t \[m].
    position: f64,
}

/// Finds the response of a scene between these speeds [rad/s], at so many of them; whether also by the laws as they stand.
pub fn response(scene: &str, ends: Option<&[f64]>, steps: u32, exact: bool) -> Result<()> {
    let scene = scenes::find(scene)?;
    let file = || scene.file.display().to_string();
    let unbalance = scene.parameters().shape().unbalance();
    ensure!(unbalance.iter().any(|off| off.norm() > 0.0), "{}: nothing is out of balance (effects.unbalance)", file());
    let machine = Machine::of(&scene.parameters());
    let speeds = speeds::range(&scene, machine.as_ref().ok(), ends, steps).with_context(file)?;
    let stations = stations(&scene);
    let linear = machine.and_then(|machine| Linear::of(&machine, &speeds, &stations));
    if let (Err(obstacle), false) = (&linear, exact) {
        bail!("{}: {obstacle}", file());
    }
    if exact {
        eprintln!("Following the whirl by the laws as they stand: up to a minute (--linear leaves it out) ...");
    }
    let nonlinear = exact.then(|| nonlinear::branches(&scene, &speeds));
    write(&Found { scene, stations, speeds, linear, nonlinear })
}

impl Linear {
    fn of(machine: &Machine, speeds: &[f64], stations: &[Station]) -> Result<Self, Obstacle> {
        let mut points: Vec<Point> = Vec::new();
        for speed in speeds {
            points.push(Point::of(machine, *speed, points.last())?);
        }
        let peaks = stations.iter().map(|station| peaks_of(machine, station, &points)).collect::<Result<_, _>>()?;
        Ok(Self { points, peaks })
    }
}

/// c, and what looks at the rotor or touches it: probes, or bearings and rings where there are none.
fn stations(scene: &Scene) -> Vec<Station> {
    let value = scenes::values(scene);
    let of = |kinds: &[&str]| -> Vec<Station> {
        let blocks = scene.effects.iter().filter(|(info, _)| kinds.contains(&info.name));
        // In a general scene an effect may be off.
        let blocks = blocks.filter(|(info, index)| value(&info.switch_name(*index)) != Some(0.0));
        let names = blocks.map(|(info, index)| info.block_name(*index));
        names.filter_map(|name| Some(Station { position: value(&format!("{name}.position"))?, name })).collect()
    };
    let probes = of(&["probe"]);
    let rest = if probes.is_empty() { of(&["bearing", "rub"]) } else { probes };
    std::iter::once(Station { name: "c".into(), position: 0.0 }).chain(rest).collect()
}

/// Where the orbit of a station is larger than beside it.
fn peaks_of(machine: &Machine, station: &Station, points: &[Point]) -> Result<Vec<Point>, Obstacle> {
    let at = |speed: f64, near: &Point| Point::of(machine, speed, Some(near));
    peaks::of(points, |point| (point.speed, point.size(station)), at)
}

fn write(found: &Found) -> Result<()> {
    let table = table::table(found);
    let [linear, nonlinear] = [rows(found), nonlinear::rows(found)];
    let json = json!({
        "scene": found.scene.name,
        "title": found.scene.title,
        "responses": sheets::objects(linear.clone()),
        "nonlinear": sheets::objects(nonlinear.clone()),
    });
    let (folder, pictures) = (format!("response/{}", found.scene.name), [("response.svg", picture::svg(found)?)]);
    let left = sheets::leave(&folder, "response", &table, &linear, &json, &pictures)?;
    std::fs::write(left.folder.join("nonlinear.csv"), sheets::csv(&nonlinear))?;
    left.show();
    Ok(())
}

/// A station's harmonic that goes round with the spin, as columns.
fn once(orbit: Orbit) -> sheets::Row {
    let Orbit { y, z } = orbit;
    vec![
        ("major_m", json!(orbit.major())),
        ("minor_m", json!(orbit.minor())),
        ("amplitude_y_m", json!(y.modulus())),
        ("phase_y_rad", json!(y.argument())),
        ("amplitude_z_m", json!(z.modulus())),
        ("phase_z_rad", json!(z.argument())),
    ]
}

/// A row for each station at each speed at which it has a bound.
fn rows(found: &Found) -> Vec<sheets::Row> {
    let points = found.linear.iter().flat_map(|linear| &linear.points);
    let all = points.flat_map(|point| found.stations.iter().map(move |station| (point, station)));
    let row = |(point, station): (&Point, &Station)| {
        let place = vec![
            ("speed_rad_s", json!(point.speed)),
            ("station", json!(station.name)),
            ("position_m", json!(station.position)),
        ];
        Some([place, once(point.orbit(station)?)].concat())
    };
    all.filter_map(row).collect()
}
