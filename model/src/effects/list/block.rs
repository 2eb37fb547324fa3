//! An effect of a list without its type: what is not asked in every evaluation.

use super::{InputSet, Motion, Tangent};
use crate::body::Shape;
use crate::effects::{Acting, Doubt, Exchange, Facts, Law, MOST_DOUBTS, MOST_OWN, block_name, full_name, switch_name};
use crate::error::Invalid;
use crate::signal::Signal;
use crate::state::Rates;
#[cfg(feature = "scenes")]
use crate::traced::Traced;
use crate::variable::Meta;

/// What an entry of a list is.
#[derive(Debug)]
pub struct Kind {
    /// Its name in scenes and variables.
    pub name: &'static str,
    /// Whether a scene may hold several, and which of them it is, from 1.
    pub several: bool,
    /// Counts from 1 where there are several of its kind.
    pub index: u32,
    /// Its block of value references.
    pub block: u32,
    /// The metadata of its switch, if it has one.
    pub switch: Meta,
    /// What it can do, and how much room it needs.
    pub facts: Facts,
    /// Which effects cannot act beside it.
    pub excludes: &'static [&'static str],
    /// What is said of its variable in this row; None where there is none.
    pub meta: fn(usize) -> Option<&'static Meta>,
}

impl Kind {
    /// The name of its block.
    pub fn block_name(&self) -> String {
        block_name(self.name, self.several, self.index)
    }

    /// The full name of its variable that has this name within its block.
    pub fn full_name(&self, name: &str) -> String {
        full_name(&self.block_name(), name)
    }

    /// The full name of its switch.
    pub fn switch_name(&self) -> String {
        switch_name(self.name, self.several, self.index)
    }
}

/// The hooks of an effect that an entry of a list forwards unchanged; add a new one to `Effect` and here.
macro_rules! hooks {
    ($take:ident) => {
        $take! {
            fn shape(body: &mut Shape);
            fn no_limit() -> Option<&'static str>;
            fn works() -> bool;
            fn is_analytic() -> bool;
            fn follows_speed() -> bool;
            fn doubts(speeds: [f64; 2]) -> [Option<Doubt>; MOST_DOUBTS];
            fn has_events() -> bool;
            fn own_at_start(start: &Motion<f64>) -> [f64; MOST_OWN];
            fn own_decay() -> f64;
            fn own_nominal() -> [f64; MOST_OWN];
            fn is_answered(t: f64) -> bool;
            fn exchange(motion: &Motion<f64>) -> Option<Exchange>;
            fn acting(t: f64) -> Acting;
            fn order() -> usize;
            fn lag() -> Option<f64>;
            fn known_until(lag: f64) -> Option<f64>;
            fn knows_partner() -> bool;
            mut:
            fn begin(start: &Motion<f64>);
            fn switch(positive: &[bool], motion: &Motion<f64>);
            fn step_to(end: &Motion<f64>);
            fn extrapolate(number: usize, lag: Option<f64>, signal: &mut Signal);
            fn interpolate(number: usize, lag: Option<f64>, to: f64, signal: &mut Signal);
            fn law_mut() -> Option<&mut Law>;
        }
    };
}

macro_rules! declared {
    (
        $(fn $asked:ident($($of:ident: $type:ty),*) $(-> $answer:ty)?;)*
        mut:
        $(fn $told:ident($($with:ident: $what:ty),*) $(-> $result:ty)?;)*
    ) => {
        /// What is forwarded to the effect.
        pub trait Hooks {
            $(#[doc = concat!("[`crate::effects::Effect::", stringify!($asked), "`].")]
            fn $asked(&self, $($of: $type),*) $(-> $answer)?;)*
            $(#[doc = concat!("[`crate::effects::Effect::", stringify!($told), "`].")]
            fn $told(&mut self, $($with: $what),*) $(-> $result)?;)*
        }
    };
}

hooks!(declared);

/// An effect of a list. Rows are those of its variables.
pub trait Block: Hooks {
    /// What it is.
    fn kind(&self) -> &'static Kind;
    /// Whether it is not switched off.
    fn is_active(&self) -> bool;
    /// Switches it on or off, where it has a switch.
    fn switch_to(&mut self, on: bool);
    /// The first of its parameters whose value is not possible.
    fn check(&self) -> Result<(), Invalid>;
    /// Shows each of its inputs.
    fn for_each_signal(&mut self, act: &mut dyn FnMut(&mut Signal));
    /// Whether a variable is calculated from the rates of the state too.
    fn asks_rates(&self, row: usize) -> bool;
    /// The value of a variable, an input's at time `t` \[s], a calculated one's of what is switched off zero; None where there is
    /// none, or nothing is shown.
    fn value(&self, row: usize, t: f64, motion: Option<&Motion<f64>>, rates: Option<&Rates<f64>>) -> Option<f64>;
    /// The same of a calculated one with its derivative.
    fn tangent(&self, row: usize, motion: &Motion<Tangent>, rates: Option<&Rates<Tangent>>) -> Option<Tangent>;
    /// What a calculated one depends on.
    #[cfg(feature = "scenes")]
    fn traced(&self, row: usize, motion: &Motion<Traced>, rates: &Rates<Traced>) -> Option<Traced>;
    /// The number of its own state that this variable is, if it is one.
    fn own_state(&self, row: usize) -> Option<usize>;
    /// Sets a parameter; false where there is none.
    fn set_parameter(&mut self, row: usize, value: f64) -> bool;
    /// An input; None where there is none.
    fn signal(&self, row: usize) -> Option<&Signal>;
    /// An input to set; None where there is none.
    fn signal_mut(&mut self, row: usize) -> Option<&mut Signal>;
    /// Changes an input, its value or its derivative of an order, at the communication point `set` says; whether anything goes on
    /// otherwise, None where there is none.
    fn change_input(&mut self, set: InputSet, change: &dyn Fn(&mut Signal)) -> Option<bool>;
    /// Whether that would change anything.
    fn would_change(&self, set: InputSet, change: &dyn Fn(&mut Signal)) -> Option<bool>;
}
