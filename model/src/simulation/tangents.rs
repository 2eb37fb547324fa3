//! Exact derivatives of what an instant shows, by dual numbers.

use crate::dual::Tangent;
use crate::effects::Effects;
use crate::state::{WITH_WORK, Whole};
use crate::variable::Place;
use crate::variables::{Parameters, Reading, state_number};

/// An instant that moves in one direction.
pub struct Tangents<E> {
    parameters: Parameters<E>,
    reading: Reading<Tangent>,
}

impl<E: Effects> Tangents<E> {
    /// Where states and inputs move by the seeds at their places.
    pub(super) fn new(
        parameters: &Parameters<E>,
        reading: &Reading,
        seeds: impl Iterator<Item = (Place, f64)>,
    ) -> Self {
        let mut parameters = parameters.clone();
        let mut moved = [0.0; WITH_WORK];
        for (place, seed) in seeds {
            if let Some(n) = state_number(place) {
                moved[n] += seed;
            } else if let Some(signal) = parameters.effects.signal_mut(place) {
                signal.ask(seed);
            }
        }
        Self { reading: reading.moving(&moved, 0.0, &parameters.effects), parameters }
    }

    /// Where everything moves with time, the state at these rates.
    pub(super) fn along_motion(parameters: &Parameters<E>, reading: &Reading, rates: &Whole<f64>) -> Self {
        let parameters = parameters.clone();
        Self { reading: reading.moving(rates, 1.0, &parameters.effects), parameters }
    }

    /// The derivative of the calculated variable at this place; None where there is none.
    pub fn of(&self, place: Place) -> Option<f64> {
        self.parameters.calculated(place, &self.reading).map(|tangent| tangent.eps[0])
    }
}
