//! The linear equations of a scene as an FMU of their own, in C that travels with it.

use crate::{c, paths};
use anyhow::{Context, Result};
use minijinja::{Value, context};
use nalgebra::DMatrix;
use split_rotor_model::linear::{Quantity, StateSpace};
use split_rotor_model::log::Category;
use split_rotor_model::scene::Scene;
use split_rotor_model::variable::units::Unit;
use split_rotor_model::variables::Variable;
use split_rotor_model::xml;
use split_rotor_tools::archive::{ICON, archive, licence};
use split_rotor_tools::platform::Platform;
use split_rotor_tools::templates;
use std::env::consts::DLL_SUFFIX;
use std::fs;
use std::path::{Path, PathBuf};

/// The C that is the same in each model; what is compiled is the first.
const SOURCES: [&str; 4] = ["linear.c", "instance.h", "equations.h", "fmi2.h"];

/// The numbers of a model, beside them.
const MATRICES: &str = "matrices.h";

/// Writes SCENE_linear.fmu into a folder; its path. Where no library can be compiled, it has its sources only, and that is told.
pub fn write(scene: &Scene, space: &StateSpace, folder: &Path) -> Result<PathBuf> {
    let (name, identifier) = (format!("{}_linear", scene.name), format!("{}_linear", scene.identifier()));
    let values = values(scene, space)?;
    let render = |file: &str, guid: &str| {
        let values = context! { name => &name, identifier => &identifier, guid, ..values.clone() };
        templates::render(&format!("linear/{file}"), values)
    };
    let said = |guid: &str| Ok::<_, anyhow::Error>([render("modelDescription.xml", guid)?, render(MATRICES, guid)?]);
    let guid = xml::guid_of(&said("")?.concat());
    let [description, matrices] = said(&guid)?;
    let sources = sources(scene);
    fs::create_dir_all(&sources)?;
    for source in SOURCES {
        fs::copy(paths::root().join("modelDescription/linear").join(source), sources.join(source))?;
    }
    fs::write(sources.join(MATRICES), matrices)?;
    let library =
        Platform::here().and_then(|here| Ok((here.library_path(&identifier), fs::read(library(scene, &[])?)?)));
    let fmu = folder.join(format!("{name}.fmu"));
    archive(&fmu, |add| {
        add("modelDescription.xml", description.as_bytes())?;
        add("model.png", ICON)?;
        if let Ok((path, library)) = &library {
            add(path, library)?;
        }
        for source in SOURCES.iter().chain(&[MATRICES]) {
            add(&format!("sources/{source}"), &fs::read(sources.join(source))?)?;
        }
        add("documentation/index.html", render("index.html", &guid)?.as_bytes())?;
        add("documentation/licenses/license.txt", licence("It holds no libraries of others.").as_bytes())
    })?;
    if let Err(error) = library {
        eprintln!("{} holds its sources, but no library: {error:#}", fmu.display());
    }
    Ok(fmu)
}

/// Where the sources of a scene's linear FMU stand, once it was written.
fn sources(scene: &Scene) -> PathBuf {
    paths::target().join("linear").join(scene.identifier())
}

/// Compiles them with further flags to a shared library beside them.
pub fn library(scene: &Scene, flags: &[&str]) -> Result<PathBuf> {
    c::library(&sources(scene), SOURCES[0], &format!("library{DLL_SUFFIX}"), flags)
}

