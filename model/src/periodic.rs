//! What a machine does that turns at a steady speed, with all its laws as they stand: motions that repeat with each revolution, whether
//! they last, and how they change with the speed.
//!
//! The equations are those of the simulation, solved by it over a revolution: shooting, and continuation by arc length through folds.

mod branch;
mod orbit;
mod revolution;

pub use branch::{Branch, End};
pub use orbit::{Loss, Orbit, Path};
pub use revolution::{NUMBERS, Obstacle, Rotating, State};
