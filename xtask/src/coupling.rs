//! `coupling`: how long communication steps may be where the bearings of a machine are other models, and what to set in which master.

mod picture;

use crate::progress::Progress;
use crate::{scenes, sheets};
use anyhow::{Result, anyhow};
use split_rotor_model::scene::Given;
use split_rotor_model::variable::units::SECOND;
use split_rotor_tools::coupling::Found;
use split_rotor_tools::coupling::exchange::Scheme;
use std::path::Path;

/// Measures the couplings of a scene at this speed [rad/s], at these communication steps. Into the folder `out`, or target/coupling/SCENE.
pub fn coupling(scene: &str, speed: Option<f64>, steps: &[String], out: Option<&Path>) -> Result<()> {
    let scene = scenes::find(scene)?;
    let step = |text: &String| Given::new(text).value(&SECOND).map_err(|wrong| anyhow!("--steps {wrong}"));
    let steps = steps.iter().map(step).collect::<Result<Vec<_>>>()?;
    let mut progress: Option<Progress> = None;
    let found = Found::of(&scene, speed, (!steps.is_empty()).then_some(steps), |n, all| {
        let progress = progress.get_or_insert_with(|| {
            let progress = Progress::of(all);
            progress.tell("running the machine and its partners at each communication step");
            progress
        });
        progress.set_position(n as u64);
    });
    drop(progress);
    let found = found?;
    let pictures = Scheme::ALL.map(|scheme| Ok((scheme.name().to_owned() + ".svg", picture::svg(&found, scheme)?)));
    let pictures = pictures.into_iter().collect::<Result<Vec<_>>>()?;
    let pictures: Vec<_> = pictures.iter().map(|(name, svg)| (&**name, svg.clone())).collect();
    let folder = sheets::folder(out, &format!("coupling/{}", scene.name))?;
    sheets::leave(folder, "coupling", &found.table(), &found.rows(), &found.json(), &pictures)?.show();
    Ok(())
}
