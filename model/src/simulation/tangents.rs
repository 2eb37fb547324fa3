//! Exact derivatives of what an instant shows, by dual numbers.

use crate::dual::Tangent;
use crate::effects::Effects;
use crate::state::WITH_WORK;
use crate::variable::Place;
use crate::variables::{Instant, Parameters};

/// An instant that moves in one direction.
pub struct Tangents<E, const N: usize = WITH_WORK> {
    parameters: Parameters<E>,
    instant: Instant<N, Tangent>,
}

impl<E: Effects, const N: usize> Tangents<E, N> {
    /// Where states and inputs move by the seeds at their places.
    pub(super) fn new(
        parameters: &Parameters<E>,
        instant: &Instant<N>,
        seeds: impl Iterator<Item = (Place, f64)>,
    ) -> Self {
        let mut parameters = parameters.clone();
        let mut moved = [0.0; N];
        for (place, seed) in seeds {
            if let Some(n) = parameters.number_in_state::<N>(place) {
                moved[n] += seed;
            } else if let Some(signal) = parameters.effects.signal_mut(place) {
                signal.ask(seed);
            }
        }
        Self { instant: instant.moving(&moved, 0.0, &parameters.effects), parameters }
    }

    /// Where everything moves with time, the state at these rates.
    pub(super) fn along_motion(parameters: &Parameters<E>, instant: &Instant<N>, rates: &[f64; N]) -> Self {
        let parameters = parameters.clone();
        Self { instant: instant.moving(rates, 1.0, &parameters.effects), parameters }
    }

    /// The derivative of the calculated variable at this place; None where there is none.
    pub fn of(&self, place: Place) -> Option<f64> {
        self.parameters.tangent(place, &self.instant).map(|tangent| tangent.eps[0])
    }
}
