//! `demo`: the main job, from a scene to a report with pictures.

use crate::progress::program;
use crate::{package, paths, python, report, scenes};
use anyhow::Result;
use serde_json::{Value, json};
use split_rotor_model::scene::{Input, Scene};
use split_rotor_tools::run::Run;

/// Packages the scene, simulates it with fmpy, and reports. An energy that does not add up is an error.
pub fn demo(scene: &str) -> Result<()> {
    let found = scenes::find(scene)?;
    let mut run = Run::of(&found, Vec::new());
    // A start that is refused is reported as the FMU runs.
    let _ = run.begin(&found.experiment);
    let unheld = report::unheld(&run);
    let Scene { name, inputs, .. } = found;
    let fmu = package::package(&[scene.to_owned()], None)?.remove(0);
    let out = paths::target().join("demo").join(name);
    let view = report::linear_view(scene);
    let course = |input: &Input| json!({ "name": input.name, "time": input.time, "value": input.value });
    let inputs: Value = inputs.iter().map(course).collect();
    let mut demo = python::python()?;
    demo.arg("xtask/python/demo.py")
        .arg(fmu)
        .arg("--out")
        .arg(out)
        .args(["--inputs", &inputs.to_string()])
        .args(view)
        .args(unheld);
    program("simulating the FMU with fmpy, and making its report", &mut demo)
}
