//! modelDescription.xml (FMI 2.0.4) and the GUID of a scene, from the one list of variables.

use crate::log::{self, Category};
use crate::scene::Scene;
use crate::variable::units::Unit;
use crate::variable::{Bound, Depends, Enumeration, Kind, Role};
use crate::variables::Variable;
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use std::io;
use uuid::Uuid;

/// The namespace of our GUIDs.
const NAMESPACE: Uuid = Uuid::from_u128(0x8a1c_66f0_52b3_4d0e_9b1d_7c6f_2f4e_5a31);

/// The scene's modelDescription.xml.
pub fn model_description(scene: &Scene) -> String {
    render(scene, &guid(scene))
}

/// The scene's GUID: it follows every change of the text.
pub fn guid(scene: &Scene) -> String {
    format!("{{{}}}", Uuid::new_v5(&NAMESPACE, render(scene, "").as_bytes()))
}

type Out = Writer<Vec<u8>>;

fn render(scene: &Scene, guid: &str) -> String {
    let mut out = Writer::new_with_indent(Vec::new(), b' ', 2);
    write(&mut out, scene, guid).expect("writing to memory does not fail");
    let mut text = String::from_utf8(out.into_inner()).expect("the XML is UTF-8");
    text.push('\n');
    text
}

fn write(out: &mut Out, scene: &Scene, guid: &str) -> io::Result<()> {
    out.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let version = env!("CARGO_PKG_VERSION");
    let attributes = [
        ("fmiVersion", "2.0"),
        ("modelName", &scene.name),
        ("guid", guid),
        ("description", &scene.title),
        ("version", version),
        ("license", env!("CARGO_PKG_LICENSE")),
        ("generationTool", &format!("split-rotor {version}")),
        ("variableNamingConvention", "structured"),
    ];
    out.create_element("fmiModelDescription").with_attributes(attributes).write_inner_content(|out| {
        let capabilities = [
            ("modelIdentifier", scene.identifier()),
            ("canHandleVariableCommunicationStepSize", "true".into()),
            ("canNotUseMemoryManagementFunctions", "true".into()),
            ("canGetAndSetFMUstate", "true".into()),
        ];
        empty(out, "CoSimulation", &capabilities)?;
        units(out, &scene.variables)?;
        types(out, &scene.variables)?;
        inside(out, "LogCategories", |out| {
            let all = (log::ALL, "all messages");
            for (name, description) in Category::EACH.map(Category::words).into_iter().chain([all]) {
                empty(out, "Category", &[("name", name.into()), ("description", description.into())])?;
            }
            Ok(())
        })?;
        let experiment = &scene.experiment;
        let times = [
            ("startTime", number(experiment.start)),
            ("stopTime", number(experiment.stop)),
            ("tolerance", number(experiment.tolerance)),
            ("stepSize", number(experiment.step)),
        ];
        empty(out, "DefaultExperiment", &times)?;
        inside(out, "ModelVariables", |out| {
            scene.variables.iter().try_for_each(|variable| scalar_variable(out, scene, variable))
        })?;
        inside(out, "ModelStructure", |out| structure(out, scene))
    })?;
    Ok(())
}

fn units(out: &mut Out, variables: &[Variable]) -> io::Result<()> {
    let mut used: Vec<&Unit> = Vec::new();
    for unit in variables.iter().map(|variable| variable.meta.unit) {
        if !unit.name.is_empty() && !used.contains(&unit) {
            used.push(unit);
        }
    }
    inside(out, "UnitDefinitions", |out| {
        for unit in used {
            out.create_element("Unit").with_attribute(("name", unit.name)).write_inner_content(|out| {
                let exponents = ["kg", "m", "s", "rad"].into_iter().zip(unit.exponents);
                let exponents: Vec<_> =
                    exponents.filter(|(_, power)| *power != 0).map(|(base, power)| (base, power.to_string())).collect();
                empty(out, "BaseUnit", &exponents)?;
                if let Some((name, factor)) = unit.display {
                    empty(out, "DisplayUnit", &[("name", name.into()), ("factor", number(factor))])?;
                }
                Ok(())
            })?;
        }
        Ok(())
    })
}

