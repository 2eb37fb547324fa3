//! A saved FMU state, as a host holds it.

use super::Instance;
use split_rotor::abi::{FmuState, Status};
use split_rotor::exports::*;
use std::ptr::null_mut;

/// What fmi2GetFMUstate or fmi2DeSerializeFMUstate gave; not freed by itself, since that takes an instance.
#[derive(Debug)]
pub struct Saved(FmuState);

impl Saved {
    /// The state of an instance.
    pub fn of(instance: &Instance) -> Self {
        let mut saved = Self(null_mut());
        assert_eq!(saved.again(instance), Status::Ok);
        assert!(!saved.0.is_null());
        saved
    }

    /// Saves into the same object.
    pub fn again(&mut self, instance: &Instance) -> Status {
        // SAFETY: a live instance; null, or a state of this FMU's.
        unsafe { fmi2GetFMUstate(instance.component(), &raw mut self.0) }
    }

    /// fmi2SetFMUstate, whatever it returns.
    pub fn offer(&self, instance: &Instance) -> Status {
        // SAFETY: a live instance and a state of this FMU's.
        unsafe { fmi2SetFMUstate(instance.component(), self.0) }
    }

    /// fmi2SetFMUstate, which must work.
    pub fn restore(&self, instance: &Instance) {
        assert_eq!(self.offer(instance), Status::Ok, "{:?}", instance.journal.take());
    }

    /// As bytes.
    pub fn bytes(&self, instance: &Instance) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: a live instance, a state of this FMU's, a place to write to.
        assert_eq!(unsafe { fmi2SerializedFMUstateSize(instance.component(), self.0, &raw mut size) }, Status::Ok);
        let mut bytes = vec![0_u8; size];
        // SAFETY: the same, and room for as many bytes as told.
        let status =
            unsafe { fmi2SerializeFMUstate(instance.component(), self.0, bytes.as_mut_ptr().cast(), bytes.len()) };
        assert_eq!(status, Status::Ok);
        bytes
    }

    /// From bytes; what was returned where they are refused, with the pointer left alone.
    pub fn read(instance: &Instance, bytes: &[u8]) -> Result<Self, Status> {
        let untouched = std::ptr::dangling_mut::<u64>().cast();
        let mut state: FmuState = untouched;
        // SAFETY: a live instance, as many bytes as told, and a place to write to, whose value is not looked at.
        let status = unsafe {
            fmi2DeSerializeFMUstate(instance.component(), bytes.as_ptr().cast(), bytes.len(), &raw mut state)
        };
        if status == Status::Ok {
            assert!(!state.is_null() && state != untouched);
            return Ok(Self(state));
        }
        assert_eq!(state, untouched, "a refusal leaves the pointer alone");
        Err(status)
    }

    /// Brings an instance to where the bytes were written.
    #[track_caller]
    pub fn unpack(instance: &Instance, bytes: &[u8]) {
        let saved = Self::read(instance, bytes).unwrap_or_else(|_| panic!("{:?}", instance.journal.take()));
        saved.restore(instance);
        saved.free(instance);
    }

    /// fmi2FreeFMUstate.
    pub fn free(mut self, instance: &Instance) {
        // SAFETY: a live instance and a state of this FMU's, which nobody uses any more.
        assert_eq!(unsafe { fmi2FreeFMUstate(instance.component(), &raw mut self.0) }, Status::Ok);
        assert!(self.0.is_null());
    }

    /// The pointer of the C interface.
    pub fn pointer(&self) -> FmuState {
        self.0
    }
}
