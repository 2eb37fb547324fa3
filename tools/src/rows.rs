//! Rows of named values, as comma-separated ones and as JSON.

use serde_json::{Map, Value, json};

/// A row: columns' names and values.
pub type Row = Vec<(&'static str, Value)>;

/// Rows as objects of JSON.
pub fn objects(rows: impl IntoIterator<Item = Row>) -> Vec<Map<String, Value>> {
    rows.into_iter().map(|row| row.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()).collect()
}

/// Rows of columns' names and values, with a header.
pub fn csv(rows: &[Row]) -> String {
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
