//! The one place that names the scene's type: what build.rs wrote of the scene that this FMU holds.

use split_rotor_model::simulation;

include!(concat!(env!("OUT_DIR"), "/scene.rs"));

/// The simulation of this scene.
pub type Simulation = simulation::Simulation<Effects, { simulation::numbers_of_state::<Effects>() }>;
