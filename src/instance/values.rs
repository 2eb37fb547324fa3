//! Reading and setting variables.

use super::{Failure, Instance, Reply};
use crate::abi::{Boolean, Integer, Real, Status};
use crate::calls::State;
use crate::guard::{Room, fill};
use crate::scene::Effects;
use split_rotor_model::variable::{Kind, Meta, Place, Role};
use split_rotor_model::variables::Parameters;
use std::mem::MaybeUninit;

/// The FMI type through which a variable is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Type {
    /// fmi2Real
    Real,
    /// fmi2Integer, of enumerations too
    Integer,
    /// fmi2Boolean
    Boolean,
    /// fmi2String
    String,
}

/// A list of so many values is short.
const SHORT: usize = 32;

impl Instance {
    /// fmi2GetReal
    pub fn get_real(&mut self, references: &[u32], values: Room<Real>) -> Reply {
        if !self.get_at_hand(references, values) {
            self.make_ready(references, Type::Real)?;
            if !self.get_at_hand(references, values) {
                return self.get(references, values, Type::Real, |value| value);
            }
        }
        Ok(Status::Ok)
    }

    /// What hosts do most, made quick: a short list of what is calculated already. If it is not that, nothing is written.
    #[inline(always)]
    fn get_at_hand(&self, references: &[u32], values: Room<Real>) -> bool {
        let mut got = [0.0; SHORT];
        if references.len() > SHORT || !self.memory.simulation.reals_at_hand(references, &mut got[..values.len()]) {
            return false;
        }
        fill(values, &got[..values.len()]);
        true
    }

    /// fmi2GetInteger
    pub fn get_integer(&mut self, references: &[u32], values: Room<Integer>) -> Reply {
        self.get(references, values, Type::Integer, |value| value as Integer)
    }

    /// fmi2GetBoolean
    pub fn get_boolean(&mut self, references: &[u32], values: Room<Boolean>) -> Reply {
        self.get(references, values, Type::Boolean, |value| Boolean::from(value != 0.0))
    }

    /// fmi2GetString: there is no variable of this type.
    pub fn get_other(&mut self, references: &[u32], kind: Type) -> Reply {
        self.get(references, &mut vec![MaybeUninit::new(()); references.len()], kind, |_| ())
    }

    /// fmi2SetReal
    pub fn set_real(&mut self, references: &[u32], values: &[Real]) -> Reply {
        self.set(references, values, Type::Real, |value| *value)
    }

    /// fmi2SetInteger
    pub fn set_integer(&mut self, references: &[u32], values: &[Integer]) -> Reply {
        self.set(references, values, Type::Integer, |value| f64::from(*value))
    }

    /// fmi2SetBoolean
    pub fn set_boolean(&mut self, references: &[u32], values: &[Boolean]) -> Reply {
        self.set(references, values, Type::Boolean, |value| f64::from(*value != 0))
    }

    /// fmi2SetString: there is no variable of this type.
    pub fn set_other(&mut self, references: &[u32], kind: Type) -> Reply {
        self.set(references, &vec![(); references.len()], kind, |()| 0.0)
    }

    fn get<T>(&mut self, references: &[u32], values: Room<T>, kind: Type, convert: fn(f64) -> T) -> Reply {
        self.make_ready(references, kind)?;
        for (reference, value) in references.iter().zip(values) {
            let place = Place::of(*reference);
            let got = self.memory.simulation.value(place).ok_or_else(|| unknown(*reference))?;
            // A parameter that a host set may be anything until the run starts.
            let has_start = Parameters::<Effects>::meta(place).is_some_and(Meta::has_start);
            value.write(convert(if has_start { got } else { finite(*reference, got)? }));
        }
        Ok(Status::Ok)
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

    fn set<T>(&mut self, references: &[u32], values: &[T], kind: Type, convert: fn(&T) -> f64) -> Reply {
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
        Ok(Status::Ok)
    }

    /// Whether the variable may be set now, to this value. What a parameter must be is checked when the run starts.
    fn may_be_set(&self, reference: u32, meta: &Meta, value: f64) -> Result<(), Failure> {
        let wrong = |what: &str| Err(Failure::error(format!("{} {what}", shown(reference))));
        match meta.role {
            Role::Input { .. } if !value.is_finite() => wrong(&format!("= {value:?} must be a finite number")),
            Role::Input { .. } => Ok(()),
            Role::Parameter { .. } if !matches!(self.memory.state, State::Instantiated | State::Initialization) => {
                let state = self.memory.state.name();
                wrong(&format!(
                    "is a fixed parameter, not to be set in the state \"{state}\": set it before \
                     fmi2ExitInitializationMode, or call fmi2Reset first"
                ))
            }
            Role::Parameter { .. } => Ok(()),
            Role::Output => wrong("is an output: only parameters and inputs can be set"),
            Role::State | Role::Mode => wrong("is calculated: states are set with fmi2SetContinuousStates"),
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
    Err(Failure::error(format!("{} is of type {own:?}, not {kind:?}", shown(reference))))
}

/// The FMI type of a variable.
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
    Err(Failure::discard(format!("{} is infinite or undefined here", shown(reference))))
}

/// A variable in a message.
#[cold]
pub(super) fn shown(reference: u32) -> String {
    let name = Parameters::<Effects>::name(Place::of(reference)).unwrap_or_default();
    format!("{name} (value reference {reference})")
}

#[cold]
fn unknown(reference: u32) -> Failure {
    Failure::error(format!("there is no variable with value reference {reference}: modelDescription.xml lists them"))
}
