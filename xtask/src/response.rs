//! `response`: how far and when an unbalance makes the stations of a machine whirl, against the spin; by the linear equations, and by
//! the laws as they stand.

mod picture;

use crate::progress::stage;
use crate::{scenes, sheets};
use anyhow::Result;
use split_rotor_tools::response::{Found, nonlinear};
use std::path::Path;

/// Finds the response of a scene between these speeds [rad/s], at so many of them; whether also by the laws as they stand. Into the
/// folder `out`, or target/response/SCENE.
pub fn response(scene: &str, ends: Option<[f64; 2]>, steps: u32, exact: bool, out: Option<&Path>) -> Result<()> {
    let scene = scenes::find(scene)?;
    let what = match exact {
        true => "following the whirl by the laws as they stand, up to a minute (--linear leaves it out)",
        false => "solving the linear equations",
    };
    let found = stage(what, || Found::of(&scene, ends, steps, exact))?;
    let pictures = [("response.svg", picture::svg(&found)?)];
    let folder = sheets::folder(out, &format!("response/{}", scene.name))?;
    let left = sheets::leave(folder, "response", &found.table(), &found.rows(), &found.json(), &pictures)?;
    std::fs::write(left.folder.join("nonlinear.csv"), sheets::csv(&nonlinear::rows(&found)))?;
    std::fs::write(left.folder.join("peaks.csv"), sheets::csv(&found.peaks()))?;
    left.show();
    Ok(())
}
