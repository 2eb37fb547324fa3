//! Bytes from libFuzzer as a sequence of FMI calls: `tests/calls` makes them and checks each.
#![no_main]

#[path = "../../tests/calls/mod.rs"]
#[allow(dead_code, unused_imports, reason = "the tally is for the random tests")]
mod calls;
#[path = "../../tests/harness/mod.rs"]
mod harness;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| calls::play(bytes));
