//! A small C host for the tests: instances of the compiled-in scene behind the exported functions, a logger that writes
//! everything down, and value references by name. `life` tells when a call is legal, `exchange` integrates instances for
//! model exchange, `saved` holds their FMU states.
#![allow(unsafe_code, reason = "the exported functions are those of a C interface")]
#![allow(dead_code, unused_imports, reason = "each test file uses a part")]

mod exchange;
mod life;
mod saved;

pub use life::{FAST, Life, RULES, Rule, Stage, Traveller};
pub use saved::Saved;

use split_rotor::abi::*;
use split_rotor::exports::*;
use split_rotor::scene::values;
use split_rotor_model::scene::Scene;
use split_rotor_model::variable::{Kind, Role};
use split_rotor_model::variables::Variable;
use std::ffi::{CStr, CString};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock};

/// The folder of the scenes: beside the tests, or above a crate that shares them.
pub fn scenes() -> PathBuf {
    let folders = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().map(|folder| folder.join("scenes"));
    folders.into_iter().find(|folder| folder.is_dir()).expect("the project has a folder of scenes")
}

/// The scene that is compiled in.
pub fn scene() -> &'static Scene {
    static SCENE: OnceLock<Scene> = OnceLock::new();
    SCENE.get_or_init(|| {
        let read = |name: String| Scene::find(&name, &scenes()).unwrap_or_else(|error| panic!("{error}"));
        let mut all = Scene::names(&scenes()).into_iter().map(read);
        all.find(|scene| split_rotor_model::xml::guid(scene) == values().guid())
            .expect("the compiled-in scene must be one of scenes/")
    })
}

/// Whether the scene has variables of these names.
pub fn has(names: &[&str]) -> bool {
    names.iter().all(|name| scene().variables.iter().any(|variable| variable.name == *name))
}

/// Of these values, those of variables that the scene has.
pub fn there(values: &[(&'static str, Real)]) -> Vec<(&'static str, Real)> {
    values.iter().copied().filter(|(name, _)| has(&[name])).collect()
}

/// A rotor that tumbles at 30 rad/s about y, held by next to no spring, but by one: where |γ| = 3.1 rad, its law ends.
/// A scene without that law is none for it.
pub fn tumbling() -> Vec<(&'static str, Real)> {
    let all = [
        ("support.c1", 0.0),
        ("support.c2", 1e-300),
        ("support.d1", 0.0),
        ("support.d2", 0.0),
        ("drive.tau", 0.0),
        ("start.omega.x", 0.0),
        ("start.omega.y", 30.0),
    ];
    assert!(has(&["support.c2"]), "a test that needs a support is ignored in a scene without one");
    there(&all)
}

/// The value references of the scene's inputs.
pub fn inputs() -> Vec<ValueReference> {
    let inputs = scene().variables.iter().filter(|variable| matches!(variable.meta.role, Role::Input { .. }));
    inputs.map(|variable| variable.place.value_reference()).collect()
}

/// The variable of this name.
pub fn variable(name: &str) -> &'static Variable {
    let found = scene().variables.iter().find(|variable| variable.name == name);
    found.unwrap_or_else(|| panic!("the scene has no variable {name}"))
}

/// The value reference of this name.
pub fn reference(name: &str) -> ValueReference {
    variable(name).place.value_reference()
}

/// The value references of a scene's Real variables, ascending.
pub fn reals(scene: &Scene) -> Vec<ValueReference> {
    let real = scene.variables.iter().filter(|variable| variable.meta.kind == Kind::Real);
    let mut references: Vec<_> = real.map(|variable| variable.place.value_reference()).collect();
    references.sort_unstable();
    references
}

/// A value reference that no variable has.
pub const NO_VARIABLE: ValueReference = 0x00ff_ffff;

/// A call of the logger.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    pub instance: String,
    pub status: Status,
    pub category: String,
    pub message: String,
}

/// What a host's environment pointer points to: the records of its own instance.
#[derive(Default)]
pub struct Journal(Mutex<Vec<Record>>);

impl Journal {
    /// The records since the last time somebody asked.
    pub fn take(&self) -> Vec<Record> {
        std::mem::take(&mut self.0.lock().expect("no test panics within the logger"))
    }
}

/// A logger as a C host has it, but for the dots at the end.
extern "C" fn record(environment: Environment, instance: Text, status: Status, category: Text, message: Text) {
    // SAFETY: the FMU hands back the pointer that it was given, a journal that outlives its instance.
    let journal = unsafe { &*environment.cast::<Journal>() };
    // SAFETY: the FMU calls the logger with strings.
    let text = |text| unsafe { CStr::from_ptr(text) }.to_str().expect("messages are UTF-8").to_owned();
    let record = Record { instance: text(instance), status, category: text(category), message: text(message) };
    journal.0.lock().expect("no test panics within the logger").push(record);
}

