//! Reading and setting variables.

use super::{Failure, Instance, Reply, State};
use crate::scene::Effects;
use split_rotor_model::variable::{Kind, Meta, Place, Role};
use split_rotor_model::variables::Parameters;
use std::mem::MaybeUninit;

/// The type through which a variable is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Type {
    /// A floating-point number.
    Real,
    /// A whole number, or one of an enumeration.
    Integer,
    /// A switch.
    Boolean,
    /// A text, which no variable is.
    String,
}

/// Room for values that a host asked for, and need not have initialised: it is written, never read.
pub type Room<'a, T> = &'a mut [MaybeUninit<T>];

/// Writes `values` to room for as many.
pub fn fill<T: Copy>(room: Room<T>, values: &[T]) {
    assert_eq!(room.len(), values.len());
    for (place, value) in room.iter_mut().zip(values) {
        place.write(*value);
    }
}

/// A list of so many values is short.
const SHORT: usize = 32;

impl Instance {
    /// Reads variables of type Real.
    pub fn get_real(&mut self, references: &[u32], values: Room<f64>) -> Reply {
        if !self.get_at_hand(references, values) {
            self.make_ready(references, Type::Real)?;
            if !self.get_at_hand(references, values) {
                return self.get(references, values, Type::Real, |value| value);
            }
        }
        Ok(())
    }

    /// What hosts do most, made quick: a short list of what is calculated already. If it is not that, nothing is written.
    #[inline(always)]
    fn get_at_hand(&self, references: &[u32], values: Room<f64>) -> bool {
        let mut got = [0.0; SHORT];
        if references.len() > SHORT || !self.memory.simulation.reals_at_hand(references, &mut got[..values.len()]) {
            return false;
        }
        fill(values, &got[..values.len()]);
        true
    }

    /// Reads variables of this type.
    pub fn get<T>(&mut self, references: &[u32], values: Room<T>, kind: Type, convert: fn(f64) -> T) -> Reply {
        self.make_ready(references, kind)?;
        for (reference, value) in references.iter().zip(values) {
            let place = Place::of(*reference);
            let got = self.memory.simulation.value(place).ok_or_else(|| unknown(*reference))?;
            // A parameter that a host set may be anything until the run starts.
            let has_start = Parameters::<Effects>::meta(place).is_some_and(Meta::has_start);
            value.write(convert(if has_start { got } else { finite(*reference, got)? }));
        }
        Ok(())
    }

    /// Refuses a list with a wrong reference before anything is written, and has calculated what it asks for.
    fn make_ready(&mut self, references: &[u32], kind: Type) -> Result<(), Failure> {
        let mut is_calculated = false;
        for reference in references {
            is_calculated |= !typed(*reference, kind)?.has_start();
        }
        if is_calculated {
            self.memory.simulation.admits()?;
            self.memory.simulation.read()?;
        }
        Ok(())
    }

    /// Strings: there are none, so that any reference is a wrong one.
    pub fn no_strings(&self, references: &[u32]) -> Reply {
        references.iter().try_for_each(|reference| typed(*reference, Type::String).map(|_| ()))
    }

    /// Sets parameters and inputs of this type.
    pub fn set<T>(&mut self, references: &[u32], values: &[T], kind: Type, convert: fn(&T) -> f64) -> Reply {
        let mut sets_tolerance = false;
        for (reference, value) in references.iter().zip(values) {
            let meta = typed(*reference, kind)?;
            sets_tolerance |= meta.name == "solver.relative_tolerance";
            self.may_be_set(*reference, meta, convert(value))?;
        }
        for (reference, value) in references.iter().zip(values) {
            let (place, value) = (Place::of(*reference), convert(value));
            let simulation = &mut self.memory.simulation;
            // It is the one or the other, as was checked.
            let _ = simulation.set_parameter(place, value) || simulation.set_input(place, value);
        }
        self.memory.experiment.host_set_tolerance |= sets_tolerance;
        self.warn_of_inputs_off(references.iter().zip(values).map(|(reference, value)| (*reference, convert(value))));
        Ok(())
    }

    /// Whether the variable may be set now, to this value. What a parameter must be is checked when the run starts.
    fn may_be_set(&self, reference: u32, meta: &Meta, value: f64) -> Result<(), Failure> {
        let wrong = |what: &str| Err(Failure::Error(format!("{} {what}", shown(reference))));
        match meta.role {
            Role::Input { .. } if !value.is_finite() => wrong(&format!("= {value:?} must be a finite number")),
            Role::Input { .. } => Ok(()),
            Role::Parameter { .. } if !matches!(self.memory.state, State::Instantiated | State::Initialization) => {
                let (state, names) = (self.memory.state.name(), self.names);
                wrong(&format!(
                    "is a fixed parameter, not to be set in the state \"{state}\": set it before {}, or call {} first",
                    names.end_of_initialization, names.reset
                ))
            }
            Role::Parameter { .. } => Ok(()),
            Role::Output => wrong("is an output: only parameters and inputs can be set"),
            Role::State | Role::Mode => wrong(&format!("is calculated: states are set with {}", self.names.set_states)),
        }
    }
}

/// What is said of a variable, if it is of this type.
#[inline(always)]
pub(super) fn typed(reference: u32, kind: Type) -> Result<&'static Meta, Failure> {
    let meta = Parameters::<Effects>::meta(Place::of(reference)).ok_or_else(|| unknown(reference))?;
    let own = type_of(meta);
    if own == kind {
        return Ok(meta);
    }
    Err(Failure::Error(format!("{} is of type {own:?}, not {kind:?}", shown(reference))))
}

/// The type of a variable.
#[inline(always)]
fn type_of(meta: &Meta) -> Type {
    match meta.kind {
        Kind::Real => Type::Real,
        Kind::Boolean => Type::Boolean,
        Kind::Integer | Kind::Enumeration(_) => Type::Integer,
    }
}

/// A value that can be calculated.
#[inline(always)]
pub(super) fn finite(reference: u32, value: f64) -> Result<f64, Failure> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(Failure::Discard(format!("{} is infinite or undefined here", shown(reference))))
}

/// A variable in a message.
#[cold]
pub(super) fn shown(reference: u32) -> String {
    let name = Parameters::<Effects>::name(Place::of(reference)).unwrap_or_default();
    format!("{name} (value reference {reference})")
}

#[cold]
fn unknown(reference: u32) -> Failure {
    Failure::Error(format!("there is no variable with value reference {reference}: modelDescription.xml lists them"))
}
