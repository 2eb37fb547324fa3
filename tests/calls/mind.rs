//! What should be known of an instance, by the standard alone.

use crate::harness::{Life, RULES, Rule, Stage, scene};
use split_rotor::abi::{Choice, Real, ValueReference};
use std::collections::BTreeMap;

/// What goes with a saved state.
#[derive(Clone, Debug, PartialEq)]
pub struct Memory {
    pub life: Life,
    /// The communication point [s], or before the run where it will start.
    pub now: Real,
    pub stop: Option<Real>,
    /// The value of each parameter.
    pub parameters: BTreeMap<ValueReference, Real>,
    /// Whether a parameter was set: what then follows may be impossible.
    pub touched: bool,
}

/// All of it.
pub struct Mind {
    pub memory: Memory,
    /// The categories that are not silenced, among those that a host hears unasked.
    pub hears_errors: bool,
    pub hears_discards: bool,
}

impl Memory {
    fn new(kind: Choice) -> Self {
        let life = Life::new(kind, Stage::Instantiated);
        Self { life, now: 0.0, stop: None, parameters: scene().starts.clone(), touched: false }
    }
}

impl Mind {
    pub fn new(kind: Choice) -> Self {
        Self { memory: Memory::new(kind), hears_errors: true, hears_discards: true }
    }

    /// After fmi2Reset.
    pub fn reset(&mut self) {
        self.memory = Memory::new(self.memory.life.kind);
    }

    /// Whether a function may be called now.
    pub fn allows(&self, function: &str) -> bool {
        self.memory.life.allows(rule(function))
    }
}

fn rule(function: &str) -> &'static Rule {
    RULES.iter().find(|rule| rule.name == function).expect("a function of FMI")
}