/// What stands in the struct of callbacks after fmi2Instantiate: nobody may call it.
extern "C" fn gone(_: Environment, _: Text, _: Status, _: Text, _: Text) {
    eprintln!("the struct of callbacks was read after fmi2Instantiate");
    std::process::abort();
}

fn variadic(callback: extern "C" fn(Environment, Text, Status, Text, Text)) -> LoggerCallback {
    // SAFETY: stable Rust cannot define a C-variadic function. On each platform that has a build, named arguments of a
    // variadic function travel as those of a plain one do, and the FMU passes no others: messages are ready-made.
    unsafe { std::mem::transmute(callback) }
}

/// What a host passes to fmi2Instantiate.
#[derive(Clone)]
pub struct Request {
    pub name: Option<CString>,
    pub kind: Choice,
    pub guid: Option<CString>,
    pub logging_on: bool,
    pub has_logger: bool,
}

impl Default for Request {
    fn default() -> Self {
        let guid = CString::new(values().guid()).expect("a GUID holds no zero");
        Self { name: Some(c"rotor".into()), kind: CO_SIMULATION, guid: Some(guid), logging_on: false, has_logger: true }
    }
}

impl Request {
    /// fmi2Instantiate; the records where it returns null. The struct of callbacks is spoilt and gone afterwards.
    pub fn instantiate(self) -> Result<Instance, Vec<Record>> {
        let journal = Box::<Journal>::default();
        let environment: Environment = (&raw const *journal).cast_mut().cast();
        let mut callbacks = Box::new(CallbackFunctions {
            logger: self.has_logger.then_some(variadic(record)),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            environment,
        });
        let pointer = |text: &Option<CString>| text.as_ref().map_or(std::ptr::null(), |text| text.as_ptr());
        let (name, guid) = (pointer(&self.name), pointer(&self.guid));
        let resources = c"file:///nowhere/resources".as_ptr();
        let logging_on = Boolean::from(self.logging_on);
        // SAFETY: null or strings, and a struct of callbacks, all alive during the call.
        let component =
            unsafe { fmi2Instantiate(name, self.kind, guid, resources, &raw const *callbacks, FALSE, logging_on) };
        callbacks.logger = Some(variadic(gone));
        callbacks.environment = std::ptr::dangling_mut::<u64>().cast();
        drop(std::hint::black_box(callbacks));
        if component.is_null() { Err(journal.take()) } else { Ok(Instance { component, journal }) }
    }
}

/// An instance of the FMU and what it said.
pub struct Instance {
    component: Component,
    pub journal: Box<Journal>,
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: it came from fmi2Instantiate and is freed once.
        unsafe { fmi2FreeInstance(self.component) }
    }
}

/// Methods that make a call with no more than numbers.
macro_rules! plain {
    ($($name:ident($($argument:ident: $kind:ty),*): $function:ident $(($($more:expr),*))?;)*) => {
        impl Instance {$(
            pub fn $name(&mut self $(, $argument: $kind)*) -> Status {
                // SAFETY: a live instance.
                unsafe { $function(self.component $(, $argument)* $($(, $more)*)?) }
            }
        )*}
    };
}

plain! {
    enter_initialization(): fmi2EnterInitializationMode;
    exit_initialization(): fmi2ExitInitializationMode;
    do_step(from: Real, step: Real): fmi2DoStep(TRUE);
    terminate(): fmi2Terminate;
    reset(): fmi2Reset;
    set_time(time: Real): fmi2SetTime;
    enter_event_mode(): fmi2EnterEventMode;
    enter_continuous_time_mode(): fmi2EnterContinuousTimeMode;
}

/// A value as an instance gives it, in bits, or what it returned instead.
pub type Readable = Result<u64, Status>;

impl Instance {
    /// An instance that says only what goes wrong.
    pub fn quiet() -> Self {
        Request::default().instantiate().expect("the request is right")
    }

    /// One of this kind, fmi2Type, that says only what goes wrong.
    pub fn of(kind: Choice) -> Self {
        Request { kind, ..Request::default() }.instantiate().expect("the request is right")
    }

    /// An instance that says everything.
    pub fn talkative() -> Self {
        Request { logging_on: true, ..Request::default() }.instantiate().expect("the request is right")
    }

