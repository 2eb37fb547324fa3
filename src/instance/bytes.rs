//! An FMU state as bytes, readable in another process: magic, version, scene, length, numbers, checksum.

use super::{Experiment, Failure, Instance, Memory, State};
use crate::scene;
use split_rotor_model::section::GUID;
use split_rotor_model::simulation::Integrator;
use split_rotor_model::stored::{self, Damaged, Stored, Walk, choice};

/// What the bytes begin with.
const MAGIC: &[u8; 8] = b"rotorFMU";

/// Changes whenever what is stored does.
const VERSION: u32 = 5;

/// Magic, version, GUID, length of the numbers.
const HEAD: usize = MAGIC.len() + 4 + GUID + 8;

/// The checksum, CRC-32 of all before it.
const TAIL: usize = 4;

impl Memory {
    /// The state as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let numbers = stored::to_bytes(&mut self.clone());
        let mut bytes = Vec::with_capacity(HEAD + numbers.len() + TAIL);
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(scene::values().guid().as_bytes());
        bytes.extend((numbers.len() as u64).to_le_bytes());
        bytes.extend(numbers);
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        bytes
    }
}

impl Instance {
    /// The state behind these bytes; an error where they are damaged, of another version, scene or kind of instance.
    pub fn memory_of(&self, bytes: &[u8]) -> Result<Memory, Failure> {
        let mut memory = Memory::new(self.memory.integrator());
        let numbers = numbers(bytes).map_err(Failure::Error)?;
        stored::from_bytes(&mut memory, numbers).map_err(|Damaged| Failure::Error(DAMAGED.into()))?;
        self.check_kind(&memory)?;
        Ok(memory)
    }
}

const DAMAGED: &str =
    "the serialized FMU state is damaged: its checksum or its length is wrong, or its numbers mean nothing";

/// The numbers between head and checksum.
fn numbers(bytes: &[u8]) -> Result<&[u8], String> {
    let rest = bytes.strip_prefix(MAGIC).ok_or("the bytes are not a serialized state of a split-rotor FMU")?;
    let (version, rest) = rest.split_first_chunk().ok_or(DAMAGED)?;
    let version = u32::from_le_bytes(*version);
    if version != VERSION {
        return Err(format!("the serialized FMU state has version {version}, and this FMU reads version {VERSION}"));
    }
    let (guid, rest) = rest.split_at_checked(GUID).ok_or(DAMAGED)?;
    let (guid, values) = (String::from_utf8_lossy(guid), scene::values());
    if guid != values.guid() {
        return Err(format!("the serialized FMU state is one of {guid}, another FMU: this one is {}", values.guid()));
    }
    let (length, rest) = rest.split_first_chunk().ok_or(DAMAGED)?;
    let (numbers, sum) = rest.split_last_chunk::<TAIL>().ok_or(DAMAGED)?;
    let whole = &bytes[..bytes.len() - TAIL];
    if u64::from_le_bytes(*length) != numbers.len() as u64 || u32::from_le_bytes(*sum) != crc32fast::hash(whole) {
        return Err(DAMAGED.into());
    }
    Ok(numbers)
}

/// The states in which a memory can be saved.
const STATES: [State; 7] = [
    State::Instantiated,
    State::Initialization,
    State::StepComplete,
    State::StepFailed,
    State::EventMode,
    State::ContinuousTime,
    State::Terminated,
];

impl Stored for Memory {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let Self { state, simulation, experiment, step_failed, warned, learnt, doubted } = self;
        choice(state, &STATES, walk)?;
        simulation.walk(walk)?;
        let kinds = match state {
            State::Instantiated | State::Initialization => None,
            State::StepComplete | State::StepFailed => Some(Integrator::Method),
            State::EventMode | State::ContinuousTime => Some(Integrator::Host),
            _ => Some(simulation.integrator()),
        };
        if simulation.time().map(|_| simulation.integrator()) != kinds {
            return Err(Damaged);
        }
        let Experiment { start, stop, tolerance, host_set_tolerance } = experiment;
        start.walk(walk)?;
        stop.walk(walk)?;
        tolerance.walk(walk)?;
        host_set_tolerance.walk(walk)?;
        step_failed.walk(walk)?;
        warned.walk(walk)?;
        learnt.walk(walk)?;
        doubted.walk(walk)
    }
}
