//! The exported symbols of FMI 2.0, each one call through `crate::guard`.
#![allow(unsafe_code)]
#![allow(non_snake_case, reason = "the names of the standard")]
#![allow(
    clippy::missing_safety_doc,
    reason = "the contract is the same for all: that of FMI 2.0, which the host keeps"
)]

mod co_simulation;
mod common;
mod model_exchange;

pub use co_simulation::*;
pub use common::*;
pub use model_exchange::*;

use crate::abi::{Component, Status};
use crate::calls::Call;
use crate::guard;
use crate::instance::Failure;

/// Answers a function that is not there yet.
///
/// # Safety
/// As [`guard::enter`].
unsafe fn absent(component: Component, call: &Call, why: &str) -> Status {
    // SAFETY: the caller's promise.
    unsafe { guard::enter(component, call, |_| Err(Failure::error(why))) }
}
