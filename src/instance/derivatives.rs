//! Directional derivatives, exact.

use super::values::{Type, finite, shown, typed};
use super::{Failure, Instance, Reply, Room};
use split_rotor_model::variable::{Place, Role};

impl Instance {
    /// How the unknown variables change as the known ones change by the seeds.
    pub fn directional_derivative(
        &mut self,
        unknown: &[u32],
        known: &[u32],
        seeds: &[f64],
        sensitivities: Room<f64>,
    ) -> Reply {
        for reference in unknown {
            if !matches!(typed(*reference, Type::Real)?.role, Role::Output | Role::State) {
                let message = format!("{} is no unknown: outputs, states and derivatives are", shown(*reference));
                return Err(Failure::Error(message));
            }
        }
        for (reference, seed) in known.iter().zip(seeds) {
            let is_input = matches!(typed(*reference, Type::Real)?.role, Role::Input { .. });
            if !is_input && !self.memory.simulation.is_state(Place::of(*reference)) {
                return Err(Failure::Error(format!("{} is no known: inputs and states are", shown(*reference))));
            }
            if !seed.is_finite() {
                let name = shown(*reference);
                return Err(Failure::Error(format!("the seed {seed:?} of {name} must be a finite number")));
            }
        }
        let simulation = &mut self.memory.simulation;
        simulation.admits()?;
        let seeds = known.iter().map(|reference| Place::of(*reference)).zip(seeds.iter().copied());
        let tangents = simulation.tangents(seeds)?;
        for (reference, sensitivity) in unknown.iter().zip(sensitivities) {
            sensitivity.write(finite(*reference, tangents.of(Place::of(*reference)).unwrap_or(f64::NAN))?);
        }
        Ok(())
    }
}
