//! The one door: every exported function passes here on its way to the safe instance.
//!
//! A null instance or a call that is not legal gives fmi2Error; a panic is caught, and gives fmi2Fatal; every failure is
//! logged with the function's name. Nothing is written to stdout or stderr.
#![allow(unsafe_code)]

use crate::abi::{Component, Size, Status, Text};
use crate::calls::{Call, State};
use crate::instance::{Failure, Instance};
use split_rotor_model::log::Category;
use std::any::Any;
use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs `body` on the instance behind `component`, if `call` is legal now.
///
/// # Safety
/// `component` is null or came from fmi2Instantiate and was not freed, and no other thread uses it during the call.
pub unsafe fn enter(
    component: Component,
    call: &Call,
    body: impl FnOnce(&mut Instance) -> Result<Status, Failure>,
) -> Status {
    // SAFETY: see above.
    let Some(instance) = (unsafe { component.cast::<Instance>().as_mut() }) else { return Status::Error };
    if instance.memory.state == State::Lost {
        return Status::Fatal;
    }
    let integrator = instance.memory.integrator();
    if !call.is_legal(instance.memory.state, integrator) {
        let message = format!("{}: {}", call.name, call.refusal(instance.memory.state, integrator));
        instance.logger.log(Status::Error, Category::Error, &message);
        return Status::Error;
    }
    match caught(|| body(instance)) {
        Ok(Ok(status)) => status,
        Ok(Err(failure)) => {
            instance.logger.log(failure.status, failure.category, &format!("{}: {}", call.name, failure.message));
            failure.status
        }
        Err(panic) => {
            instance.memory.state = State::Lost;
            let message = format!("{}: internal failure: {panic}; free the instance", call.name);
            // The host's logger may itself be what failed.
            let _ = caught(|| instance.logger.log(Status::Fatal, Category::Error, &message));
            Status::Fatal
        }
    }
}

/// What `body` returns, or the message of its panic.
pub fn caught<T>(body: impl FnOnce() -> T) -> Result<T, String> {
    silence();
    catch_unwind(AssertUnwindSafe(body)).map_err(|panic: Box<dyn Any + Send>| {
        let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
        text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "a panic".into())
    })
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

/// Whether `n` values of type T can stand at `first`.
fn check_array<T>(first: *const T, n: Size, what: &str) -> Result<(), Failure> {
    if first.is_null() {
        return Err(Failure::error(format!("{what} is a null pointer")));
    }
    if n > isize::MAX as usize / size_of::<T>() {
        return Err(Failure::error(format!("{n} of {what} cannot be")));
    }
    Ok(())
}

/// `n` values to read.
///
/// # Safety
/// `first` is null or points to `n` values that nobody writes while they are used.
pub unsafe fn values<'a, T>(first: *const T, n: Size, what: &str) -> Result<&'a [T], Failure> {
    if n == 0 {
        return Ok(&[]);
    }
    check_array(first, n, what)?;
    // SAFETY: see above.
    Ok(unsafe { std::slice::from_raw_parts(first, n) })
}

/// Room for values that a host asked for, and need not have initialised: it is written, never read.
pub type Room<'a, T> = &'a mut [MaybeUninit<T>];

/// Room for `n` values.
///
/// # Safety
/// `first` is null or points to room for `n` values that nobody else uses meanwhile.
pub unsafe fn room<'a, T>(first: *mut T, n: Size, what: &str) -> Result<Room<'a, T>, Failure> {
    if n == 0 {
        return Ok(&mut []);
    }
    check_array(first, n, what)?;
    // SAFETY: see above; what is not initialised may stand in a MaybeUninit.
    Ok(unsafe { std::slice::from_raw_parts_mut(first.cast(), n) })
}

/// Writes `values` to room for as many.
pub fn fill<T: Copy>(room: Room<T>, values: &[T]) {
    assert_eq!(room.len(), values.len());
    for (place, value) in room.iter_mut().zip(values) {
        place.write(*value);
    }
}

/// A C string.
///
/// # Safety
/// `text` is null or points to a string that ends with a zero and outlives its use.
pub unsafe fn text<'a>(text: Text, what: &str) -> Result<&'a CStr, Failure> {
    if text.is_null() {
        return Err(Failure::error(format!("{what} is a null pointer")));
    }
    // SAFETY: see above.
    Ok(unsafe { CStr::from_ptr(text) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::abi::{CallbackFunctions, Environment, LoggerCallback};
    use crate::calls::call;
    use crate::logger::Logger;
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
    fn what_a_host_lends_may_be_uninitialised() {
        // Neither the types nor the calls let anything be read from it.
        let mut lent = [const { MaybeUninit::<f64>::uninit() }; 3];
        let first = lent.as_mut_ptr().cast::<f64>();
        // SAFETY: room for three values, which only this thread uses.
        let places: &mut [MaybeUninit<f64>] = unsafe { room(first, 2, "value") }.expect("it is not null");
        fill(places, &[1.0, 2.0]);
        // SAFETY: the first two were written.
        assert_eq!(unsafe { [lent[0].assume_init(), lent[1].assume_init()] }, [1.0, 2.0]);
        // SAFETY: null, or no room at all, which is not looked at.
        unsafe {
            assert_eq!(room::<f64>(std::ptr::null_mut(), 0, "value").expect("nothing is asked for").len(), 0);
            let failure = room::<f64>(std::ptr::null_mut(), 1, "value").expect_err("it is null");
            assert_eq!(failure.message, "value is a null pointer");
            let failure = room(first, Size::MAX / 8, "value").expect_err("so much cannot be");
            assert!(failure.message.ends_with("of value cannot be"), "{}", failure.message);
        }
    }

    #[test]
    fn a_panic_is_fatal_and_logged_and_loses_the_instance() {
        let lines = Lines::default();
        type Plain = extern "C" fn(Environment, Text, Status, Text, Text);
        // SAFETY: stable Rust cannot define a C-variadic function; named arguments travel alike (tests/harness).
        let logger = unsafe { std::mem::transmute::<Plain, LoggerCallback>(record) };
        let callbacks = CallbackFunctions {
            logger: Some(logger),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            environment: (&raw const lines).cast_mut().cast(),
        };
        let mut instance = Instance::new(Logger::new(&callbacks, c"rotor", false), Integrator::Method);
        let component: Component = (&raw mut instance).cast();
        for panic in [|| panic!("100% unexpected"), || panic!("{}", "100% unexpected".to_owned()) as fn() -> ()] {
            instance.memory.state = State::Instantiated;
            // SAFETY: the instance lives, and only this thread uses it.
            let status = unsafe {
                enter(component, &call::GET_REAL, |_| {
                    panic();
                    Ok(Status::Ok)
                })
            };
            assert_eq!(status, Status::Fatal);
            let line = "fmi2GetReal: internal failure: 100%% unexpected; free the instance".to_owned();
            assert_eq!(std::mem::take(&mut *lines.lock().unwrap()), [(Status::Fatal, line)]);
            // SAFETY: as above. Nothing but fmi2FreeInstance is legal any more, fmi2Reset neither, and nobody is told again.
            let status = unsafe { enter(component, &call::RESET_INSTANCE, |instance| instance.reset()) };
            assert_eq!((status, instance.memory.state), (Status::Fatal, State::Lost));
            assert!(lines.lock().unwrap().is_empty());
        }
    }
}
