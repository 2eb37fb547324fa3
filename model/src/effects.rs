//! What acts on the rotor. One file an effect, one line in [`catalogue!`](self); the laws stand in each file.
//!
//! An effect implements the hooks of [`Effect`] that it needs; each defaults to the identity. A scene's effects are a
//! type, a list of [`Called`] effects that build.rs writes: what is not in the list is not compiled. The list [`All`]
//! holds every effect behind a switch.

mod list;
mod terminal;
mod wrench;

pub use list::{Called, Effects, Switched};
pub use terminal::Terminal;
pub use wrench::Wrench;

use crate::scalar::Scalar;
use crate::state::Kinematics;
use crate::variable::{self, Meta};

/// Outputs of effects are read from the motion.
pub enum Motion {}

impl variable::Shown for Motion {
    type Of<S: Scalar> = Kinematics<S>;
}

/// A variable of an effect.
pub type Row<E> = variable::Row<E, Motion>;

/// A law and its variables. All vectors in the inertial frame O.
pub trait Effect: Clone + Default + Send + 'static {
    /// Its variables, named within its block; new ones go to the end, for a value reference is a place in this list.
    const ROWS: &'static [Row<Self>];

    /// Whether it can lose energy or be supplied with it, with any parameters. To forget to deny it costs time, not
    /// energy.
    const COULD_WORK: bool = true;

    /// Its inputs and outputs as a terminal of the FMU, where other models are connected to it.
    const TERMINAL: Option<Terminal> = None;

    /// Force on the rotor and moment about c [N, N·m].
    #[inline(always)]
    fn load<S: Scalar>(&self, _motion: &Kinematics<S>) -> Wrench<S> {
        Wrench::zero()
    }

    /// What damps, as a force on the rotor and a moment about c [N, N·m], beside [`Effect::load`]: it is asked for only
    /// where some effect [works](Effect::works), so that undamped motions do not pay for it.
    #[inline(always)]
    fn damping<S: Scalar>(&self, _motion: &Kinematics<S>) -> Wrench<S> {
        Wrench::zero()
    }

    /// Potential energy [J].
    #[inline(always)]
    fn potential<S: Scalar>(&self, _motion: &Kinematics<S>) -> S {
        S::zero()
    }

    /// Power that leaves the mechanics [W], ≥ 0.
    #[inline(always)]
    fn loss<S: Scalar>(&self, _motion: &Kinematics<S>) -> S {
        S::zero()
    }

    /// Power that comes from outside [W].
    #[inline(always)]
    fn supply<S: Scalar>(&self, _motion: &Kinematics<S>) -> S {
        S::zero()
    }

    /// Whether, with its present parameters and inputs, its law has no limit where |γ| = π, because it follows the
    /// direction of γ.
    fn needs_gamma(&self) -> bool {
        false
    }

    /// Whether, with its present parameters, it can lose energy or be supplied with it. Where no effect can, the work
    /// integrals are not solved.
    fn works(&self) -> bool {
        Self::COULD_WORK
    }
}

/// An effect's place in the catalogue.
pub trait Entry: Effect {
    /// Its name in scenes and variables.
    const NAME: &'static str;
    /// Its number, from which its value references follow.
    const NUMBER: u32;
}

/// What can be said of an effect without its type.
#[derive(Debug)]
pub struct Info {
    /// Its name in scenes and variables.
    pub name: &'static str,
    /// Its number, from which its value references follow.
    pub number: u32,
    /// The terminal that it is, if it is one.
    pub terminal: Option<Terminal>,
    /// The path of its type, for the list that build.rs writes.
    pub type_path: &'static str,
    /// Its variables.
    pub metas: fn() -> Vec<Meta>,
    /// Whether it can lose energy or be supplied with it.
    pub could_work: bool,
}

/// The effect of this name.
pub fn named(name: &str) -> Option<&'static Info> {
    CATALOGUE.iter().find(|info| info.name == name)
}

/// Declares the effects: their number (never reused), module and type.
macro_rules! catalogue {
    ($($number:literal $module:ident $type:ident;)*) => {
        $(
            pub mod $module;

            impl Entry for $module::$type {
                const NAME: &'static str = stringify!($module);
                const NUMBER: u32 = $number;
            }

            const _: () = assert!(<$module::$type as Effect>::ROWS.len() <= 256, "an effect has at most 256 variables");
        )*

        /// Every effect there is.
        pub static CATALOGUE: &[Info] = &[$(Info {
            name: stringify!($module),
            number: $number,
            terminal: <$module::$type as Effect>::TERMINAL,
            type_path: concat!("model::effects::", stringify!($module), "::", stringify!($type)),
            metas: || <$module::$type as Effect>::ROWS.iter().map(|row| row.meta).collect(),
            could_work: <$module::$type as Effect>::COULD_WORK,
        }),*];

        /// Every effect, each behind a switch.
        pub type All = catalogue!(@list $($module::$type,)*);

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
    (@list $head:ty, $($tail:ty,)*) => { (Switched<$head, 1>, catalogue!(@list $($tail,)*)) };
}

catalogue! {
    1 gravity Gravity;
    2 support Support;
    3 shaft Shaft;
}
