//! split-rotor as an FMI 2.0 co-simulation FMU: the shell around `model`, which holds the rotor.
//!
//! `abi` names the C types, `exports` the 44 functions, each one line through the door in `guard`; `calls` tells where a
//! function is legal, `instance` what it means, `logger` speaks to the host, `scene` is what build.rs compiled in.

pub mod abi;
mod calls;
pub mod exports;
mod guard;
mod instance;
mod logger;
pub mod scene;
