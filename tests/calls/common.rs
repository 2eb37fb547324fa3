//! The calls that both kinds of instance have.

use super::Actor;
use super::arguments::*;
use super::check::{ANY, ERROR, OK, OK_OR_DISCARD, Told};
use super::source::Source;
use crate::harness::{Instance, Request, Stage, reals, scene};
use split_rotor::abi::*;
use split_rotor::exports::*;
use split_rotor_model::variables::TOLERANCES;
use std::sync::OnceLock;

/// What a call may return whose arguments are right, or are not.
fn ok_if(right: bool) -> &'static [Status] {
    if right { OK } else { ERROR }
}

/// fmi2Instantiate with something wrong: no instance, and one line that says why.
pub fn refused_instantiation(source: &mut Source) {
    let right = Request::default();
    let wrong = match source.below(5) {
        0 => Request { guid: None, ..right },
        1 => Request { guid: Some(c"{00000000-0000-0000-0000-000000000000}".into()), ..right },
        2 => Request { name: None, ..right },
        3 => Request { name: Some(c" \t".into()), ..right },
        _ => Request { kind: source.of(&[2, -1, Choice::MAX, Choice::MIN]), ..right },
    };
    let Err(records) = wrong.instantiate() else { panic!("the request is wrong") };
    assert!(matches!(&records[..], [record] if record.status == Status::Error), "{records:?}");
}

impl Actor {
    pub fn common_call(&mut self, source: &mut Source) {
        match source.below(16) {
            0 => self.set_debug_logging(source),
            1 => self.setup_experiment(source),
            2 => self.enter_initialization(),
            3 => self.exit_initialization(),
            4 => self.terminate(),
            5 => self.reset(),
            6..=7 => self.get_real(source),
            8 => self.get_integer(source),
            9 => self.get_or_set_another_type(source),
            10 => self.set_a_parameter(source),
            11..=13 => self.set_real(source),
            14 => self.set_integer(source),
            _ => self.directional_derivative(source),
        }
    }

    fn set_debug_logging(&mut self, source: &mut Source) {
        let known =
            [c"logEvents", c"logSolver", c"logStatusWarning", c"logStatusDiscard", c"logStatusError", c"logAll"];
        let on = source.chance(160);
        let mut names = Vec::new();
        let mut right = true;
        for _ in 0..source.below(3) {
            if source.chance(40) {
                right = false;
                names.push(source.of(&[c"logall".as_ptr(), c"".as_ptr(), c"%s".as_ptr(), std::ptr::null()]));
            } else {
                names.push(source.of(&known).as_ptr());
            }
        }
        let (pointer, is_wrong) = pointer(source, &names);
        let told = Told { function: "fmi2SetDebugLogging", may: ok_if(right && !is_wrong) };
        let call = |instance: &mut Instance| {
            // SAFETY: a live instance; null, or as many strings or nulls as told.
            unsafe { fmi2SetDebugLogging(instance.component(), on.into(), names.len(), pointer) }
        };
        if self.call(&told, call) == Status::Ok {
            let names_it = |name: &std::ffi::CStr| {
                names.iter().any(|pointer| {
                    // SAFETY: they were accepted: all are strings, and none is null.
                    let given = unsafe { std::ffi::CStr::from_ptr(*pointer) };
                    given == name || given == c"logAll"
                }) || names.is_empty()
            };
            // What is enabled by name disables the rest; what is disabled by name leaves the rest.
            let after = |heard: bool, name: &std::ffi::CStr| if on { names_it(name) } else { heard && !names_it(name) };
            self.mind.hears_errors = after(self.mind.hears_errors, c"logStatusError");
            self.mind.hears_discards = after(self.mind.hears_discards, c"logStatusDiscard");
        }
    }

