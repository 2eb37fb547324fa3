//! What every report of a scene shows beside a run of it, whoever ran it.

use crate::campbell;
use anyhow::bail;
use split_rotor_model::scene::Scene;
use split_rotor_tools::run::Run;
use std::ffi::OsString;

/// The linear view of a scene, as options of the report's Python: where `campbell` left it, or why there is none.
pub fn linear_view(scene: &str) -> [OsString; 2] {
    match campbell::campbell(scene, None, campbell::STEPS, &campbell::ORDERS, None) {
        Ok(left) => ["--linear".into(), left.folder.join("campbell.json").into()],
        Err(error) => ["--no-linear".into(), error.root_cause().to_string().into()],
    }
}

/// In which directions nothing holds the rotor of a scene where its run begins, as options of the report's Python.
pub fn unheld(scene: &Scene) -> Vec<OsString> {
    let mut run = Run::of(scene, Vec::new());
    // A start that is refused is reported by the command that runs it.
    let _ = run.follow(&scene.experiment, |_, _| bail!("it has begun"));
    let told = run.unheld().filter(|unheld| !unheld.is_mere_axial());
    told.map(|unheld| vec!["--unheld".into(), unheld.to_string().into()]).unwrap_or_default()
}
