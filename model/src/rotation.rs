//! The split rotation L(ϑ) = L(γ)·L(φe): an axial angle φ about **e** = +x, then a transverse Euler vector γ ⟂ e.
//!
//! Notation of the paper (Sorokin and Zhang 2018). Every vector is in the inertial frame O.

pub mod angle;
pub mod arc;
mod attitude;
pub mod chart;
pub mod elliptic;
pub mod euler_vector;
pub mod exact;
pub mod free;
pub mod series;
pub mod split;

pub use angle::Angle;
pub use chart::Chart;
pub use free::{Turn, Turned, Winding};
pub use split::Tilt;
