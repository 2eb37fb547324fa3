//! What can be wrong with the numbers that somebody gave.

use std::fmt;

/// A parameter that cannot be simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Invalid {
    /// The variable's name, as in modelDescription.xml.
    pub variable: String,
    /// What is wrong with it, and what would be right.
    pub reason: String,
}

impl Invalid {
    /// The Real `variable` = `value` breaks `bound`.
    pub fn new(variable: impl Into<String>, value: f64, bound: impl fmt::Display) -> Self {
        Self::out_of_bound(variable, &written(value, false), bound)
    }

    /// The `variable`, whose value is written so, breaks `bound`.
    pub fn out_of_bound(variable: impl Into<String>, value: &str, bound: impl fmt::Display) -> Self {
        let reason = format!("= {value} is not possible: it must be {bound}");
        Self { variable: variable.into(), reason }
    }

    /// The switch `variable` is on, and `other` too.
    pub fn excluded(variable: impl Into<String>, other: &str) -> Self {
        let reason = format!("and {other} exclude each other: only one of them can act");
        Self { variable: variable.into(), reason }
    }
}

/// A value as people write it: a whole number without a point.
pub fn written(value: f64, whole: bool) -> String {
    if whole { value.to_string() } else { format!("{value:?}") }
}

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.variable, self.reason)
    }
}

impl std::error::Error for Invalid {}
