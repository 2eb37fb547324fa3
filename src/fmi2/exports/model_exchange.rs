//! Functions for model exchange (FMI 2.0.4, section 3.2).

use crate::arguments::{place, room, values};
use crate::fmi2::abi::*;

export! {
    /// Enters event mode.
    fmi2EnterEventMode(instance) { instance.enter_event_mode() }

    /// Changes the chart of the states, where it should be.
    fmi2NewDiscreteStates(instance, info: *mut EventInfo) {
        place(info, "eventInfo")?.write(EventInfo {
            new_discrete_states_needed: FALSE,
            terminate_simulation: FALSE,
            nominals_of_continuous_states_changed: FALSE,
            values_of_continuous_states_changed: instance.new_discrete_states()?.into(),
            next_event_time_defined: FALSE,
            next_event_time: 0.0,
        });
        Ok(())
    }

    /// Enters continuous-time mode.
    fmi2EnterContinuousTimeMode(instance) { instance.enter_continuous_time_mode() }

    /// The host completed a step; asks for event mode where the chart should be changed.
    fmi2CompletedIntegratorStep(
        instance, _no_set_state_before: Boolean, enter_event_mode: *mut Boolean, terminate: *mut Boolean
    ) {
        let what = "enterEventMode or terminateSimulation";
        let (enter_event_mode, terminate) = (place(enter_event_mode, what)?, place(terminate, what)?);
        enter_event_mode.write(instance.completed_integrator_step()?.into());
        terminate.write(FALSE);
        Ok(())
    }

    /// Sets the time \[s].
    fmi2SetTime(instance, time: Real) { instance.set_time(time) }

    /// Sets the continuous states.
    fmi2SetContinuousStates(instance, x: *const Real, n: Size) { instance.set_continuous_states(values(x, n, "x")?) }

    /// Reads the rates of the continuous states.
    fmi2GetDerivatives(instance, rates: *mut Real, n: Size) { instance.derivatives(room(rates, n, "derivatives")?) }

    /// Reads the event indicators.
    fmi2GetEventIndicators(instance, indicators: *mut Real, n: Size) {
        instance.event_indicators(room(indicators, n, "eventIndicators")?)
    }

    /// Reads the continuous states.
    fmi2GetContinuousStates(instance, x: *mut Real, n: Size) { instance.continuous_states(room(x, n, "x")?) }

    /// Reads what each continuous state counts with.
    fmi2GetNominalsOfContinuousStates(instance, nominals: *mut Real, n: Size) {
        instance.nominals(room(nominals, n, "x_nominal")?)
    }
}
