//! Steps, and what is known of the last one.

use super::values::{Type, finite, shown, typed};
use super::{Failure, Instance, Reply, Room, State};
use split_rotor_model::scalar::ulp;
use split_rotor_model::signal::HIGHEST_DERIVATIVE;
use split_rotor_model::variable::{Place, Role};

/// Two times are equal within this part of a step, and this many units in the last place.
const TIME_TOLERANCE: f64 = 1e-9;
const TIME_ULPS: f64 = 4.0;

impl Instance {
    /// Moves the communication point from `from` by `step` \[s].
    pub fn do_step(&mut self, from: f64, step: f64) -> Reply {
        let to = self.end_of_step(from, step)?;
        // There is news of the run only where the method has gone on.
        let outcome = if self.memory.simulation.advance_within_step(to) { Ok(()) } else { self.run_to(to) };
        self.memory.step_failed = outcome.is_err();
        self.memory.state = if outcome.is_ok() { State::StepComplete } else { State::StepFailed };
        outcome
    }

    /// Moves the communication point to time `to` \[s], and tells what is new.
    #[inline(never)]
    fn run_to(&mut self, to: f64) -> Reply {
        self.warn_of_zeros();
        let changes = self.memory.simulation.changes_of_method();
        let outcome = self.memory.simulation.advance(to);
        let changed = self.memory.simulation.changes_of_method().abs_diff(changes);
        if changed > 0 {
            self.tell_auto(changed);
        }
        self.warn();
        outcome.map_err(|fault| Failure::Discard(fault.to_string()))
    }

    /// Where a step ends, if it is a right one.
    fn end_of_step(&self, from: f64, step: f64) -> Result<f64, Failure> {
        let now = self.now();
        let to = from + step;
        if !(step > 0.0 && step < f64::INFINITY) {
            return Err(Failure::Error(format!("communicationStepSize = {step:?} must be a finite number > 0")));
        }
        if !same_time(from, now, step) {
            // Some hosts do not heed a status.
            let stands = match self.memory.step_failed {
                true => ": the step before was discarded, and the motion has not gone on (output solver.time)",
                false => "",
            };
            return Err(Failure::Error(format!(
                "currentCommunicationPoint = {from:?} must be {now:?}, where the last step ended{stands}"
            )));
        }
        if to <= now {
            return Err(Failure::Error(format!(
                "communicationStepSize = {step:?} is too small to advance the time {now:?}: about {:?} is needed",
                2.0 * ulp(now)
            )));
        }
        if let Some(stop) = self.memory.experiment.stop.filter(|stop| to > *stop && !same_time(to, *stop, step)) {
            return Err(Failure::Error(format!("the step to {to:?} goes past the stop time {stop:?}")));
        }
        Ok(to)
    }

    /// The communication point \[s].
    pub fn now(&self) -> f64 {
        self.memory.simulation.time().unwrap_or(self.memory.experiment.start)
    }

    /// Sends derivatives of inputs, of order 1 to 3, at the communication point.
    pub fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Reply {
        for ((reference, order), value) in references.iter().zip(orders).zip(values) {
            let name = || shown(*reference);
            if !matches!(typed(*reference, Type::Real)?.role, Role::Input { .. }) {
                return Err(Failure::Error(format!("{} is not an input", name())));
            }
            if !(1..=HIGHEST_DERIVATIVE as i32).contains(order) {
                return Err(Failure::Error(format!(
                    "order = {order} of {} must be from 1 to {HIGHEST_DERIVATIVE}",
                    name()
                )));
            }
            if !value.is_finite() {
                let name = name();
                return Err(Failure::Error(format!("derivative {value:?} of {name} must be a finite number")));
            }
        }
        self.warn_of_inputs_off(references.iter().zip(values).map(|(reference, value)| (*reference, *value)));
        for ((reference, order), value) in references.iter().zip(orders).zip(values) {
            self.memory.simulation.set_input_derivative(Place::of(*reference), order.unsigned_abs(), *value);
        }
        Ok(())
    }

    /// Reads derivatives of outputs with respect to time, of order 1, at the communication point.
    pub fn output_derivatives(&mut self, references: &[u32], orders: &[i32], values: Room<f64>) -> Reply {
        for (reference, order) in references.iter().zip(orders) {
            if !matches!(typed(*reference, Type::Real)?.role, Role::Output) {
                return Err(Failure::Error(format!("{} is not an output", shown(*reference))));
            }
            if *order != 1 {
                let name = shown(*reference);
                return Err(Failure::Error(format!("order = {order} of {name} must be 1, maxOutputDerivativeOrder")));
            }
        }
        let derivatives = self.memory.simulation.time_derivatives()?;
        for (reference, value) in references.iter().zip(values) {
            value.write(finite(*reference, derivatives.of(Place::of(*reference)).unwrap_or(f64::NAN))?);
        }
        Ok(())
    }

    /// Whether the last step could not be done; then no shorter one can.
    pub fn step_failed(&self) -> bool {
        self.memory.step_failed
    }
}

#[inline(always)]
fn same_time(a: f64, b: f64, step: f64) -> bool {
    // Mostly the step tells, and an ulp takes as long as the rest of a short step.
    let (apart, near) = ((a - b).abs(), TIME_TOLERANCE * step);
    apart <= near || apart <= near + TIME_ULPS * ulp(b)
}