    pub fn setup_experiment(&mut self, source: &mut Source) {
        let tolerance = source.chance(128).then(|| if source.chance(128) { 1e-6 } else { source.number() });
        let start = if source.chance(128) { source.number() } else { 0.0 };
        let stop = source.chance(64).then(|| if source.chance(128) { start + 0.5 } else { source.number() });
        let right = start.is_finite()
            && stop.is_none_or(|stop| stop >= start)
            && tolerance.is_none_or(|tolerance| TOLERANCES.holds(tolerance));
        let told = Told { function: "fmi2SetupExperiment", may: ok_if(right) };
        if self.call(&told, |instance| instance.setup(tolerance, start, stop)) == Status::Ok {
            self.mind.memory.now = start;
            self.mind.memory.stop = stop;
        }
    }

    pub fn enter_initialization(&mut self) {
        let told = Told { function: "fmi2EnterInitializationMode", may: OK };
        if self.call(&told, Instance::enter_initialization) == Status::Ok {
            self.mind.memory.life.stage = Stage::Initialization;
        }
    }

    /// Parameters that the scene has are possible; others may not be.
    pub fn exit_initialization(&mut self) {
        let may = if self.mind.memory.touched { &[Status::Ok, Status::Error] } else { OK };
        let told = Told { function: "fmi2ExitInitializationMode", may };
        if self.call(&told, Instance::exit_initialization) == Status::Ok {
            let is_exchange = self.mind.memory.life.kind == MODEL_EXCHANGE;
            self.mind.memory.life.stage = if is_exchange { Stage::EventMode } else { Stage::StepComplete };
            self.look();
        }
    }

    fn terminate(&mut self) {
        let told = Told { function: "fmi2Terminate", may: OK };
        if self.call(&told, Instance::terminate) == Status::Ok {
            self.mind.memory.life.stage = Stage::Terminated;
        }
    }

    pub fn reset(&mut self) {
        let told = Told { function: "fmi2Reset", may: OK };
        if self.call(&told, Instance::reset) == Status::Ok {
            self.mind.reset();
            self.hurry();
        }
    }