    /// Leads it through initialization with these values set; starts at 0 s.
    pub fn started(mut self, values: &[(&str, Real)]) -> Self {
        self.set_all(values);
        assert_eq!(self.setup(None, 0.0, None), Status::Ok);
        self.initialized()
    }

    /// Leads it through initialization.
    pub fn initialized(mut self) -> Self {
        assert_eq!(self.enter_initialization(), Status::Ok);
        assert_eq!(self.exit_initialization(), Status::Ok, "{:?}", self.journal.take());
        self
    }

    /// The pointer of the C interface.
    pub fn component(&self) -> Component {
        self.component
    }

    pub fn setup(&mut self, tolerance: Option<Real>, start: Real, stop: Option<Real>) -> Status {
        let (tolerance_defined, stop_defined) = (tolerance.is_some().into(), stop.is_some().into());
        // What is not defined is not looked at.
        let (tolerance, stop) = (tolerance.unwrap_or(Real::NAN), stop.unwrap_or(Real::NAN));
        // SAFETY: a live instance.
        unsafe { fmi2SetupExperiment(self.component, tolerance_defined, tolerance, start, stop_defined, stop) }
    }

    pub fn debug_logging(&mut self, on: bool, categories: &[&CStr]) -> Status {
        let names: Vec<_> = categories.iter().map(|name| name.as_ptr()).collect();
        // SAFETY: a live instance, and as many strings as told.
        unsafe { fmi2SetDebugLogging(self.component, on.into(), names.len(), names.as_ptr()) }
    }

    /// fmi2GetReal into `values`, one for each reference.
    pub fn read(&mut self, references: &[ValueReference], values: &mut [Real]) -> Status {
        assert_eq!(references.len(), values.len());
        // SAFETY: a live instance, and two arrays of the same length.
        unsafe { fmi2GetReal(self.component, references.as_ptr(), references.len(), values.as_mut_ptr()) }
    }

    /// A Real value by name.
    pub fn get(&mut self, name: &str) -> Real {
        let mut value = [Real::NAN];
        assert_eq!(self.read(&[reference(name)], &mut value), Status::Ok, "{name}: {:?}", self.journal.take());
        value[0]
    }

    /// Real values by name.
    pub fn get_all<const N: usize>(&mut self, names: [&str; N]) -> [Real; N] {
        names.map(|name| self.get(name))
    }

    /// fmi2SetReal.
    pub fn write(&mut self, references: &[ValueReference], values: &[Real]) -> Status {
        assert_eq!(references.len(), values.len());
        // SAFETY: a live instance, and two arrays of the same length.
        unsafe { fmi2SetReal(self.component, references.as_ptr(), references.len(), values.as_ptr()) }
    }

    /// fmi2SetRealInputDerivatives of one input.
    pub fn send(&mut self, input: ValueReference, order: Integer, value: Real) -> Status {
        // SAFETY: a live instance, and arrays of one.
        unsafe { fmi2SetRealInputDerivatives(self.component, &raw const input, 1, &raw const order, &raw const value) }
    }

    /// Sets Real parameters by name.
    pub fn set_all(&mut self, values: &[(&str, Real)]) {
        for (name, value) in values {
            assert_eq!(self.write(&[reference(name)], &[*value]), Status::Ok, "{name}: {:?}", self.journal.take());
        }
    }

    /// What a call writes, from `start`, or the status with which it was refused.
    fn asked<T>(&self, mut value: T, call: impl FnOnce(Component, *mut T) -> Status) -> Result<T, Status> {
        let status = call(self.component, &raw mut value);
        if status == Status::Ok { Ok(value) } else { Err(status) }
    }

    /// fmi2GetInteger of one reference.
    pub fn get_integer(&mut self, reference: ValueReference) -> Result<Integer, Status> {
        // SAFETY: a live instance, and arrays of one.
        self.asked(Integer::MIN, |c, value| unsafe { fmi2GetInteger(c, &raw const reference, 1, value) })
    }

    /// fmi2GetBoolean of one reference.
    pub fn get_boolean(&mut self, reference: ValueReference) -> Result<Boolean, Status> {
        // SAFETY: a live instance, and arrays of one.
        self.asked(Boolean::MIN, |c, value| unsafe { fmi2GetBoolean(c, &raw const reference, 1, value) })
    }

    /// fmi2SetInteger of one reference.
    pub fn set_integer(&mut self, reference: ValueReference, value: Integer) -> Status {
        // SAFETY: a live instance, and arrays of one.
        unsafe { fmi2SetInteger(self.component, &raw const reference, 1, &raw const value) }
    }

