//! The tests of the exported functions in one program: what they stand on is compiled and linked once. Beside it stand what counts
//! allocations for itself, what other builds run too (`bits.rs`), and the house rules.
#![allow(unsafe_code, reason = "the exported functions are those of a C interface, and FMU states raw pointers")]

#[path = "../calls/mod.rs"]
mod calls;
#[path = "../harness/mod.rs"]
mod harness;

mod abi;
mod arguments;
mod derivatives;
mod exchange;
mod inputs;
mod log;
mod outputs;
mod random_calls;
mod serialized;
mod solver;
mod state;
mod stepping;
mod tight_tolerance;