    /// What reading what is calculated may return.
    pub fn calculation(&self) -> &'static [Status] {
        match self.mind.memory.life.stage {
            // What follows from parameters that are not possible is not calculated.
            Stage::Instantiated | Stage::Initialization if self.mind.memory.touched => ANY,
            _ => OK_OR_DISCARD,
        }
    }

    /// Sets a parameter to about the scene's value.
    pub fn set_a_parameter(&mut self, source: &mut Source) {
        let reference = reference(source, |variable| is_real(variable) && is_parameter(variable));
        let start = scene().starts.get(&reference).copied().unwrap_or_default();
        let value = source.about(start);
        self.set(&[reference], &[value], false);
    }

    fn set_real(&mut self, source: &mut Source) {
        let wants_input = source.chance(128);
        let references = references(source, if wants_input { is_input } else { |v| is_real(v) && is_parameter(v) });
        let values: Vec<Real> = references.iter().map(|_| source.number()).collect();
        self.set(&references, &values, source.chance(6));
    }

    /// Sets these, or, with `null`, from an array that is not there.
    fn set(&mut self, references: &[ValueReference], values: &[Real], null: bool) {
        let v = if null { std::ptr::null() } else { values.as_ptr() };
        let has_started = self.mind.memory.life.stage.has_started();
        let right = |(reference, value): (&ValueReference, &Real)| {
            variable(*reference).is_some_and(|variable| {
                is_real(variable) && (is_parameter(variable) && !has_started || is_input(variable) && value.is_finite())
            })
        };
        let right = (!null || values.is_empty()) && references.iter().zip(values).all(right);
        let told = Told { function: "fmi2SetReal", may: ok_if(right) };
        // SAFETY: a live instance; null, or arrays of one length.
        let call = |instance: &mut Instance| unsafe {
            fmi2SetReal(instance.component(), references.as_ptr(), references.len(), v)
        };
        if self.call(&told, call) != Status::Ok {
            return;
        }
        for (reference, value) in references.iter().zip(values) {
            if variable(*reference).is_some_and(is_parameter) {
                self.mind.memory.touched = true;
                self.mind.memory.parameters.insert(*reference, *value);
            } else {
                let mut got = [Real::NAN];
                assert_eq!(self.instance.read(&[*reference], &mut got), Status::Ok);
                let last = references.iter().zip(values).rfind(|(other, _)| *other == reference).expect("it is there");
                assert_eq!(got[0], *last.1, "an input has the value that it was given");
            }
        }
    }

    fn set_integer(&mut self, source: &mut Source) {
        let references = references(source, |variable| is_integer(variable) && is_parameter(variable));
        let values: Vec<Integer> =
            references.iter().map(|_| source.of(&[2, 3, 2, 3, 2, 3, 0, 1, -1, Integer::MAX, Integer::MIN])).collect();
        let (r, r_is_wrong) = pointer(source, &references);
        let (v, v_is_wrong) = pointer(source, &values);
        let right = all_are(&references, |variable| is_integer(variable) && is_parameter(variable));
        let told = Told { function: "fmi2SetInteger", may: ok_if(right && !r_is_wrong && !v_is_wrong) };
        // SAFETY: a live instance; null, or arrays of one length.
        let call = |instance: &mut Instance| unsafe { fmi2SetInteger(instance.component(), r, references.len(), v) };
        if self.call(&told, call) == Status::Ok && !references.is_empty() {
            self.mind.memory.touched = true;
            for (reference, value) in references.iter().zip(&values) {
                self.mind.memory.parameters.insert(*reference, f64::from(*value));
            }
        }
    }

    fn get_real(&mut self, source: &mut Source) {
        let references = references(source, is_real);
        let mut values = vec![0.5; references.len()];
        let (r, r_is_wrong) = pointer(source, &references);
        let (v, v_is_wrong) = place(source, &mut values);
        let is_wrong = r_is_wrong || v_is_wrong || !all_are(&references, is_real);
        let calculates = references.iter().any(|reference| variable(*reference).is_some_and(is_calculated));
        let may = if is_wrong || !calculates { ok_if(!is_wrong) } else { self.calculation() };
        let told = Told { function: "fmi2GetReal", may };
        // SAFETY: a live instance; null, or arrays of one length.
        let call = |instance: &mut Instance| unsafe { fmi2GetReal(instance.component(), r, references.len(), v) };
        match self.call(&told, call) {
            Status::Ok => self.check_values(&references, &values),
            Status::Error => assert!(values.iter().all(|value| *value == 0.5), "nothing is written"),
            _ => {}
        }
    }

    /// Parameters are what they were set to; what is calculated is finite.
    fn check_values(&self, references: &[ValueReference], values: &[Real]) {
        for (reference, value) in references.iter().zip(values) {
            match self.mind.memory.parameters.get(reference) {
                Some(parameter) if variable(*reference).is_some_and(is_parameter) => {
                    assert_eq!(value.to_bits(), parameter.to_bits(), "{reference}");
                }
                _ => assert!(value.is_finite(), "{:?} = {value}", variable(*reference).map(|variable| &variable.name)),
            }
        }
    }

    fn get_integer(&mut self, source: &mut Source) {
        let references = references(source, is_integer);
        let mut values = vec![77; references.len()];
        let (r, r_is_wrong) = pointer(source, &references);
        let (v, v_is_wrong) = place(source, &mut values);
        let is_wrong = r_is_wrong || v_is_wrong || !all_are(&references, is_integer);
        let calculates = references.iter().any(|reference| variable(*reference).is_some_and(is_calculated));
        let may = if is_wrong || !calculates { ok_if(!is_wrong) } else { self.calculation() };
        let told = Told { function: "fmi2GetInteger", may };
        // SAFETY: a live instance; null, or arrays of one length.
        let call = |instance: &mut Instance| unsafe { fmi2GetInteger(instance.component(), r, references.len(), v) };
        if self.call(&told, call) != Status::Ok {
            return;
        }
        for (reference, value) in references.iter().zip(&values) {
            match self.mind.memory.parameters.get(reference) {
                Some(parameter) => assert_eq!(f64::from(*value), *parameter),
                None => assert!((1..=2).contains(value), "state.chart is 1 or 2"),
            }
        }
    }

    /// Booleans, and texts, of which there are no variables.
    fn get_or_set_another_type(&mut self, source: &mut Source) {
        let references = references(source, |variable| is_boolean(variable) && is_parameter(variable));
        let (r, n) = (references.as_ptr(), references.len());
        // A start at rest is sought anew after each change, which takes its time.
        let (mut truths, mut texts) = ([source.of(&[0, 0, 0, 0, 0, 0, 0, 1]); 3], [c"".as_ptr(); 3]);
        let may = ok_if(references.is_empty());
        let may_be_true = ok_if(all_are(&references, is_boolean));
        // SAFETY (of the calls below): a live instance; arrays of at least as many as told.
        match source.below(4) {
            0 => {
                let told = Told { function: "fmi2GetBoolean", may: may_be_true };
                // SAFETY: see above.
                let call = |i: &mut Instance| unsafe { fmi2GetBoolean(i.component(), r, n, truths.as_mut_ptr()) };
                if self.call(&told, call) == Status::Ok {
                    for (reference, truth) in references.iter().zip(truths) {
                        let known = self.mind.memory.parameters.get(reference);
                        assert!(known.is_none_or(|known| *known == f64::from(truth)), "{reference} is {truth}");
                    }
                }
            }
            1 => {
                let told = Told { function: "fmi2SetBoolean", may: may_be_true };
                // SAFETY: see above.
                let call = |i: &mut Instance| unsafe { fmi2SetBoolean(i.component(), r, n, truths.as_ptr()) };
                if self.call(&told, call) == Status::Ok && !references.is_empty() {
                    self.mind.memory.touched = true;
                    for (reference, truth) in references.iter().zip(truths) {
                        self.mind.memory.parameters.insert(*reference, f64::from(truth));
                    }
                }
            }
            2 => {
                let told = Told { function: "fmi2GetString", may };
                // SAFETY: see above.
                self.call(&told, |i| unsafe { fmi2GetString(i.component(), r, n, texts.as_mut_ptr()) });
            }
            _ => {
                let told = Told { function: "fmi2SetString", may };
                // SAFETY: see above.
                self.call(&told, |i| unsafe { fmi2SetString(i.component(), r, n, texts.as_ptr()) });
            }
        }
    }

    fn directional_derivative(&mut self, source: &mut Source) {
        let unknown = references(source, is_unknown);
        let known = references(source, is_known);
        let seeds: Vec<Real> = known.iter().map(|_| source.number()).collect();
        let mut values = vec![0.5; unknown.len()];
        let (u, u_is_wrong) = pointer(source, &unknown);
        let (k, k_is_wrong) = pointer(source, &known);
        let (s, s_is_wrong) = pointer(source, &seeds);
        let (v, v_is_wrong) = place(source, &mut values);
        let right = !(u_is_wrong || k_is_wrong || s_is_wrong || v_is_wrong)
            && all_are(&unknown, is_unknown)
            && all_are(&known, is_known)
            && seeds.iter().all(|seed| seed.is_finite());
        let told =
            Told { function: "fmi2GetDirectionalDerivative", may: if right { self.calculation() } else { ERROR } };
        // SAFETY: a live instance; null, or arrays as long as told.
        let call = |instance: &mut Instance| unsafe {
            fmi2GetDirectionalDerivative(instance.component(), u, unknown.len(), k, known.len(), s, v)
        };
        match self.call(&told, call) {
            Status::Ok => assert!(values.iter().all(|value| value.is_finite()), "{unknown:?}, {known:?}: {values:?}"),
            Status::Error => assert!(values.iter().all(|value| *value == 0.5), "nothing is written"),
            _ => {}
        }
    }

    /// Reads everything at once: with fmi2OK, every number is finite, and every parameter is what it was set to.
    pub fn look(&mut self) {
        static ALL: OnceLock<Vec<ValueReference>> = OnceLock::new();
        let references = ALL.get_or_init(|| reals(scene()));
        let mut values = vec![Real::NAN; references.len()];
        let told = Told { function: "fmi2GetReal", may: self.calculation() };
        if self.call(&told, |instance| instance.read(references, &mut values)) == Status::Ok {
            self.check_values(references, &values);
        }
    }
}
