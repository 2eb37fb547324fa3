//! The calls of model exchange.

use super::Actor;
use super::check::{DISCARD, ERROR, OK, OK_OR_DISCARD, Told};
use super::source::Source;
use crate::harness::{Instance, Stage};
use split_rotor::abi::*;
use split_rotor::exports::*;
use split_rotor::scene::Simulation;

const STATES: usize = Simulation::STATES;
const INDICATORS: usize = Simulation::INDICATORS;

type Get = unsafe extern "C" fn(Component, *mut Real, Size) -> Status;

impl Actor {
    pub fn exchange_call(&mut self, source: &mut Source) {
        match source.below(16) {
            0 => self.enter_event_mode(),
            1 => self.new_discrete_states(source),
            2 => self.enter_continuous_time_mode(),
            3..=4 => self.completed_integrator_step(source),
            5..=6 => {
                let time = source.number();
                self.set_time(time);
            }
            7..=8 => self.set_some_states(source),
            9..=10 => {
                let may = self.calculation();
                self.vector(source, "fmi2GetDerivatives", fmi2GetDerivatives, may);
            }
            11..=12 => {
                let may = if self.mind.memory.life.stage.has_started() { OK } else { self.calculation() };
                self.vector(source, "fmi2GetContinuousStates", fmi2GetContinuousStates, may);
            }
            13..=14 => {
                let touched = self.mind.memory.touched && !self.mind.memory.life.stage.has_started();
                let may = if touched { &[Status::Ok, Status::Error] } else { OK };
                self.vector(source, "fmi2GetNominalsOfContinuousStates", fmi2GetNominalsOfContinuousStates, may);
            }
            _ => {
                let n = source.of(&[0, 1, INDICATORS, STATES]);
                let may = if n == INDICATORS { self.calculation() } else { ERROR };
                let told = Told { function: "fmi2GetEventIndicators", may };
                let mut values = [0.5; STATES];
                // SAFETY: a live instance, and room for at least as many as told.
                self.call(&told, |i| unsafe { fmi2GetEventIndicators(i.component(), values.as_mut_ptr(), n) });
            }
        }
    }

    /// From event mode to continuous-time mode.
    pub fn settle(&mut self) {
        let told = Told { function: "fmi2NewDiscreteStates", may: OK_OR_DISCARD };
        self.call(&told, |instance| instance.new_discrete_states().map_or_else(|status| status, |_| Status::Ok));
        self.enter_continuous_time_mode();
    }

    /// A step of Euler's in continuous-time mode.
    pub fn integrate(&mut self, source: &mut Source) {
        let h = source.of(&[1e-4, 1e-3, 1e-3, 5e-3, 0.02, 0.1]);
        let Ok(mut states) = self.instance.states() else { return };
        let Ok(rates) = self.instance.rates() else {
            self.instance.journal.take();
            // The host went too far, and has no way back but this.
            return self.reset();
        };
        states.iter_mut().zip(rates).for_each(|(state, rate)| *state += h * rate);
        let to = self.mind.memory.now + h;
        self.set_time(to);
        self.set_states(&states);
        let mut wants_event = false;
        let told = Told { function: "fmi2CompletedIntegratorStep", may: OK_OR_DISCARD };
        self.call(&told, |instance| match instance.completed_integrator_step() {
            Ok(event) => {
                wants_event = event;
                Status::Ok
            }
            Err(status) => status,
        });
        if wants_event {
            self.enter_event_mode();
        }
        self.look();
    }

    fn enter_event_mode(&mut self) {
        let told = Told { function: "fmi2EnterEventMode", may: OK };
        if self.call(&told, Instance::enter_event_mode) == Status::Ok {
            self.mind.memory.life.stage = Stage::EventMode;
        }
    }

    fn enter_continuous_time_mode(&mut self) {
        let told = Told { function: "fmi2EnterContinuousTimeMode", may: OK };
        if self.call(&told, Instance::enter_continuous_time_mode) == Status::Ok {
            self.mind.memory.life.stage = Stage::ContinuousTime;
        }
    }

    fn new_discrete_states(&mut self, source: &mut Source) {
        let is_null = source.chance(32);
        let told = Told { function: "fmi2NewDiscreteStates", may: if is_null { ERROR } else { OK_OR_DISCARD } };
        self.call(&told, |instance| {
            if is_null {
                // SAFETY: a live instance.
                return unsafe { fmi2NewDiscreteStates(instance.component(), std::ptr::null_mut()) };
            }
            instance.new_discrete_states().map_or_else(|status| status, |_| Status::Ok)
        });
    }

    fn completed_integrator_step(&mut self, source: &mut Source) {
        let is_null = source.chance(32);
        let told = Told { function: "fmi2CompletedIntegratorStep", may: if is_null { ERROR } else { OK_OR_DISCARD } };
        self.call(&told, |instance| {
            if is_null {
                let mut event = 77;
                // SAFETY: a live instance, and a place to write to.
                return unsafe {
                    fmi2CompletedIntegratorStep(instance.component(), TRUE, &raw mut event, std::ptr::null_mut())
                };
            }
            instance.completed_integrator_step().map_or_else(|status| status, |_| Status::Ok)
        });
    }

    fn set_time(&mut self, time: Real) {
        let told = Told { function: "fmi2SetTime", may: if time.is_finite() { OK } else { ERROR } };
        if self.call(&told, |instance| instance.set_time(time)) == Status::Ok {
            self.mind.memory.now = time;
        }
    }

    /// Changes a few numbers of the state.
    fn set_some_states(&mut self, source: &mut Source) {
        let mut states = match self.instance.states() {
            Ok(states) => states,
            Err(_) => {
                self.instance.journal.take();
                vec![0.0; STATES]
            }
        };
        for _ in 0..source.below(3) {
            let n = source.below(STATES);
            states[n] = source.number();
        }
        if source.chance(32) {
            states.truncate(source.below(STATES));
        }
        self.set_states(&states);
    }

    fn set_states(&mut self, states: &[Real]) {
        let may = match states.len() {
            STATES if states.iter().all(|state| state.is_finite()) => OK,
            STATES => DISCARD,
            _ => ERROR,
        };
        let before = self.instance.serialized();
        let told = Told { function: "fmi2SetContinuousStates", may };
        match self.call(&told, |instance| instance.set_states(states)) {
            Status::Ok => {
                let got = self.instance.states().expect("what was set can be read");
                assert!(got.iter().zip(states).all(|(a, b)| a.to_bits() == b.to_bits()), "{got:?}, not {states:?}");
            }
            _ => assert!(before == self.instance.serialized(), "a refusal changed something"),
        }
    }

    /// Asks for one of the vectors, now and then into nowhere or with a wrong length.
    fn vector(&mut self, source: &mut Source, function: &'static str, get: Get, may: &'static [Status]) {
        let n = if source.chance(32) { source.below(STATES) } else { STATES };
        let is_null = source.chance(16);
        let mut values = [0.5; STATES];
        let at = if is_null { std::ptr::null_mut() } else { values.as_mut_ptr() };
        let told = Told { function, may: if n == STATES && !is_null { may } else { ERROR } };
        // SAFETY: a live instance; null, or room for at least as many as told.
        match self.call(&told, |instance| unsafe { get(instance.component(), at, n) }) {
            Status::Ok => assert!(values.iter().all(|value| value.is_finite()), "{function}: {values:?}"),
            _ => assert_eq!(values, [0.5; STATES], "{function}: nothing is written"),
        }
    }
}
