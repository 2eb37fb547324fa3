//! Functions for co-simulation and model exchange alike (FMI 2.0.4, section 2.1).

use crate::abi::*;
use crate::calls::call;
use crate::guard::{caught, enter, fill, room, text, values};
use crate::instance::{Failure, Instance, Memory, Type};
use crate::logger::Logger;
use crate::scene::GUID;
use split_rotor_model::log::Category;
use split_rotor_model::simulation::Integrator;

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
    let Some(callbacks) = (unsafe { callbacks.as_ref() }) else { return std::ptr::null_mut() };
    // SAFETY: null, or strings of the host's.
    let name = unsafe { text(instance_name, "instanceName") };
    let logger = Logger::new(callbacks, name.as_ref().copied().unwrap_or_default(), logging_on != FALSE);
    let refusal = |failure: Failure| {
        logger.log(Status::Error, Category::Error, &format!("fmi2Instantiate: {}", failure.message));
        std::ptr::null_mut()
    };
    match name {
        Err(failure) => return refusal(failure),
        Ok(name) if name.to_bytes().trim_ascii().is_empty() => {
            return refusal(Failure::error("instanceName must have a character that is not white space"));
        }
        Ok(_) => {}
    }
    // SAFETY: as above.
    match unsafe { text(guid, "fmuGUID") } {
        Err(failure) => return refusal(failure),
        Ok(guid) if guid.to_bytes() != GUID.as_bytes() => {
            let message =
                format!("fmuGUID = {guid:?} must be {GUID:?}: the binary and the modelDescription.xml differ");
            return refusal(Failure::error(message));
        }
        Ok(_) => {}
    }
    let integrator = match kind {
        MODEL_EXCHANGE => Integrator::Host,
        CO_SIMULATION => Integrator::Method,
        _ => {
            let message = format!("fmuType = {kind} must be fmi2ModelExchange (0) or fmi2CoSimulation (1)");
            return refusal(Failure::error(message));
        }
    };
    caught(|| Box::into_raw(Box::new(Instance::new(logger, integrator))).cast()).unwrap_or(std::ptr::null_mut())
}

/// Frees an instance; null is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(component: Component) {
    if !component.is_null() {
        // SAFETY: it came from fmi2Instantiate, and the host uses it no more.
        let _ = caught(|| drop(unsafe { Box::from_raw(component.cast::<Instance>()) }));
    }
}

/// Chooses what is logged.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    component: Component,
    on: Boolean,
    n: Size,
    categories: *const Text,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::SET_DEBUG_LOGGING, |instance| {
            let names = values(categories, n, "categories")?.iter().map(|name| text(*name, "a category"));
            let names = names.map(|name| name.map(|name| name.to_str().unwrap_or("not UTF-8")));
            instance.set_debug_logging(on != FALSE, &names.collect::<Result<Vec<_>, _>>()?)
        })
    }
}

/// Tolerance, start and stop of the experiment.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    component: Component,
    tolerance_defined: Boolean,
    tolerance: Real,
    start: Real,
    stop_defined: Boolean,
    stop: Real,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::SETUP_EXPERIMENT, |instance| {
            let given = |defined, value| (defined != FALSE).then_some(value);
            instance.setup_experiment(given(tolerance_defined, tolerance), start, given(stop_defined, stop))
        })
    }
}

/// Enters initialization mode.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(component: Component) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { enter(component, &call::ENTER_INITIALIZATION_MODE, |instance| instance.enter_initialization_mode()) }
}

/// Checks all parameters and starts the motion.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(component: Component) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { enter(component, &call::EXIT_INITIALIZATION_MODE, |instance| instance.exit_initialization_mode()) }
}

/// Ends the run; values can still be read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(component: Component) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { enter(component, &call::TERMINATE, |instance| instance.terminate()) }
}

/// Back to the state after fmi2Instantiate; what the host set is forgotten.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(component: Component) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe { enter(component, &call::RESET_INSTANCE, |instance| instance.reset()) }
}

/// Reads variables of type Real.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(
    component: Component,
    references: *const ValueReference,
    n: Size,
    value: *mut Real,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::GET_REAL, |instance| {
            instance.get_real(values(references, n, "vr")?, room(value, n, "value")?)
        })
    }
}

/// Reads variables of type Integer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetInteger(
    component: Component,
    references: *const ValueReference,
    n: Size,
    value: *mut Integer,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::GET_INTEGER, |instance| {
            instance.get_integer(values(references, n, "vr")?, room(value, n, "value")?)
        })
    }
}

/// Reads variables of type Boolean, the switches.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBoolean(
    component: Component,
    references: *const ValueReference,
    n: Size,
    value: *mut Boolean,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::GET_BOOLEAN, |instance| {
            instance.get_boolean(values(references, n, "vr")?, room(value, n, "value")?)
        })
    }
}

/// Reads variables of type String, of which there are none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetString(
    component: Component,
    references: *const ValueReference,
    n: Size,
    _value: *mut Text,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::GET_STRING, |instance| instance.get_other(values(references, n, "vr")?, Type::String))
    }
}

