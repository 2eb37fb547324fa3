//! The templates of what travels in the FMU beside its library: the files of modelDescription/.

use anyhow::Result;
use minijinja::{Environment, UndefinedBehavior, Value, context};
use split_rotor_model::variable::units::Unit;

/// The template in this file of modelDescription/, filled in. What is put into HTML and XML is escaped.
pub fn render(name: &str, values: Value) -> Result<String> {
    let mut environment = Environment::new();
    minijinja_embed::load_templates!(&mut environment);
    // A slip in a template's name for a value should be an error, not an empty place on the page.
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    let mut text = environment.get_template(name)?.render(values)?;
    text.push('\n');
    Ok(text)
}

/// The units among these, each once, by name: with their base units, and how they are shown.
pub fn units<'u>(used: impl Iterator<Item = &'u Unit>) -> Value {
    let mut units: Vec<_> = used.filter(|unit| !unit.name.is_empty()).collect();
    units.sort_by_key(|unit| unit.name);
    units.dedup_by_key(|unit| unit.name);
    let unit = |unit: &Unit| {
        let bases = ["kg", "m", "s", "rad"].into_iter().zip(unit.exponents).filter(|(_, exponent)| *exponent != 0);
        let bases: Vec<_> = bases.map(|(name, exponent)| context! { name, exponent }).collect();
        let display = unit.display.map(|(name, factor)| context! { name, factor => format!("{factor:?}") });
        context! { name => unit.name, bases, display }
    };
    units.into_iter().map(unit).collect()
}
