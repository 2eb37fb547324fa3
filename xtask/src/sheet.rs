//! What a C host must know of an FMU, from its modelDescription.xml, in lines that C reads without an XML parser
//! (`tests/c/sheet.h` gives the format).

use anyhow::{Context, Result, bail};
use quick_xml::Reader;
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use std::fmt::Write;

/// The elements whose attributes a host asks for by name.
const ATTRIBUTES: [&str; 4] = ["fmiModelDescription", "CoSimulation", "ModelExchange", "DefaultExperiment"];

/// One variable, on its way from the XML to a line.
struct Variable {
    reference: String,
    name: String,
    causality: String,
    variability: String,
    kind: char,
    start: Option<String>,
    /// The index from 1 of the state whose derivative it is.
    state: Option<usize>,
}

/// The sheet of a modelDescription.xml.
pub fn sheet(xml: &str) -> Result<String> {
    let mut reader = Reader::from_str(xml);
    let (mut sheet, mut variables, mut derivatives) = (String::new(), Vec::<Variable>::new(), Vec::<usize>::new());
    let mut in_derivatives = false;
    loop {
        match reader.read_event()? {
            Event::Start(element) | Event::Empty(element) => {
                let name = element.name().as_ref().to_owned();
                match name.as_str() {
                    name if ATTRIBUTES.contains(&name) => {
                        for attribute in element.attributes() {
                            let attribute = attribute?;
                            let key = attribute.key.as_ref();
                            writeln!(
                                sheet,
                                "attribute {name}.{key} {}",
                                attribute.normalized_value(XmlVersion::Implicit1_0)?
                            )?;
                        }
                    }
                    "ScalarVariable" => variables.push(Variable {
                        reference: value(&element, "valueReference")?.context("a variable without a reference")?,
                        name: value(&element, "name")?.context("a variable without a name")?,
                        causality: value(&element, "causality")?.unwrap_or("local".into()),
                        variability: value(&element, "variability")?.unwrap_or("continuous".into()),
                        kind: '-',
                        start: None,
                        state: None,
                    }),
                    "Real" | "Integer" | "Enumeration" | "Boolean" | "String" => {
                        // Elements of these names stand in TypeDefinitions, too, before the first variable.
                        if let Some(variable) = variables.last_mut() {
                            variable.kind = if name == "Enumeration" { 'I' } else { name.as_bytes()[0].into() };
                            // C reads a truth as a number.
                            let truth = |start: String| match start.as_str() {
                                "true" => "1".into(),
                                "false" => "0".into(),
                                _ => start,
                            };
                            variable.start = value(&element, "start")?.map(truth);
                            variable.state = value(&element, "derivative")?.map(|index| index.parse()).transpose()?;
                        }
                    }
                    "Derivatives" => in_derivatives = true,
                    "Unknown" if in_derivatives => {
                        derivatives.push(value(&element, "index")?.context("an Unknown without an index")?.parse()?);
                    }
                    _ => {}
                }
            }
            Event::End(element) if element.name().as_ref() == "Derivatives" => in_derivatives = false,
            Event::Eof => break,
            _ => {}
        }
    }
    let reference = |index: usize| -> Result<&str> {
        Ok(&variables.get(index.wrapping_sub(1)).with_context(|| format!("there is no variable {index}"))?.reference)
    };
    for variable in &variables {
        let Variable { reference: own, name, causality, variability, kind, start, state } = variable;
        if *kind == '-' {
            bail!("the variable {name} has no type");
        }
        let state = state.map(reference).transpose()?.unwrap_or("-");
        let start = start.as_deref().unwrap_or("-");
        writeln!(sheet, "variable {own} {kind} {causality} {variability} {start} {state} {name}")?;
    }
    for index in derivatives {
        writeln!(sheet, "derivative {}", reference(index)?)?;
    }
    Ok(sheet)
}

fn value(element: &BytesStart, name: &str) -> Result<Option<String>> {
    let found = element.try_get_attribute(name)?;
    Ok(found
        .map(|attribute| attribute.normalized_value(XmlVersion::Implicit1_0).map(|text| text.into_owned()))
        .transpose()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_and_their_derivatives_are_found_by_index() {
        let xml = r#"<fmiModelDescription guid="{a}"><ModelExchange canSerializeFMUstate="true"/>
            <TypeDefinitions><SimpleType name="T"><Enumeration/></SimpleType></TypeDefinitions>
            <ModelVariables>
            <ScalarVariable name="x" valueReference="7" causality="local"><Real/></ScalarVariable>
            <ScalarVariable name="der(x)" valueReference="9"><Real derivative="1"/></ScalarVariable>
            <ScalarVariable name="m" valueReference="3" causality="parameter" variability="fixed"><Enumeration start="2"/>
            </ScalarVariable></ModelVariables>
            <ModelStructure><Outputs><Unknown index="1"/></Outputs><Derivatives><Unknown index="2"/></Derivatives>
            <InitialUnknowns><Unknown index="1"/></InitialUnknowns></ModelStructure></fmiModelDescription>"#;
        let lines = [
            "attribute fmiModelDescription.guid {a}",
            "attribute ModelExchange.canSerializeFMUstate true",
            "variable 7 R local continuous - - x",
            "variable 9 R local continuous - 7 der(x)",
            "variable 3 I parameter fixed 2 - m",
            "derivative 9",
        ];
        assert_eq!(sheet(xml).unwrap().lines().collect::<Vec<_>>(), lines);
    }
}
