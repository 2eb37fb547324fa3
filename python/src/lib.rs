//! The compiled part of the Python package `split_rotor`: a scene, its run and its linear view, over the same code as the commands.
//! What users see of it stands in `split_rotor/`.

mod run;
mod scene;
mod studies;

use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::path::PathBuf;

create_exception!(
    split_rotor,
    SceneError,
    PyValueError,
    "A scene that cannot be simulated: what is wrong, where, and what would be right."
);
create_exception!(split_rotor, RunError, PyRuntimeError, "A run that ended early; `result` holds what was reached.");

#[pymodule]
mod _core {
    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "as Python names it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
    #[pymodule_export]
    use super::did_you_mean;
    #[pymodule_export]
    use super::run::run;
    #[pymodule_export]
    use super::scene::Scene;
    #[pymodule_export]
    use super::studies::{accuracy, campbell, package, response};
    #[pymodule_export]
    use super::{RunError, SceneError};
}

/// The folder of what travels with the package: scenes, and the library of every effect.
fn data(py: Python) -> PyResult<PathBuf> {
    let file: PathBuf = py.import("split_rotor")?.getattr("__file__")?.extract()?;
    Ok(file.with_file_name("data"))
}

/// Which of the known names was probably meant, in words.
#[pyfunction]
fn did_you_mean(name: &str, known: Vec<String>) -> Option<String> {
    split_rotor_model::scene::did_you_mean(name, known.iter().map(String::as_str))
}

/// What the commands print of an error.
fn failed(error: anyhow::Error) -> PyErr {
    match error.downcast::<PyErr>() {
        Ok(interrupted) => interrupted,
        Err(error) if error.is::<split_rotor_model::scene::SceneError>() => SceneError::new_err(error.to_string()),
        Err(error) => PyRuntimeError::new_err(format!("{error:#}")),
    }
}
