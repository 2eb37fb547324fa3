//! Steps, and what is known of the last one.

use super::values::{Type, finite, shown, typed};
use super::{Failure, Instance, Reply};
use crate::abi::{Boolean, Choice, Integer, Real, Status, status_kind};
use crate::calls::State;
use crate::guard::Room;
use split_rotor_model::scalar::ulp;
use split_rotor_model::signal::HIGHEST_DERIVATIVE;
use split_rotor_model::variable::{Place, Role};

/// Two times are equal within this part of a step, and this many units in the last place.
const TIME_TOLERANCE: f64 = 1e-9;
const TIME_ULPS: f64 = 4.0;

impl Instance {
    /// fmi2DoStep
    pub fn do_step(&mut self, from: Real, step: Real) -> Reply {
        let to = self.end_of_step(from, step)?;
        self.warn_of_zeros();
        let changes = self.memory.simulation.changes_of_method();
        let outcome = self.memory.simulation.advance(to);
        if self.memory.simulation.changes_of_method() != changes {
            self.tell_auto();
        }
        self.warn();
        match outcome {
            Ok(()) => {
                self.memory.state = State::StepComplete;
                self.memory.step_status = Status::Ok;
                Ok(Status::Ok)
            }
            Err(fault) => {
                self.memory.state = State::StepFailed;
                self.memory.step_status = Status::Discard;
                Err(Failure::discard(fault.to_string()))
            }
        }
    }

    /// Where a step ends, if it is a right one.
    fn end_of_step(&self, from: Real, step: Real) -> Result<Real, Failure> {
        let now = self.now();
        let to = from + step;
        if !(step > 0.0 && step.is_finite()) {
            return Err(Failure::error(format!("communicationStepSize = {step:?} must be a finite number > 0")));
        }
        if !same_time(from, now, step) {
            return Err(Failure::error(format!(
                "currentCommunicationPoint = {from:?} must be {now:?}, where the last step ended"
            )));
        }
        if to <= now {
            return Err(Failure::error(format!(
                "communicationStepSize = {step:?} is too small to advance the time {now:?}: about {:?} is needed",
                2.0 * ulp(now)
            )));
        }
        if let Some(stop) = self.memory.experiment.stop.filter(|stop| to > *stop && !same_time(to, *stop, step)) {
            return Err(Failure::error(format!("the step to {to:?} goes past the stop time {stop:?}")));
        }
        Ok(to)
    }

    /// The communication point \[s].
    fn now(&self) -> Real {
        self.memory.simulation.time().unwrap_or(self.memory.experiment.start)
    }

    /// fmi2SetRealInputDerivatives
    pub fn set_input_derivatives(&mut self, references: &[u32], orders: &[Integer], values: &[Real]) -> Reply {
        for ((reference, order), value) in references.iter().zip(orders).zip(values) {
            let name = || shown(*reference);
            if !matches!(typed(*reference, Type::Real)?.role, Role::Input { .. }) {
                return Err(Failure::error(format!("{} is not an input", name())));
            }
            if !(1..=HIGHEST_DERIVATIVE as Integer).contains(order) {
                return Err(Failure::error(format!("order = {order} of {} must be 1 or 2", name())));
            }
            if !value.is_finite() {
                let name = name();
                return Err(Failure::error(format!("derivative {value:?} of {name} must be a finite number")));
            }
        }
        for ((reference, order), value) in references.iter().zip(orders).zip(values) {
            self.memory.simulation.set_input_derivative(Place::of(*reference), order.unsigned_abs(), *value);
        }
        Ok(Status::Ok)
    }

    /// fmi2GetRealOutputDerivatives
    pub fn output_derivatives(&mut self, references: &[u32], orders: &[Integer], values: Room<Real>) -> Reply {
        for (reference, order) in references.iter().zip(orders) {
            if !matches!(typed(*reference, Type::Real)?.role, Role::Output) {
                return Err(Failure::error(format!("{} is not an output", shown(*reference))));
            }
            if *order != 1 {
                let name = shown(*reference);
                return Err(Failure::error(format!("order = {order} of {name} must be 1, maxOutputDerivativeOrder")));
            }
        }
        let derivatives = self.memory.simulation.time_derivatives()?;
        for (reference, value) in references.iter().zip(values) {
            value.write(finite(*reference, derivatives.of(Place::of(*reference)).unwrap_or(Real::NAN))?);
        }
        Ok(Status::Ok)
    }

    /// fmi2GetStatus
    pub fn status(&self, kind: Choice) -> Result<Status, Failure> {
        match kind {
            status_kind::DO_STEP => Ok(self.memory.step_status),
            _ => Err(wrong_kind(kind, "fmi2DoStepStatus")),
        }
    }

    /// fmi2GetRealStatus
    pub fn real_status(&self, kind: Choice) -> Result<Real, Failure> {
        match kind {
            status_kind::LAST_SUCCESSFUL_TIME => Ok(self.now()),
            _ => Err(wrong_kind(kind, "fmi2LastSuccessfulTime")),
        }
    }

    /// fmi2GetBooleanStatus: after a step that could not be done, no shorter one can.
    pub fn boolean_status(&self, kind: Choice) -> Result<Boolean, Failure> {
        match kind {
            status_kind::TERMINATED => Ok(Boolean::from(self.memory.step_status == Status::Discard)),
            _ => Err(wrong_kind(kind, "fmi2Terminated")),
        }
    }
}

fn wrong_kind(kind: Choice, right: &str) -> Failure {
    Failure::error(format!("status kind {kind} has no answer of this type: ask for {right}"))
}

#[inline(always)]
fn same_time(a: f64, b: f64, step: f64) -> bool {
    (a - b).abs() <= TIME_TOLERANCE * step + TIME_ULPS * ulp(b)
}
