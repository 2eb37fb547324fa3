//! A packaged FMU in this process, called as a host calls it: the only `unsafe` beside the FMI shell. Safe to use as long as the
//! library is an FMU that keeps to FMI 2.0.
#![allow(unsafe_code, reason = "the FMU is reached through the C functions of FMI 2.0")]

use anyhow::{Context, Result, bail};
use libloading::Library;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_double, c_int, c_uint, c_void};
use std::fmt::{Display, Formatter};
use std::path::Path;
use std::ptr::{NonNull, null};

/// fmi2ValueReference
pub type Reference = c_uint;

type Text = *const c_char;
type Status = c_int;
type Component = *mut c_void;

/// fmi2OK
const OK: Status = 0;
/// fmi2OK and fmi2Warning: what was asked is done.
const DONE: [Status; 2] = [OK, 1];
/// fmi2Discard
pub const DISCARD: Status = 2;
/// fmi2Error
pub const ERROR: Status = 3;
/// fmi2LastSuccessfulTime
const LAST_SUCCESSFUL_TIME: c_int = 2;
/// fmi2CoSimulation
const CO_SIMULATION: c_int = 1;
const FALSE: c_int = 0;
const TRUE: c_int = 1;

/// fmi2CallbackLogger; what follows the message is not declared, since the FMU sends messages ready-made.
type Logger = extern "C" fn(environment: *mut c_void, instance: Text, Status, category: Text, message: Text);

/// fmi2CallbackFunctions
#[repr(C)]
struct Callbacks {
    logger: Logger,
    allocate_memory: Option<extern "C" fn()>,
    free_memory: Option<extern "C" fn()>,
    step_finished: Option<extern "C" fn()>,
    environment: *mut c_void,
}

/// A struct of the functions of an FMU that are called, by the names of the standard, and what loads it.
macro_rules! functions {
    ($($name:ident: $symbol:literal ($($argument:ty),*) $(-> $result:ty)?;)*) => {
        /// The functions of an FMU that are called; they stay valid as long as the library is loaded.
        pub struct Fmu {
            guid: CString,
            $($name: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
            _library: Library,
        }

        impl Fmu {
            fn of(library: Library, guid: CString) -> Result<Self> {
                let lacks = "the library lacks a function of FMI 2.0";
                Ok(Self {
                    guid,
                    // SAFETY: the standard gives the function under this name the type of the field that it goes to.
                    $($name: *unsafe { library.get($symbol) }.context(lacks)?,)*
                    _library: library,
                })
            }
        }
    };
}

functions! {
    instantiate: "fmi2Instantiate" (Text, c_int, Text, Text, *const Callbacks, c_int, c_int) -> Component;
    free_instance: "fmi2FreeInstance" (Component);
    setup_experiment: "fmi2SetupExperiment" (Component, c_int, c_double, c_double, c_int, c_double) -> Status;
    enter_initialization: "fmi2EnterInitializationMode" (Component) -> Status;
    exit_initialization: "fmi2ExitInitializationMode" (Component) -> Status;
    set_real: "fmi2SetReal" (Component, *const Reference, usize, *const c_double) -> Status;
    set_integer: "fmi2SetInteger" (Component, *const Reference, usize, *const c_int) -> Status;
    set_boolean: "fmi2SetBoolean" (Component, *const Reference, usize, *const c_int) -> Status;
    get_real: "fmi2GetReal" (Component, *const Reference, usize, *mut c_double) -> Status;
    set_derivatives: "fmi2SetRealInputDerivatives" (Component, *const Reference, usize, *const c_int, *const c_double) -> Status;
    do_step: "fmi2DoStep" (Component, c_double, c_double, c_int) -> Status;
    get_real_status: "fmi2GetRealStatus" (Component, c_int, *mut c_double) -> Status;
}

impl Fmu {
    /// Loads the library of an FMU with this GUID.
    pub fn load(library: &Path, guid: &str) -> Result<Self> {
        // SAFETY: the library of an FMU of ours does nothing when it is loaded or unloaded.
        let library = unsafe { Library::new(library) }.with_context(|| format!("cannot load {}", library.display()))?;
        Self::of(library, CString::new(guid)?)
    }

    /// A new instance for co-simulation.
    pub fn instantiate(&self) -> Result<Instance<'_>> {
        self.instance(FALSE)
    }

    /// One that also says what it does and why: [`Instance::said`].
    pub fn instantiate_with_log(&self) -> Result<Instance<'_>> {
        self.instance(TRUE)
    }

    fn instance(&self, logging_on: c_int) -> Result<Instance<'_>> {
        let journal = Box::<Journal>::default();
        let callbacks = Callbacks {
            logger: listen,
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            environment: (&raw const *journal).cast_mut().cast(),
        };
        let (name, guid) = (c"split-rotor".as_ptr(), self.guid.as_ptr());
        // SAFETY: strings and a struct of callbacks that live during the call; the FMU keeps copies. Its journal is boxed
        // and outlives the instance.
        let component =
            unsafe { (self.instantiate)(name, CO_SIMULATION, guid, null(), &raw const callbacks, FALSE, logging_on) };
        match NonNull::new(component) {
            Some(component) => Ok(Instance { fmu: self, component, journal }),
            None => bail!("fmi2Instantiate: {}", journal.take()),
        }
    }
}

/// What an instance logged. It logs only from within calls, so nobody else looks at the same time.
#[derive(Default)]
struct Journal(RefCell<Vec<(Status, String)>>);

