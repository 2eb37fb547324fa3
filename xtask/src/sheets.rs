//! Rows of named values as comma-separated ones.

use serde_json::{Value, json};

/// Rows of columns' names and values, with a header.
pub fn csv(rows: &[Vec<(&'static str, Value)>]) -> String {
    let header = rows.first().into_iter().map(|row| line(row.iter().map(|(name, _)| json!(name))));
    header.chain(rows.iter().map(|row| line(row.iter().map(|(_, value)| value.clone())))).collect()
}

fn line(fields: impl Iterator<Item = Value>) -> String {
    let field = |value| match value {
        Value::Null => String::new(),
        Value::String(text) if text.contains([',', '"', '\n']) => format!("\"{}\"", text.replace('"', "\"\"")),
        Value::String(text) => text,
        value => value.to_string(),
    };
    fields.map(field).collect::<Vec<_>>().join(",") + "\n"
}
