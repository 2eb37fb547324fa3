//! The calls of model exchange, and a host that integrates with them.

use super::Instance;
use split_rotor::abi::*;
use split_rotor::exports::*;
use split_rotor::scene::Simulation;

impl Instance {
    /// fmi2NewDiscreteStates; whether the continuous states changed.
    pub fn new_discrete_states(&mut self) -> Result<bool, Status> {
        const UNTOUCHED: Boolean = 77;
        let mut info = EventInfo {
            new_discrete_states_needed: UNTOUCHED,
            terminate_simulation: UNTOUCHED,
            nominals_of_continuous_states_changed: UNTOUCHED,
            values_of_continuous_states_changed: UNTOUCHED,
            next_event_time_defined: UNTOUCHED,
            next_event_time: Real::NAN,
        };
        // SAFETY: a live instance, and a place to write to.
        let status = unsafe { fmi2NewDiscreteStates(self.component, &raw mut info) };
        let needs = [
            info.new_discrete_states_needed,
            info.terminate_simulation,
            info.nominals_of_continuous_states_changed,
            info.next_event_time_defined,
        ];
        if status == Status::Ok {
            assert_eq!(needs, [FALSE; 4]);
            assert!((0..=1).contains(&info.values_of_continuous_states_changed));
            return Ok(info.values_of_continuous_states_changed == TRUE);
        }
        assert_eq!((needs, info.values_of_continuous_states_changed), ([UNTOUCHED; 4], UNTOUCHED));
        Err(status)
    }

    /// fmi2CompletedIntegratorStep; whether event mode should be entered.
    pub fn completed_integrator_step(&mut self) -> Result<bool, Status> {
        let (mut event, mut terminate) = (77, 77);
        // SAFETY: a live instance, and places to write to.
        let status = unsafe { fmi2CompletedIntegratorStep(self.component, TRUE, &raw mut event, &raw mut terminate) };
        if status == Status::Ok {
            assert!((0..=1).contains(&event) && terminate == FALSE);
            return Ok(event == TRUE);
        }
        assert_eq!((event, terminate), (77, 77), "nothing is written");
        Err(status)
    }

    pub fn set_states(&mut self, states: &[Real]) -> Status {
        // SAFETY: a live instance, and an array as long as told.
        unsafe { fmi2SetContinuousStates(self.component, states.as_ptr(), states.len()) }
    }

    pub fn states(&mut self) -> Result<Vec<Real>, Status> {
        self.vector(fmi2GetContinuousStates)
    }

    pub fn rates(&mut self) -> Result<Vec<Real>, Status> {
        self.vector(fmi2GetDerivatives)
    }

    pub fn nominals(&mut self) -> Result<Vec<Real>, Status> {
        self.vector(fmi2GetNominalsOfContinuousStates)
    }

    fn vector(&mut self, get: unsafe extern "C" fn(Component, *mut Real, Size) -> Status) -> Result<Vec<Real>, Status> {
        let mut values = vec![Real::NAN; Simulation::STATES];
        // SAFETY: a live instance, and an array as long as told.
        let status = unsafe { get(self.component, values.as_mut_ptr(), values.len()) };
        if status == Status::Ok {
            return Ok(values);
        }
        assert!(values.iter().all(|value| value.is_nan()), "nothing is written");
        Err(status)
    }

    /// From event mode: settles it and enters continuous-time mode.
    pub fn settled(&mut self) {
        self.new_discrete_states().unwrap_or_else(|status| panic!("{status:?}: {:?}", self.journal.take()));
        assert_eq!(self.enter_continuous_time_mode(), Status::Ok);
    }

    /// In continuous-time mode: a step by the midpoint rule, with an event at its end where one is asked for.
    pub fn midpoint_step(&mut self, t: Real, h: Real) -> Status {
        let Ok(start) = self.states() else { return Status::Discard };
        let Ok(slope) = self.rates() else { return Status::Discard };
        let along = |slope: &[Real], h: Real| -> Vec<Real> {
            start.iter().zip(slope).map(|(state, rate)| state + h * rate).collect()
        };
        let statuses = [self.set_time(t + 0.5 * h), self.set_states(&along(&slope, 0.5 * h))];
        if statuses != [Status::Ok; 2] {
            return Status::Discard;
        }
        let Ok(slope) = self.rates() else { return Status::Discard };
        let statuses = [self.set_time(t + h), self.set_states(&along(&slope, h))];
        if statuses != [Status::Ok; 2] {
            return Status::Discard;
        }
        match self.completed_integrator_step() {
            Ok(false) => Status::Ok,
            Ok(true) => {
                assert_eq!(self.enter_event_mode(), Status::Ok);
                self.settled();
                Status::Ok
            }
            Err(status) => status,
        }
    }

    /// In continuous-time mode: `n` steps by the midpoint rule from `from`; the bits of all Real variables after each.
    pub fn integrate(&mut self, from: Real, step: Real, n: u32) -> Vec<Vec<u64>> {
        let steps = (0..n).map(|i| {
            let status = self.midpoint_step(from + Real::from(i) * step, step);
            assert_eq!(status, Status::Ok, "{:?}", self.journal.take());
            self.bits()
        });
        steps.collect()
    }
}
