//! modelDescription.xml (FMI 2.0.4) and the GUID of a scene, from the one list of variables.

use crate::dependencies::Dependencies;
use crate::log::{self, Category};
use crate::scene::Scene;
use crate::simulation::{Any, Integrator};
use crate::state::{GAMMA, PHI, SUPPLIED};
use crate::variable::units::Unit;
use crate::variable::{Bound, Enumeration, Kind, Role};
use crate::variables::{Variable, state_number};
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
    guid_of(&render(scene, ""))
}

/// The GUID of a model of which this text says everything.
pub fn guid_of(text: &str) -> String {
    format!("{{{}}}", Uuid::new_v5(&NAMESPACE, text.as_bytes()))
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
        ("numberOfEventIndicators", &scene.indicators.to_string()),
    ];
    out.create_element("fmiModelDescription").with_attributes(attributes).write_inner_content(|out| {
        let common = [
            ("modelIdentifier", scene.identifier()),
            ("canNotUseMemoryManagementFunctions", "true".into()),
            ("canGetAndSetFMUstate", "true".into()),
            ("canSerializeFMUstate", "true".into()),
            ("providesDirectionalDerivative", "true".into()),
        ];
        empty(out, "ModelExchange", &common)?;
        let co_simulation = [
            ("canHandleVariableCommunicationStepSize", "true".into()),
            ("canInterpolateInputs", "true".into()),
            ("maxOutputDerivativeOrder", "1".into()),
        ];
        empty(out, "CoSimulation", &[&common[..], &co_simulation].concat())?;
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
        Role::Parameter { .. } => ("parameter", "fixed", Some("exact")),
        Role::Input { .. } => ("input", "continuous", None),
        Role::Output => ("output", "continuous", Some("calculated")),
        Role::State => ("local", "continuous", Some("calculated")),
        Role::Mode => ("local", "discrete", Some("calculated")),
    };
    let reference_text = reference.to_string();
    // `min` would be a possible value.
    let description = match meta.role {
        Role::Parameter { bound: Bound::Positive, .. } => format!("{}, > 0", meta.description),
        _ => meta.description.to_owned(),
    };
    let attributes = [
        ("name", Some(variable.name.as_str())),
        ("valueReference", Some(&reference_text)),
        ("description", Some(&description)),
        ("causality", Some(causality)),
        ("variability", Some(variability)),
        ("initial", initial),
    ];
    let attributes = attributes.into_iter().filter_map(|(key, value)| Some((key, value?)));
    let start = scene.starts.get(&reference).copied();
    out.create_element("ScalarVariable").with_attributes(attributes).write_inner_content(|out| match meta.kind {
        Kind::Real => {
            let mut attributes = real(meta.unit);
            if let (Role::Parameter { bound, .. }, Some(_)) = (meta.role, start) {
                attributes.extend(limits(bound));
            }
            attributes.extend(start.map(|value| ("start", number(value))));
            attributes.extend(nominal_of(scene, variable).map(|nominal| ("nominal", number(nominal))));
            attributes.extend(derivative_of(scene, variable).map(|index| ("derivative", index.to_string())));
            attributes.extend(is_set_anew(scene, variable).then(|| ("reinit", "true".to_owned())));
            empty(out, "Real", &attributes)
        }
        Kind::Integer => {
            let mut attributes = Vec::new();
            if let (Role::Parameter { bound, .. }, Some(start)) = (meta.role, start) {
                let (least, greatest) = bound.range();
                let limits = [("min", least), ("max", greatest), ("start", Some(start))];
                attributes.extend(limits.into_iter().filter_map(|(name, value)| Some((name, value?.to_string()))));
            }
            empty(out, "Integer", &attributes)
        }
        Kind::Boolean => {
            let start = start.map(|value| ("start", (value != 0.0).to_string()));
            empty(out, "Boolean", &start.into_iter().collect::<Vec<_>>())
        }
        Kind::Enumeration(of) => {
            let mut attributes = vec![("declaredType", of.name.to_owned())];
            attributes.extend(start.map(|value| ("start", value.to_string())));
            empty(out, "Enumeration", &attributes)
        }
    })?;
    Ok(())
}

