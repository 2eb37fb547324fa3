//! The record of one variable: everything that its value reference, its XML line and its typed access need, written once.

pub mod units;

use crate::dual::Tangent;
use crate::error::{Invalid, written};
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::state::Rates;
#[cfg(feature = "scenes")]
use crate::traced::Traced;
use units::Unit;

/// Over what a calculated variable is compiled a third time: where no scene is read, nobody asks for that.
#[cfg(not(feature = "scenes"))]
type Traced = f64;

/// One variable of a block that lives on `P` (its parameters and inputs) and is read from `O` (what an instant shows).
pub struct Row<P: 'static, O: Shown> {
    /// What is said of it.
    pub meta: Meta,
    /// How it is reached.
    pub access: Access<P, O>,
}

/// What an instant shows, in values or in values with derivatives.
pub trait Shown: 'static {
    /// Over this scalar.
    type Of<'m, S: Scalar>;
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

    /// The last row of an effect's block, which is its switch's where it has one, and else nobody's.
    pub const SWITCH: usize = 255;

    /// The first row of a housing, in the block of its effect.
    pub const HOUSING: usize = 192;

    /// The block of the effect with this catalogue number (from 1), the `index`th of its kind (from 1).
    pub const fn effect_block(number: u32, index: u32) -> u32 {
        Self::FIRST_EFFECT + Self::OF_A_KIND * (number - 1) + (index - 1)
    }

    /// The switch of the effect that has this block, where it has one.
    pub const fn switch(block: u32) -> Self {
        Self { block, row: Self::SWITCH }
    }

    /// The place behind a value reference.
    pub const fn of(value_reference: u32) -> Self {
        Self { block: value_reference >> 8, row: (value_reference & 0xff) as usize }
    }

    /// Whether the variable there is one of a housing.
    pub fn is_of_housing(self) -> bool {
        self.block >= Self::FIRST_EFFECT && (Self::HOUSING..Self::SWITCH).contains(&self.row)
    }

    /// The FMI value reference.
    pub const fn value_reference(self) -> u32 {
        (self.block << 8) | self.row as u32
    }
}

/// How a variable is reached. Whole numbers, enumerations and Booleans travel as f64, exactly.
pub enum Access<P: 'static, O: Shown> {
    /// Set before the run.
    Parameter {
        /// Reads it.
        get: fn(&P) -> f64,
        /// Writes it.
        set: fn(&mut P, f64),
    },
    /// Set at communication points.
    Input {
        /// Reads it.
        get: fn(&P) -> &Signal,
        /// To write it.
        get_mut: fn(&mut P) -> &mut Signal,
    },
    /// Calculated from the state.
    Output(Output<P, O>),
    /// Calculated from the state and its rates.
    Rate(Rate<P, O>),
}

/// One line of calculation, compiled for values, for values with derivatives, and for what went into them.
pub struct Output<P: 'static, O: Shown> {
    /// For values.
    pub value: for<'m> fn(&P, &O::Of<'m, f64>) -> f64,
    /// For derivatives.
    pub tangent: for<'m> fn(&P, &O::Of<'m, Tangent>) -> Tangent,
    /// For what it depends on.
    #[cfg(feature = "scenes")]
    pub traced: for<'m> fn(&P, &O::Of<'m, Traced>) -> Traced,
}

/// As [`Output`], of the rates too.
pub struct Rate<P: 'static, O: Shown> {
    /// For values.
    pub value: for<'m> fn(&P, &O::Of<'m, f64>, &Rates<'m, f64>) -> f64,
    /// For derivatives.
    pub tangent: for<'m> fn(&P, &O::Of<'m, Tangent>, &Rates<'m, Tangent>) -> Tangent,
    /// For what it depends on.
    #[cfg(feature = "scenes")]
    pub traced: for<'m> fn(&P, &O::Of<'m, Traced>, &Rates<'m, Traced>) -> Traced,
}

impl<P, O: Shown> Output<P, O> {
    /// One line, written three times.
    pub const fn new(
        value: for<'m> fn(&P, &O::Of<'m, f64>) -> f64,
        tangent: for<'m> fn(&P, &O::Of<'m, Tangent>) -> Tangent,
        _traced: for<'m> fn(&P, &O::Of<'m, Traced>) -> Traced,
    ) -> Self {
        Self {
            value,
            tangent,
            #[cfg(feature = "scenes")]
            traced: _traced,
        }
    }
}

impl<P, O: Shown> Rate<P, O> {
    /// One line, written three times.
    pub const fn new(
        value: for<'m> fn(&P, &O::Of<'m, f64>, &Rates<'m, f64>) -> f64,
        tangent: for<'m> fn(&P, &O::Of<'m, Tangent>, &Rates<'m, Tangent>) -> Tangent,
        _traced: for<'m> fn(&P, &O::Of<'m, Traced>, &Rates<'m, Traced>) -> Traced,
    ) -> Self {
        Self {
            value,
            tangent,
            #[cfg(feature = "scenes")]
            traced: _traced,
        }
    }
}

