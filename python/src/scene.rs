//! A scene as Python holds it: its text, and what was read from it.

use crate::{SceneError, data};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyInt};
use split_rotor_model::scene::{self, Experiment, did_you_mean};
use split_rotor_model::variable::Role;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, Table, Value};

/// A scene: the rotor, what acts on it, how it starts and how long it is looked at; it does not change.
#[pyclass(frozen, module = "split_rotor")]
pub struct Scene {
    /// What was read.
    pub scene: scene::Scene,
    text: String,
}

/// The sections whose keys are the names of variables.
const SECTIONS: [&str; 4] = ["rotor", "start", "solver", "experiment"];

#[pymethods]
impl Scene {
    /// The scene in this text; `path` names it, and is where the files of its inputs are looked for.
    #[staticmethod]
    #[pyo3(signature = (text, path = PathBuf::from("scene.toml")))]
    fn from_toml(text: String, path: PathBuf) -> PyResult<Self> {
        Ok(Self { scene: scene::Scene::parse(&path, &text).map_err(told)?, text })
    }

    /// The scene in this TOML file.
    #[staticmethod]
    fn load(path: PathBuf) -> PyResult<Self> {
        Self::of(scene::Scene::read(&path))
    }

    /// One of the scenes that come with the package: `Scene.names()`.
    #[staticmethod]
    fn named(py: Python, name: &str) -> PyResult<Self> {
        Self::of(scene::Scene::find(name, &data(py)?.join("scenes")))
    }

    /// The names of the scenes that come with the package.
    #[staticmethod]
    fn names(py: Python) -> PyResult<Vec<String>> {
        Ok(scene::Scene::names(&data(py)?.join("scenes")))
    }

    /// This scene with other parameters, by the names of variables ("rotor.m", "bearing[1].kyy", "unbalance[1].moment", "experiment.stop");
    /// values as in a scene: numbers in SI units, or texts with a unit ("3000 rpm").
    fn with_values(&self, values: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut document = self.document()?;
        for (name, value) in values {
            let name: String = name.extract()?;
            let value =
                toml(&value).map_err(|error| PyTypeError::new_err(format!("{name}: {}", error.value(value.py()))))?;
            let place = self.place(&mut document, &name).ok_or_else(|| told(self.unknown(&name)))?;
            *place = Item::Value(value);
        }
        Self::from_toml(document.to_string(), self.scene.file.clone())
    }

    /// This scene with these inputs over time, in place of its own of the same names: name, times in s, values.
    fn with_inputs(&self, inputs: Vec<(String, Vec<f64>, Vec<f64>)>) -> PyResult<Self> {
        let mut document = self.document()?;
        let all = document.entry("input").or_insert(Item::ArrayOfTables(ArrayOfTables::new()));
        let Some(all) = all.as_array_of_tables_mut() else {
            return Err(told(self.error("input is written within a line", "write [[input]]")));
        };
        for (name, time, value) in inputs {
            all.retain(|input| input.get("name").and_then(Item::as_str) != Some(&name));
            let mut table = Table::new();
            table.insert("name", name.into());
            table.insert("time", Item::Value(Array::from_iter(time).into()));
            table.insert("value", Item::Value(Array::from_iter(value).into()));
            all.push(table);
        }
        Self::from_toml(document.to_string(), self.scene.file.clone())
    }

    /// The name of its file, and of its FMU.
    #[getter]
    fn name(&self) -> &str {
        &self.scene.name
    }

    /// One line on what it shows.
    #[getter]
    fn title(&self) -> &str {
        &self.scene.title
    }

    /// Its text.
    #[getter]
    fn toml(&self) -> &str {
        &self.text
    }

    /// What acts on the rotor.
    #[getter]
    fn effects(&self) -> Vec<String> {
        self.scene.effects.iter().map(|(info, index)| info.block_name(*index)).collect()
    }

