//! The record of one variable: everything that its value reference, its XML line and its typed access need, written once.

pub mod units;

use crate::error::Invalid;
use units::Unit;

/// One variable of a block that lives on `P` (its parameters) and is read from `O` (what an instant shows).
pub struct Row<P: 'static, O: 'static> {
    /// What is said of it.
    pub meta: Meta,
    /// How it is reached.
    pub access: Access<P, O>,
}

/// Where a variable stands, the same in every scene: its block, and its row within the block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Blocks below [`Place::FIRST_EFFECT`] are always there; four blocks an effect follow.
    pub block: u32,
    /// The row of its block, below 256.
    pub row: usize,
}

impl Place {
    /// The first block of effects.
    pub const FIRST_EFFECT: u32 = 16;

    /// How many of a kind a scene may call for.
    pub const OF_A_KIND: u32 = 4;

    /// The block of the effect with this catalogue number (from 1), the `index`th of its kind (from 1).
    pub const fn effect_block(number: u32, index: u32) -> u32 {
        Self::FIRST_EFFECT + Self::OF_A_KIND * (number - 1) + (index - 1)
    }

    /// The place behind a value reference.
    pub const fn of(value_reference: u32) -> Self {
        Self { block: value_reference >> 8, row: (value_reference & 0xff) as usize }
    }

    /// The FMI value reference.
    pub const fn value_reference(self) -> u32 {
        (self.block << 8) | self.row as u32
    }
}

/// How a variable is reached. Whole numbers, enumerations and Booleans travel as f64, exactly.
pub enum Access<P: 'static, O: 'static> {
    /// Set before the run.
    Parameter {
        /// Reads it.
        get: fn(&P) -> f64,
        /// Writes it.
        set: fn(&mut P, f64),
    },
    /// Calculated.
    Output(fn(&P, &O) -> f64),
}

/// What is said of a variable.
#[derive(Clone, Copy, Debug)]
pub struct Meta {
    /// Its name within its block.
    pub name: &'static str,
    /// One line for the reader of the XML.
    pub description: &'static str,
    /// Its unit.
    pub unit: &'static Unit,
    /// Its FMI type.
    pub kind: Kind,
    /// Parameter or output.
    pub role: Role,
}

/// The FMI type of a variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// fmi2Real.
    Real,
    /// fmi2Integer, with the meaning of each value.
    Enumeration(&'static Enumeration),
}

/// An enumeration type.
#[derive(Debug, PartialEq)]
pub struct Enumeration {
    /// The name of the type.
    pub name: &'static str,
    /// Number, name, description. Numbers are never reused.
    pub items: &'static [(i32, &'static str, &'static str)],
}

/// What a variable is for.
#[derive(Clone, Copy, Debug)]
pub enum Role {
    /// causality parameter, variability fixed, initial exact.
    Parameter {
        /// What a scene that does not name it gets; None where a scene must.
        default: Option<f64>,
        /// What its value must be.
        bound: Bound,
    },
    /// causality output, initial calculated; at the start it depends on these.
    Output(Depends),
}

/// The parameters on which an output depends at the start.
#[derive(Clone, Copy, Debug)]
pub enum Depends {
    /// These names, or all that begin with one of them and a dot.
    On(&'static [&'static str]),
    /// What the effects' potentials depend on.
    Potential,
    /// These names, and what the effects' potentials depend on.
    PotentialAnd(&'static [&'static str]),
}

/// What the value of a parameter must be, besides finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Any finite number.
    Finite,
    /// > 0
    Positive,
    /// ≥ 0
    NotNegative,
    /// Within both ends.
    Within(f64, f64),
}

impl Bound {
    /// Whether `value` keeps the bound.
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Bound::Finite => true,
                Bound::Positive => value > 0.0,
                Bound::NotNegative => value >= 0.0,
                Bound::Within(low, high) => (low..=high).contains(&value),
            }
    }

    /// The bound in words.
    pub fn words(self) -> String {
        match self {
            Bound::Finite => "a finite number".into(),
            Bound::Positive => "a finite number > 0".into(),
            Bound::NotNegative => "a finite number >= 0".into(),
            Bound::Within(low, high) => format!("a number from {low:?} to {high:?}"),
        }
    }

    /// The least and greatest value that the XML can state.
    pub fn range(self) -> (Option<f64>, Option<f64>) {
        match self {
            Bound::Finite => (None, None),
            Bound::Positive | Bound::NotNegative => (Some(0.0), None),
            Bound::Within(low, high) => (Some(low), Some(high)),
        }
    }
}

impl Meta {
    /// A parameter with its FMI type Real; `default` None: a scene must give it.
    pub const fn parameter(
        name: &'static str,
        unit: &'static Unit,
        default: Option<f64>,
        bound: Bound,
        description: &'static str,
    ) -> Self {
        Self { name, description, unit, kind: Kind::Real, role: Role::Parameter { default, bound } }
    }

    /// A Real output.
    pub const fn output(name: &'static str, unit: &'static Unit, depends: Depends, description: &'static str) -> Self {
        Self { name, description, unit, kind: Kind::Real, role: Role::Output(depends) }
    }

    /// The error of a parameter's value, if it has one; `full_name` is the name with its block.
    pub fn check(&self, full_name: impl FnOnce() -> String, value: f64) -> Result<(), Invalid> {
        let Role::Parameter { bound, .. } = self.role else { return Ok(()) };
        match self.kind {
            Kind::Enumeration(of) if !of.items.iter().any(|item| f64::from(item.0) == value) => {
                Err(Invalid::new(full_name(), value, of.words()))
            }
            Kind::Real if !bound.holds(value) => Err(Invalid::new(full_name(), value, bound.words())),
            _ => Ok(()),
        }
    }
}

impl Enumeration {
    /// The possible values in words: `2 (dopri5) or 3 (dop853)`.
    pub fn words(&self) -> String {
        let items: Vec<_> = self.items.iter().map(|(number, name, _)| format!("{number} ({name})")).collect();
        items.join(" or ")
    }
}

/// A row for a parameter that is a field: `parameter!(c1, &NEWTON_PER_METRE, Some(0.0), Bound::NotNegative, "…")`.
/// The name of the field is the name of the variable.
macro_rules! parameter {
    ($($field:ident).+, $unit:expr, $default:expr, $bound:expr, $description:expr) => {
        parameter!(stringify!($($field).+), $($field).+, $unit, $default, $bound, $description)
    };
    ($name:expr, $($field:ident).+, $unit:expr, $default:expr, $bound:expr, $description:expr) => {
        $crate::variable::Row {
            meta: $crate::variable::Meta::parameter($name, $unit, $default, $bound, $description),
            access: $crate::variable::Access::Parameter {
                get: |p| p.$($field).+,
                set: |p, value| p.$($field).+ = value,
            },
        }
    };
}

/// A row for an output: `output!("F.x", &NEWTON, Depends::On(&["rotor.l"]), "…", |effect, instant| …)`.
macro_rules! output {
    ($name:expr, $unit:expr, $depends:expr, $description:expr, $read:expr) => {
        $crate::variable::Row {
            meta: $crate::variable::Meta::output($name, $unit, $depends, $description),
            access: $crate::variable::Access::Output($read),
        }
    };
}

pub(crate) use {output, parameter};
