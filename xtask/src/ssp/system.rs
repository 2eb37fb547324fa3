//! A system of models and their connections, as a SystemStructure.ssd.

use super::model::{Model, Parameter, Unit, Variable};
use anyhow::Result;
use minijinja::{Value, context};
use split_rotor_model::scene::Scene;
use split_rotor_tools::templates;

/// A model of a system.
pub struct Component {
    /// Its name, another one for each.
    pub name: String,
    /// Where its FMU lies in the package.
    pub source: String,
    /// Where its parameter set lies there.
    pub parameters: String,
    /// Its inputs and outputs.
    pub model: Model,
}

/// Names of a component and of one of its connectors.
pub type End = [String; 2];

/// Models and their connections.
pub struct System {
    /// The models, the rotor first.
    pub components: Vec<Component>,
    /// From outputs to inputs.
    pub connections: Vec<[End; 2]>,
}

impl System {
    /// The variables of a component that no other reads or feeds.
    pub fn free<'s>(&'s self, component: &'s Component) -> impl Iterator<Item = &'s Variable> {
        let is_at =
            |[name, connector]: &End, variable: &Variable| *name == component.name && *connector == variable.name;
        let is_connected = move |variable: &Variable| {
            self.connections.iter().any(|[from, to]| is_at(if variable.is_input { to } else { from }, variable))
        };
        component.model.variables.iter().filter(move |variable| !is_connected(variable))
    }

    /// The SystemStructure.ssd of this scene. Without a boundary it has no connectors of free inputs either: fmpy feeds those with any value.
    pub fn structure(&self, scene: &Scene, has_boundary: bool) -> Result<String> {
        let bounded = self.components.iter().filter(|_| has_boundary);
        let boundary = bounded.flat_map(|component| self.free(component).map(move |variable| (component, variable)));
        let boundary = boundary.map(|(component, variable)| {
            // Not joined by a point: the path of the connector within has that name in fmpy.
            let name = format!("{}_{}", component.name, variable.name);
            context! { connector => connector(&name, variable), component => &component.name, variable => &variable.name }
        });
        let component = |of: &Component| {
            let free: Vec<_> = self.free(of).filter(|of| of.is_input && !has_boundary).map(|of| &of.name).collect();
            let listed = of.model.variables.iter().filter(|variable| !free.contains(&&variable.name));
            let connectors: Value = listed.map(|variable| connector(&variable.name, variable)).collect();
            context! { name => &of.name, source => &of.source, parameters => &of.parameters, connectors }
        };
        let connection = |[from, to]: &[End; 2]| context! { from, to };
        let context = context! {
            name => &scene.name,
            title => &scene.title,
            version => env!("CARGO_PKG_VERSION"),
            boundary => boundary.collect::<Value>(),
            components => self.components.iter().map(component).collect::<Value>(),
            connections => self.connections.iter().map(connection).collect::<Value>(),
            units => self.units(),
            start => format!("{:?}", scene.experiment.start),
            stop => format!("{:?}", scene.experiment.stop),
            step => format!("{:?}", scene.experiment.step),
        };
        templates::render("ssp/SystemStructure.xml", context)
    }

    /// The units of all connectors.
    fn units(&self) -> Value {
        let variables = self.components.iter().flat_map(|component| &component.model.variables);
        units(variables.filter_map(|variable| variable.unit.as_ref()).collect())
    }
}

impl Component {
    /// The values of its parameters as a parameter set of this name.
    pub fn parameter_set(&self, name: &str) -> Result<String> {
        let parameter = |of: &Parameter| {
            context! { name => &of.name, kind => &of.kind, value => &of.value, unit => defined(of.unit.as_ref()) }
        };
        let parameters = &self.model.parameters;
        let context = context! {
            name,
            title => format!("Parameters of {}", self.name),
            version => env!("CARGO_PKG_VERSION"),
            parameters => parameters.iter().map(parameter).collect::<Value>(),
            units => units(parameters.iter().filter_map(|of| of.unit.as_ref()).collect()),
        };
        templates::render("ssv/parameters.xml", context)
    }
}

