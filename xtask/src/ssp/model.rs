//! The inputs, outputs and parameters of an FMU with their units, from its modelDescription.xml.

use anyhow::{Context, Result, bail, ensure};
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};
use std::collections::{BTreeMap, HashMap};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use zip::ZipArchive;

/// The types that become connectors: hosts fail at others.
const KINDS: [&str; 3] = ["Real", "Integer", "Boolean"];

/// A model as its partners see it.
pub struct Model {
    /// Its inputs and outputs.
    pub variables: Vec<Variable>,
    /// Its parameters, if they have a value.
    pub parameters: Vec<Parameter>,
}

/// An input or an output.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Whether it is an input; else it is an output.
    pub is_input: bool,
    /// Its type.
    pub kind: String,
    /// Its unit, if it has one.
    pub unit: Option<Unit>,
}

/// A parameter.
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its type.
    pub kind: String,
    /// Its value, as it is written.
    pub value: String,
    /// Its unit, if it has one.
    pub unit: Option<Unit>,
}

/// A unit.
#[derive(Clone, Debug)]
pub struct Unit {
    /// Its name.
    pub name: String,
    /// Exponents of the base units, factor and offset, if the model defines it.
    pub base: Option<BTreeMap<String, String>>,
}

impl Unit {
    /// Whether a value in this unit has the same number in the other one. Units that only one model defines are compared by name.
    pub fn is(&self, other: &Self) -> bool {
        let number = |base: &BTreeMap<String, String>, key: &str| {
            let default = if key == "factor" { 1.0 } else { 0.0 };
            base.get(key).and_then(|text| text.parse().ok()).unwrap_or(default)
        };
        // Without rad, a number of radians is a pure number.
        let keys = ["kg", "m", "s", "A", "K", "mol", "cd", "factor", "offset"];
        match (&self.base, &other.base) {
            (Some(own), Some(other)) => keys.iter().all(|key| number(own, key) == number(other, key)),
            _ => self.name == other.name,
        }
    }
}

impl Model {
    /// Reads an FMU for co-simulation.
    pub fn of_fmu(fmu: &Path) -> Result<Self> {
        let file = File::open(fmu)?;
        let mut zip = ZipArchive::new(file).context("not an FMU, which is a zip file")?;
        let mut xml = Vec::new();
        let mut description =
            zip.by_name("modelDescription.xml").context("not an FMU: it holds no modelDescription.xml")?;
        description.read_to_end(&mut xml).context("modelDescription.xml")?;
        // Some tools write Latin letters of other encodings, in descriptions.
        Self::read(&String::from_utf8_lossy(&xml)).context("modelDescription.xml")
    }

    /// Reads a modelDescription.xml of FMI 2.0.
    pub fn read(xml: &str) -> Result<Self> {
        let mut reader = Reader::from_str(xml);
        let mut found = Found::default();
        loop {
            match reader.read_event()? {
                Event::Start(element) | Event::Empty(element) => found.add(&element)?,
                Event::Eof => break,
                _ => {}
            }
        }
        ensure!(found.is_co_simulation, "this FMU is not for co-simulation, and SSP masters step no other");
        Ok(found.model())
    }
}

/// The elements that were read so far.
#[derive(Default)]
struct Found {
    is_co_simulation: bool,
    units: HashMap<String, Option<BTreeMap<String, String>>>,
    unit: String,
    /// The units of declared types.
    types: HashMap<String, Option<String>>,
    declared: String,
    variables: Vec<Typed>,
}

/// A variable.
struct Typed {
    name: String,
    causality: String,
    of: Option<Type>,
}

/// What its type says of it.
struct Type {
    kind: String,
    unit: Option<String>,
    declared: Option<String>,
    start: Option<String>,
}

