//! The effects of one scene as a type: `(Called<Gravity, 1>, (Called<Support, 1>, ()))`.

mod member;
mod none;
mod pair;

pub use member::{Called, Switched};

use super::Wrench;
use crate::body::Shape;
use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::state::{Kinematics, Whole};
use crate::stored::Stored;
use crate::variable::{Meta, Place, Readable};
use std::ops::Add;

/// Whether what extrapolates inputs has room for all of the list's.
pub const fn follows_all_inputs<E: Effects>() -> bool {
    E::EXTRAPOLATED <= E::MOST_EXTRAPOLATED
}

/// What effects do to a rotor.
#[derive(Clone, Copy)]
pub struct Action<S: Scalar> {
    /// Force and moment about c [N, N·m], without what damps.
    pub load: Wrench<S>,
    /// Of what damps [N, N·m].
    pub damping: Wrench<S>,
    /// Power that comes from outside \[W].
    pub supply: S,
    /// Power that leaves the mechanics \[W].
    pub loss: S,
}

impl<S: Scalar> Add for Action<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            load: self.load + other.load,
            damping: self.damping + other.damping,
            supply: self.supply + other.supply,
            loss: self.loss + other.loss,
        }
    }
}

/// The effects of a scene together: sums of what each does, and access to their variables.
pub trait Effects: Clone + Default + Send + Stored + 'static {
    /// Whether any of them has a switch.
    const SWITCHED: bool;
    /// Whether any of them can lose energy or be supplied with it, with any parameters.
    const COULD_WORK: bool;
    /// Whether any of them can shape the body.
    const SHAPES: bool;
    /// Whether any of them can follow φ.
    const FOLLOWS_PHI: bool;
    /// Whether any of them can impose a speed.
    const IMPOSES: bool;
    /// How many inputs they have that may be extrapolated.
    const EXTRAPOLATED: usize;
    /// How many can be.
    const MOST_EXTRAPOLATED: usize;
    /// The ω_φ that one of them imposes at time `t` [rad/s], and the rate of that [rad/s²].
    fn imposed<S: Scalar>(&self, t: S) -> Option<[S; 2]>;
    /// What they make of the body.
    fn shape(&self, body: &mut Shape);
    /// Force on the rotor and moment about c [N, N·m], without what damps.
    #[inline(always)]
    fn load<S: Scalar>(&self, motion: &Kinematics<S>) -> Wrench<S> {
        self.load_of::<S, true>(motion)
    }
    /// What they do where any of them works, in one pass, so that each switch is asked once.
    #[inline(always)]
    fn action<S: Scalar>(&self, motion: &Kinematics<S>) -> Action<S> {
        self.action_of::<S, true>(motion)
    }
    /// [`Effects::load`]; without `PLACE`, of those that do not follow the place: the others are known to be off.
    fn load_of<S: Scalar, const PLACE: bool>(&self, motion: &Kinematics<S>) -> Wrench<S>;
    /// [`Effects::action`] of the same.
    fn action_of<S: Scalar, const PLACE: bool>(&self, motion: &Kinematics<S>) -> Action<S>;
    /// Potential energy \[J].
    fn potential<S: Scalar>(&self, motion: &Kinematics<S>) -> S;
    /// Whether any of them follows φ.
    fn follows_phi(&self) -> bool;
    /// Whether any of them follows where the rotor is or how fast it moves there.
    fn follows_place(&self) -> bool;
    /// Whether the law of any of them has no limit where |γ| = π.
    fn needs_gamma(&self) -> bool;
    /// Whether any of them can act on the rotor.
    fn push(&self) -> bool;
    /// Whether any of them can lose energy or be supplied with it.
    fn works(&self) -> bool;
    /// Whether one of this name acts.
    fn acts(&self, name: &str) -> bool;
    /// The first parameter whose value is not possible.
    fn check(&self) -> Result<(), Invalid>;
    /// Hear where the motion begins.
    fn begin(&mut self, start: &Kinematics<f64>);
    /// What is said of the variable at this place; None where there is none.
    fn meta(place: Place) -> Option<&'static Meta>;
    /// The full name of the variable at this place; None where there is none.
    fn name(place: Place) -> Option<String>;
    /// The value of a variable, an input's at time `t` \[s], a calculated one's of a switched-off effect zero; None where
    /// there is none at this place, or nothing is shown. `rates` is asked only where it counts.
    fn value(
        &self,
        place: Place,
        t: f64,
        motion: Option<&Kinematics<f64>>,
        rates: impl FnOnce() -> Option<Whole<f64>>,
    ) -> Option<f64>;
    /// Sets a parameter; false where there is none at this place.
    fn set_parameter(&mut self, place: Place, value: f64) -> bool;
    /// The value of a calculated variable, zero where its effect is switched off; None where there is none at this
    /// place. `rates` is asked only where it counts.
    fn calculated<S: Readable>(
        &self,
        place: Place,
        motion: &Kinematics<S>,
        rates: impl FnOnce() -> Whole<S>,
    ) -> Option<S>;
    /// An input; None where there is none at this place.
    fn signal(&self, place: Place) -> Option<&Signal>;
    /// An input to set; None where there is none at this place.
    fn signal_mut(&mut self, place: Place) -> Option<&mut Signal>;
    /// Changes an input at the communication point `t` \[s], its value or its derivative of an order; whether anything goes on
    /// otherwise, None where there is none at this place.
    fn change_input(&mut self, place: Place, order: u32, t: f64, change: impl FnOnce(&mut Signal)) -> Option<bool>;
    /// Hear where a communication step ended.
    fn step_to(&mut self, end: &Kinematics<f64>);
    /// Whether any of them extrapolates inputs.
    fn extrapolates(&self) -> bool;
    /// Hear that a communication step begins at time `t` \[s].
    fn step_from(&mut self, t: f64);
    /// Extrapolate the input of this number over the step that begins.
    fn extrapolate(&mut self, number: usize, signal: &mut Signal);
    /// Each input that may be extrapolated.
    fn for_each_extrapolated(&mut self, act: &mut impl FnMut(&mut Signal));
    /// Each input.
    fn for_each_signal(&mut self, act: &mut impl FnMut(&mut Signal));
    /// Takes the inputs of other effects of the same list.
    fn hear(&mut self, other: &Self);
    /// Switches the effect at this place on, where it has a switch.
    fn switch_on(&mut self, block: u32);
}
