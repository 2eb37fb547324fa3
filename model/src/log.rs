//! The categories of log messages, which modelDescription.xml declares.

/// What a message is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Category {
    /// What is wrong.
    Error,
    /// What may be wrong.
    Warning,
    /// Why a step could not be done.
    Discard,
    /// What happened to the instance.
    Events,
    /// What the solver chose.
    Solver,
}

/// A number as messages show it: to five digits, without zeros behind them.
pub fn shown(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}

/// The name under which a host asks for all messages.
pub const ALL: &str = "logAll";

impl Category {
    /// Every category.
    pub const EACH: [Category; 5] =
        [Category::Error, Category::Warning, Category::Discard, Category::Events, Category::Solver];

    /// Its name, and what it holds.
    pub const fn words(self) -> (&'static str, &'static str) {
        match self {
            Category::Error => ("logStatusError", "what is wrong: function, state and remedy"),
            Category::Warning => ("logStatusWarning", "what may be wrong"),
            Category::Discard => ("logStatusDiscard", "why a step could not be done"),
            Category::Events => ("logEvents", "what happened to the instance"),
            Category::Solver => ("logSolver", "what the solver chose, and what it spent"),
        }
    }

    /// Its bit in a set of categories.
    pub const fn bit(self) -> u8 {
        1 << self as u8
    }
}