impl Found {
    fn add(&mut self, element: &BytesStart) -> Result<()> {
        let name = element.name().as_ref().to_owned();
        match name.as_str() {
            "fmiModelDescription" => {
                let version = value(element, "fmiVersion")?.unwrap_or_default();
                ensure!(version == "2.0", "this FMU is of FMI {version}: use one of FMI 2.0");
            }
            "CoSimulation" => self.is_co_simulation = true,
            "Unit" => {
                self.unit = named(element)?;
                self.units.insert(self.unit.clone(), None);
            }
            "BaseUnit" => {
                let attributes = element.attributes().map(|attribute| {
                    let attribute = attribute?;
                    let text = attribute.normalized_value(XmlVersion::Implicit1_0)?.into_owned();
                    Ok((attribute.key.as_ref().to_owned(), text))
                });
                self.units.insert(self.unit.clone(), Some(attributes.collect::<Result<_>>()?));
            }
            "SimpleType" => self.declared = named(element)?,
            "ScalarVariable" => {
                let causality = value(element, "causality")?.unwrap_or_default();
                self.variables.push(Typed { name: named(element)?, causality, of: None });
            }
            "Real" | "Integer" | "Boolean" | "String" | "Enumeration" => {
                let unit = value(element, "unit")?;
                match self.variables.last_mut() {
                    Some(Typed { of: of @ None, .. }) => {
                        let (declared, start) = (value(element, "declaredType")?, value(element, "start")?);
                        *of = Some(Type { kind: name, unit, declared, start });
                    }
                    Some(_) => {}
                    // Types stand before the first variable.
                    None => {
                        self.types.insert(self.declared.clone(), unit);
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn model(self) -> Model {
        let mut model = Model { variables: Vec::new(), parameters: Vec::new() };
        for Typed { name, causality, of } in self.variables {
            let Some(Type { kind, unit, declared, start }) = of.filter(|of| KINDS.contains(&of.kind.as_str())) else {
                continue;
            };
            let unit = unit.or_else(|| self.types.get(&declared?)?.clone());
            let unit = unit.map(|name| Unit { base: self.units.get(&name).cloned().flatten(), name });
            match (causality.as_str(), start) {
                ("input" | "output", _) => {
                    model.variables.push(Variable { name, is_input: causality == "input", kind, unit });
                }
                ("parameter", Some(value)) => model.parameters.push(Parameter { name, kind, value, unit }),
                _ => {}
            }
        }
        model
    }
}

fn named(element: &BytesStart) -> Result<String> {
    match value(element, "name")? {
        Some(name) => Ok(name),
        None => bail!("a {} without a name", element.name().as_ref()),
    }
}

fn value(element: &BytesStart, name: &str) -> Result<Option<String>> {
    let found = element.try_get_attribute(name)?;
    let text = found.map(|attribute| attribute.normalized_value(XmlVersion::Implicit1_0).map(|text| text.into_owned()));
    Ok(text.transpose()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    const XML: &str = r#"<fmiModelDescription fmiVersion="2.0"><CoSimulation/>
        <UnitDefinitions><Unit name="N"><BaseUnit kg="1" m="1" s="-2"/></Unit><Unit name="kN"><BaseUnit kg="1" m="1" s="-2" factor="1000"/>
        </Unit><Unit name="Newton"><BaseUnit kg="1" m="1" s="-2"/></Unit><Unit name="lbf"/></UnitDefinitions>
        <TypeDefinitions><SimpleType name="Force"><Real unit="N"/></SimpleType></TypeDefinitions>
        <ModelVariables>
        <ScalarVariable name="f.x" causality="output"><Real declaredType="Force"/></ScalarVariable>
        <ScalarVariable name="f.y" causality="output"><Real unit="kN"/></ScalarVariable>
        <ScalarVariable name="f.z" causality="output"><Real unit="Newton"/></ScalarVariable>
        <ScalarVariable name="m.x" causality="output"><Real unit="lbf"/></ScalarVariable>
        <ScalarVariable name="is_on" causality="input"><Boolean/></ScalarVariable>
        <ScalarVariable name="k" causality="parameter"><Real start="1"/></ScalarVariable>
        <ScalarVariable name="file" causality="input"><String start=""/></ScalarVariable>
        </ModelVariables></fmiModelDescription>"#;

    #[test]
    fn inputs_and_outputs_are_read_with_the_units_of_their_types() {
        let model = Model::read(XML).unwrap();
        let unit = |variable: &Variable| variable.unit.as_ref().map(|unit| unit.name.clone()).unwrap_or_default();
        let found = model.variables.iter().map(|of| format!("{} {} {} {}", of.name, of.is_input, of.kind, unit(of)));
        let expected = [
            "f.x false Real N",
            "f.y false Real kN",
            "f.z false Real Newton",
            "m.x false Real lbf",
            "is_on true Boolean ",
        ];
        assert_eq!(found.collect::<Vec<_>>(), expected);
        let parameters: Vec<_> = model.parameters.iter().map(|of| format!("{} = {}", of.name, of.value)).collect();
        assert_eq!(parameters, ["k = 1"]);
    }

    #[test]
    fn a_mark_of_the_byte_order_is_no_part_of_the_text() {
        assert_eq!(Model::read(&format!("\u{feff}{XML}")).unwrap().variables.len(), 5);
    }

    #[test]
    fn units_are_compared_by_what_they_are_and_by_name_if_that_is_unknown() {
        let model = Model::read(XML).unwrap();
        let units: Vec<_> = model.variables[..4].iter().map(|of| of.unit.clone().unwrap()).collect();
        let same = |one: usize, other: usize| units[one].is(&units[other]);
        assert!(same(0, 0) && same(0, 2) && same(3, 3) && !same(0, 1) && !same(0, 3));
    }

    #[test]
    fn what_cannot_be_a_partner_is_refused() {
        let refused = |from: &str, to: &str| Model::read(&XML.replace(from, to)).err().unwrap().to_string();
        assert_eq!(refused("\"2.0\"", "\"3.0\""), "this FMU is of FMI 3.0: use one of FMI 2.0");
        let expected = "this FMU is not for co-simulation, and SSP masters step no other";
        assert_eq!(refused("<CoSimulation/>", "<ModelExchange/>"), expected);
    }
}
