//! `campbell`: whirl frequencies and damping against the spin, critical speeds, and where the machine begins to whirl by itself.

mod picture;
mod turning;

use crate::progress::stage;
use crate::{scenes, sheets};
use anyhow::Result;
use split_rotor_model::linear::{Machine, Obstacle};
use split_rotor_tools::campbell::View;
pub use split_rotor_tools::campbell::{ORDERS, STEPS};
use std::path::Path;

/// Draws the diagram of a scene between these speeds [rad/s], at so many of them, into the folder `out`, or target/campbell/SCENE.
pub fn campbell(
    scene: &str,
    speeds: Option<[f64; 2]>,
    steps: u32,
    orders: &[f64],
    out: Option<&Path>,
) -> Result<sheets::Left> {
    let scene = scenes::find(scene)?;
    let machine = Machine::of(&scene.parameters());
    let what = match machine {
        Err(Obstacle::Asymmetric) => "the body is not symmetric: following its revolutions, which may take a minute",
        _ => "following the modes",
    };
    let view = stage(what, || View::of(&scene, &machine, speeds, steps, orders))?;
    let svg = match &view {
        View::Diagram(diagram) => picture::svg(diagram)?,
        View::Turning(turning) => turning::svg(turning)?,
    };
    let folder = sheets::folder(out, &format!("campbell/{}", scene.name))?;
    sheets::leave(folder, "campbell", &view.table(), &view.rows(), &view.json(), &[("campbell.svg", svg)])
}
