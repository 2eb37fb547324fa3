//! The calls of co-simulation.

use super::Actor;
use super::arguments::*;
use super::check::{ERROR, OK, OK_OR_DISCARD, Told};
use super::source::Source;
use crate::harness::{Instance, Stage, reference};
use split_rotor::abi::*;
use split_rotor::exports::*;
use split_rotor_model::scalar::ulp;

/// What may be evaluated in a step beyond what solver.max_evaluations says: a step that was begun.
const BEGUN: Real = 2e5;

/// Steps [s] that a host makes.
const STEPS: [Real; 8] = [1e-3, 3e-3, 0.01, 0.01, 1.0 / 64.0, 0.02, 0.05, 0.1];

const MOST: &str = "solver.max_evaluations";

/// Steps that are far too long are made again and again: each may cost so many evaluations.
const FEW: Real = 1e4;

impl Actor {
    /// What a host does that does not want to wait.
    pub fn hurry(&mut self) {
        let most = reference(MOST);
        assert_eq!(self.instance.write(&[most], &[FEW]), Status::Ok);
        self.mind.memory.parameters.insert(most, FEW);
    }

    pub fn stepping_call(&mut self, source: &mut Source) {
        match source.below(12) {
            0..=3 => self.step(source),
            4..=6 => self.set_input_derivatives(source),
            7..=8 => self.output_derivatives(source),
            9 => {
                self.call(&Told { function: "fmi2CancelStep", may: ERROR }, |instance| {
                    // SAFETY: a live instance.
                    unsafe { fmi2CancelStep(instance.component()) }
                });
            }
            _ => self.status(source),
        }
    }

    /// A step as a host makes it, now and then one that is far too long.
    pub fn step_on(&mut self, source: &mut Source) {
        let step = if source.chance(8) { 1e300 } else { source.of(&STEPS) };
        self.do_step(self.mind.memory.now, step);
    }

    fn step(&mut self, source: &mut Source) {
        let now = self.mind.memory.now;
        let step = if source.chance(128) {
            source.of(&[0.0, -0.0, -0.01, 1.0, 1e-18, Real::NAN, Real::INFINITY, 5e-324, 1e300, Real::MAX])
        } else {
            source.of(&STEPS)
        };
        let from = if source.chance(32) { source.of(&[now + 0.01, now - 0.01, -now, Real::NAN, 1e300]) } else { now };
        self.do_step(from, step);
    }

    /// A step that is far too long only where the solver may not evaluate long for it: nine tenths of the time would go there.
    fn do_step(&mut self, from: Real, step: Real) {
        let is_endless = step > 1.0 && step.is_finite() && self.mind.memory.parameters[&reference(MOST)] > FEW;
        let step = if is_endless { STEPS[0] } else { step };
        let (now, to) = (self.mind.memory.now, from + step);
        let same = |a: Real, b: Real| (a - b).abs() <= 1e-9 * step + 4.0 * ulp(b);
        let right = step.is_finite()
            && step > 0.0
            && same(from, now)
            && to > now
            && self.mind.memory.stop.is_none_or(|stop| to <= stop || same(to, stop));
        let told = Told { function: "fmi2DoStep", may: if right { OK_OR_DISCARD } else { ERROR } };
        let spent = self.evaluations();
        match self.call(&told, |instance| instance.do_step(from, step)) {
            Status::Ok => {
                self.mind.memory.now = to;
                self.mind.memory.life.stage = Stage::StepComplete;
                assert_eq!(self.instance.last_successful_time().map(Real::to_bits), Ok(to.to_bits()));
                assert_eq!((self.instance.step_status(), self.instance.terminated()), (Ok(Status::Ok), Ok(false)));
            }
            Status::Discard => {
                let last = self.instance.last_successful_time().expect("it can be asked for");
                assert!((now..=to).contains(&last), "{last:?} is not between {now:?} and {to:?}");
                self.mind.memory.now = last;
                self.mind.memory.life.stage = Stage::StepFailed;
                assert_eq!((self.instance.step_status(), self.instance.terminated()), (Ok(Status::Discard), Ok(true)));
            }
            _ => return,
        }
        if let (Some(before), Some(after)) = (spent, self.evaluations()) {
            let most = self.mind.memory.parameters[&reference(MOST)] + BEGUN;
            assert!(after - before <= most, "a step took {} evaluations", after - before);
        }
        self.look();
    }

    /// What the solver spent so far, where it can be read.
    fn evaluations(&mut self) -> Option<Real> {
        if !self.mind.allows("fmi2DoStep") {
            return None;
        }
        let mut value = [Real::NAN];
        let status = self.instance.read(&[reference("solver.evaluations")], &mut value);
        (status == Status::Ok).then_some(value[0])
    }

