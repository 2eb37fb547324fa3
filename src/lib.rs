//! split-rotor as an FMU: the shell around `model`, which holds the rotor.
//!
//! `instance` is what any version of FMI asks of a rotor; `fmi2` its functions under the names, types and rules of FMI 2.0;
//! `arguments` reads and writes the arrays of a host; `scene` is what build.rs compiled in.

mod arguments;
mod fmi2;
mod instance;
pub mod scene;

pub use fmi2::{abi, exports};