/// What the templates are filled in with, but for the names of the model.
fn values(scene: &Scene, space: &StateSpace) -> Result<Value> {
    let StateSpace { steady, states, inputs, outputs, a, b, c, d, .. } = space;
    let mut matrix = DMatrix::zeros(states.len() + outputs.len(), states.len() + inputs.len());
    matrix.view_mut((0, 0), a.shape()).copy_from(a);
    matrix.view_mut((0, states.len()), b.shape()).copy_from(b);
    matrix.view_mut((states.len(), 0), c.shape()).copy_from(c);
    matrix.view_mut((states.len(), states.len()), d.shape()).copy_from(d);
    let mut variables = Vec::new();
    let mut units = Vec::new();
    let mut list = |unit: &'static Unit, variable: Value| {
        units.push(unit);
        let display = unit.display.map(|(name, _)| name);
        variables.push(context! { unit => unit.name, display, ..variable });
    };
    for (n, state) in states.iter().enumerate() {
        let (found, _) = of_state(scene, state)?;
        let nominal = xml::nominal_of(scene, found).context("a state has a nominal")?;
        list(
            state.unit,
            context! {
                name => deviation(state),
                description => format!("{}, less its steady value {:?}", described(space, n, found), state.steady),
                causality => "local",
                initial => "exact",
                steady => "0.0",
                start => "0.0",
                nominal => format!("{nominal:?}"),
            },
        );
    }
    for input in inputs {
        let steady = format!("{:?}", input.steady);
        let description = named(scene, &input.name)?.meta.description;
        list(input.unit, context! { name => &input.name, description, causality => "input", start => &steady, steady });
    }
    let entries = |row: usize| -> (Vec<String>, String) {
        let row: Vec<f64> = matrix.row(row).iter().copied().collect();
        let depends = (1..).zip(&row).filter(|(_, entry)| **entry != 0.0).map(|(index, _)| index.to_string());
        (row.iter().map(|entry| format!("{entry:?}")).collect(), depends.collect::<Vec<_>>().join(" "))
    };
    for (n, state) in states.iter().enumerate() {
        let (entries, dependencies) = entries(n);
        list(
            of_state(scene, state)?.1.meta.unit,
            context! {
                name => format!("der({})", deviation(state)),
                description => format!("rate of {}", deviation(state)),
                causality => "local",
                initial => "calculated",
                steady => "0.0",
                derivative => n + 1,
                entries,
                dependencies,
            },
        );
    }
    for (n, output) in outputs.iter().enumerate() {
        let (entries, dependencies) = entries(states.len() + n);
        list(
            output.unit,
            context! {
                name => &output.name,
                description => named(scene, &output.name)?.meta.description,
                causality => "output",
                initial => "calculated",
                steady => format!("{:?}", output.steady),
                entries,
                dependencies,
            },
        );
    }
    let experiment = &scene.experiment;
    Ok(context! {
        title => &scene.title,
        scene => &scene.name,
        speed => steady.speed.to_string(),
        version => env!("CARGO_PKG_VERSION"),
        licence => env!("CARGO_PKG_LICENSE"),
        start => format!("{:?}", experiment.start),
        stop => format!("{:?}", experiment.stop),
        step => format!("{:?}", experiment.step),
        tolerance => format!("{:?}", experiment.tolerance),
        categories => [Category::Error, Category::Discard].map(Category::words).to_vec(),
        states => states.len(),
        columns => states.len() + inputs.len(),
        units => templates::units(units.into_iter()),
        variables,
    })
}

/// The variable of the scene's own FMU that has this name.
fn named<'s>(scene: &'s Scene, name: &str) -> Result<&'s Variable> {
    let found = scene.variables.iter().find(|variable| variable.name == name);
    found.with_context(|| format!("the scene has no {name}"))
}

/// A state of the scene's own FMU that is like this one, and its rate.
fn of_state<'s>(scene: &'s Scene, state: &Quantity) -> Result<(&'s Variable, &'s Variable)> {
    let name = if state.name.starts_with(MOMENTUM) { "state.K.y" } else { &state.name };
    Ok((named(scene, name)?, named(scene, &format!("der({name})"))?))
}

/// The parts of K across the axis, by number from 1.
const MOMENTUM: &str = "state.K.u";

/// The name of a state counted from the steady state: that of the scene's own FMU is counted from 0.
fn deviation(state: &Quantity) -> String {
    state.name.replacen("state.", "deviation.", 1)
}

/// What the state of this number is, which is like that of the scene's own FMU.
fn described(space: &StateSpace, number: usize, like: &Variable) -> String {
    let description = like.meta.description;
    match space.states[number].name.strip_prefix(MOMENTUM) {
        None => description.into(),
        Some(part) => {
            let along = space.directions.column(usize::from(part == "2"));
            format!("{}, along ({}, {}, {})", description.trim_end_matches(", y"), along.x, along.y, along.z)
        }
    }
}