    fn set_input_derivatives(&mut self, source: &mut Source) {
        let references = references(source, is_input);
        let orders: Vec<Integer> =
            references.iter().map(|_| source.of(&[1, 2, 3, 1, 2, 3, 1, 2, 0, 4, -1, Integer::MIN])).collect();
        let values: Vec<Real> = references.iter().map(|_| source.number()).collect();
        let (r, r_is_wrong) = pointer(source, &references);
        let (o, o_is_wrong) = pointer(source, &orders);
        let (v, v_is_wrong) = pointer(source, &values);
        let right = !(r_is_wrong || o_is_wrong || v_is_wrong)
            && all_are(&references, is_input)
            && orders.iter().all(|order| (1..=3).contains(order))
            && values.iter().all(|value| value.is_finite());
        let told = Told { function: "fmi2SetRealInputDerivatives", may: if right { OK } else { ERROR } };
        // SAFETY: a live instance; null, or arrays of one length.
        self.call(&told, |instance| unsafe {
            fmi2SetRealInputDerivatives(instance.component(), r, references.len(), o, v)
        });
    }

    fn output_derivatives(&mut self, source: &mut Source) {
        let references = references(source, is_output);
        let orders: Vec<Integer> = references.iter().map(|_| source.of(&[1, 1, 1, 1, 1, 1, 1, 0, 2, -1])).collect();
        let mut values = vec![0.5; references.len()];
        let (r, r_is_wrong) = pointer(source, &references);
        let (o, o_is_wrong) = pointer(source, &orders);
        let (v, v_is_wrong) = place(source, &mut values);
        let right = !(r_is_wrong || o_is_wrong || v_is_wrong)
            && all_are(&references, is_output)
            && orders.iter().all(|order| *order == 1);
        let told =
            Told { function: "fmi2GetRealOutputDerivatives", may: if right { self.calculation() } else { ERROR } };
        // SAFETY: a live instance; null, or arrays of one length.
        let call = |instance: &mut Instance| unsafe {
            fmi2GetRealOutputDerivatives(instance.component(), r, references.len(), o, v)
        };
        match self.call(&told, call) {
            Status::Ok => assert!(values.iter().all(|value| value.is_finite()), "{references:?}: {values:?}"),
            Status::Error => assert!(values.iter().all(|value| *value == 0.5), "nothing is written"),
            _ => {}
        }
    }

    fn status(&mut self, source: &mut Source) {
        let kind = source.of(&[0, 1, 2, 3, -1, 4, Choice::MAX]);
        let is_null = source.chance(16);
        let answers = |right: Choice| if kind == right && !is_null { OK } else { ERROR };
        let (mut status, mut time, mut number, mut truth, mut text) = (Status::Pending, 0.5, 77, 77, c"".as_ptr());
        fn place<T>(value: &mut T, is_null: bool) -> *mut T {
            if is_null { std::ptr::null_mut() } else { value }
        }
        match source.below(5) {
            0 => {
                let told = Told { function: "fmi2GetStatus", may: answers(status_kind::DO_STEP) };
                let at = place(&mut status, is_null);
                // SAFETY: a live instance, and null or a place to write to; the same below.
                self.call(&told, |i| unsafe { fmi2GetStatus(i.component(), kind, at) });
            }
            1 => {
                let told = Told { function: "fmi2GetRealStatus", may: answers(status_kind::LAST_SUCCESSFUL_TIME) };
                let at = place(&mut time, is_null);
                // SAFETY: see above.
                let answer = self.call(&told, |i| unsafe { fmi2GetRealStatus(i.component(), kind, at) });
                assert!(answer != Status::Ok || time == self.mind.memory.now);
            }
            2 => {
                let told = Told { function: "fmi2GetBooleanStatus", may: answers(status_kind::TERMINATED) };
                let at = place(&mut truth, is_null);
                // SAFETY: see above.
                self.call(&told, |i| unsafe { fmi2GetBooleanStatus(i.component(), kind, at) });
            }
            3 => {
                let told = Told { function: "fmi2GetIntegerStatus", may: ERROR };
                // SAFETY: see above.
                self.call(&told, |i| unsafe { fmi2GetIntegerStatus(i.component(), kind, &raw mut number) });
            }
            _ => {
                let told = Told { function: "fmi2GetStringStatus", may: ERROR };
                // SAFETY: see above.
                self.call(&told, |i| unsafe { fmi2GetStringStatus(i.component(), kind, &raw mut text) });
            }
        }
    }
}
