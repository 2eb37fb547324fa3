//! What acts on the rotor. One file an effect, one line in [`catalogue!`](self); the laws stand in each file.
//!
//! An effect implements the hooks of [`Effect`] that it needs; each defaults to the identity. A scene's effects are a
//! type, a list of [`Called`] effects that build.rs writes: what is not in the list is not compiled. The list [`All`]
//! holds every effect behind a switch.

mod act;
mod doubt;
mod facts;
pub mod housing;
mod list;
pub mod load;
mod motion;
pub mod partner;
pub mod series;
pub mod table;
mod terminal;
mod wrench;

pub use act::Act;
pub use doubt::Doubt;
pub use facts::Facts;
pub use list::{Block, Called, Effects, Switched, follows_all_inputs};
pub use load::{Change, MOST_LOADS, Pose};
pub use motion::Motion;
pub use partner::{Acting, Exchange, Law};
pub use terminal::Terminal;
pub use wrench::Wrench;

use crate::body::Shape;
use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::variable::{self, Meta};

/// Outputs of effects are read from the motion that laws see.
pub enum Seen {}

impl variable::Shown for Seen {
    type Of<'m, S: Scalar> = Motion<'m, S>;
}

/// A variable of an effect.
pub type Row<E> = variable::Row<E, Seen>;

/// An effect has at most so many states of its own.
pub const MOST_OWN: usize = 6;

/// The effects of a list have at most so many indicators together.
pub const MOST_INDICATORS: usize = 16;

/// A law has at most so many doubts.
pub const MOST_DOUBTS: usize = 3;

