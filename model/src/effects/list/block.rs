//! An effect of a list without its type: what is not asked in every evaluation.

use super::{InputSet, Motion, Tangent};
use crate::body::Shape;
use crate::effects::{Doubt, Exchange, Law, Loads, MOST_DOUBTS, MOST_OWN, block_name, full_name, switch_name};
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
    /// Whether it has a switch, and what is said of that.
    pub switched: bool,
    /// See `switched`.
    pub switch: Meta,
    /// How many states of its own it has.
    pub own: usize,
    /// How many indicators of events it has.
    pub indicators: usize,
    /// Whether it can act on the rotor other than by its weight.
    pub pushes: bool,
    /// Whether it extrapolates inputs.
    pub extrapolates: bool,
    /// Whether what it does follows φ.
    pub follows_phi: bool,
    /// Whether its own inputs tell one another's rates.
    pub tells_rates: bool,
    /// Whether it may have a partner.
    pub has_partner: bool,
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

/// An effect of a list. Rows are those of its variables.
pub trait Block {
    /// What it is.
    fn kind(&self) -> &'static Kind;
    /// Whether it is not switched off.
    fn is_active(&self) -> bool;
    /// Switches it, where it has a switch.
    fn switch(&mut self, on: bool);
    /// Adds its share to the mass, mass centre and inertia of the body.
    fn shape(&self, body: &mut Shape);
    /// What of its law has no limit where |γ| = π.
    fn no_limit(&self) -> Option<&'static str>;
    /// Whether it can lose energy or be supplied with it.
    fn works(&self) -> bool;
    /// Whether its law is analytic as it is now.
    fn is_analytic(&self) -> bool;
    /// Whether what it applies depends on how fast the rotor moves.
    fn follows_speed(&self) -> bool;
    /// Whether its law is doubtful at some speeds.
    fn is_doubtful(&self) -> bool;
    /// What is doubtful of it at ω_φ from the first to the second of these [rad/s].
    fn doubts(&self, speeds: [f64; 2]) -> [Option<Doubt>; MOST_DOUBTS];
    /// The first of its parameters whose value is not possible.
    fn check(&self) -> Result<(), Invalid>;
    /// Whether it has events.
    fn has_events(&self) -> bool;
    /// Goes on where its indicators have these signs.
    fn hear_signs(&mut self, positive: &[bool], motion: &Motion<f64>);
    /// Hears where the motion begins.
    fn begin(&mut self, start: &Motion<f64>);
    /// Its own states there.
    fn own_at_start(&self, start: &Motion<f64>) -> [f64; MOST_OWN];
    /// How fast they die out [1/s].
    fn own_decay(&self) -> f64;
    /// What they count with until they have been larger.
    fn own_nominal(&self) -> [f64; MOST_OWN];
    /// Hears that a communication step begins at time `t` \[s].
    fn step_from(&mut self, t: f64);
    /// Hears where one ended.
    fn step_to(&mut self, end: &Motion<f64>);
    /// Extrapolates the input of this number.
    fn extrapolate(&mut self, number: usize, signal: &mut Signal);
    /// Whether a value was set of its inputs at the communication point `t` \[s].
    fn is_answered(&self, t: f64) -> bool;
    /// What it shows its partner at the communication point, and what was set there.
    fn exchange(&self, motion: &Motion<f64>) -> Option<Exchange>;
    /// The law of its partner; None of what may have none.
    fn law_mut(&mut self) -> Option<&mut Law>;
    /// What acts of its inputs from the communication point `t` \[s] on.
    fn acting(&self, t: f64) -> [Loads; 3];
    /// The degree of the polynomials as which inputs go on by it.
    fn order(&self) -> usize;
    /// How many communication steps values of inputs are late, where that is given.
    fn lag(&self) -> Option<f64>;
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
