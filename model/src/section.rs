//! The bytes of a library that hold a scene's values, so that one library serves all scenes of the same effects: written into its file,
//! read back by the library itself.
//!
//! In this order, numbers little-endian: mark; CRC-32 of all that follows; CRC-32 of the list of effects; for how many start values there
//! is room; GUID; how many start values; value reference and start value of each; zeros.

use std::collections::BTreeMap;

/// What a section begins with; nothing else in a library has these bytes.
const MARK: [u8; 16] = *b"\x00rotor's values\x00";
const CHECKSUM: usize = MARK.len();
/// Where that begins which no scene changes: list and room.
const KIND: usize = CHECKSUM + 4;
const VALUES: usize = KIND + 8;
/// The length of a GUID in braces.
pub const GUID: usize = 38;
const COUNT: usize = VALUES + GUID;
const STARTS: usize = COUNT + 4;
/// A value reference, and a start value.
const START: usize = 4 + 8;

/// The section of a library for this list of effects, with room for so many start values, and none written.
pub fn blank(list: &str, room: usize) -> Vec<u8> {
    let kind = [crc32fast::hash(list.as_bytes()), room as u32].map(u32::to_le_bytes).concat();
    let mut section = [&MARK[..], &[0; KIND - CHECKSUM], &kind].concat();
    section.resize(STARTS + room * START, 0);
    section
}

/// Writes values into a section; it keeps its length.
///
/// # Panics
/// Where the GUID has another length than [`GUID`], or the section no room.
pub fn fill(section: &mut [u8], guid: &str, starts: &BTreeMap<u32, f64>) {
    section[VALUES..COUNT].copy_from_slice(guid.as_bytes());
    section[COUNT..STARTS].copy_from_slice(&(starts.len() as u32).to_le_bytes());
    let room = &mut section[STARTS..];
    room.fill(0);
    assert!(starts.len() * START <= room.len(), "there is room for {} start values", room.len() / START);
    for (place, (reference, value)) in room.chunks_exact_mut(START).zip(starts) {
        place[..4].copy_from_slice(&reference.to_le_bytes());
        place[4..].copy_from_slice(&value.to_le_bytes());
    }
    let sum = crc32fast::hash(&section[KIND..]);
    section[CHECKSUM..KIND].copy_from_slice(&sum.to_le_bytes());
}

/// The section in a library of this list of effects, with so much room. An error where it has none, several, or another's.
pub fn find<'l>(library: &'l mut [u8], list: &str, room: usize) -> Result<&'l mut [u8], String> {
    let all = library.windows(MARK.len()).enumerate();
    let marks: Vec<_> = all.filter(|(_, bytes)| *bytes == MARK).map(|(place, _)| place).collect();
    let [start] = marks[..] else { return Err(format!("it has {} sections of values instead of one", marks.len())) };
    let blank = blank(list, room);
    let section = library.get_mut(start..start + blank.len()).ok_or("its section of values is cut")?;
    if section[KIND..VALUES] != blank[KIND..VALUES] {
        return Err("it is that of another list of effects".into());
    }
    Ok(section)
}

/// Whether values were written into a section, and are as they were written; else what is wrong.
pub fn check(section: &[u8]) -> Result<(), &'static str> {
    if section[VALUES..].iter().all(|byte| *byte == 0) {
        return Err("no values of a scene were written into this library: `cargo xtask package` does that");
    }
    if section[CHECKSUM..KIND] != crc32fast::hash(&section[KIND..]).to_le_bytes() {
        return Err("the values of the scene in this library are damaged: their checksum is wrong");
    }
    Ok(())
}

/// The GUID in a section, in braces; of bytes that [`check`] refuses it may be empty.
pub fn guid(section: &[u8]) -> &str {
    str::from_utf8(&section[VALUES..COUNT]).unwrap_or_default()
}

/// The start values in a section.
pub fn starts(section: &[u8]) -> impl Iterator<Item = (u32, f64)> + Clone {
    let count = u32_at(section, COUNT) as usize;
    let start = |place: &[u8]| (u32_at(place, 0), f64::from_le_bytes(std::array::from_fn(|n| place[4 + n])));
    section[STARTS..].chunks_exact(START).take(count).map(start)
}

fn u32_at(bytes: &[u8], place: usize) -> u32 {
    u32::from_le_bytes(std::array::from_fn(|n| bytes[place + n]))
}