    /// Chooses the method by number.
    pub fn set_method(&mut self, number: Integer) {
        assert_eq!(self.set_integer(reference("solver.method"), number), Status::Ok);
    }

    /// What the last fmi2DoStep returned.
    pub fn step_status(&mut self) -> Result<Status, Status> {
        // SAFETY: a live instance, and a place to write to.
        self.asked(Status::Pending, |c, value| unsafe { fmi2GetStatus(c, status_kind::DO_STEP, value) })
    }

    pub fn last_successful_time(&mut self) -> Result<Real, Status> {
        // SAFETY: a live instance, and a place to write to.
        self.asked(Real::NAN, |c, value| unsafe { fmi2GetRealStatus(c, status_kind::LAST_SUCCESSFUL_TIME, value) })
    }

    pub fn terminated(&mut self) -> Result<bool, Status> {
        // SAFETY: a live instance, and a place to write to.
        let value = self.asked(-1, |c, value| unsafe { fmi2GetBooleanStatus(c, status_kind::TERMINATED, value) })?;
        assert!((0..=1).contains(&value), "fmi2True is 1 and fmi2False is 0");
        Ok(value == TRUE)
    }

    /// Its FMU state as bytes: all that it remembers.
    pub fn serialized(&self) -> Vec<u8> {
        let saved = Saved::of(self);
        let bytes = saved.bytes(self);
        saved.free(self);
        bytes
    }

    /// Everything that can be read, each on its own: all variables and all statuses. What this logs is dropped.
    pub fn snapshot(&mut self) -> Vec<(String, Readable)> {
        let kept = self.journal.take();
        let mut all = Vec::new();
        for variable in &scene().variables {
            let reference = variable.place.value_reference();
            let mut value = [Real::NAN];
            let readable = match variable.meta.kind {
                Kind::Integer | Kind::Enumeration(_) => self.get_integer(reference).map(|value| value as u64),
                Kind::Boolean => self.get_boolean(reference).map(|value| value as u64),
                Kind::Real => match self.read(&[reference], &mut value) {
                    Status::Ok => Ok(value[0].to_bits()),
                    status => Err(status),
                },
            };
            all.push((variable.name.clone(), readable));
        }
        all.push(("fmi2GetStatus".into(), self.step_status().map(|status| status as u64)));
        all.push(("fmi2GetRealStatus".into(), self.last_successful_time().map(Real::to_bits)));
        all.push(("fmi2GetBooleanStatus".into(), self.terminated().map(u64::from)));
        *self.journal.0.lock().expect("no test panics within the logger") = kept;
        all
    }

    /// The bits of all Real variables.
    pub fn bits(&mut self) -> Vec<u64> {
        let references = reals(scene());
        let mut values = vec![Real::NAN; references.len()];
        assert_eq!(self.read(&references, &mut values), Status::Ok, "{:?}", self.journal.take());
        values.into_iter().map(Real::to_bits).collect()
    }

    /// Steps `n` times by `step` from `from`; the bits of all Real variables at the end of each step.
    pub fn run(&mut self, from: Real, step: Real, n: u32) -> Vec<Vec<u64>> {
        let steps = (0..n).map(|i| {
            let status = self.do_step(from + f64::from(i) * step, step);
            assert_eq!(status, Status::Ok, "{:?}", self.journal.take());
            self.bits()
        });
        steps.collect()
    }
}

/// Checks that these are one record, of this status and of its category, in these words.
#[track_caller]
pub fn only<'r>(records: &'r [Record], status: Status, words: &[&str]) -> &'r Record {
    let [record] = records else { panic!("{words:?}: one line, not {records:?}") };
    assert_eq!((record.status, &*record.category), (status, &*format!("logStatus{status:?}")), "{record:?}");
    for word in words {
        assert!(record.message.contains(word), "{word:?} must be in {:?}", record.message);
    }
    record
}

/// Calls a function that must be refused with one log line that says so in these words, and must change nothing: neither
/// what can be read, nor what the instance remembers.
#[track_caller]
pub fn refused(instance: &mut Instance, call: impl FnOnce(Component) -> Status, words: &[&str]) {
    // The snapshot first: to read between two steps of the solver's costs evaluations, which are remembered.
    let before = (instance.snapshot(), instance.serialized());
    instance.journal.take();
    let status = call(instance.component());
    let records = instance.journal.take();
    assert_eq!(status, Status::Error, "{words:?}: {records:?}");
    only(&records, status, words);
    let bytes = instance.serialized();
    assert_eq!(before, (instance.snapshot(), bytes), "{words:?}");
}
