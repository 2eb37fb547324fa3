//! The one place that names the scene's type: what build.rs wrote of the scene that this FMU holds.

include!(concat!(env!("OUT_DIR"), "/scene.rs"));

/// The simulation of this scene.
pub type Simulation = split_rotor_model::simulation::Simulation<Effects>;
