//! What a machine does that turns at a steady speed, with all its laws as they stand: motions that repeat with each revolution, whether
//! they last, and how they change with the speed.
//!
//! The equations are those of the simulation, solved by it over a revolution: shooting, and continuation by arc length through folds.
//! So laws that switch are located as in any run, and bodies whose equations change as they turn need nothing more; harmonic balance would
//! need a ring's law in many harmonics.

mod branch;
mod orbit;
mod revolution;

pub use branch::{Branch, End};
pub use orbit::{Loss, Orbit, Path};
pub use revolution::{NUMBERS, Obstacle, Rotating, State};
