//! Bytes as a sequence of FMI calls, legal and illegal, on a few instances of both kinds and their saved states.
//!
//! `play` makes the calls and checks each against what `mind` knows of the standard: which status a call may have, that a
//! refusal is told in one line and changes nothing that the instance remembers, that nothing comes out with fmi2OK that
//! is not finite, that a saved state brings back every bit. The random tests and the fuzz target share it.

mod arguments;
mod check;
mod common;
mod exchange;
mod mind;
mod saving;
mod source;
mod stepping;

use crate::harness::{Instance, Saved};
pub use check::{Tally, take_tally};

use check::Told;
use mind::{Memory, Mind};
use source::Source;
use split_rotor::abi::{CO_SIMULATION, Choice, MODEL_EXCHANGE};

/// An instance and what should be known of it.
struct Actor {
    instance: Instance,
    mind: Mind,
}

/// A saved state, what should be known of an instance that gets it, and its bytes.
struct Kept {
    saved: Saved,
    memory: Memory,
    bytes: Vec<u8>,
}

/// A saved state on its way, as bytes.
struct Parcel {
    /// As they were written.
    whole: Vec<u8>,
    /// As they arrive.
    bytes: Vec<u8>,
    memory: Memory,
}

/// Everything that a sequence plays with.
struct Theatre {
    actors: Vec<Actor>,
    shelf: Vec<Kept>,
    parcels: Vec<Parcel>,
}

/// So many instances, saved states and parcels are there at most.
const MOST: usize = 3;

/// Makes the calls that the bytes stand for.
pub fn play(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let mut theatre = Theatre { actors: Vec::new(), shelf: Vec::new(), parcels: Vec::new() };
    theatre.enter(if source.chance(128) { CO_SIMULATION } else { MODEL_EXCHANGE });
    while !source.has_ended() {
        theatre.act(&mut source);
    }
    theatre.clear();
}

impl Theatre {
    fn enter(&mut self, kind: Choice) {
        let mut actor = Actor { instance: Instance::of(kind), mind: Mind::new(kind) };
        actor.hurry();
        self.actors.push(actor);
    }

    fn act(&mut self, source: &mut Source) {
        if self.actors.is_empty() {
            self.enter(source.of(&[CO_SIMULATION, MODEL_EXCHANGE]));
        }
        let n = source.below(self.actors.len());
        let actor = &mut self.actors[n];
        match source.below(16) {
            // Most of the time life goes on, or nothing would ever be reached.
            0..=5 => actor.go_on(source),
            6 => actor.go_on_twice(source),
            7..=9 => actor.common_call(source),
            10..=12 => actor.call_of_its_kind(source),
            13..=14 => self.saving_call(n, source),
            _ => self.come_and_go(n, source),
        }
        if let Some(actor) = self.actors.get_mut(n)
            && source.chance(64)
        {
            actor.look();
        }
    }

    fn come_and_go(&mut self, n: usize, source: &mut Source) {
        match source.below(4) {
            0 if self.actors.len() < MOST => self.enter(source.of(&[CO_SIMULATION, MODEL_EXCHANGE])),
            1 => drop(self.actors.swap_remove(n)),
            2 => common::refused_instantiation(source),
            _ => self.actors[n].reset(),
        }
    }

    fn clear(mut self) {
        if self.actors.is_empty() {
            self.enter(CO_SIMULATION);
        }
        for kept in self.shelf {
            kept.saved.free(&self.actors[0].instance);
        }
    }
}

impl Actor {
    /// What a host would call next that wants a run.
    fn go_on(&mut self, source: &mut Source) {
        use crate::harness::Stage::*;
        match self.mind.memory.life.stage {
            Instantiated if source.chance(160) => self.set_a_parameter(source),
            Instantiated if source.chance(64) => self.setup_experiment(source),
            Instantiated => self.enter_initialization(),
            Initialization => self.exit_initialization(),
            StepComplete => self.step_on(source),
            EventMode => self.settle(),
            ContinuousTime => self.integrate(source),
            // Both are hard to reach, and should not be left at once.
            StepFailed | Terminated if source.chance(112) => self.common_call(source),
            StepFailed | Terminated if source.chance(192) => self.call_of_its_kind(source),
            StepFailed | Terminated => self.reset(),
        }
    }

    /// Now and then one of the other kind.
    fn call_of_its_kind(&mut self, source: &mut Source) {
        if (self.mind.memory.life.kind == MODEL_EXCHANGE) == source.chance(224) {
            self.exchange_call(source);
        } else {
            self.stepping_call(source);
        }
    }

    /// The same again from the same state, here and in another instance that gets it as bytes: every bit must be the same.
    fn go_on_twice(&mut self, source: &mut Source) {
        let saved = Saved::of(&self.instance);
        let (memory, bytes) = (self.mind.memory.clone(), saved.bytes(&self.instance));
        let again = source.clone();
        self.go_on(source);
        let expected = self.instance.serialized();
        let end = self.mind.memory.clone();

        saved.restore(&self.instance);
        saved.free(&self.instance);
        self.mind.memory = memory.clone();
        self.go_on(&mut again.clone());
        assert!(self.instance.serialized() == expected, "after a rollback: {:?}", self.mind.memory.life);

        let mut other = Self { instance: Instance::of(memory.life.kind), mind: Mind::new(memory.life.kind) };
        Saved::unpack(&other.instance, &bytes);
        other.mind.memory = memory;
        other.go_on(&mut again.clone());
        assert!(other.instance.serialized() == expected, "in another instance: {:?}", self.mind.memory.life);
        assert_eq!(self.mind.memory.life, end.life);
    }

    /// A call that may have one of the outcomes that `told` names.
    fn call(
        &mut self,
        told: &Told,
        call: impl FnOnce(&mut Instance) -> split_rotor::abi::Status,
    ) -> split_rotor::abi::Status {
        check::call(self, told, call)
    }
}
