//! The one door: every exported function passes here on its way to the safe instance.
//!
//! A null instance or a call that is not legal gives fmi2Error; a panic is caught, and gives fmi2Fatal; every failure is
//! logged with the function's name. Nothing is written to stdout or stderr.
#![allow(unsafe_code)]

use super::abi::{Component, Status};
use super::calls::Call;
use crate::instance::{Failure, Instance, Reply, Severity, State};
use split_rotor_model::log::Category;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs `body` on the instance behind `component`, if `call` is legal now.
///
/// # Safety
/// `component` is null or came from fmi2Instantiate and was not freed, and no other thread uses it during the call.
pub unsafe fn enter(component: Component, call: &Call, body: impl FnOnce(&mut Instance) -> Reply) -> Status {
    // SAFETY: see above.
    let Some(instance) = (unsafe { component.cast::<Instance>().as_mut() }) else { return Status::Error };
    if !call.is_legal(instance.memory.state, instance.memory.integrator()) {
        return refused(instance, call);
    }
    match caught(|| body(instance)) {
        Ok(Ok(())) => Status::Ok,
        Ok(Err(failure)) => told(instance, call, Ok(failure)),
        Err(panic) => told(instance, call, Err(panic)),
    }
}

/// Not written into every call, as [`told`]: they were a twentieth of the library.
#[cold]
#[inline(never)]
fn refused(instance: &mut Instance, call: &Call) -> Status {
    match (instance.memory.state, instance.memory.integrator()) {
        (State::Lost, _) => Status::Fatal,
        (state, integrator) => told(instance, call, Ok(Failure::Error(call.refusal(state, integrator)))),
    }
}

/// The status of what failed, or panicked with a message, once the host's logger knows.
#[cold]
#[inline(never)]
fn told(instance: &mut Instance, call: &Call, failed: Result<Failure, String>) -> Status {
    let (severity, category, message) = match failed {
        Ok(Failure::Error(message)) => (Severity::Error, Category::Error, message),
        Ok(Failure::Discard(message)) => (Severity::Discard, Category::Discard, message),
        Err(panic) => {
            instance.memory.state = State::Lost;
            (Severity::Fatal, Category::Error, format!("internal failure: {panic}; free the instance"))
        }
    };
    // The host's logger may itself be what failed.
    let _ = caught(|| instance.logger.log(severity, category, &format!("{}: {message}", call.name)));
    severity.into()
}

/// What `body` returns, or the message of its panic.
pub fn caught<T>(body: impl FnOnce() -> T) -> Result<T, String> {
    silence();
    catch_unwind(AssertUnwindSafe(body)).map_err(message)
}

#[cold]
fn message(panic: Box<dyn Any + Send>) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "a panic".into())
}

/// A caught panic would still print: in a host's process that is nobody's business. Builds for development keep the
/// message, or a failing test would be silent too.
fn silence() {
    #[cfg(not(debug_assertions))]
    {
        static ONCE: std::sync::Once = std::sync::Once::new();
        ONCE.call_once(|| std::panic::set_hook(Box::new(|_| ())));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi2::NAMES;
    use crate::fmi2::abi::{CallbackFunctions, Environment, LoggerCallback, Text};
    use crate::fmi2::calls::call;
    use crate::fmi2::logger::logger;
    use split_rotor_model::simulation::Integrator;
    use std::ffi::CStr;
    use std::sync::Mutex;

    type Lines = Mutex<Vec<(Status, String)>>;

    extern "C" fn record(environment: Environment, _: Text, status: Status, _: Text, message: Text) {
        // SAFETY: the environment is the test's own, and messages are strings.
        let (lines, message) = unsafe { (&*environment.cast::<Lines>(), CStr::from_ptr(message)) };
        lines.lock().unwrap().push((status, message.to_str().unwrap().to_owned()));
    }

    #[test]
    fn a_panic_is_fatal_and_logged_and_loses_the_instance() {
        let lines = Lines::default();
        type Plain = extern "C" fn(Environment, Text, Status, Text, Text);
        // SAFETY: stable Rust cannot define a C-variadic function; named arguments travel alike (tests/harness).
        let callback = unsafe { std::mem::transmute::<Plain, LoggerCallback>(record) };
        let callbacks = CallbackFunctions {
            logger: Some(callback),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            environment: (&raw const lines).cast_mut().cast(),
        };
        let mut instance = Instance::new(logger(&callbacks, c"rotor", false), &NAMES, Integrator::Method);
        let component: Component = (&raw mut instance).cast();
        for panic in [|| panic!("100% unexpected"), || panic!("{}", "100% unexpected".to_owned()) as fn() -> ()] {
            instance.memory.state = State::Instantiated;
            // SAFETY: the instance lives, and only this thread uses it.
            let status = unsafe {
                enter(component, &call::fmi2GetReal, |_| {
                    panic();
                    Ok(())
                })
            };
            assert_eq!(status, Status::Fatal);
            let line = "fmi2GetReal: internal failure: 100%% unexpected; free the instance".to_owned();
            assert_eq!(std::mem::take(&mut *lines.lock().unwrap()), [(Status::Fatal, line)]);
            // SAFETY: as above. Nothing but fmi2FreeInstance is legal any more, fmi2Reset neither, and nobody is told again.
            let status = unsafe { enter(component, &call::fmi2Reset, |instance| instance.reset()) };
            assert_eq!((status, instance.memory.state), (Status::Fatal, State::Lost));
            assert!(lines.lock().unwrap().is_empty());
        }
    }
}
