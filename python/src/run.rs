//! A run, and what was seen of it as arrays.

use crate::SceneError;
use crate::scene::Scene;
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyDict};
use split_rotor_model::scene::{Experiment, did_you_mean};
use split_rotor_model::simulation::{Deflection, Growth};
use split_rotor_model::variables::Variable;
use split_rotor_tools::run::{Run, outputs, points};
use std::time::{Duration, Instant};

/// How often it is looked whether the user wants to end a run.
const PATIENCE: Duration = Duration::from_millis(50);

/// What was seen: times and values of so many communication points, why there are no more.
struct Seen {
    time: Vec<f64>,
    values: Vec<f64>,
    count: usize,
    outcome: anyhow::Result<()>,
}

/// Runs a scene; of its outputs those of these names, or all. Others run meanwhile.
///
/// Returns a dictionary: `time` (points) and `values` (outputs, points) as bytes, how many points were reached (`count`), `names`, `units`, `solver`, `log`, `warnings`, the `largest` deflection \[m]
/// of each station and when that was \[s], and `error` where the run ended early.
#[pyfunction]
pub fn run<'py>(py: Python<'py>, scene: &Scene, names: Option<Vec<String>>) -> PyResult<Bound<'py, PyDict>> {
    let scene = &scene.scene;
    let read: Vec<&Variable> = match names {
        None => outputs(scene).collect(),
        Some(names) => names.iter().map(|name| output(scene, name)).collect::<PyResult<_>>()?,
    };
    let mut run = Run::of(scene, read).with_deflections();
    let Seen { time, values, count, outcome } = py.detach(|| follow(&mut run, &scene.experiment));
    let error = match outcome {
        Ok(()) => None,
        // Nothing was reached, or the user has ended it.
        Err(error) if count == 0 || error.is::<PyErr>() => return Err(crate::failed(error)),
        Err(error) => Some(format!("{}: {error}", scene.file.display())),
    };
    let cost = run.simulation.read().map_err(|invalid| SceneError::new_err(invalid.to_string()))?.cost;
    let solver = PyDict::new(py);
    solver.set_item("method", run.method())?;
    solver.set_item("steps", cost.steps)?;
    solver.set_item("rejected", cost.rejected)?;
    solver.set_item("evaluations", cost.evaluations)?;
    let result = PyDict::new(py);
    result.set_item("time", bytes(py, &time))?;
    result.set_item("values", bytes(py, &values))?;
    result.set_item("count", count)?;
    result.set_item("names", run.outputs().iter().map(|output| &*output.name).collect::<Vec<_>>())?;
    result.set_item("units", run.outputs().iter().map(|output| output.meta.unit.name).collect::<Vec<_>>())?;
    result.set_item("solver", solver)?;
    result.set_item("log", run.simulation.auto().into_iter().collect::<Vec<_>>())?;
    let of_tilt = run.simulation.warns_of_tilt().map(str::to_owned);
    let unheld = run.unheld().filter(|unheld| !unheld.is_mere_axial()).map(ToString::to_string);
    let of_unjudged = run.unjudged().map(|unjudged| unjudged.to_string());
    let of_rattle = run.simulation.rattle().map(|rattle| rattle.to_string());
    let doubts = run.doubts().iter().map(|(block, doubt)| doubt.words(block));
    let of_motion = unheld.into_iter().chain(of_tilt).chain(run.grown().iter().map(Growth::to_string));
    let warnings: Vec<_> =
        scene.warnings().into_iter().chain(of_motion).chain(of_unjudged).chain(of_rattle).chain(doubts).collect();
    result.set_item("warnings", warnings)?;
    let largest = PyDict::new(py);
    for (name, Deflection { largest: size, at, .. }) in run.largest() {
        largest.set_item(name, (size, at))?;
    }
    result.set_item("largest", largest)?;
    result.set_item("error", error)?;
    Ok(result)
}

/// Numbers as an array of Python takes them.
fn bytes<'py>(py: Python<'py>, numbers: &[f64]) -> Bound<'py, PyByteArray> {
    PyByteArray::new(py, bytemuck::cast_slice(numbers))
}

/// The output of this name.
fn output<'s>(scene: &'s split_rotor_model::scene::Scene, name: &str) -> PyResult<&'s Variable> {
    outputs(scene).find(|output| output.name == name).ok_or_else(|| {
        let meant = did_you_mean(name, outputs(scene).map(|output| &*output.name));
        let meant = meant.map_or_else(String::new, |meant| format!(": {meant}"));
        SceneError::new_err(format!("{} has no output `{name}`{meant}", scene.name))
    })
}

/// Runs, and keeps what is seen at the points of an experiment, output by output.
fn follow(run: &mut Run, experiment: &Experiment) -> Seen {
    let points = points(experiment) + 1;
    let mut seen =
        Seen { time: vec![0.0; points], values: vec![0.0; points * run.outputs().len()], count: 0, outcome: Ok(()) };
    let Seen { time, values, count, .. } = &mut seen;
    let mut asked = Instant::now();
    let outcome = run.follow(experiment, |run, t| {
        time[*count] = t;
        for (value, output) in run.values()?.iter().zip(values.chunks_exact_mut(points)) {
            output[*count] = *value;
        }
        *count += 1;
        if asked.elapsed() > PATIENCE {
            Python::attach(|py| py.check_signals())?;
            asked = Instant::now();
        }
        Ok(())
    });
    Seen { outcome, ..seen }
}