    /// Parameters, inputs and outputs by name: causality, unit, description, and its value at the start.
    #[getter]
    fn variables<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for variable in &self.scene.variables {
            let causality = match variable.meta.role {
                Role::Parameter { .. } => "parameter",
                Role::Input { .. } => "input",
                Role::Output => "output",
                Role::State | Role::Mode => continue,
            };
            let one = PyDict::new(py);
            one.set_item("causality", causality)?;
            one.set_item("unit", variable.meta.unit.name)?;
            one.set_item("description", variable.meta.description)?;
            one.set_item("start", self.scene.starts.get(&variable.place.value_reference()))?;
            all.set_item(&variable.name, one)?;
        }
        Ok(all)
    }

    /// Its inputs over time by name: times in s and values.
    #[getter]
    fn inputs(&self) -> BTreeMap<&str, (&[f64], &[f64])> {
        self.scene.inputs.iter().map(|input| (&*input.name, (&*input.time, &*input.value))).collect()
    }

    /// When and how finely it is looked at: `start`, `stop` and `step` in s, `tolerance`.
    #[getter]
    fn experiment(&self) -> BTreeMap<&str, f64> {
        let Experiment { start, stop, step, tolerance } = self.scene.experiment;
        BTreeMap::from([("start", start), ("stop", stop), ("step", step), ("tolerance", tolerance)])
    }

    fn __repr__(&self) -> String {
        format!("<Scene {}: {}>", self.scene.name, self.scene.title)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (&str, &Path))> {
        Ok((py.get_type::<Self>().getattr("from_toml")?, (&self.text, &self.scene.file)))
    }
}

impl Scene {
    /// What was read from a file, with its text.
    fn of(read: Result<scene::Scene, scene::SceneError>) -> PyResult<Self> {
        let scene = read.map_err(told)?;
        Ok(Self { text: std::fs::read_to_string(&scene.file)?, scene })
    }

    /// One more of it, which its owner may change.
    pub fn again(&self) -> PyResult<scene::Scene> {
        scene::Scene::parse(&self.scene.file, &self.text).map_err(told)
    }

    fn document(&self) -> PyResult<DocumentMut> {
        self.text.parse().map_err(|error: toml_edit::TomlError| SceneError::new_err(error.to_string()))
    }

    /// Where the value of this name stands in the file, or would stand; None where the scene does not hold that it belongs to.
    fn place<'d>(&self, document: &'d mut DocumentMut, name: &str) -> Option<&'d mut Item> {
        let mut parts = name.split('.').flat_map(|part| part.split('[')).peekable();
        let first = *parts.peek()?;
        let mut place = document.as_item_mut();
        if !SECTIONS.contains(&first) {
            place = place.get_mut("effects")?;
            // What is not called for is not called for by a value.
            place.get(first)?;
        }
        for part in parts {
            place = match part.strip_suffix(']') {
                Some(number) => place.get_mut(number.parse::<usize>().ok()?.checked_sub(1)?)?,
                None if place.is_table_like() || place.is_none() => &mut place[part],
                None => return None,
            };
        }
        Some(place)
    }

    fn unknown(&self, name: &str) -> scene::SceneError {
        let names: Vec<_> = self.scene.variables.iter().filter(|it| it.meta.has_start()).map(|it| &*it.name).collect();
        let right = did_you_mean(name, names).unwrap_or_else(|| "`scene.variables` has those that there are".into());
        self.error(&format!("the scene has no parameter `{name}`"), &right)
    }

    fn error(&self, wrong: &str, right: &str) -> scene::SceneError {
        scene::SceneError::of_file(&self.scene.file, wrong, right)
    }
}

/// A scene's errors as the commands print them.
fn told(error: scene::SceneError) -> PyErr {
    SceneError::new_err(error.to_string())
}

/// A value of Python as a scene has it.
fn toml(value: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Ok(is) = value.cast::<PyBool>() {
        return Ok(is.is_true().into());
    }
    if let Ok(text) = value.extract::<String>() {
        return Ok(text.into());
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(value.extract::<i64>()?.into());
    }
    if let Ok(number) = value.extract::<f64>() {
        return Ok(number.into());
    }
    let Ok(several) = value.try_iter() else {
        let kind = value.get_type().name()?;
        let words = format!("a value must be a number, a text, True or False, or a list of these, not {kind}");
        return Err(PyTypeError::new_err(words));
    };
    let several: PyResult<Vec<Value>> = several.map(|one| toml(&one?)).collect();
    Ok(Array::from_iter(several?).into())
}
