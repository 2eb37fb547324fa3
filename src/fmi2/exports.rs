//! The exported symbols of FMI 2.0, each one call through `guard`.
#![allow(unsafe_code)]
#![allow(non_snake_case, reason = "the names of the standard")]
#![allow(
    clippy::missing_safety_doc,
    reason = "the contract is the same for all: that of FMI 2.0, which the host keeps"
)]

/// Exports functions that take an instance, each under its name in the standard and in [`super::calls`].
macro_rules! export {
    ($($(#[$doc:meta])* $name:ident($instance:ident $(, $argument:ident: $type:ty)*) $body:block)*) => {$(
        $(#[$doc])*
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(component: Component $(, $argument: $type)*) -> Status {
            // SAFETY: the host keeps the contract of the standard, which is that of the door and of what reads and writes
            // its arguments. A saved state that is not null came from fmi2GetFMUstate or fmi2DeSerializeFMUstate.
            unsafe { crate::fmi2::guard::enter(component, &crate::fmi2::calls::call::$name, |$instance| $body) }
        }
    )*};
}

mod co_simulation;
mod life;
mod model_exchange;
mod saved;
mod values;

pub use co_simulation::*;
pub use life::*;
pub use model_exchange::*;
pub use saved::*;
pub use values::*;
