//! FMU states: saved, brought back, freed, written down and read, damaged.

use super::check::{ERROR, OK, Told};
use super::source::Source;
use super::{Kept, MOST, Parcel, Theatre};
use crate::harness::{Instance, Saved};
use split_rotor::abi::*;
use split_rotor::exports::*;

impl Theatre {
    /// A call that has to do with saved states, by actor `n`.
    pub fn saving_call(&mut self, n: usize, source: &mut Source) {
        match source.below(8) {
            0..=1 => self.save(n, source),
            2..=3 => self.restore(n, source),
            4 => self.free(n, source),
            5 => self.serialize(n, source),
            6 => self.damage(source),
            _ => self.deserialize(n, source),
        }
    }

    fn save(&mut self, n: usize, source: &mut Source) {
        let actor = &mut self.actors[n];
        if source.chance(16) {
            // SAFETY: a live instance.
            let null = |instance: &mut Instance| unsafe { fmi2GetFMUstate(instance.component(), std::ptr::null_mut()) };
            actor.call(&Told { function: "fmi2GetFMUstate", may: ERROR }, null);
            return;
        }
        if self.shelf.len() < MOST {
            let saved = Saved::of(&actor.instance);
            let (memory, bytes) = (actor.mind.memory.clone(), saved.bytes(&actor.instance));
            self.shelf.push(Kept { saved, memory, bytes });
            return;
        }
        let kept = &mut self.shelf[source.below(MOST)];
        let told = Told { function: "fmi2GetFMUstate", may: OK };
        actor.call(&told, |instance| kept.saved.again(instance));
        kept.memory = actor.mind.memory.clone();
        kept.bytes = kept.saved.bytes(&actor.instance);
    }

    fn restore(&mut self, n: usize, source: &mut Source) {
        let actor = &mut self.actors[n];
        if self.shelf.is_empty() || source.chance(16) {
            // SAFETY: a live instance.
            let null = |instance: &mut Instance| unsafe { fmi2SetFMUstate(instance.component(), std::ptr::null_mut()) };
            actor.call(&Told { function: "fmi2SetFMUstate", may: ERROR }, null);
            return;
        }
        let kept = &self.shelf[source.below(self.shelf.len())];
        let fits = kept.memory.life.kind == actor.mind.memory.life.kind;
        let told = Told { function: "fmi2SetFMUstate", may: if fits { OK } else { ERROR } };
        if actor.call(&told, |instance| kept.saved.offer(instance)) == Status::Ok {
            assert!(actor.instance.serialized() == kept.bytes, "what was saved is not what came back");
            actor.mind.memory = kept.memory.clone();
            actor.look();
        }
    }

    fn free(&mut self, n: usize, source: &mut Source) {
        let actor = &mut self.actors[n];
        if self.shelf.is_empty() {
            // To free nothing is no error.
            let (mut null, place) = (std::ptr::null_mut(), std::ptr::null_mut());
            let place = if source.chance(128) { place } else { &raw mut null };
            let told = Told { function: "fmi2FreeFMUstate", may: OK };
            // SAFETY: a live instance, and null or a place that holds null.
            actor.call(&told, |instance| unsafe { fmi2FreeFMUstate(instance.component(), place) });
            return;
        }
        let kept = self.shelf.swap_remove(source.below(self.shelf.len()));
        kept.saved.free(&actor.instance);
    }

    fn serialize(&mut self, n: usize, source: &mut Source) {
        let actor = &mut self.actors[n];
        let Some(kept) = self.shelf.last() else { return };
        let (state, length) = (kept.saved.pointer(), kept.bytes.len());
        let mut size = 0;
        // SAFETY: a live instance, a saved state, a place to write to.
        actor.call(&Told { function: "fmi2SerializedFMUstateSize", may: OK }, |instance| unsafe {
            fmi2SerializedFMUstateSize(instance.component(), state, &raw mut size)
        });
        assert_eq!(size, length);
        let size = source.of(&[length, length, length, length + 1, length - 1, 0]);
        let mut bytes = vec![0x55_u8; length + 1];
        let told = Told { function: "fmi2SerializeFMUstate", may: if size == length { OK } else { ERROR } };
        // SAFETY: a live instance, a saved state, and room for at least as many bytes as told.
        let status = actor.call(&told, |instance| unsafe {
            fmi2SerializeFMUstate(instance.component(), state, bytes.as_mut_ptr().cast(), size)
        });
        let untouched = bytes.split_off(if status == Status::Ok { length } else { 0 });
        assert!(untouched.iter().all(|byte| *byte == 0x55), "more was written than told");
        assert!(status != Status::Ok || bytes == kept.bytes, "a saved state has changed on the shelf");
        if self.parcels.len() >= MOST {
            self.parcels.remove(0);
        }
        let whole = kept.bytes.clone();
        self.parcels.push(Parcel { bytes: whole.clone(), whole, memory: kept.memory.clone() });
    }

    /// Flips a bit, cuts or lengthens; done twice, that may leave the bytes whole.
    fn damage(&mut self, source: &mut Source) {
        let Some(Parcel { bytes, .. }) = self.parcels.last_mut() else { return };
        let place = (usize::from(source.byte()) << 8 | usize::from(source.byte())) % bytes.len().max(1);
        match source.below(3) {
            0 if !bytes.is_empty() => bytes[place] ^= 1 << source.below(8),
            1 if !bytes.is_empty() => bytes.truncate(place),
            _ => bytes.push(source.byte()),
        }
    }

    fn deserialize(&mut self, n: usize, source: &mut Source) {
        let actor = &mut self.actors[n];
        let parcel = if self.parcels.is_empty() { None } else { Some(&self.parcels[source.below(self.parcels.len())]) };
        let kind = actor.mind.memory.life.kind;
        let fits = parcel.filter(|parcel| parcel.bytes == parcel.whole && parcel.memory.life.kind == kind);
        let bytes = parcel.map_or(&[][..], |parcel| &parcel.bytes);
        let told = Told { function: "fmi2DeSerializeFMUstate", may: if fits.is_some() { OK } else { ERROR } };
        let mut read = None;
        actor.call(&told, |instance| match Saved::read(instance, bytes) {
            Ok(saved) => {
                read = Some(saved);
                Status::Ok
            }
            Err(status) => status,
        });
        let (Some(saved), Some(Parcel { memory, .. })) = (read, fits) else { return };
        assert!(saved.bytes(&actor.instance) == bytes, "what was read is not what was written");
        if self.shelf.len() < MOST {
            self.shelf.push(Kept { saved, memory: memory.clone(), bytes: bytes.to_vec() });
        } else {
            saved.free(&actor.instance);
        }
    }
}
