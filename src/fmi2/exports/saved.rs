//! Saved FMU states (FMI 2.0.4, section 2.1.8).

use crate::arguments::{place, room, values};
use crate::fmi2::abi::*;
use crate::instance::{Failure, Memory, fill};

const NULL: &str = "FMUstate is a null pointer";

/// The saved state behind a pointer.
///
/// # Safety
/// `state` is null or came from fmi2GetFMUstate or fmi2DeSerializeFMUstate and was not freed.
unsafe fn memory<'a>(state: FmuState) -> Result<&'a Memory, Failure> {
    // SAFETY: see above.
    unsafe { state.cast::<Memory>().as_ref() }.ok_or_else(|| Failure::Error(NULL.into()))
}

export! {
    /// Saves all that the instance holds; an object saved before is used again.
    fmi2GetFMUstate(instance, state: *mut FmuState) {
        let place = state.as_mut().ok_or_else(|| Failure::Error(NULL.into()))?;
        match place.cast::<Memory>().as_mut() {
            Some(saved) => saved.clone_from(&instance.memory),
            None => *place = Box::into_raw(Box::new(instance.memory.clone())).cast(),
        }
        Ok(())
    }

    /// Brings back all that was saved.
    fmi2SetFMUstate(instance, state: FmuState) { instance.restore(memory(state)?) }

    /// Frees a saved state, and makes the pointer null; a null state is left alone.
    fmi2FreeFMUstate(_instance, state: *mut FmuState) {
        if let Some(place) = state.as_mut().filter(|place| !place.is_null()) {
            drop(Box::from_raw(std::mem::replace(place, std::ptr::null_mut()).cast::<Memory>()));
        }
        Ok(())
    }

    /// How many bytes a saved state takes.
    fmi2SerializedFMUstateSize(_instance, state: FmuState, size: *mut Size) {
        place(size, "size")?.write(memory(state)?.to_bytes().len());
        Ok(())
    }

    /// Writes a saved state down as bytes.
    fmi2SerializeFMUstate(_instance, state: FmuState, bytes: *mut Byte, size: Size) {
        let written = memory(state)?.to_bytes();
        if size != written.len() {
            let message = format!("size = {size} must be {}, as fmi2SerializedFMUstateSize says", written.len());
            return Err(Failure::Error(message));
        }
        fill(room(bytes.cast(), size, "serializedState")?, &written);
        Ok(())
    }

    /// A saved state from its bytes; what the pointer was is not looked at.
    fmi2DeSerializeFMUstate(instance, bytes: *const Byte, size: Size, state: *mut FmuState) {
        let read = values(bytes.cast(), size, "serializedState")?;
        place(state, "FMUstate")?.write(Box::into_raw(Box::new(instance.memory_of(read)?)).cast());
        Ok(())
    }
}