/// A law and its variables. All vectors in the inertial frame O.
pub trait Effect: Clone + Default + Send + 'static {
    /// Its variables, named within its block; new ones go to the end, for a value reference is a place in this list.
    const ROWS: &'static [Row<Self>];

    /// Those of its [housing](housing::rows), from the row [`HOUSING`](variable::Place::HOUSING) on.
    const HOUSING: &'static [Row<Self>] = &[];

    /// What it can do, and how much room it needs.
    const FACTS: Facts = Facts::USUAL;

    /// The effects after it in the catalogue that cannot act beside it.
    const EXCLUDES: &'static [&'static str] = &[];

    /// Its inputs and outputs as a terminal of the FMU, where other models are connected to it.
    const TERMINAL: Option<Terminal> = None;

    /// Its law in one line, for the reference of scenes.
    const LAW: &'static str = "";

    /// What some of its variables are where a scene calls for it and gives none.
    const WHERE_EMPTY: &'static [(&'static str, f64)] = &[];

    /// Adds its share to the mass, mass centre and inertia of the body.
    fn shape(&self, _body: &mut Shape) {}

    /// What it does to the rotor: loads, energy, power, and the rates of its own states. What nobody asks for of the answer, the
    /// compiler leaves out.
    #[inline(always)]
    fn act<S: Scalar>(&self, _motion: &Motion<S>) -> Act<S> {
        Act::none()
    }

    /// By how much each of its loads changes with a small change of the motion, squared \[N²] or [(N·m)²].
    fn load_changes(&self, _at: &Pose, _change: &Change) -> [f64; MOST_LOADS] {
        [0.0; MOST_LOADS]
    }

    /// How large each of its loads is after this change of the motion from where excursions are counted from, squared \[N²] or
    /// [(N·m)²].
    #[inline(always)]
    fn load_sizes(&self, at: &Pose, excursion: &Change) -> [f64; MOST_LOADS] {
        self.load_changes(at, excursion)
    }

    /// The ω_φ that it imposes at time `t` \[s] [rad/s], and the rate of that [rad/s²]; None where it imposes none.
    #[inline(always)]
    fn imposed<S: Scalar>(&self, _t: S) -> Option<[S; 2]> {
        None
    }

    /// Whether, with its present parameters and in any branch, it has events: asked where a run starts.
    fn has_events(&self) -> bool {
        Self::FACTS.indicators > 0
    }

    /// An indicator, by its number: where it changes its sign, there is an event, and the law [switches](Effect::switch).
    fn indicator(&self, _n: usize, _motion: &Motion<f64>) -> f64 {
        1.0
    }

    /// Takes the branch of these signs of its indicators, which nothing else may decide: a step that is taken back is told with the signs
    /// that were. Until it is called again, the law keeps that branch, whatever the indicators say.
    fn switch(&mut self, _positive: &[bool], _motion: &Motion<f64>) {}

    /// Its own states where the motion begins, which has zeros in their place; those beyond [`Facts::own`] do not count.
    fn own_at_start(&self, _start: &Motion<f64>) -> [f64; MOST_OWN] {
        [0.0; MOST_OWN]
    }

    /// How fast its own states die out, with its present parameters [1/s]: a composition steps backwards too, where they grow, and so takes
    /// no step that is longer than one over this.
    fn own_decay(&self) -> f64 {
        if Self::FACTS.own > 0 { f64::INFINITY } else { 0.0 }
    }

    /// What its own states count with until they have been larger, in their units, > 0.
    fn own_nominal(&self) -> [f64; MOST_OWN] {
        [1.0; MOST_OWN]
    }

    /// What of its law, with its present parameters and inputs, has no limit where |γ| = π, because it follows the direction of γ:
    /// as the macro `no_limit` says it to the user who gets there.
    fn no_limit(&self) -> Option<&'static str> {
        None
    }

    /// What no single bound says: the first of its parameters that does not go with the others, named within its block.
    fn check(&self) -> Result<(), Invalid> {
        Ok(())
    }

    /// Hears where the motion begins, before anything is asked.
    fn begin(&mut self, _start: &Motion<f64>) {}

    /// Hears that a communication step begins at time `t` \[s].
    fn step_from(&mut self, _t: f64) {}

    /// Extrapolates the input with this index over the step that begins. `lag`: by how many steps it is late, where its own effect says so \[1].
    fn extrapolate(&mut self, _number: usize, _lag: Option<f64>, _signal: &mut Signal) {}

    /// Interpolates the input with this index up to time `to` \[s], up to which all are known.
    fn interpolate(&mut self, _number: usize, _lag: Option<f64>, _to: f64, _signal: &mut Signal) {}

    /// The time \[s] up to which inputs are known that are so many communication steps late, where the motion is to be done again up to there.
    fn known_until(&self, _lag: f64) -> Option<f64> {
        None
    }

    /// Whether it was given how its partner answers.
    fn knows_partner(&self) -> bool {
        false
    }

    /// Whether a value was set of its inputs at the communication point `t` \[s], which may be the answer of a partner.
    fn is_answered(&self, _t: f64) -> bool {
        false
    }

    /// What it shows its partner at the communication point, and what was set there; asked of what [may have one](Facts::partners).
    fn exchange(&self, _motion: &Motion<f64>) -> Option<Exchange> {
        None
    }

    /// The law of its partner, which a run sets; None of what [has none](Facts::partners).
    fn law_mut(&mut self) -> Option<&mut Law> {
        None
    }

    /// What acts of its inputs from the communication point `t` \[s] on, as coefficients of the powers of the time.
    fn acting(&self, _t: f64) -> Acting {
        Acting::default()
    }

    /// The degree of the polynomials as which inputs go on by it; 0 where they are held.
    fn order(&self) -> usize {
        0
    }

    /// By how many communication steps the values of its inputs are late, where that is given \[1]; of all inputs, if it extrapolates them.
    fn lag(&self) -> Option<f64> {
        None
    }

    /// Hears that one of its inputs was set, of what it was `before`; whether that changes how anything goes on.
    fn input_set(&mut self, _before: &Self, set: InputSet) -> bool {
        !set.goes_on
    }

    /// Hears where a communication step ended.
    fn step_to(&mut self, _end: &Motion<f64>) {}

    /// What it remembers of a run besides its variables: saved and brought back with them.
    fn memory(&mut self) -> &mut [f64] {
        &mut []
    }

    /// Hears that its variables and memory were brought back; whether it can remember this: what was saved may have been altered.
    fn restored(&mut self) -> bool {
        true
    }

    /// Whether, with its present parameters, it can lose energy or be supplied with it: it is not conservative. Where no effect
    /// can, the work integrals are not solved.
    fn works(&self) -> bool {
        Self::FACTS.could_work
    }

    /// Whether it is [analytic](Facts::analytic) with its present parameters and in its present branch.
    fn is_analytic(&self) -> bool {
        Self::FACTS.analytic
    }

    /// Whether, with its present parameters, its law is doubtful at some speeds: asked at each step, where the motion has begun.
    fn is_doubtful(&self) -> bool {
        Self::FACTS.may_be_doubted
    }

    /// What is doubtful of its law at ω_φ from the first to the second of these [rad/s].
    fn doubts(&self, _speeds: [f64; 2]) -> [Option<Doubt>; MOST_DOUBTS] {
        [None; MOST_DOUBTS]
    }

    /// Whether, with its present parameters, what it applies to the rotor depends on how fast that moves.
    fn follows_speed(&self) -> bool {
        self.works()
    }
}

