//! The templates of what travels in the FMU beside its library: the files of modelDescription/.

use crate::paths;
use anyhow::Result;
use minijinja::{Environment, UndefinedBehavior, Value, path_loader};

/// The template in this file of modelDescription/, filled in. What is put into HTML and XML is escaped.
pub fn render(name: &str, values: Value) -> Result<String> {
    let mut environment = Environment::new();
    environment.set_loader(path_loader(paths::root().join("modelDescription")));
    // A slip in a template's name for a value should be an error, not an empty place on the page.
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    let mut text = environment.get_template(name)?.render(values)?;
    text.push('\n');
    Ok(text)
}
