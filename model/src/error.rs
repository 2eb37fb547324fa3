//! What can be wrong with the numbers that somebody gave.

use std::fmt;

/// A parameter whose value cannot be simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Invalid {
    /// The variable's name, as in modelDescription.xml.
    pub variable: String,
    /// Its value, in its unit.
    pub value: f64,
    /// Whether that is a whole number, which is written without a point.
    pub whole: bool,
    /// What would be right.
    pub bound: String,
}

impl Invalid {
    /// The Real `variable` = `value` breaks `bound`.
    pub fn new(variable: impl Into<String>, value: f64, bound: impl Into<String>) -> Self {
        Self { variable: variable.into(), value, whole: false, bound: bound.into() }
    }
}

/// A value as people write it: a whole number without a point.
pub fn written(value: f64, whole: bool) -> String {
    if whole { value.to_string() } else { format!("{value:?}") }
}

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { variable, value, whole, bound } = self;
        write!(f, "{variable} = {} is not possible: it must be {bound}", written(*value, *whole))
    }
}

impl std::error::Error for Invalid {}
