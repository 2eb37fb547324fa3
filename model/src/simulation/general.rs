//! A run of any scene, compiled once: what is generic is compiled again in each program that calls it, minutes of it for the list of all effects.

use super::{Any, Divergence, Growth, Integrator, Largest, Rattle, Unheld, Unjudged};
use crate::effects::All;
use crate::error::Invalid;
use crate::integrate::Fault;
use crate::variable::Place;
use crate::variables::{Parameters, Reading};
use std::ops::{Deref, DerefMut};

/// [`Any`], of which what follows here is compiled here; all else where it is called.
#[derive(Clone)]
pub struct General(Any);

impl General {
    /// A rotor with these parameters, for who integrates it.
    #[inline(never)]
    pub fn with(integrator: Integrator, parameters: Parameters<All>) -> Self {
        Self(Any::with(integrator, parameters))
    }
}

impl General {
    /// [`super::Simulation::advance`], with the code of [`General::advance_looking`].
    pub fn advance(&mut self, t: f64) -> Result<(), Fault> {
        self.advance_looking(t, &mut None)
    }
}

impl Deref for General {
    type Target = Any;

    fn deref(&self) -> &Any {
        &self.0
    }
}

impl DerefMut for General {
    fn deref_mut(&mut self) -> &mut Any {
        &mut self.0
    }
}

impl From<Parameters<All>> for General {
    #[inline(never)]
    fn from(parameters: Parameters<All>) -> Self {
        Self(parameters.into())
    }
}

/// Declares methods that pass their arguments on to those of [`Any`] of the same names.
macro_rules! passed_on {
    ($($name:ident(&$($mutable:ident)?, $($argument:ident: $type:ty),*) -> $answer:ty;)*) => {
        impl General {
            $(
                #[doc = concat!("[`super::Simulation::", stringify!($name), "`].")]
                #[inline(never)]
                #[allow(clippy::missing_errors_doc, reason = "they are those of what it passes on to")]
                pub fn $name(&$($mutable)? self $(, $argument: $type)*) -> $answer {
                    self.0.$name($($argument),*)
                }
            )*
        }
    };
}

passed_on! {
    parameters(&,) -> &Parameters<All>;
    set_parameter(&mut, place: Place, value: f64) -> bool;
    set_input(&mut, place: Place, value: f64) -> bool;
    set_input_derivative(&mut, place: Place, order: u32, value: f64) -> bool;
    start(&mut, t: f64, relative_tolerance: Option<f64>) -> Result<(), Invalid>;
    start_until(&mut, t: f64, relative_tolerance: Option<f64>, stop: Option<f64>) -> Result<(), Invalid>;
    advance_looking(&mut, t: f64, largest: &mut Option<Largest>) -> Result<(), Fault>;
    look(&, largest: &mut Largest) -> ();
    divergence(&,) -> Option<Divergence>;
    rattle(&,) -> Option<Rattle>;
    time(&,) -> Option<f64>;
    get(&mut, place: Place) -> Result<Option<f64>, Invalid>;
    value(&, place: Place) -> Option<f64>;
    reals_at_hand(&, references: &[u32], values: &mut [f64]) -> bool;
    read(&mut,) -> Result<&Reading, Invalid>;
    auto(&,) -> Option<String>;
    growth(&,) -> Option<Growth>;
    unheld(&,) -> Option<Unheld>;
    speeds_met(&,) -> Option<[f64; 2]>;
    unjudged(&,) -> Option<Unjudged>;
    warns_of_tilt(&,) -> Option<&'static str>;
}
