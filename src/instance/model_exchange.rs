//! What a host asks that integrates itself.

use super::{Failure, Instance, Reply};
use crate::abi::{Real, Status};
use crate::calls::State;
use crate::guard::{Room, fill};
use crate::scene::Simulation;
use split_rotor_model::log::Category;

/// What fmi2NewDiscreteStates found.
pub struct Events {
    /// Whether the continuous states are others now.
    pub states_changed: bool,
}

impl Instance {
    /// fmi2EnterEventMode
    pub fn enter_event_mode(&mut self) -> Reply {
        if let Some(mut exchange) = self.memory.simulation.exchange() {
            exchange.enter_event();
        }
        self.memory.state = State::EventMode;
        Ok(Status::Ok)
    }

    /// fmi2NewDiscreteStates
    pub fn new_discrete_states(&mut self) -> Result<Events, Failure> {
        self.memory.simulation.admits()?;
        let settled = self.memory.simulation.exchange().map(|mut exchange| exchange.settle()).unwrap_or_default();
        if settled.chart {
            self.tell(Category::Events, || {
                "the axis has turned far: gamma and phi are now measured in the other chart, and the states changed"
                    .into()
            });
        }
        if settled.work {
            self.tell(Category::Events, || "the imposed speed jumped: its work is booked as supplied".into());
        }
        Ok(Events { states_changed: settled.any() })
    }

    /// fmi2EnterContinuousTimeMode
    pub fn enter_continuous_time_mode(&mut self) -> Reply {
        self.warn_of_zeros();
        if let Some(mut exchange) = self.memory.simulation.exchange() {
            exchange.leave_event();
        }
        self.memory.state = State::ContinuousTime;
        Ok(Status::Ok)
    }

    /// fmi2CompletedIntegratorStep; whether event mode should be entered.
    pub fn completed_integrator_step(&mut self) -> Result<bool, Failure> {
        self.memory.simulation.admits()?;
        let wants_event = self.memory.simulation.exchange().is_some_and(|mut exchange| exchange.complete_step());
        self.warn();
        Ok(wants_event)
    }

    /// fmi2SetTime
    pub fn set_time(&mut self, t: Real) -> Reply {
        if !t.is_finite() {
            return Err(Failure::error(format!("time = {t:?} must be a finite number of seconds")));
        }
        if let Some(mut exchange) = self.memory.simulation.exchange() {
            exchange.set_time(t);
        }
        Ok(Status::Ok)
    }

    /// fmi2SetContinuousStates
    pub fn set_continuous_states(&mut self, states: &[Real]) -> Reply {
        check_number(states.len())?;
        if let Some(n) = states.iter().position(|state| !state.is_finite()) {
            let message = format!("state {} of {} = {:?} must be a finite number", n + 1, states.len(), states[n]);
            return Err(Failure::discard(message));
        }
        if let Some(mut exchange) = self.memory.simulation.exchange() {
            exchange.set_state(states);
        }
        Ok(Status::Ok)
    }

    /// fmi2GetContinuousStates
    pub fn continuous_states(&mut self, states: Room<Real>) -> Reply {
        check_number(states.len())?;
        let state = self.memory.simulation.state()?;
        fill(states, &state[..Simulation::STATES]);
        Ok(Status::Ok)
    }

    /// fmi2GetDerivatives
    pub fn derivatives(&mut self, derivatives: Room<Real>) -> Reply {
        check_number(derivatives.len())?;
        self.memory.simulation.admits()?;
        let rates = self.memory.simulation.rates()?;
        if rates.iter().any(|rate| !rate.is_finite()) {
            return Err(Failure::discard("a force or a rate is infinite or not a number"));
        }
        fill(derivatives, &rates[..Simulation::STATES]);
        Ok(Status::Ok)
    }

    /// fmi2GetNominalsOfContinuousStates
    pub fn nominals(&mut self, nominals: Room<Real>) -> Reply {
        check_number(nominals.len())?;
        // Before the start their parameters may be impossible.
        self.memory.simulation.parameters().check()?;
        fill(nominals, &self.memory.simulation.nominals()[..Simulation::STATES]);
        Ok(Status::Ok)
    }

    /// fmi2GetEventIndicators: there is none.
    pub fn event_indicators(&self, n: usize) -> Reply {
        if n == 0 {
            return Ok(Status::Ok);
        }
        Err(Failure::error(format!("ni = {n} must be 0: there are no event indicators")))
    }
}

fn check_number(n: usize) -> Result<(), Failure> {
    if n == Simulation::STATES {
        return Ok(());
    }
    Err(Failure::error(format!("nx = {n} must be {}, the number of continuous states", Simulation::STATES)))
}
