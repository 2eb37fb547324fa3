//! What every report of a scene shows beside a run of it, whoever ran it.

use crate::campbell;
use std::ffi::OsString;

/// The linear view of a scene, as options of the report's Python: where `campbell` left it, or why there is none.
pub fn linear_view(scene: &str) -> [OsString; 2] {
    match campbell::campbell(scene, None, campbell::STEPS, &campbell::ORDERS, None) {
        Ok(left) => ["--linear".into(), left.folder.join("campbell.json").into()],
        Err(error) => ["--no-linear".into(), error.root_cause().to_string().into()],
    }
}