impl<P, O: Shown> Access<P, O> {
    /// Whether it is calculated.
    pub fn is_calculated(&self) -> bool {
        matches!(self, Access::Output(_) | Access::Rate(_))
    }

    /// The value of a variable at an instant, an input's at time `t` \[s]; None of a calculated one where nothing is shown, or not
    /// the rates that it asks for.
    #[inline(always)]
    pub fn value<'m>(
        &self,
        of: &P,
        t: f64,
        shown: Option<&O::Of<'m, f64>>,
        rates: Option<&Rates<'m, f64>>,
    ) -> Option<f64> {
        match self {
            Access::Parameter { get, .. } => Some(get(of)),
            Access::Input { get, .. } => Some(get(of).at(t)),
            Access::Output(output) => Some((output.value)(of, shown?)),
            Access::Rate(rate) => Some((rate.value)(of, shown?, rates?)),
        }
    }

    /// The value of a calculated variable with its derivative; None of others.
    pub fn tangent<'m>(
        &self,
        of: &P,
        shown: &O::Of<'m, Tangent>,
        rates: Option<&Rates<'m, Tangent>>,
    ) -> Option<Tangent> {
        match self {
            Access::Output(output) => Some((output.tangent)(of, shown)),
            Access::Rate(rate) => Some((rate.tangent)(of, shown, rates?)),
            Access::Parameter { .. } | Access::Input { .. } => None,
        }
    }

    /// What a calculated variable depends on; None of others.
    #[cfg(feature = "scenes")]
    pub fn traced<'m>(&self, of: &P, shown: &O::Of<'m, Traced>, rates: &Rates<'m, Traced>) -> Option<Traced> {
        match self {
            Access::Output(output) => Some((output.traced)(of, shown)),
            Access::Rate(rate) => Some((rate.traced)(of, shown, rates)),
            Access::Parameter { .. } | Access::Input { .. } => None,
        }
    }
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
    /// Parameter, input, output or state.
    pub role: Role,
}

/// The FMI type of a variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// fmi2Real.
    Real,
    /// fmi2Integer.
    Integer,
    /// fmi2Boolean, 1 or 0.
    Boolean,
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
    /// causality input, with the value that it has until somebody sets it.
    Input {
        /// In the variable's unit.
        start: f64,
    },
    /// causality output, calculated.
    Output,
    /// causality local: a continuous state, or its derivative where it is called der(…).
    State,
    /// causality local, variability discrete: changes at events only.
    Mode,
}

/// What the value of a parameter must be, besides finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Any finite number.
    Finite,
    /// > 0, and so large that its reciprocal is finite: what is positive is divided by.
    Positive,
    /// ≥ 0
    NotNegative,
    /// 0, or within both ends.
    ZeroOrWithin(f64, f64),
    /// Within both ends.
    Within(f64, f64),
    /// One of these, which ascend.
    OneOf(&'static [f64]),
}

