//! The scene that this FMU holds: the type of its effects, compiled in, and its values, which stand in a section of the library that is
//! written after it was built.

use split_rotor_model::{section, simulation};
use std::sync::atomic::{AtomicU8, Ordering};

include!(concat!(env!("OUT_DIR"), "/list.rs"));

/// The simulation of this scene.
pub type Simulation = simulation::Simulation<Effects, { simulation::numbers_of_state::<Effects>() }>;

/// As build.rs wrote it.
const BUILT: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/section"));

/// As it stands in the file. Atomic, and used by somebody whom the compiler does not see: so it reads what is there, and does not take
/// it for what it was built with.
#[used]
static SECTION: [AtomicU8; BUILT.len()] = {
    let mut bytes = [const { AtomicU8::new(0) }; BUILT.len()];
    let mut n = 0;
    while n < BUILT.len() {
        bytes[n] = AtomicU8::new(BUILT[n]);
        n += 1;
    }
    bytes
};

/// The GUID and the start values, as bytes.
pub struct Values([u8; BUILT.len()]);

/// What this library holds; check it first.
pub fn values() -> Values {
    Values(std::array::from_fn(|n| SECTION[n].load(Ordering::Relaxed)))
}

impl Values {
    /// Whether they are those of a scene, whole; else what is wrong.
    pub fn check(&self) -> Result<(), &'static str> {
        section::check(&self.0)
    }

    /// The GUID of its modelDescription.xml, in braces.
    pub fn guid(&self) -> &str {
        section::guid(&self.0)
    }

    /// The start value of each parameter and input, by value reference.
    pub fn starts(&self) -> impl Iterator<Item = (u32, f64)> + Clone {
        section::starts(&self.0)
    }
}