impl Journal {
    /// What went wrong.
    fn take(&self) -> String {
        let wrong = self.0.take().into_iter().filter(|(status, _)| *status != OK);
        wrong.map(|(_, message)| message).collect::<Vec<_>>().join("; ")
    }
}

/// The logger of each instance. What is variadic in C travels as here where no arguments follow the message.
extern "C" fn listen(environment: *mut c_void, _instance: Text, status: Status, _category: Text, message: Text) {
    // SAFETY: the FMU hands back the pointer that it was given, and a string.
    let (journal, message) = unsafe { (&*environment.cast::<Journal>(), CStr::from_ptr(message)) };
    // The message is a format without conversions.
    journal.0.borrow_mut().push((status, message.to_string_lossy().replace("%%", "%")));
}

/// A call that was not done.
#[derive(Debug)]
pub struct Refused {
    function: &'static str,
    /// What it returned.
    pub status: Status,
    /// What was logged.
    pub log: String,
}

impl Display for Refused {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.function, self.log)
    }
}

impl std::error::Error for Refused {}

/// An instance; errors are [`Refused`].
pub struct Instance<'f> {
    fmu: &'f Fmu,
    component: NonNull<c_void>,
    journal: Box<Journal>,
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        // SAFETY: it came from fmi2Instantiate and is freed once.
        unsafe { (self.fmu.free_instance)(self.component.as_ptr()) }
    }
}

impl Instance<'_> {
    /// Sets Real variables.
    pub fn set_real(&mut self, reference: Reference, value: f64) -> Result<()> {
        // SAFETY: a live instance; one reference and one value.
        self.done("fmi2SetReal", |component| unsafe {
            (self.fmu.set_real)(component, &raw const reference, 1, &raw const value)
        })
    }

    /// Sets an Integer or an enumeration.
    pub fn set_integer(&mut self, reference: Reference, value: i32) -> Result<()> {
        // SAFETY: a live instance; one reference and one value.
        self.done("fmi2SetInteger", |component| unsafe {
            (self.fmu.set_integer)(component, &raw const reference, 1, &raw const value)
        })
    }

    /// Sets a Boolean.
    pub fn set_boolean(&mut self, reference: Reference, value: bool) -> Result<()> {
        let value = c_int::from(value);
        // SAFETY: a live instance; one reference and one value.
        self.done("fmi2SetBoolean", |component| unsafe {
            (self.fmu.set_boolean)(component, &raw const reference, 1, &raw const value)
        })
    }

    /// Leads it through initialization, for a run between these times \[s].
    pub fn initialize(&mut self, start: f64, stop: f64) -> Result<()> {
        // SAFETY: a live instance, here and below.
        self.done("fmi2SetupExperiment", |component| unsafe {
            (self.fmu.setup_experiment)(component, FALSE, 0.0, start, TRUE, stop)
        })?;
        // SAFETY: as above.
        self.done("fmi2EnterInitializationMode", |component| unsafe { (self.fmu.enter_initialization)(component) })?;
        // SAFETY: as above.
        self.done("fmi2ExitInitializationMode", |component| unsafe { (self.fmu.exit_initialization)(component) })
    }

    /// Sets the rate of an input.
    pub fn set_rate(&mut self, reference: Reference, rate: f64) -> Result<()> {
        let order = 1;
        // SAFETY: a live instance; one reference, one order and one value.
        self.done("fmi2SetRealInputDerivatives", |component| unsafe {
            (self.fmu.set_derivatives)(component, &raw const reference, 1, &raw const order, &raw const rate)
        })
    }

    /// A communication step from time `from` of length `step` \[s], never to be taken back.
    pub fn do_step(&mut self, from: f64, step: f64) -> Result<()> {
        // SAFETY: a live instance.
        self.done("fmi2DoStep", |component| unsafe { (self.fmu.do_step)(component, from, step, TRUE) })
    }

    /// Reads Real variables, in the order of their references.
    pub fn get_real<const N: usize>(&self, references: &[Reference; N]) -> Result<[f64; N]> {
        let mut values = [0.0; N];
        // SAFETY: a live instance; as many values as references.
        self.done("fmi2GetReal", |component| unsafe {
            (self.fmu.get_real)(component, references.as_ptr(), N, values.as_mut_ptr())
        })?;
        Ok(values)
    }

    /// What went wrong, or may, and was not told yet.
    pub fn journal(&self) -> String {
        self.journal.take()
    }

    /// What it said as fmi2OK.
    pub fn said(&self) -> Vec<String> {
        let all = self.journal.0.borrow();
        all.iter().filter(|(status, _)| *status == OK).map(|(_, message)| message.clone()).collect()
    }

    /// The time that the last step reached \[s].
    pub fn last_successful_time(&self) -> Result<f64> {
        let mut t = 0.0;
        // SAFETY: a live instance; a place for one value.
        self.done("fmi2GetRealStatus", |component| unsafe {
            (self.fmu.get_real_status)(component, LAST_SUCCESSFUL_TIME, &raw mut t)
        })?;
        Ok(t)
    }

    fn done(&self, function: &'static str, call: impl FnOnce(Component) -> Status) -> Result<()> {
        let status = call(self.component.as_ptr());
        if !DONE.contains(&status) {
            return Err(Refused { function, status, log: self.journal.take() }.into());
        }
        Ok(())
    }
}
