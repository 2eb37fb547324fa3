//! Random journeys of an instance: of either kind, with any method, through steps of any size, with inputs and their
//! derivatives set on the way where the scene has some.
#![allow(dead_code, reason = "each test file uses a part")]

use crate::harness::{Instance, inputs, there};
use proptest::collection::vec;
use proptest::prelude::*;
use split_rotor::abi::{CO_SIMULATION, Choice, Integer, MODEL_EXCHANGE, Real, Status};

/// A step, and what is sent before it to every input.
#[derive(Clone, Debug)]
pub struct Leg {
    /// As a part of the longest step of the kind.
    size: Real,
    /// Values (order 0) and derivatives, in this order.
    sent: Vec<(Integer, Real)>,
}

/// A life up to a point, a way on from there, and another one.
#[derive(Clone, Debug)]
pub struct Journey {
    pub kind: Choice,
    method: Integer,
    start: usize,
    pub before: Vec<Leg>,
    pub after: Vec<Leg>,
    pub detour: Vec<Leg>,
}

/// The scene's own start; a damped one; one that tumbles through both charts.
const STARTS: [&[(&str, Real)]; 3] = [
    &[],
    &[("support.d1", 30.0), ("support.d2", 0.5)],
    &[("support.c2", 0.0), ("start.omega.x", 1.0), ("start.omega.y", 20.0)],
];

fn leg() -> impl Strategy<Value = Leg> {
    let sent = prop_oneof![(Just(0), -5.0..5.0_f64), (Just(1), -50.0..50.0_f64), (Just(2), -500.0..500.0_f64),];
    (1e-3..1.0_f64, vec(sent, 0..4)).prop_map(|(size, sent)| Leg { size, sent })
}

/// Any journey.
pub fn journey() -> impl Strategy<Value = Journey> {
    let (kind, method) = (prop_oneof![Just(CO_SIMULATION), Just(MODEL_EXCHANGE)], 1..=5);
    let legs = (vec(leg(), 0..8), vec(leg(), 1..8), vec(leg(), 0..4));
    (kind, method, 0..STARTS.len(), legs).prop_map(|(kind, method, start, (before, after, detour))| Journey {
        kind,
        method,
        start,
        before,
        after,
        detour,
    })
}

/// What a step returned, and the bits of all Real variables after it.
pub type Shown = (Status, Vec<u64>);

impl Journey {
    /// An instance at the point, and the time there [s].
    pub fn traveller(&self) -> (Instance, Real) {
        let mut instance = Instance::of(self.kind);
        instance.set_method(self.method);
        let mut instance = instance.started(&there(STARTS[self.start]));
        if self.kind == MODEL_EXCHANGE {
            instance.settled();
        }
        let mut now = 0.0;
        self.walk(&mut instance, &mut now, &self.before);
        (instance, now)
    }

    /// Makes these legs from time `now` [s]; what all variables show after each, up to a step that cannot be done.
    pub fn walk(&self, instance: &mut Instance, now: &mut Real, legs: &[Leg]) -> Vec<Shown> {
        let mut shown = Vec::new();
        for Leg { size, sent } in legs {
            for (input, (order, value)) in inputs().iter().flat_map(|input| sent.iter().map(move |sent| (*input, sent)))
            {
                let status = match order {
                    0 => instance.write(&[input], &[*value]),
                    _ if self.kind == MODEL_EXCHANGE => continue,
                    _ => instance.send(input, *order, *value),
                };
                assert_eq!(status, Status::Ok, "{:?}", instance.journal.take());
            }
            let status = if self.kind == MODEL_EXCHANGE {
                instance.midpoint_step(*now, size * 2e-3)
            } else {
                instance.do_step(*now, size * 0.1)
            };
            if status != Status::Ok {
                // Where it stands can be read all the same, of an instance that steps itself.
                let bits = if self.kind == CO_SIMULATION { instance.bits() } else { Vec::new() };
                *now = instance.last_successful_time().unwrap_or(*now);
                shown.push((status, bits));
                return shown;
            }
            *now += if self.kind == MODEL_EXCHANGE { size * 2e-3 } else { size * 0.1 };
            shown.push((status, instance.bits()));
        }
        shown
    }

    /// The way on, from an instance that stands at the point.
    pub fn way_on(&self, instance: &mut Instance, now: Real) -> Vec<Shown> {
        self.walk(instance, &mut { now }, &self.after)
    }

    /// The other way.
    pub fn detour(&self, instance: &mut Instance, now: Real) {
        self.walk(instance, &mut { now }, &self.detour);
        instance.journal.take();
    }

    /// Another instance of the same kind, without a past.
    pub fn stranger(&self) -> Instance {
        Instance::of(self.kind)
    }
}
