//! The states of an instance.

use split_rotor_model::simulation::Integrator;

/// Where an instance is in its life: a bit, since the states in which a call is legal are a set.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// New, or reset.
    Instantiated = 1,
    /// Parameters are set, and the motion has not begun.
    Initialization = 2,
    /// Ready for a step.
    StepComplete = 4,
    /// After a step that could not be done.
    StepFailed = 8,
    /// The run has ended.
    Terminated = 16,
    /// After a caught panic: it can only be freed.
    Lost = 32,
    /// Model exchange: at an event, and after the initialization.
    EventMode = 64,
    /// Model exchange: while the host integrates.
    ContinuousTime = 128,
}

impl State {
    /// Its name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            State::Instantiated => "instantiated",
            State::Initialization => "initialization mode",
            State::StepComplete => "step complete",
            State::StepFailed => "step failed",
            State::Terminated => "terminated",
            State::Lost => "lost after an internal failure",
            State::EventMode => "event mode",
            State::ContinuousTime => "continuous-time mode",
        }
    }
}

/// What an instance is for.
pub const fn kind_name(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::Method => "co-simulation",
        Integrator::Host => "model exchange",
    }
}
