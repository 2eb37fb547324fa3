//! What a host asks that integrates itself.

use super::{Failure, Instance, Reply, Room, State, fill};
use crate::scene::Simulation;
use split_rotor_model::log::Category;

impl Instance {
    /// Enters event mode.
    pub fn enter_event_mode(&mut self) -> Reply {
        if let Some(mut exchange) = self.memory.simulation.exchange() {
            exchange.enter_event();
        }
        self.memory.state = State::EventMode;
        Ok(())
    }

    /// Changes the chart of the states, where it should be; whether the continuous states are others now.
    pub fn new_discrete_states(&mut self) -> Result<bool, Failure> {
        self.memory.simulation.admits()?;
        let settled = self.memory.simulation.exchange().map(|mut exchange| exchange.settle()).unwrap_or_default();
        if settled.chart {
            self.tell(Category::Events, || {
                "the axis has turned far: gamma and phi are now measured in the other chart, and the states changed"
                    .into()
            });
        }
        if settled.law {
            self.tell(Category::Events, || "a law of an effect goes on as another one".into());
        }
        if settled.work {
            self.tell(Category::Events, || "the imposed speed jumped: its work is booked as supplied".into());
        }
        Ok(settled.any())
    }

    /// Enters continuous-time mode.
    pub fn enter_continuous_time_mode(&mut self) -> Reply {
        self.warn_of_zeros();
        if let Some(mut exchange) = self.memory.simulation.exchange() {
            exchange.leave_event();
        }
        self.memory.state = State::ContinuousTime;
        Ok(())
    }

    /// The host completed a step; whether event mode should be entered.
    pub fn completed_integrator_step(&mut self) -> Result<bool, Failure> {
        self.memory.simulation.admits()?;
        let wants_event = self.memory.simulation.exchange().is_some_and(|mut exchange| exchange.complete_step());
        self.warn();
        Ok(wants_event)
    }

    /// Sets the time \[s].
    pub fn set_time(&mut self, t: f64) -> Reply {
        if !t.is_finite() {
            return Err(Failure::Error(format!("time = {t:?} must be a finite number of seconds")));
        }
        if let Some(mut exchange) = self.memory.simulation.exchange() {
            exchange.set_time(t);
        }
        Ok(())
    }

    /// Sets the continuous states.
    pub fn set_continuous_states(&mut self, states: &[f64]) -> Reply {
        check_number(states.len())?;
        if let Some(n) = states.iter().position(|state| !state.is_finite()) {
            let message = format!("state {} of {} = {:?} must be a finite number", n + 1, states.len(), states[n]);
            return Err(Failure::Discard(message));
        }
        if let Some(mut exchange) = self.memory.simulation.exchange() {
            exchange.set_state(states);
        }
        Ok(())
    }

    /// Reads the continuous states.
    pub fn continuous_states(&mut self, states: Room<f64>) -> Reply {
        check_number(states.len())?;
        let state = self.memory.simulation.state()?;
        fill(states, &state[..Simulation::STATES]);
        Ok(())
    }

    /// Reads the rates of the continuous states.
    pub fn derivatives(&mut self, derivatives: Room<f64>) -> Reply {
        check_number(derivatives.len())?;
        self.memory.simulation.admits_trial()?;
        let rates = self.memory.simulation.rates()?;
        if rates.iter().any(|rate| !rate.is_finite()) {
            // A law that has no limit nearby gives its own reason.
            self.memory.simulation.admits()?;
            return Err(Failure::Discard("a force or a rate is infinite or not a number".into()));
        }
        fill(derivatives, &rates[..Simulation::STATES]);
        Ok(())
    }

    /// Reads what each continuous state counts with.
    pub fn nominals(&mut self, nominals: Room<f64>) -> Reply {
        check_number(nominals.len())?;
        // Before the start their parameters may be impossible.
        self.memory.simulation.parameters().check()?;
        fill(nominals, &self.memory.simulation.nominals()[..Simulation::STATES]);
        Ok(())
    }

    /// Reads the event indicators.
    pub fn event_indicators(&mut self, indicators: Room<f64>) -> Reply {
        let n = indicators.len();
        if n != Simulation::INDICATORS {
            let message = format!("ni = {n} must be {}, the number of event indicators", Simulation::INDICATORS);
            return Err(Failure::Error(message));
        }
        self.memory.simulation.admits_trial()?;
        fill(indicators, &self.memory.simulation.indicators()?[..Simulation::INDICATORS]);
        Ok(())
    }
}

fn check_number(n: usize) -> Result<(), Failure> {
    if n == Simulation::STATES {
        return Ok(());
    }
    Err(Failure::Error(format!("nx = {n} must be {}, the number of continuous states", Simulation::STATES)))
}