impl Bound {
    /// Whether `value` keeps the bound.
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Bound::Finite => true,
                Bound::Positive => value > 0.0 && value.recip().is_finite(),
                Bound::NotNegative => value >= 0.0,
                Bound::ZeroOrWithin(low, high) => value == 0.0 || (low..=high).contains(&value),
                Bound::Within(low, high) => (low..=high).contains(&value),
                Bound::OneOf(these) => these.contains(&value),
            }
    }

    /// The bound of a variable of this kind, in words.
    pub fn words(self, kind: Kind) -> String {
        let number = |value| written(value, kind != Kind::Real);
        match self {
            Bound::Finite => "a finite number".into(),
            Bound::Positive => "a finite number > 0".into(),
            Bound::NotNegative => "a finite number >= 0".into(),
            Bound::ZeroOrWithin(low, high) => format!("0 or a number from {} to {}", number(low), number(high)),
            Bound::Within(low, high) => format!("a number from {} to {}", number(low), number(high)),
            Bound::OneOf(these) => these.iter().map(f64::to_string).collect::<Vec<_>>().join(" or "),
        }
    }

    /// What [`Bound::words`] leave out, for whom a positive number was refused.
    fn besides(self) -> &'static str {
        if self == Bound::Positive { ", large enough to divide by" } else { "" }
    }

    /// The least and greatest value that the XML can state: ends that are themselves possible.
    pub fn range(self) -> (Option<f64>, Option<f64>) {
        match self {
            Bound::Finite | Bound::Positive => (None, None),
            Bound::NotNegative => (Some(0.0), None),
            Bound::ZeroOrWithin(_, high) => (Some(0.0), Some(high)),
            Bound::Within(low, high) => (Some(low), Some(high)),
            Bound::OneOf(these) => (these.first().copied(), these.last().copied()),
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

    /// A Boolean parameter; its value is 1 where it is true, else 0.
    pub const fn boolean(name: &'static str, default: bool, description: &'static str) -> Self {
        let role = Role::Parameter { default: Some(default as u8 as f64), bound: Bound::OneOf(&[0.0, 1.0]) };
        Self { name, description, unit: &units::ONE, kind: Kind::Boolean, role }
    }

    /// A Real variable of another role.
    pub const fn real(name: &'static str, unit: &'static Unit, role: Role, description: &'static str) -> Self {
        Self { name, description, unit, kind: Kind::Real, role }
    }

    /// The value that it has until somebody sets it, where the list knows one.
    pub fn default(&self) -> Option<f64> {
        match self.role {
            Role::Parameter { default, .. } => default,
            Role::Input { start } => Some(start),
            _ => None,
        }
    }

    /// The column and the node, from 1, of a number in a table: `kyy[2]`.
    #[cfg(feature = "scenes")]
    pub fn node(&self) -> Option<(&'static str, usize)> {
        let (column, node) = self.name.strip_suffix(']')?.split_once('[')?;
        Some((column, node.parse().ok()?))
    }

    /// Whether somebody gives it its value.
    pub fn has_start(&self) -> bool {
        matches!(self.role, Role::Parameter { .. } | Role::Input { .. })
    }

    /// The error of a parameter's or input's value, if it has one; `full_name` is the name with its block.
    pub fn check(&self, full_name: impl FnOnce() -> String, value: f64) -> Result<(), Invalid> {
        let bound = match self.role {
            Role::Parameter { bound, .. } => bound,
            Role::Input { .. } => Bound::Finite,
            _ => return Ok(()),
        };
        match self.kind {
            Kind::Enumeration(of) if !of.items.iter().any(|item| f64::from(item.0) == value) => {
                Err(Invalid::out_of_bound(full_name(), &written(value, true), of.words()))
            }
            Kind::Real | Kind::Integer | Kind::Boolean if !bound.holds(value) => {
                let words = bound.words(self.kind) + if value > 0.0 { bound.besides() } else { "" };
                Err(Invalid::out_of_bound(full_name(), &written(value, self.kind != Kind::Real), words))
            }
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
#[macro_export]
macro_rules! parameter {
    ($($field:ident).+, $unit:expr, $default:expr, $bound:expr, $description:expr) => {
        $crate::parameter!(stringify!($($field).+), $($field).+, $unit, $default, $bound, $description)
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

/// A row for an input that is a [`Signal`]: `input!(tau, &NEWTON_METRE, 0.0, "…")`, with its value at first. The name of
/// the field is the name of the variable.
#[macro_export]
macro_rules! input {
    ($($field:ident).+, $unit:expr, $start:expr, $description:expr) => {
        $crate::variable::Row {
            meta: $crate::variable::Meta::real(
                stringify!($($field).+),
                $unit,
                $crate::variable::Role::Input { start: $start },
                $description,
            ),
            access: $crate::variable::Access::Input { get: |p| &p.$($field).+, get_mut: |p| &mut p.$($field).+ },
        }
    };
}

/// A row for an output: `output!("F.x", &NEWTON, "…", |effect, motion| …)`; with a third name, that of the rates of the
/// state, which are calculated only for it. The expression is compiled for each scalar.
#[macro_export]
macro_rules! output {
    ($name:expr, $unit:expr, $description:expr, |$p:tt, $o:tt $(, $rates:tt)?| $read:expr) => {
        $crate::output!(Output, $name, $unit, $description, |$p, $o $(, $rates)?| $read)
    };
    ($role:ident, $name:expr, $unit:expr, $description:expr, |$p:tt, $o:tt| $read:expr) => {
        $crate::variable::Row {
            meta: $crate::variable::Meta::real($name, $unit, $crate::variable::Role::$role, $description),
            access: $crate::variable::Access::Output($crate::variable::Output::new(
                |$p, $o| $read,
                |$p, $o| $read,
                |$p, $o| $read,
            )),
        }
    };
    ($role:ident, $name:expr, $unit:expr, $description:expr, |$p:tt, $o:tt, $rates:tt| $read:expr) => {
        $crate::variable::Row {
            meta: $crate::variable::Meta::real($name, $unit, $crate::variable::Role::$role, $description),
            access: $crate::variable::Access::Rate($crate::variable::Rate::new(
                |$p, $o, $rates| $read,
                |$p, $o, $rates| $read,
                |$p, $o, $rates| $read,
            )),
        }
    };
}

/// The two rows of a state of an effect's own, by its number: `own!(state 0, "state.tau", &NEWTON_METRE, "…")`, and of its rate
/// `own!(rate 0, "der(state.tau)", &NEWTON_METRE_PER_SECOND, "…")`. States stand in the order of their numbers.
#[macro_export]
macro_rules! own {
    (state $n:expr, $name:expr, $unit:expr, $description:expr) => {
        $crate::output!(State, $name, $unit, $description, |_, m| m.own($n))
    };
    (rate $n:expr, $name:expr, $unit:expr, $description:expr) => {
        $crate::output!(State, $name, $unit, $description, |_, _, rates| rates.own[$n])
    };
}

#[doc(no_inline)]
pub use crate::{input, output, own, parameter};