/// The units that a model defines, each name once.
fn units(mut units: Vec<&Unit>) -> Value {
    units.sort_by_key(|unit| &unit.name);
    units.dedup_by_key(|unit| &unit.name);
    let unit = |unit: &&Unit| {
        let bases = unit.base.as_ref()?.iter().map(|(name, exponent)| context! { name, exponent });
        Some(context! { name => &unit.name, bases => bases.collect::<Value>() })
    };
    units.iter().filter_map(unit).collect()
}

/// The name of a unit, if the model defines it.
fn defined(unit: Option<&Unit>) -> Option<&String> {
    unit.filter(|unit| unit.base.is_some()).map(|unit| &unit.name)
}

/// A connector of this name for a variable.
fn connector(name: &str, variable: &Variable) -> Value {
    let kind = if variable.is_input { "input" } else { "output" };
    context! { name, kind, type => &variable.kind, unit => defined(variable.unit.as_ref()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes;
    use split_rotor_model::xml;

    /// `coupled` with a partner that answers with one force, and needs a temperature.
    fn system(scene: &Scene) -> System {
        let partner = r#"<fmiModelDescription fmiVersion="2.0"><CoSimulation/><ModelVariables>
            <ScalarVariable name="f.y" causality="output"><Real/></ScalarVariable>
            <ScalarVariable name="T" causality="input"><Real/></ScalarVariable>
            </ModelVariables></fmiModelDescription>"#;
        let component = |name: &str, xml: &str| Component {
            name: name.into(),
            source: format!("resources/{name}.fmu"),
            parameters: format!("resources/{name}.ssv"),
            model: Model::read(xml).unwrap(),
        };
        let components = vec![component("coupled", &xml::model_description(scene)), component("film", partner)];
        let ends = [["film", "f.y"], ["coupled", "port[1].f.y"]].map(|end| end.map(str::to_owned));
        System { components, connections: vec![ends] }
    }

    #[test]
    fn what_nothing_inside_feeds_or_reads_is_at_the_boundary() {
        let scene = scenes::find("coupled").unwrap();
        let ssd = system(&scene).structure(&scene, true).unwrap();
        let (boundary, _) = ssd.split_once("<ssd:Elements>").unwrap();
        let count = |kind: &str| boundary.matches(&format!("kind=\"{kind}\"")).count();
        // Six loads at each of two ports, one of which is fed, and the temperature.
        assert_eq!(count("input"), 12, "{boundary}");
        assert!(
            boundary.contains("<ssd:Connector name=\"coupled_port[1].f.z\" kind=\"input\"><ssc:Real unit=\"N\"/>"),
            "{boundary}"
        );
        assert!(!boundary.contains("port[1].f.y") && boundary.contains("film_T"), "{boundary}");
        assert!(
            ssd.contains("<ssd:Connection startConnector=\"film_T\" endElement=\"film\" endConnector=\"T\"/>"),
            "{ssd}"
        );
        let out = "<ssd:Connection startElement=\"coupled\" startConnector=\"phi\" endConnector=\"coupled_phi\"/>";
        assert!(ssd.contains(out), "{ssd}");
        assert_eq!(ssd.matches("<ssd:Connection ").count(), 1 + boundary.matches("<ssd:Connector ").count());
    }

    #[test]
    fn without_a_boundary_no_free_input_has_a_connector() {
        let scene = scenes::find("coupled").unwrap();
        let ssd = system(&scene).structure(&scene, false).unwrap();
        assert!(ssd.split_once("<ssd:Elements>").unwrap().0.lines().all(|line| !line.contains("Connector")), "{ssd}");
        assert_eq!((ssd.matches("<ssd:Connection ").count(), ssd.matches("kind=\"input\"").count()), (1, 1), "{ssd}");
    }
}
