//! Directional derivatives, exact.

use super::values::{Type, finite, shown, typed};
use super::{Failure, Instance, Reply};
use crate::abi::{Real, Status};
use crate::guard::Room;
use split_rotor_model::variable::{Place, Role};
use split_rotor_model::variables::state_number;

impl Instance {
    /// fmi2GetDirectionalDerivative: how the unknown variables change as the known ones change by the seeds.
    pub fn directional_derivative(
        &mut self,
        unknown: &[u32],
        known: &[u32],
        seeds: &[Real],
        sensitivities: Room<Real>,
    ) -> Reply {
        for reference in unknown {
            if !matches!(typed(*reference, Type::Real)?.role, Role::Output | Role::State) {
                let message = format!("{} is no unknown: outputs, states and derivatives are", shown(*reference));
                return Err(Failure::error(message));
            }
        }
        for (reference, seed) in known.iter().zip(seeds) {
            let is_input = matches!(typed(*reference, Type::Real)?.role, Role::Input { .. });
            if !is_input && state_number(Place::of(*reference)).is_none() {
                return Err(Failure::error(format!("{} is no known: inputs and states are", shown(*reference))));
            }
            if !seed.is_finite() {
                let name = shown(*reference);
                return Err(Failure::error(format!("the seed {seed:?} of {name} must be a finite number")));
            }
        }
        let simulation = &mut self.memory.simulation;
        simulation.admits()?;
        let seeds = known.iter().map(|reference| Place::of(*reference)).zip(seeds.iter().copied());
        let tangents = simulation.tangents(seeds)?;
        for (reference, sensitivity) in unknown.iter().zip(sensitivities) {
            sensitivity.write(finite(*reference, tangents.of(Place::of(*reference)).unwrap_or(Real::NAN))?);
        }
        Ok(Status::Ok)
    }
}
