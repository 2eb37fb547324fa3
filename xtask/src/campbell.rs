//! `campbell`: whirl frequencies and damping against the spin, critical speeds, and where the machine begins to whirl by itself.

mod picture;
mod table;
mod turning;

use crate::{scenes, sheets, speeds};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use split_rotor_model::linear::{Campbell, Crossing, Machine, Obstacle, Point};
use split_rotor_model::scene::Scene;

/// What the command found.
struct Diagram<'m> {
    scene: Scene,
    campbell: Campbell<'m>,
    /// Of each multiple of the speed, where modes cross it.
    critical: Vec<(f64, Vec<Crossing>)>,
    thresholds: Vec<Crossing>,
}

/// Speeds that are looked at, unless the user says how many.
pub const STEPS: u32 = 201;

/// Multiples of the speed whose lines are crossed, unless the user says which.
pub const ORDERS: [f64; 2] = [1.0, 2.0];

/// Draws the diagram of a scene between these speeds [rad/s], at so many of them.
pub fn campbell(scene: &str, speeds: Option<&[f64]>, steps: u32, orders: &[f64]) -> Result<sheets::Left> {
    let scene = scenes::find(scene)?;
    ensure!(orders.iter().all(|order| *order > 0.0), "--orders: each must be more than 0");
    let file = || scene.file.display().to_string();
    let machine = match Machine::of(&scene.parameters()) {
        Err(Obstacle::Asymmetric) => return turning::turning(scene, speeds, steps),
        machine => machine.with_context(file)?,
    };
    let speeds = speeds::range(&scene, Some(&machine), speeds, steps).with_context(file)?;
    let campbell = Campbell::of(&machine, &speeds).with_context(file)?;
    let crossed = |order: &f64| Ok((*order, campbell.critical_speeds(*order).with_context(file)?));
    let critical = orders.iter().map(crossed).collect::<Result<_>>()?;
    let thresholds = campbell.thresholds().with_context(file)?;
    write(&Diagram { scene, campbell, critical, thresholds })
}

fn write(diagram: &Diagram) -> Result<sheets::Left> {
    let table = table::table(diagram);
    let folder = format!("campbell/{}", diagram.scene.name);
    let pictures = [("campbell.svg", picture::svg(diagram)?)];
    sheets::leave(&folder, "campbell", &table, &rows(diagram), &json(diagram), &pictures)
}

/// A mode's number, as people count.
fn number(branch: usize) -> usize {
    branch + 1
}

/// A row for each mode at each speed.
fn rows(diagram: &Diagram) -> Vec<sheets::Row> {
    let branches = diagram.campbell.branches.iter().enumerate();
    let all = branches.flat_map(|(branch, of)| of.points.iter().map(move |point| (branch, point)));
    let row = |(branch, point): (usize, &Point)| {
        vec![
            ("speed_rad_s", json!(point.speed)),
            ("mode", json!(number(branch))),
            ("frequency_rad_s", json!(point.mode.frequency())),
            ("damping_ratio", json!(point.mode.damping_ratio())),
            ("direction", json!(point.mode.direction.name())),
        ]
    };
    all.map(row).collect()
}

fn json(diagram: &Diagram) -> Value {
    let crossing = |crossing: &Crossing| {
        json!({
            "mode": number(crossing.branch),
            "speed_rad_s": crossing.speed,
            "frequency_rad_s": crossing.mode.frequency(),
            "damping_ratio": crossing.mode.damping_ratio(),
            "direction": crossing.mode.direction.name(),
        })
    };
    let all = |crossings: &[Crossing]| crossings.iter().map(crossing).collect::<Vec<_>>();
    let critical = diagram.critical.iter().map(|(order, speeds)| json!({ "order": order, "speeds": all(speeds) }));
    let steady = diagram.campbell.steady.iter().map(|steady| {
        json!({
            "speed_rad_s": steady.speed,
            "r_m": steady.r.as_slice(),
            "gamma_rad": steady.gamma.as_slice(),
            "torque_N_m": steady.torque,
        })
    });
    json!({
        "scene": diagram.scene.name,
        "title": diagram.scene.title,
        "critical_speeds": critical.collect::<Vec<_>>(),
        "thresholds": all(&diagram.thresholds),
        "steady_states": steady.collect::<Vec<_>>(),
        "modes": sheets::objects(rows(diagram)),
    })
}