/// What a continuous state counts with, in its unit; None of other variables.
pub fn nominal_of(scene: &Scene, variable: &Variable) -> Option<f64> {
    Any::with(Integrator::Host, scene.parameters()).nominal(variable.place)
}

/// The index from 1 of the state whose derivative the variable is.
fn derivative_of(scene: &Scene, variable: &Variable) -> Option<usize> {
    let state = variable.name.strip_prefix("der(")?.strip_suffix(')')?;
    Some(scene.variables.iter().position(|variable| variable.name == state)? + 1)
}

/// Whether the variable is a state that changes at an event: where the chart does, or where an imposed speed jumps.
fn is_set_anew(scene: &Scene, variable: &Variable) -> bool {
    let jumps = || scene.effects.iter().any(|(info, _)| info.facts.imposes);
    state_number(variable.place).is_some_and(|n| GAMMA.contains(&n) || n == PHI || (n == SUPPLIED && jumps()))
}

fn real(unit: &Unit) -> Vec<(&'static str, String)> {
    let mut attributes = Vec::new();
    if !unit.name.is_empty() {
        attributes.push(("unit", unit.name.to_owned()));
        attributes.extend(unit.display.map(|(name, _)| ("displayUnit", name.to_owned())));
    }
    attributes
}

fn limits(bound: Bound) -> impl Iterator<Item = (&'static str, String)> {
    let (least, greatest) = bound.range();
    let least = least.map(|value| ("min", number(value)));
    least.into_iter().chain(greatest.map(|value| ("max", number(value))))
}

/// Outputs and derivatives with what they depend on, and all that is calculated at the start with what it depends on then.
fn structure(out: &mut Out, scene: &Scene) -> io::Result<()> {
    let Dependencies { at_start, later } = Dependencies::of(scene);
    let list = |wanted: &dyn Fn(&Variable) -> bool| -> Vec<usize> {
        (0..).zip(&scene.variables).filter(|(_, variable)| wanted(variable)).map(|(index, _)| index).collect()
    };
    let unknowns = |out: &mut Out, indices: Vec<usize>, depends: Option<&[Vec<usize>]>| {
        indices.into_iter().try_for_each(|index| unknown(out, index, depends.map(|depends| &depends[index][..])))
    };
    let is_output = |variable: &Variable| matches!(variable.meta.role, Role::Output);
    let is_state = |variable: &Variable| matches!(variable.meta.role, Role::State);
    let is_derivative = |variable: &Variable| is_state(variable) && variable.name.starts_with("der(");
    inside(out, "Outputs", |out| unknowns(out, list(&is_output), Some(&later)))?;
    inside(out, "Derivatives", |out| unknowns(out, list(&is_derivative), Some(&later)))?;
    let is_initial = |variable: &Variable| is_output(variable) || is_state(variable);
    // Where loads balance depends on all of them.
    let at_start = (!scene.parameters().setup.start.at_rest).then_some(&at_start[..]);
    inside(out, "InitialUnknowns", |out| unknowns(out, list(&is_initial), at_start))
}

/// An unknown by its index from 0, and the indices of what it depends on, where that is not all there is.
fn unknown(out: &mut Out, index: usize, dependencies: Option<&[usize]>) -> io::Result<()> {
    let one_based = |index: &usize| (index + 1).to_string();
    let listed = dependencies.map(|these| these.iter().map(one_based).collect::<Vec<_>>().join(" "));
    let attributes: Vec<_> =
        [("index", one_based(&index))].into_iter().chain(listed.map(|listed| ("dependencies", listed))).collect();
    empty(out, "Unknown", &attributes)
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
