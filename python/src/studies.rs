//! What the commands find out about a scene, and its FMU.

use crate::scene::Scene;
use crate::{data, failed};
use anyhow::Result;
use pyo3::prelude::*;
use split_rotor_model::linear::Machine;
use split_rotor_model::scene;
use split_rotor_tools::accuracy::run::Subject;
use split_rotor_tools::accuracy::{measure, span, sweep};
use split_rotor_tools::archive::{self, Origin};
use split_rotor_tools::campbell::View;
use split_rotor_tools::general::{self, GENERAL};
use split_rotor_tools::platform::Platform;
use split_rotor_tools::response::Found;
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::path::{Path, PathBuf};

/// The table and all of the Campbell diagram, as JSON.
#[pyfunction]
pub fn campbell(
    py: Python,
    scene: &Scene,
    speeds: Option<[f64; 2]>,
    steps: u32,
    orders: Vec<f64>,
) -> PyResult<(String, String)> {
    py.detach(|| {
        let machine = Machine::of(&scene.scene.parameters());
        let view = View::of(&scene.scene, &machine, speeds, steps, &orders)?;
        Ok((view.table(), view.json().to_string()))
    })
    .map_err(failed)
}

/// The table and all of the response to unbalance, as JSON.
#[pyfunction]
pub fn response(
    py: Python,
    scene: &Scene,
    speeds: Option<[f64; 2]>,
    steps: u32,
    linear: bool,
) -> PyResult<(String, String)> {
    py.detach(|| {
        let found = Found::of(&scene.scene, speeds, steps, !linear)?;
        Ok((found.table(), found.json().to_string()))
    })
    .map_err(failed)
}

/// The tables and all of what accuracy costs in time, as JSON: of the scene's FMU, whose library is put into this folder.
#[pyfunction]
pub fn accuracy(py: Python, scene: &Scene, folder: PathBuf) -> PyResult<(String, String)> {
    let (scene, library) = over_general(&data(py)?, scene.again()?).map_err(failed)?;
    let begins = |_: &str| Ok(Python::attach(|py| py.check_signals())?);
    py.detach(|| {
        let file = folder.join(format!("{DLL_PREFIX}split_rotor{DLL_SUFFIX}"));
        std::fs::write(&file, library)?;
        let mut subject = Subject::load(&scene, &file)?;
        span::shorten(&mut subject);
        let result = measure(&scene, &subject, &sweep::curves(&subject), begins, || {}, |_, _| Vec::new())?;
        Ok((result.table(), result.json().to_string()))
    })
    .map_err(failed)
}

/// A scene as the general library runs it, which travels with the package, and that with its values.
fn over_general(data: &Path, scene: scene::Scene) -> Result<(scene::Scene, Vec<u8>)> {
    let general = scene::Scene::find(GENERAL, &data.join("scenes"))?;
    let library = std::fs::read(data.join(format!("{DLL_PREFIX}split_rotor{DLL_SUFFIX}")))?;
    general::over(&general, library, scene)
}

/// Writes the scene's FMU, over the library of every effect that travels with the package.
#[pyfunction]
pub fn package(py: Python, scene: &Scene, path: PathBuf) -> PyResult<()> {
    let data = data(py)?;
    let scene = scene.again()?;
    py.detach(|| {
        let read = |name: &str| std::fs::read_to_string(data.join(name));
        let origin = Origin { licences: read("third-party.txt")?, bill: read("bill-of-materials.cdx.json")? };
        let (scene, library) = over_general(&data, scene)?;
        let libraries = [(Platform::here()?, library)];
        archive::archive(&path, |add| archive::fill(&scene, &libraries, &origin, add))
    })
    .map_err(failed)
}