/// Sets parameters and inputs of type Real.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    component: Component,
    references: *const ValueReference,
    n: Size,
    value: *const Real,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::SET_REAL, |instance| {
            instance.set_real(values(references, n, "vr")?, values(value, n, "value")?)
        })
    }
}

/// Sets parameters of type Integer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetInteger(
    component: Component,
    references: *const ValueReference,
    n: Size,
    value: *const Integer,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::SET_INTEGER, |instance| {
            instance.set_integer(values(references, n, "vr")?, values(value, n, "value")?)
        })
    }
}

/// Sets parameters of type Boolean, the switches.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetBoolean(
    component: Component,
    references: *const ValueReference,
    n: Size,
    value: *const Boolean,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::SET_BOOLEAN, |instance| {
            instance.set_boolean(values(references, n, "vr")?, values(value, n, "value")?)
        })
    }
}

/// Sets parameters of type String, of which there are none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetString(
    component: Component,
    references: *const ValueReference,
    n: Size,
    _value: *const Text,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::SET_STRING, |instance| instance.set_other(values(references, n, "vr")?, Type::String))
    }
}

/// Saves all that the instance holds; an object saved before is used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(component: Component, state: *mut FmuState) -> Status {
    // SAFETY: the host keeps the contract of the standard: a state that is not null came from this function.
    unsafe {
        enter(component, &call::GET_FMU_STATE, |instance| {
            let place = state.as_mut().ok_or_else(|| Failure::error("FMUstate is a null pointer"))?;
            match place.cast::<Memory>().as_mut() {
                Some(saved) => saved.clone_from(&instance.memory),
                None => *place = Box::into_raw(Box::new(instance.memory.clone())).cast(),
            }
            Ok(Status::Ok)
        })
    }
}

/// Brings back all that was saved.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(component: Component, state: FmuState) -> Status {
    // SAFETY: as above.
    unsafe { enter(component, &call::SET_FMU_STATE, |instance| instance.restore(memory(state)?)) }
}

/// Frees a saved state, and makes the pointer null; a null state is left alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(component: Component, state: *mut FmuState) -> Status {
    // SAFETY: as above, and the host uses the state no more.
    unsafe {
        enter(component, &call::FREE_FMU_STATE, |_| {
            if let Some(place) = state.as_mut().filter(|place| !place.is_null()) {
                drop(Box::from_raw(std::mem::replace(place, std::ptr::null_mut()).cast::<Memory>()));
            }
            Ok(Status::Ok)
        })
    }
}

/// How many bytes a saved state takes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(component: Component, state: FmuState, size: *mut Size) -> Status {
    // SAFETY: as above.
    unsafe {
        enter(component, &call::SERIALIZED_FMU_STATE_SIZE, |_| {
            if size.is_null() {
                return Err(Failure::error("size is a null pointer"));
            }
            size.write(memory(state)?.to_bytes().len());
            Ok(Status::Ok)
        })
    }
}

/// Writes a saved state down as bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    component: Component,
    state: FmuState,
    bytes: *mut Byte,
    size: Size,
) -> Status {
    // SAFETY: as above.
    unsafe {
        enter(component, &call::SERIALIZE_FMU_STATE, |_| {
            let written = memory(state)?.to_bytes();
            if size != written.len() {
                let message = format!("size = {size} must be {}, as fmi2SerializedFMUstateSize says", written.len());
                return Err(Failure::error(message));
            }
            fill(room(bytes.cast::<u8>(), size, "serializedState")?, &written);
            Ok(Status::Ok)
        })
    }
}

/// A saved state from its bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    component: Component,
    bytes: *const Byte,
    size: Size,
    state: *mut FmuState,
) -> Status {
    // SAFETY: as above. What the place held may be anything, and is not looked at.
    unsafe {
        enter(component, &call::DESERIALIZE_FMU_STATE, |instance| {
            let read = values(bytes.cast::<u8>(), size, "serializedState")?;
            if state.is_null() {
                return Err(Failure::error("FMUstate is a null pointer"));
            }
            state.write(Box::into_raw(Box::new(instance.memory_of(read)?)).cast());
            Ok(Status::Ok)
        })
    }
}

/// The saved state behind a pointer.
///
/// # Safety
/// `state` is null or came from fmi2GetFMUstate or fmi2DeSerializeFMUstate and was not freed.
unsafe fn memory<'a>(state: FmuState) -> Result<&'a Memory, Failure> {
    // SAFETY: see above.
    unsafe { state.cast::<Memory>().as_ref() }.ok_or_else(|| Failure::error("FMUstate is a null pointer"))
}

/// How unknown variables change as known ones change by their seeds.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    component: Component,
    unknown: *const ValueReference,
    n_unknown: Size,
    known: *const ValueReference,
    n_known: Size,
    seed: *const Real,
    sensitivity: *mut Real,
) -> Status {
    // SAFETY: the host keeps the contract of the standard, which is that of the door.
    unsafe {
        enter(component, &call::GET_DIRECTIONAL_DERIVATIVE, |instance| {
            instance.directional_derivative(
                values(unknown, n_unknown, "vUnknown_ref")?,
                values(known, n_known, "vKnown_ref")?,
                values(seed, n_known, "dvKnown")?,
                room(sensitivity, n_unknown, "dvUnknown")?,
            )
        })
    }
}
