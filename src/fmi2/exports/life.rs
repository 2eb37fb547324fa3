//! The life of an instance (FMI 2.0.4, sections 2.1.4 to 2.1.6).

use crate::arguments::{text, values};
use crate::fmi2::NAMES;
use crate::fmi2::abi::*;
use crate::fmi2::guard::caught;
use crate::fmi2::logger::logger;
use crate::instance::{Failure, Instance, Severity};
use crate::scene;
use split_rotor_model::log::Category;
use split_rotor_model::simulation::Integrator;
use std::ffi::CStr;
use std::ptr::null_mut;

/// Platform of the C types.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> Text {
    c"default".as_ptr()
}

/// Version of FMI.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> Text {
    c"2.0".as_ptr()
}

/// A new instance; null, and a log line, where it cannot be.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    instance_name: Text,
    kind: Choice,
    guid: Text,
    _resource_location: Text,
    callbacks: *const CallbackFunctions,
    _visible: Boolean,
    logging_on: Boolean,
) -> Component {
    // SAFETY: null, or the host's struct for the time of this call.
    let Some(callbacks) = (unsafe { callbacks.as_ref() }) else { return null_mut() };
    // SAFETY: null, or strings of the host's.
    let (name, guid) = unsafe { (text(instance_name, "instanceName"), text(guid, "fmuGUID")) };
    let logger = logger(callbacks, name.as_ref().copied().unwrap_or_default(), logging_on != FALSE);
    match kind_of(name, guid, kind) {
        Ok(kind) => {
            caught(|| Box::into_raw(Box::new(Instance::new(logger, &NAMES, kind))).cast()).unwrap_or(null_mut())
        }
        Err(Failure::Error(message) | Failure::Discard(message)) => {
            logger.log(Severity::Error, Category::Error, &format!("fmi2Instantiate: {message}"));
            null_mut()
        }
    }
}

/// Which kind of instance a host asks for, if name and GUID are right.
fn kind_of(name: Result<&CStr, Failure>, guid: Result<&CStr, Failure>, kind: Choice) -> Result<Integrator, Failure> {
    if name?.to_bytes().trim_ascii().is_empty() {
        return Err(Failure::Error("instanceName must have a character that is not white space".into()));
    }
    let (guid, values) = (guid?, scene::values());
    values.check().map_err(|wrong| Failure::Error(wrong.into()))?;
    let own = values.guid();
    if guid.to_bytes() != own.as_bytes() {
        let message = format!("fmuGUID = {guid:?} must be {own:?}: the binary and the modelDescription.xml differ");
        return Err(Failure::Error(message));
    }
    match kind {
        MODEL_EXCHANGE => Ok(Integrator::Host),
        CO_SIMULATION => Ok(Integrator::Method),
        _ => Err(Failure::Error(format!("fmuType = {kind} must be fmi2ModelExchange (0) or fmi2CoSimulation (1)"))),
    }
}

/// Frees an instance; null is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(component: Component) {
    if !component.is_null() {
        // SAFETY: it came from fmi2Instantiate, and the host uses it no more.
        let _ = caught(|| drop(unsafe { Box::from_raw(component.cast::<Instance>()) }));
    }
}

export! {
    /// Chooses what is logged.
    fmi2SetDebugLogging(instance, on: Boolean, n: Size, categories: *const Text) {
        let names = values(categories, n, "categories")?.iter().map(|name| text(*name, "a category"));
        let names = names.map(|name| name.map(|name| name.to_str().unwrap_or("not UTF-8")));
        instance.set_debug_logging(on != FALSE, &names.collect::<Result<Vec<_>, _>>()?)
    }

    /// Tolerance, start and stop of the experiment.
    fmi2SetupExperiment(
        instance, tolerance_defined: Boolean, tolerance: Real, start: Real, stop_defined: Boolean, stop: Real
    ) {
        let given = |defined, value| (defined != FALSE).then_some(value);
        instance.setup_experiment(given(tolerance_defined, tolerance), start, given(stop_defined, stop))
    }

    /// Enters initialization mode.
    fmi2EnterInitializationMode(instance) { instance.enter_initialization_mode() }

    /// Checks all parameters and starts the motion.
    fmi2ExitInitializationMode(instance) { instance.exit_initialization_mode() }

    /// Ends the run; values can still be read.
    fmi2Terminate(instance) { instance.terminate() }

    /// Back to the state after fmi2Instantiate; what the host set is forgotten.
    fmi2Reset(instance) { instance.reset() }
}