/// The variables of an effect, each with its row.
fn rows<E: Effect>() -> impl Iterator<Item = (usize, &'static Row<E>)> {
    (0..).zip(E::ROWS).chain((variable::Place::HOUSING..).zip(E::HOUSING))
}

/// Why an axis may not come near −e: `no_limit!("drive.tau, which a joint passes on,")`.
#[allow(unused_macros, reason = "a scene's effects may all have one")]
macro_rules! no_limit {
    ($what:literal) => {
        concat!("the tilt |gamma| reaches 3.1 rad, and ", $what, " has no limit at pi")
    };
}

/// What was set of an input.
#[derive(Clone, Copy, Debug)]
pub struct InputSet {
    /// Its number among the effect's variables.
    pub row: usize,
    /// 0 for its value, else the order of the derivative.
    pub order: u32,
    /// At which communication point \[s].
    pub t: f64,
    /// Whether it still holds what it held.
    pub goes_on: bool,
}

/// An effect's place in the catalogue.
pub trait Entry: Effect {
    /// Its name in scenes and variables.
    const NAME: &'static str;
    /// Its number, from which its value references follow.
    const NUMBER: u32;
    /// Whether a scene may hold several, named with their index.
    const SEVERAL: bool;
    /// Its switch in a list where it has one.
    const SWITCH: Meta = switch("whether the effect acts; if false, it is not calculated and its outputs are 0");
}

/// What can be said of an effect without its type.
#[derive(Debug)]
pub struct Info {
    /// Its name in scenes and variables.
    pub name: &'static str,
    /// Its number, from which its value references follow.
    pub number: u32,
    /// Whether a scene may hold several, named with their index.
    pub several: bool,
    /// What is said of its switch, where it has one.
    pub switch: Meta,
    /// The terminal that it is, if it is one.
    pub terminal: Option<Terminal>,
    /// The path of its type, for the list that build.rs writes.
    pub type_path: &'static str,
    /// Its variables, each with its row.
    pub metas: fn() -> Vec<(usize, Meta)>,
    /// Its law in one line.
    pub law: &'static str,
    /// What some of its variables are where a scene calls for it and gives none.
    pub where_empty: &'static [(&'static str, f64)],
    /// What it can do without a table, as it declares that.
    pub facts: Facts,
    /// What it can do with one, if it may have one.
    pub facts_with_table: Facts,
    /// The effects after it that cannot act beside it.
    pub excludes: &'static [&'static str],
}

/// The switch of an effect, of which this is said: whether it acts.
pub const fn switch(description: &'static str) -> Meta {
    Meta::boolean("effects", false, description)
}

fn switch_name(name: &str, several: bool, index: u32) -> String {
    format!("effects.{}", block_name(name, several, index))
}

impl Info {
    /// The full name of its switch, of the `index`th of its kind.
    pub fn switch_name(&self, index: u32) -> String {
        switch_name(self.name, self.several, index)
    }

    /// What the names of its variables begin with, of the `index`th of its kind: `drag`, `bearing[1]`.
    pub fn block_name(&self, index: u32) -> String {
        block_name(self.name, self.several, index)
    }
}

fn block_name(name: &str, several: bool, index: u32) -> String {
    if several { format!("{name}[{index}]") } else { name.to_owned() }
}

/// The full name of a variable of this block: `drag.tau`, `der(motor.state.tau)`.
pub fn full_name(block: &str, name: &str) -> String {
    match name.strip_prefix("der(") {
        Some(state) => format!("der({block}.{state}"),
        None => format!("{block}.{name}"),
    }
}

/// The effect of this name.
#[cfg(feature = "scenes")]
pub fn named(name: &str) -> Option<&'static Info> {
    CATALOGUE.iter().find(|info| info.name == name)
}

