//! What can be wrong with the numbers that somebody gave.

use std::fmt;

/// A parameter whose value cannot be simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Invalid {
    /// The variable's name, as in modelDescription.xml.
    pub variable: String,
    /// Its value, in its unit.
    pub value: f64,
    /// What would be right.
    pub bound: String,
}

impl Invalid {
    /// `variable` = `value` breaks `bound`.
    pub fn new(variable: impl Into<String>, value: f64, bound: impl Into<String>) -> Self {
        Self { variable: variable.into(), value, bound: bound.into() }
    }
}

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {:?} is not possible: it must be {}", self.variable, self.value, self.bound)
    }
}

impl std::error::Error for Invalid {}
