//! Reading and setting variables.

use super::{Failure, Instance, Reply};
use crate::abi::{Integer, Real, Status};
use crate::calls::State;
use crate::scene::Effects;
use model::variable::{Kind, Meta, Place, Role};
use model::variables::Parameters;

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

impl Instance {
    /// fmi2GetReal
    pub fn get_real(&mut self, references: &[u32], values: &mut [Real]) -> Reply {
        self.get(references, values, Type::Real, |value| value)
    }

    /// fmi2GetInteger
    pub fn get_integer(&mut self, references: &[u32], values: &mut [Integer]) -> Reply {
        self.get(references, values, Type::Integer, |value| value as Integer)
    }

    /// fmi2GetBoolean and fmi2GetString: there is no variable of these types.
    pub fn get_other(&mut self, references: &[u32], kind: Type) -> Reply {
        self.get(references, &mut vec![(); references.len()], kind, |_| ())
    }

    /// fmi2SetReal
    pub fn set_real(&mut self, references: &[u32], values: &[Real]) -> Reply {
        self.set(references, values, Type::Real, |value| *value)
    }

    /// fmi2SetInteger
    pub fn set_integer(&mut self, references: &[u32], values: &[Integer]) -> Reply {
        self.set(references, values, Type::Integer, |value| f64::from(*value))
    }

    /// fmi2SetBoolean and fmi2SetString: there is no variable of these types.
    pub fn set_other(&mut self, references: &[u32], kind: Type) -> Reply {
        self.set(references, &vec![(); references.len()], kind, |()| 0.0)
    }

    fn get<T>(&mut self, references: &[u32], values: &mut [T], kind: Type, convert: fn(f64) -> T) -> Reply {
        let mut is_calculated = false;
        for reference in references {
            is_calculated |= !typed(*reference, kind)?.has_start();
        }
        // What cannot be calculated is refused before anything is written.
        if is_calculated {
            self.memory.simulation.admits()?;
            self.memory.simulation.read()?;
        }
        for (reference, value) in references.iter().zip(values) {
            let got = self.memory.simulation.get(Place::of(*reference))?.ok_or_else(|| unknown(*reference))?;
            if is_calculated {
                finite(*reference, got)?;
            }
            *value = convert(got);
        }
        Ok(Status::Ok)
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
    let own = match meta.kind {
        Kind::Real => Type::Real,
        Kind::Integer | Kind::Enumeration(_) => Type::Integer,
    };
    if own == kind {
        return Ok(meta);
    }
    Err(Failure::error(format!("{} is of type {own:?}, not {kind:?}", shown(reference))))
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