/// Declares the effects, those that build.rs lets be compiled: their number (never reused), module and type, whether it may stand in a
/// housing and have a table, and whether a scene may hold several.
macro_rules! catalogue {
    ($($number:literal $module:ident $type:ident $(<$($of:ident)*>)? $many:ident;)*) => {
        $(
            #[cfg($module)]
            pub mod $module;

            #[cfg($module)]
            catalogue!(@entry [$($($of)*)?] $module::$type, $number, stringify!($module), catalogue!(@several $many), catalogue!(@switch $module));

            #[cfg($module)]
            const _: () = {
                type Largest = catalogue!(@largest $module $type $($($of)*)?);
                let most = if Largest::HOUSING.is_empty() { variable::Place::SWITCH } else { variable::Place::HOUSING };
                assert!(Largest::ROWS.len() <= most, "an effect has at most 255 variables, 192 beside those of a housing");
                assert!(Largest::FACTS.own <= MOST_OWN, "an effect has at most MOST_OWN states of its own");
                assert!(Largest::FACTS.loads <= MOST_LOADS, "an effect has at most MOST_LOADS loads");
            };
        )*

        /// Every effect there is.
        #[cfg(feature = "scenes")]
        pub static CATALOGUE: &[Info] = &[$(Info {
            name: stringify!($module),
            number: $number,
            several: catalogue!(@several $many),
            switch: switch(catalogue!(@switch $module)),
            terminal: <$module::$type as Effect>::TERMINAL,
            type_path: concat!("split_rotor_model::effects::", stringify!($module), "::", stringify!($type)),
            metas: || rows::<catalogue!(@largest $module $type $($($of)*)?)>().map(|(number, row)| (number, row.meta)).collect(),
            law: <$module::$type as Effect>::LAW,
            where_empty: <$module::$type as Effect>::WHERE_EMPTY,
            facts: <$module::$type as Effect>::FACTS,
            facts_with_table: <catalogue!(@largest $module $type $($($of)*)?)>::FACTS,
            excludes: <$module::$type as Effect>::EXCLUDES,
        }),*];

        /// Every effect, each behind a switch.
        #[cfg(feature = "scenes")]
        pub type All = catalogue!(@list $($module $type $(<$($of)*>)? $many;)*);

        const _: () = {
            let numbers = [$($number),*];
            let mut i = 0;
            while i < numbers.len() {
                let mut j = 0;
                while j < i {
                    assert!(numbers[i] != numbers[j], "two effects with one number: duplicate value references");
                    j += 1;
                }
                i += 1;
            }
        };
    };
    (@list) => { () };
    (@list $module:ident $type:ident one; $($rest:tt)*) => {
        (Switched<$module::$type, 1>, catalogue!(@list $($rest)*))
    };
    (@list $module:ident $type:ident $(<$($of:ident)*>)? several; $($rest:tt)*) => {
        catalogue!(@four (catalogue!(@largest $module $type $($($of)*)?)) $($rest)*)
    };
    (@four ($largest:ty) $($rest:tt)*) => {
        (Switched<$largest, 1>, (Switched<$largest, 2>, (Switched<$largest, 3>, (Switched<$largest, 4>,
            catalogue!(@list $($rest)*)))))
    };
    (@largest $module:ident $type:ident) => { $module::$type };
    (@largest $module:ident $type:ident HOUSING) => { $module::$type<housing::Moving> };
    (@largest $module:ident $type:ident HOUSING NODES) => { $module::$type<housing::Moving, { table::MOST_NODES }> };
    (@entry [] $type:ty, $($of:tt)*) => { catalogue!(@entry impl [] $type, $($of)*); };
    (@entry [HOUSING] $module:ident::$type:ident, $($of:tt)*) => {
        catalogue!(@entry impl [H: housing::Housing] $module::$type<H>, $($of)*);
    };
    (@entry [HOUSING NODES] $module:ident::$type:ident, $($of:tt)*) => {
        catalogue!(@entry impl [H: housing::Housing, const NODES: usize] $module::$type<H, NODES>, $($of)*);
    };
    (@entry impl [$($generics:tt)*] $type:ty, $number:expr, $name:expr, $several:expr, $switch:expr) => {
        impl<$($generics)*> Entry for $type {
            const NAME: &'static str = $name;
            const NUMBER: u32 = $number;
            const SEVERAL: bool = $several;
            const SWITCH: Meta = switch($switch);
        }
    };
    (@switch $module:ident) => {
        concat!("whether the effect ", stringify!($module), " acts; if false, it is not calculated and its outputs are 0")
    };
    (@several one) => { false };
    (@several several) => { true };
}

catalogue! {
    1 gravity Gravity one;
    2 support Support one;
    3 drive Drive one;
    4 asymmetry Asymmetry one;
    5 unbalance Unbalance several;
    6 bearing Bearing<HOUSING NODES> several;
    7 rotating_damping RotatingDamping one;
    8 drag Drag one;
    9 probe Probe several;
    10 port Port several;
    11 imposed_speed ImposedSpeed one;
    12 extrapolation Extrapolation one;
    13 motor Motor one;
    14 rub Rub<HOUSING> several;
}