fn types(out: &mut Out, variables: &[Variable]) -> io::Result<()> {
    let mut used: Vec<&Enumeration> = Vec::new();
    for variable in variables {
        if let Kind::Enumeration(of) = variable.meta.kind
            && !used.contains(&of)
        {
            used.push(of);
        }
    }
    inside(out, "TypeDefinitions", |out| {
        for of in used {
            out.create_element("SimpleType").with_attribute(("name", of.name)).write_inner_content(|out| {
                inside(out, "Enumeration", |out| {
                    for (value, name, description) in of.items {
                        let item = [
                            ("name", (*name).into()),
                            ("value", value.to_string()),
                            ("description", (*description).into()),
                        ];
                        empty(out, "Item", &item)?;
                    }
                    Ok(())
                })
            })?;
        }
        Ok(())
    })
}

fn scalar_variable(out: &mut Out, scene: &Scene, variable: &Variable) -> io::Result<()> {
    let meta = &variable.meta;
    let reference = variable.place.value_reference();
    let (causality, variability, initial) = match meta.role {
        Role::Parameter { .. } => ("parameter", "fixed", "exact"),
        Role::Output(_) => ("output", "continuous", "calculated"),
    };
    let attributes = [
        ("name", variable.name.as_str()),
        ("valueReference", &reference.to_string()),
        ("description", meta.description),
        ("causality", causality),
        ("variability", variability),
        ("initial", initial),
    ];
    let start = match meta.role {
        Role::Parameter { bound, .. } => Some((scene.starts[&reference], bound)),
        Role::Output(_) => None,
    };
    out.create_element("ScalarVariable").with_attributes(attributes).write_inner_content(|out| match meta.kind {
        Kind::Real => empty(out, "Real", &real(meta.unit, start)),
        Kind::Enumeration(of) => {
            let mut attributes = vec![("declaredType", of.name.to_owned())];
            attributes.extend(start.map(|(value, _)| ("start", value.to_string())));
            empty(out, "Enumeration", &attributes)
        }
    })?;
    Ok(())
}

fn real(unit: &Unit, start: Option<(f64, Bound)>) -> Vec<(&'static str, String)> {
    let mut attributes = Vec::new();
    if !unit.name.is_empty() {
        attributes.push(("unit", unit.name.to_owned()));
        attributes.extend(unit.display.map(|(name, _)| ("displayUnit", name.to_owned())));
    }
    if let Some((value, bound)) = start {
        let (least, greatest) = bound.range();
        attributes.extend(least.map(|value| ("min", number(value))));
        attributes.extend(greatest.map(|value| ("max", number(value))));
        attributes.push(("start", number(value)));
    }
    attributes
}

/// Outputs, which depend on no input as there is none, and what they depend on at the start.
fn structure(out: &mut Out, scene: &Scene) -> io::Result<()> {
    let outputs: Vec<_> = (1..)
        .zip(&scene.variables)
        .filter_map(|(index, variable)| match variable.meta.role {
            Role::Output(depends) => Some((index, depends)),
            Role::Parameter { .. } => None,
        })
        .collect();
    inside(out, "Outputs", |out| outputs.iter().try_for_each(|(index, _)| unknown(out, *index, "")))?;
    inside(out, "InitialUnknowns", |out| {
        outputs.iter().try_for_each(|(index, depends)| unknown(out, *index, &indices(scene, *depends)))
    })
}

fn unknown(out: &mut Out, index: usize, dependencies: &str) -> io::Result<()> {
    empty(out, "Unknown", &[("index", index.to_string()), ("dependencies", dependencies.into())])
}

/// The indices of the parameters that an output depends on, ascending.
fn indices(scene: &Scene, depends: Depends) -> String {
    let of_potential = || scene.effects.iter().flat_map(|(info, _)| info.potential_depends);
    let names: Vec<&str> = match depends {
        Depends::On(names) => names.to_vec(),
        Depends::Potential => of_potential().copied().collect(),
        Depends::PotentialAnd(names) => names.iter().chain(of_potential()).copied().collect(),
    };
    let meant = |variable: &str, name: &str| {
        variable.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    let chosen = (1..).zip(&scene.variables).filter(|(_, v)| names.iter().any(|name| meant(&v.name, name)));
    chosen.map(|(index, _): (usize, _)| index.to_string()).collect::<Vec<_>>().join(" ")
}

/// A floating-point number that reads back to the same bits.
fn number(value: f64) -> String {
    format!("{value:?}")
}

fn inside(out: &mut Out, name: &str, content: impl FnOnce(&mut Out) -> io::Result<()>) -> io::Result<()> {
    out.create_element(name).write_inner_content(content)?;
    Ok(())
}

fn empty(out: &mut Out, name: &str, attributes: &[(&str, String)]) -> io::Result<()> {
    let attributes = attributes.iter().map(|(key, value)| (*key, value.as_str()));
    out.create_element(name).with_attributes(attributes).write_empty()?;
    Ok(())
}
