//! `demo`: the main job, from a scene to a report with pictures.

use crate::run::run;
use crate::{package, paths, python, report, scenes};
use anyhow::Result;

/// Packages the scene, simulates it with fmpy, and reports. An energy that does not add up is an error.
pub fn demo(scene: &str) -> Result<()> {
    let name = scenes::find(scene)?.name;
    let fmu = package::package(&[scene.to_owned()], None)?.remove(0);
    let out = paths::target().join("demo").join(name);
    let view = report::linear_view(scene);
    run(python::python()?.arg("xtask/python/demo.py").arg(fmu).arg("--out").arg(out).args(view))
}
