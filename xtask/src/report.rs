//! What every report of a scene shows beside a run of it, whoever ran it.

use crate::campbell;
use split_rotor_tools::run::Run;
use std::ffi::OsString;

/// The linear view of a scene, as options of the report's Python: where `campbell` left it, or why there is none.
pub fn linear_view(scene: &str) -> [OsString; 2] {
    match campbell::campbell(scene, None, campbell::STEPS, &campbell::ORDERS, None) {
        Ok(left) => ["--linear".into(), left.folder.join("campbell.json").into()],
        Err(error) => ["--no-linear".into(), error.root_cause().to_string().into()],
    }
}

/// In which directions nothing holds the rotor of a run that has begun, as options of the report's Python.
pub fn unheld(run: &Run) -> Vec<OsString> {
    let told = run.unheld().filter(|unheld| !unheld.is_mere_axial());
    told.map(|unheld| vec!["--unheld".into(), unheld.to_string().into()]).unwrap_or_default()
}
