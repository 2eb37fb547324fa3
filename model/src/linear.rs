//! The machine as rotor engineers look at it first: where it runs steadily, and how it whirls about that.
//!
//! Balanced, with its drives off, its spin held, and whatever else acts on it as in a run: the equations are those of the
//! simulation, and their derivatives those of `stiff`.

mod campbell;
mod crossings;
mod machine;
mod modes;
mod response;
mod state_space;

pub use campbell::{Branch, Campbell, Point};
pub use crossings::Crossing;
pub(crate) use machine::stop_drives;
pub use machine::{Machine, Obstacle, STATES, Steady, balanced};
pub use modes::{Direction, Mode, Shape};
pub use response::{Orbit, Response};
pub use state_space::{Quantity, StateSpace};
